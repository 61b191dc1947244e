// SPDX-License-Identifier: MIT
#include "polhode/run/citations.hpp"

#include <algorithm>
#include <string_view>

#include "polhode/scenario/schema.hpp"
#include "run/detail/experiment_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace {

struct Paper {
  std::string_view key;
  std::string_view text;
  std::string_view reason;
  // What of a scenario rests on it, parts_of joined by "|"; empty: every scenario.
  std::string_view uses;
};

// The place of those that charts rest on.
constexpr Paper of_charts = {};

constexpr Paper papers[] = {
    {"gurfil2007",
     "Gurfil, P., Elipe, A., Tangren, W., Efroimsky, M. (2007). The Serret-Andoyer formalism in "
     "rigid-body dynamics: I. Symmetries and perturbations. Regular and Chaotic Dynamics 12, "
     "389-425.",
     "the equations and the notation", ""},
    {"jacobi1850",
     "Jacobi, C. G. J. (1850). Sur la rotation d'un corps. Journal fuer die reine und angewandte "
     "Mathematik 39, 293-350.",
     "the attitude in theta functions", ""},
    {"carlson1995",
     "Carlson, B. C. (1995). Numerical computation of real or complex elliptic integrals. "
     "Numerical Algorithms 10, 13-26.",
     "the elliptic integrals", ""},
    {"kaasalainen2001",
     "Kaasalainen, M. (2001). Interpretation of lightcurves of precessing asteroids. Astronomy "
     "and Astrophysics 376, 302-309.",
     "the observers' description of a tumbler", "tumbler"},
    {"pravec2014",
     "Pravec, P., et al. (2014). The tumbling spin state of (99942) Apophis. Icarus 233, 48-60.",
     "the convention of its angles", "tumbler"},
    of_charts,
    {"efroimsky2007",
     "Efroimsky, M., Escapa, A. (2007). The theory of canonical perturbations applied to attitude "
     "dynamics and to the Earth rotation. Osculating and nonosculating Andoyer variables. "
     "Celestial "
     "Mechanics and Dynamical Astronomy 98, 251-283.",
     "osculating and canonical elements, and which angular velocity is which",
     "moving frame|convective|omega_rel|andoyer_osc|euler_osc|axes_rel"},
    {"wertz1978",
     "Wertz, J. R. (ed.) (1978). Spacecraft Attitude Determination and Control. Reidel, Dordrecht.",
     "the force of sunlight on a facet", "solar-pressure"},
    {"montenbruck2000", "Montenbruck, O., Gill, E. (2000). Satellite Orbits. Springer, Berlin.",
     "umbra and penumbra", "solar-pressure"},
    {"schaaf1961",
     "Schaaf, S. A., Chambre, P. L. (1961). Flow of Rarefied Gases. Princeton University Press.",
     "the force of free molecules on a facet", "drag"},
    {"markley1995",
     "Markley, F. L. (1995). Kepler equation solver. Celestial Mechanics and Dynamical Astronomy "
     "63, 101-111.",
     "orbits", "orbit"},
    {"erfa",
     "ERFA, Essential Routines for Fundamental Astronomy, from the SOFA software of the "
     "International Astronomical Union. github.com/liberfa/erfa.",
     "positions of Sun, Moon and planets, and time scales", "ephemeris"},
    {"moisson2001",
     "Moisson, X., Bretagnon, P. (2001). Analytical planetary solution VSOP2000. Celestial "
     "Mechanics and Dynamical Astronomy 80, 205-213.",
     "positions of the Earth", "earth"},
    {"meeus1998",
     "Meeus, J. (1998). Astronomical Algorithms, 2nd edition. Willmann-Bell, Richmond.",
     "positions of the Moon", "moon"},
    {"simon1994",
     "Simon, J. L., Bretagnon, P., Chapront, J., Chapront-Touze, M., Francou, G., Laskar, J. "
     "(1994). Numerical expressions for precession formulae and mean elements for the Moon and the "
     "planets. Astronomy and Astrophysics 282, 663-683.",
     "positions of the planets, mean elements of the Moon", "planet|moon"},
    {"park2021",
     "Park, R. S., Folkner, W. M., Williams, J. G., Boggs, D. H. (2021). The JPL planetary and "
     "lunar ephemerides DE440 and DE441. The Astronomical Journal 161, 105.",
     "gravitational parameters", "DE440"},
    {"ccsds502",
     "Consultative Committee for Space Data Systems (2023). Orbit Data Messages. Recommended "
     "Standard CCSDS 502.0-B-3.",
     "the file of an orbit", "oem"},
    {"ccsds504",
     "Consultative Committee for Space Data Systems (2024). Attitude Data Messages. Recommended "
     "Standard CCSDS 504.0-B-2.",
     "files of attitudes", "aem"},
    {"praly2012",
     "Praly, N., Hillion, M., Bonnal, C., Laurent-Varin, J., Petit, N. (2012). Study on the eddy "
     "current damping of the spin dynamics of space debris from the Ariane launcher upper stages. "
     "Acta Astronautica 76, 145-153.",
     "the torque on eddy currents", "eddy-currents"},
    {"thebault2015",
     "Thebault, E., et al. (2015). International Geomagnetic Reference Field: the 12th generation. "
     "Earth, Planets and Space 67, 79.",
     "the dipole field and its Gauss coefficients", "eddy-currents|residual-dipole"},
    {"verner2010",
     "Verner, J. H. (2010). Numerically optimal Runge-Kutta pairs with interpolants. Numerical "
     "Algorithms 53, 383-396.",
     "the integration", "adaptive"},
    {"butcher1964",
     "Butcher, J. C. (1964). Implicit Runge-Kutta processes. Mathematics of Computation 18, 50-64.",
     "collocation at Gauss' nodes", "variation of constants"},
    {"celledoni2008",
     "Celledoni, E., Fasso, F., Saefstroem, N., Zanna, A. (2008). The exact computation of the "
     "free "
     "rigid body motion and its use in splitting methods. SIAM Journal on Scientific Computing 30, "
     "2084-2112.",
     "splitting with the exact free rotor", "splitting"},
    {"blanesmoan2002",
     "Blanes, S., Moan, P. C. (2002). Practical symplectic partitioned Runge-Kutta and "
     "Runge-Kutta-Nystroem methods. Journal of Computational and Applied Mathematics 142, 313-330.",
     "the splitting of order 4", "order4"},
    {"kahanli1997",
     "Kahan, W., Li, R.-C. (1997). Composition constants for raising the orders of unconventional "
     "schemes for ordinary differential equations. Mathematics of Computation 66, 1089-1099.",
     "the splittings of order 6 and 8", "order6|order8"},
    {"blanes2013",
     "Blanes, S., Casas, F., Farres, A., Laskar, J., Makazaga, J., Murua, A. (2013). New families "
     "of symplectic splitting methods for numerical integration in dynamical astronomy. Applied "
     "Numerical Mathematics 68, 58-72.",
     "the splitting for near-integrable systems", "near-integrable"},
    {"benettin1976",
     "Benettin, G., Galgani, L., Strelcyn, J.-M. (1976). Kolmogorov entropy and numerical "
     "experiments. Physical Review A 14, 2338-2345.",
     "the Lyapunov indicator", "chaos"},
    {"cincotta2000",
     "Cincotta, P. M., Simo, C. (2000). Simple tools to study global dynamics in non-axisymmetric "
     "galactic potentials - I. Astronomy and Astrophysics Supplement Series 147, 205-228.",
     "MEGNO", "chaos"},
    {"mignard1979",
     "Mignard, F. (1979). The evolution of the lunar orbit revisited. I. The Moon and the Planets "
     "20, 301-315.",
     "tides with a constant time lag", "tide"},
    {"hut1981",
     "Hut, P. (1981). Tidal evolution in close binary systems. Astronomy and Astrophysics 99, "
     "126-140.",
     "tides with a constant time lag", "tide"},
    {"burns1973",
     "Burns, J. A., Safronov, V. S. (1973). Asteroid nutation angles. Monthly Notices of the Royal "
     "Astronomical Society 165, 403-411.",
     "the time in which a wobble dies", "anelastic-damping"},
    {"kane1966",
     "Kane, T. R., Barba, P. M. (1966). Effects of energy dissipation on a spinning satellite. "
     "AIAA "
     "Journal 4, 1392-1394.",
     "a sphere in a cavity that damps", "kane-damper"},
    {"fritsch1984",
     "Fritsch, F. N., Butland, J. (1984). A method for constructing local monotone piecewise cubic "
     "interpolants. SIAM Journal on Scientific and Statistical Computing 5, 300-304.",
     "torque tables by cubics", "torque-table"},
};

