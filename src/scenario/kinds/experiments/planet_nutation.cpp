// SPDX-License-Identifier: MIT
#include "polhode/detail/scenario/planet_nutation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ephemeris/delaunay.hpp"
#include "math/number_text.hpp"
#include "orbit/mean_ellipse.hpp"
#include "polhode/ephemeris/ephemeris.hpp"
#include "polhode/error.hpp"
#include "polhode/secular/planet.hpp"
#include "polhode/text/separated.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using polhode::detail::number_text;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double arcsec = degree / 3600.0;
constexpr double day = 86400.0;
constexpr double century = 36525.0 * day;
constexpr double au = 149597870.7;  // km, IAU 2012

[[noreturn]] void refuse(const std::string& why) { throw DomainError("PlanetNutation: " + why); }

void require(const PlanetNutation& of) {
  if (!(std::abs(of.T) <= 10.0))
    refuse("T " + number_text(of.T) + " must be within 10 centuries of J2000: years 1000 to 3000");
  const auto within = [](const std::optional<double>& value, const char* name, double least,
                         double largest) {
    if (value && !(*value >= least && *value <= largest))
      refuse(std::string(name) + " " + number_text(*value) + " must be in [" + number_text(least) +
             ", " + number_text(largest) + "]");
  };
  within(of.ellipticity, "ellipticity", 1e-9, 0.5);
  within(of.triaxiality, "triaxiality", 0.0, 0.5);
  within(of.satellite_mass, "satellite_mass", 1e-9, 1.0);
  within(of.spin_rate, "spin_rate (rad/s)", 1e-9, 1e-2);
  within(of.obliquity, "obliquity (rad)", 1e-3, std::numbers::pi - 1e-3);
  within(of.least, "least (rad)", 1e-18, 1e-3);
}

// Axis 1 = the smallest moment, in units of C.
Body body_of(double ellipticity, double triaxiality) {
  return {1.0 - ellipticity - 0.5 * triaxiality, 1.0 - ellipticity + 0.5 * triaxiality, 1.0};
}

ephemeris::DelaunayArguments delaunay(std::span<const double> at) {
  return {at[0], at[1], at[2], at[3], at[4]};
}

// Of IAU 2006 (Capitaine et al. 2003): eps_A, and the rate of the ecliptic's pole P_A, Q_A, in axes
// of date.
double earth_obliquity(double T) {
  return arcsec * (84381.406 - T * (46.836769 + T * (0.0001831 - T * 0.00200340)));
}
Vec3 earth_ecliptic_rate(double T) {
  const double Q = (-46.811015 + 2.0 * 0.0510283 * T) * arcsec / century;
  const double P = (4.199094 + 2.0 * 0.1939873 * T) * arcsec / century;
  const double general = 5028.796195 * T * arcsec;  // the equinox since J2000
  return {Q * std::cos(general) - P * std::sin(general),
          Q * std::sin(general) + P * std::cos(general), 0.0};
}

// Of Sun and Moon on the Earth, 2/3 H gm / a^3 cos(obliquity) over the spin left out: mean
// distances and eccentricities, the inclination of the Moon.
double mean_pull(double satellite_mass) {
  const auto pull = [](double gm, double a, double e, double i) {
    return gm / (a * a * a) * std::pow(1.0 - e * e, -1.5) * (1.0 - 1.5 * std::sin(i) * std::sin(i));
  };
  return pull(ephemeris::planetary_gm(ephemeris::Planetary::sun), au, 0.0167, 0.0) +
         pull(satellite_mass * ephemeris::planetary_gm(ephemeris::Planetary::earth), 384399.0,
              0.0549, 5.145 * degree);
}

// What the equinox of this Earth precesses by more than that of the real one, whose longitudes
// delaunay_rates has: rad a century.
double more_precession(const PlanetNutation& of) {
  constexpr double observed = 5038.481507 * arcsec;  // psi_A of IAU 2006
  const auto torque = [](const PlanetNutation& earth) {
    return *earth.ellipticity / *earth.spin_rate * std::cos(*earth.obliquity) *
           mean_pull(*earth.satellite_mass);
  };
  PlanetNutation real;
  real.T = of.T;
  return observed * (torque(of) / torque(completed(real)) - 1.0);
}