struct MethodParts {
  std::vector<std::string> operator()(const Adaptive&) const { return {"adaptive"}; }
  std::vector<std::string> operator()(const VariationOfConstants&) const {
    return {"variation of constants"};
  }
  std::vector<std::string> operator()(const Splitting& m) const {
    switch (m.scheme) {
      case SplittingScheme::order2:
        return {"splitting"};
      case SplittingScheme::order4:
        return {"splitting", "order4"};
      case SplittingScheme::order6:
        return {"splitting", "order6"};
      case SplittingScheme::order8:
        return {"splitting", "order8"};
      case SplittingScheme::ABA864:
      case SplittingScheme::ABA1064:
        return {"splitting", "near-integrable"};
    }
    return {};
  }
};

// Of the charts among the parts, each once.
std::vector<Citation> citations_of_charts(const std::vector<std::string>& parts) {
  std::vector<Citation> all;
  for (const ChartKind& chart : default_charts()) {
    if (std::find(parts.begin(), parts.end(), chart.name) == parts.end()) continue;
    for (const ChartSource& source : chart.sources)
      if (std::none_of(all.begin(), all.end(),
                       [&](const Citation& one) { return one.key == source.key; }))
        all.push_back(
            {std::string(source.key), std::string(source.text), std::string(source.reason)});
  }
  return all;
}

// Its chart, its groups of columns, the kinds of its terms, its method, and what moves it; the
// sources of its orbits, and what it asks for in addition to rows.
std::vector<std::string> parts_of(const Scenario& scenario) {
  std::vector<std::string> parts = detail::cited_parts(scenario);
  parts.insert(parts.end(), scenario.output.columns.begin(), scenario.output.columns.end());
  if (scenario.map && scenario.map->kind == MapKind::chaos) parts.push_back("chaos");
  if (scenario.output.writes_aem) parts.push_back("aem");
  return parts;
}

}  // namespace

std::vector<std::string> detail::cited_parts(const Rotation& rotation) {
  std::vector<std::string> parts = {rotation.chart};
  parts.insert(parts.end(), rotation.kinds.begin(), rotation.kinds.end());
  if (!rotation.frame.is_inertial()) parts.push_back("moving frame");
  for (const ScenarioOrbit& orbit : rotation.orbits) {
    if (!std::holds_alternative<TableOrbit>(orbit.motion)) parts.push_back("orbit");
    parts.insert(parts.end(), orbit.sources.begin(), orbit.sources.end());
  }
  if (const std::optional<Method> method = propagation_method(rotation))
    for (const std::string& part : std::visit(MethodParts{}, *method)) parts.push_back(part);
  return parts;
}

std::vector<Citation> citations(const Scenario& scenario) {
  const std::vector<std::string> parts = parts_of(scenario);
  const auto used = [&](std::string_view uses) {
    const std::vector<std::string_view> any = separated(uses, '|');
    return any.empty() || std::any_of(any.begin(), any.end(), [&](std::string_view part) {
             return std::find(parts.begin(), parts.end(), part) != parts.end();
           });
  };
  std::vector<Citation> result;
  for (const Paper& paper : papers) {
    if (paper.key.empty()) {
      const std::vector<Citation> charts = citations_of_charts(parts);
      result.insert(result.end(), charts.begin(), charts.end());
    } else if (used(paper.uses)) {
      result.push_back(
          {std::string(paper.key), std::string(paper.text), std::string(paper.reason)});
    }
  }
  return result;
}

}  // namespace v0
}  // namespace polhode