secular::NutationProblem earth_problem(const PlanetNutation& of) {
  const double T = of.T;
  ephemeris::DelaunayArguments at = ephemeris::delaunay_arguments(T),
                               rate = ephemeris::delaunay_rates(T);
  // Om is the one longitude among them.
  const double more = more_precession(of);
  rate.Om += more;
  at.Om += more * T;
  const auto argument = [](const char* name, double at_epoch, double per_century, int points) {
    return secular::NutationArgument{name, at_epoch, per_century / century, points};
  };
  const double gm_moon = *of.satellite_mass * ephemeris::planetary_gm(ephemeris::Planetary::earth);
  return {body_of(*of.ellipticity, *of.triaxiality),
          *of.spin_rate,
          *of.obliquity,
          {argument("l", at.l, rate.l, 11), argument("lp", at.lp, rate.lp, 7),
           argument("F", at.F, rate.F, 11), argument("D", at.D, rate.D, 11),
           argument("Om", at.Om, rate.Om, 7)},
          {{ephemeris::planetary_gm(ephemeris::Planetary::sun),
            [T](std::span<const double> x) { return ephemeris::sun_of_date(delaunay(x), T); }},
           {gm_moon,
            [T](std::span<const double> x) {
              return ephemeris::cartesian(ephemeris::moon_of_date(delaunay(x), T));
            }}},
          earth_ecliptic_rate(T),
          of.order,
          of.least,
          // The one slower combination, 2F - 2D + 2Om - 2l' in 10,467 years, is a secular change to
          // the theory of the Moon too: its divisor would make 21 mas of what Meeus leaves out.
          2.0 * std::numbers::pi / (10.0 * century)};
}

// Mean elements of planets under the Sun only, Simon et al. (1994), equinox of J2000: au, deg,
// arcsec; rates per century, whereas the source gives those of e and the perihelion per thousand
// years.
struct MeanElements {
  double a, e, e_rate, mean_motion, mean_longitude, perihelion, perihelion_rate, inclination, node;
};
constexpr MeanElements of_venus = {0.72332982,     0.0067719164, -0.00004776521,
                                   58517.81567425, 181.97980085, 131.56370300,
                                   17.548640,      3.39466189,   76.67992019};
constexpr MeanElements of_mars = {1.5236793419,   0.0934006477, 0.00009048438,
                                  19140.30268499, 355.43299958, 336.06023395,
                                  1598.045908,    1.84972648,   49.55809321};

const MeanElements& elements_of(const std::string& planet) {
  return planet == "venus" ? of_venus : of_mars;
}

struct Orbit {
  double a, e, mean_motion, perihelion, perihelion_rate, mean_longitude;
};

Orbit orbit_of(const std::string& planet, double T) {
  const MeanElements& of = elements_of(planet);
  const double rate = of.perihelion_rate * arcsec;
  return {of.a * au,
          of.e + of.e_rate * T,
          of.mean_motion * degree / century,
          of.perihelion * degree + rate * T,
          rate / century,
          (of.mean_longitude + of.mean_motion * T) * degree};
}

struct Equator {
  double equinox;    // in the longitudes of the planet's orbit
  double obliquity;  // of the momentum, and so above 90 deg for Venus
};

// At J2000, by the poles of equator (IAU) and orbit.
Equator equator_of(const std::string& planet) {
  const double i = elements_of(planet).inclination * degree;
  const double node = elements_of(planet).node * degree;
  const Vec3 normal{std::sin(i) * std::sin(node), -std::sin(i) * std::cos(node), std::cos(i)};
  const Vec3 ascending{std::cos(node), std::sin(node), 0.0};
  // Venus turns backward: its momentum is opposite to the pole of the IAU (Archinal et al. 2018).
  const Vec3 momentum = planet == "venus"
                            ? -secular::ecliptic_direction(272.76 * degree, 67.16 * degree)
                            : secular::planet_pole(secular::known_planet("mars"));
  const Vec3 equinox = cross(momentum, normal);
  return {node + std::atan2(dot(normal, cross(ascending, equinox)), dot(ascending, equinox)),
          std::atan2(norm(equinox), dot(momentum, normal))};
}

secular::NutationProblem planet_problem(const PlanetNutation& of) {
  const Orbit orbit = orbit_of(of.planet, of.T);
  // The equinox moves with the precession that the torque makes, from where it is at J2000.
  const double spin = *of.spin_rate;
  const double precession = -1.5 * orbit.mean_motion * orbit.mean_motion / spin * *of.ellipticity *
                            std::cos(*of.obliquity) * std::pow(1.0 - orbit.e * orbit.e, -1.5);
  const double equinox = equator_of(of.planet).equinox + precession * century * of.T;
  const double Ls = orbit.mean_longitude - equinox + std::numbers::pi;
  const double M = orbit.mean_longitude - orbit.perihelion;
  const double e = orbit.e, a = orbit.a;
  const auto sun = [e, a](std::span<const double> x) {
    return on_ellipse(a, e, x[0], x[1] - x[0]);
  };
  return {body_of(*of.ellipticity, *of.triaxiality),
          spin,
          *of.obliquity,
          {{"M", M, orbit.mean_motion - orbit.perihelion_rate, 41},
           {"Ls", Ls, orbit.mean_motion - precession, 7}},
          {{ephemeris::planetary_gm(ephemeris::Planetary::sun), sun}},
          {0.0, 0.0, 0.0},
          of.order,
          of.least,
          2.0 * std::numbers::pi / (10.0 * century)};
}

secular::NutationProblem problem_of(const PlanetNutation& all) {
  return all.planet == "earth" ? earth_problem(all) : planet_problem(all);
}

}  // namespace

double julian_centuries(const ephemeris::Date& date) {
  return ephemeris::seconds_between({ephemeris::TimeScale::TDB, 2451545.0, 0.0}, date) / century;
}

PlanetNutation completed(const PlanetNutation& of) {
  require(of);
  PlanetNutation all = of;
  const auto missing = [](std::optional<double>& value, double known) {
    if (!value) value = known;
  };
  if (of.planet == "earth") {
    missing(all.ellipticity, 0.0032737548);
    missing(all.triaxiality, 0.0);
    missing(all.spin_rate, 7.292115e-5);
    missing(all.obliquity, earth_obliquity(of.T));
    missing(all.satellite_mass, ephemeris::planetary_gm(ephemeris::Planetary::moon) /
                                    ephemeris::planetary_gm(ephemeris::Planetary::earth));
    return all;
  }
  const std::vector<std::string_view> known = separated(nutation_planets, '|');
  if (std::ranges::find(known, of.planet) == known.end())
    refuse("got the planet \"" + of.planet + "\"; expected " + detail::one_of(known));
  if (of.satellite_mass) refuse("satellite_mass: " + of.planet + " has no satellite here");
  if (of.planet == "venus") {
    missing(all.ellipticity, 1.31e-5);
    missing(all.triaxiality, 4.0 * 1.66e-6);
    missing(all.spin_rate, 2.0 * std::numbers::pi / (243.02 * day));
  } else {
    missing(all.ellipticity, secular::known_planet("mars").ellipticity);
    missing(all.triaxiality, 0.0);
    missing(all.spin_rate, secular::known_planet("mars").spin_rate);
  }
  missing(all.obliquity, equator_of(of.planet).obliquity);
  return all;
}

secular::NutationProblem nutation_problem(const PlanetNutation& of) {
  return problem_of(completed(of));
}

secular::NutationTheory nutation_theory(const PlanetNutation& of) {
  const PlanetNutation all = completed(of);
  // Obliquity and eccentricities change evenly.
  const auto at = [&](double T) {
    PlanetNutation then = all;
    then.T = T;
    if (all.planet == "earth") *then.obliquity += earth_obliquity(T) - earth_obliquity(all.T);
    return secular::NutationTheory(problem_of(then));
  };
  return at(all.T).changing(at(all.T - 0.5), at(all.T + 0.5), century);
}

std::vector<Citation> nutation_citations() {
  return {
      {"kinoshita1977",
       "Kinoshita, H. (1977). Theory of the rotation of the rigid Earth. Celestial Mechanics 15, "
       "277-326.",
       "the theory of nutation"},
      {"souchay1996",
       "Souchay, J., Kinoshita, H. (1996). Corrections and new developments in rigid Earth "
       "nutation "
       "theory. I. Lunisolar influence including indirect planetary effects. Astronomy and "
       "Astrophysics 312, 1017-1030.",
       "the dynamical ellipticity of the Earth"},
      {"meeus1998",
       "Meeus, J. (1998). Astronomical Algorithms, 2nd edition. Willmann-Bell, Richmond.",
       "the Moon in Delaunay's arguments"},
      {"capitaine2003",
       "Capitaine, N., Wallace, P. T., Chapront, J. (2003). Expressions for IAU 2000 precession "
       "quantities. Astronomy and Astrophysics 412, 567-586.",
       "the obliquity and the moving ecliptic of the Earth"},
      {"simon1994",
       "Simon, J. L., Bretagnon, P., Chapront, J., Chapront-Touze, M., Francou, G., Laskar, J. "
       "(1994). Numerical expressions for precession formulae and mean elements for the Moon and "
       "the planets. Astronomy and Astrophysics 282, 663-683.",
       "mean elements"},
      {"park2021",
       "Park, R. S., Folkner, W. M., Williams, J. G., Boggs, D. H. (2021). The JPL planetary and "
       "lunar ephemerides DE440 and DE441. The Astronomical Journal 161, 105.",
       "masses"},
      {"cottereau2009",
       "Cottereau, L., Souchay, J. (2009). Rotation of rigid Venus: a complete precession-nutation "
       "model. Astronomy and Astrophysics 507, 1635-1648.",
       "the moments and the spin of Venus"},
      {"konopliv2016",
       "Konopliv, A. S., Park, R. S., Folkner, W. M. (2016). An improved JPL Mars gravity field "
       "and "
       "orientation from Mars orbiter and lander tracking data. Icarus 274, 253-260.",
       "the moments of Mars"}};
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
