// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "budgets.hpp"
#include "oracle/kepler.hpp"
#include "oracle/random_draw.hpp"
#include "orbit/mean_ellipse.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using namespace oracle;

constexpr double eps = std::numeric_limits<double>::epsilon();

// The conic of each instant.
WideVec3 reference(const KeplerElements& k, const SecularRates& r, const Wide& t) {
  const Wide elapsed = t - Wide(k.epoch);
  // the axis stays
  const Wide e = Wide(k.eccentricity) + r.eccentricity * elapsed;
  const Wide q = Wide(k.pericentre) / (1 - Wide(k.eccentricity)) * (1 - e);
  WideConic conic(k.gm, q, e, Wide(k.inclination) + r.inclination * elapsed,
                  Wide(k.node) + r.node * elapsed, Wide(k.argument) + r.argument * elapsed, 0, 0);
  const Wide M = Wide(k.mean_anomaly) + (conic.n + r.mean_anomaly) * elapsed;
  return conic.position(M / conic.n);
}

double distance(const Vec3& got, const WideVec3& want) {
  const WideVec3 d = widened(got) - want;
  return static_cast<double>(sqrt(dot(d, d)));
}

struct Drawn {
  KeplerElements elements;
  SecularRates rates;
  double t;
};
Drawn drawn(std::uint64_t index, double longest) {
  Draw draw(421, index);
  const double e = draw.uniform(0.0, 0.95);
  const KeplerElements k{1.5,
                         1.0 - e,
                         e,
                         draw.uniform(0.0, 3.0),
                         draw.uniform(-3.0, 3.0),
                         draw.uniform(-3.0, 3.0),
                         draw.uniform(-3.0, 3.0),
                         draw.uniform(-2.0, 2.0)};
  const SecularRates r{0.1 * draw.normal(), 0.1 * draw.normal(), 0.1 * draw.normal()};
  return {k, r, k.epoch + draw.sign() * draw.power_of_ten(-1.0, longest)};
}

// With a tilt and an eccentricity that change: the latter to another ellipse within |t - epoch|.
Drawn tilting(std::uint64_t index, double longest) {
  Drawn d = drawn(index, longest);
  Draw draw(422, index);
  const double end = draw.uniform(0.0, 0.9);
  d.rates.inclination = 0.1 * draw.normal();
  d.rates.eccentricity = (end - d.elements.eccentricity) / (d.t - d.elements.epoch);
  return d;
}

TEST(PrecessingKeplerOrbit, TiltAndEccentricityChange) {
  Worst position, velocity;
  for (std::uint64_t i = 0; i < 600; ++i) {
    const Drawn d = tilting(i, i % 2 == 0 ? 9.0 : 3.0);
    const PrecessingKeplerOrbit orbit(d.elements, d.rates);
    const Vec3 x = orbit.position(d.t), v = orbit.velocity(d.t);
    position.add(distance(x, reference(d.elements, d.rates, d.t)) / (eps * norm(x)));
    const Wide h = 1e-14;
    const auto at = [&](const Wide& shift) {
      return reference(d.elements, d.rates, Wide(d.t) + shift);
    };
    const WideVec3 want =
        Wide(1 / (12 * h)) * (Wide(8) * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h)));
    if (i % 2 == 1) velocity.add(distance(v, want) / (eps * norm(v)));
    const auto dual = orbit.position(Dual<double, 1>::variable(d.t, 0));
    EXPECT_EQ((Vec3{dual.x.derivative[0], dual.y.derivative[0], dual.z.derivative[0]}), v);
    EXPECT_EQ(dual.x.value, x.x);
    const BasicVec3<DoubleDouble> wide = orbit.position(DoubleDouble(d.t));
    EXPECT_LE(norm(Vec3{wide.x.hi, wide.y.hi, wide.z.hi} - x),
              budget::kepler_position_eps * eps * norm(x));
  }
  EXPECT_LE(position.value(), budget::kepler_position_eps);
  EXPECT_LE(velocity.value(), budget::kepler_velocity_eps);
}

// Outside, there is no orbit.
TEST(PrecessingKeplerOrbit, TheEccentricityStaysThatOfAnEllipse) {
  const KeplerElements k{1.0, 0.75, 0.25, 0.5, 1.0, 2.0, 0.3, 10.0};
  SecularRates growing, falling;
  growing.eccentricity = 0.125;
  falling.eccentricity = -0.125;
  const PrecessingKeplerOrbit up(k, growing), down(k, falling), still(k, {});
  EXPECT_EQ(up.first_time(), 8.0);
  EXPECT_EQ(up.last_time(), 16.0);
  EXPECT_EQ(down.first_time(), 4.0);
  EXPECT_EQ(down.last_time(), 12.0);
  EXPECT_EQ(still.last_time(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(up.eccentricity(12.0), 0.5);
  EXPECT_TRUE(std::isfinite(up.position(8.0).x));
  EXPECT_TRUE(std::isfinite(up.position(15.9).x));
  for (const double t : {7.9, 16.0, 17.0}) {
    EXPECT_TRUE(std::isnan(up.position(t).x)) << t;
    EXPECT_TRUE(std::isnan(up.velocity(t).x)) << t;
  }
}

TEST(PrecessingKeplerOrbit, PositionForAnyTime) {
  Worst worst;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Drawn d = drawn(i, 9.0);
    const WideVec3 want = reference(d.elements, d.rates, d.t);
    const Vec3 got = PrecessingKeplerOrbit(d.elements, d.rates).position(d.t);
    worst.add(distance(got, want) / (eps * norm(got)));
  }
  EXPECT_LE(worst.value(), budget::kepler_position_eps);
}

TEST(PrecessingKeplerOrbit, VelocityIsTheDerivative) {
  Worst worst;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Drawn d = drawn(i, 3.0);
    const Wide h = 1e-14;
    const auto at = [&](const Wide& shift) {
      return reference(d.elements, d.rates, Wide(d.t) + shift);
    };
    const WideVec3 want =
        Wide(1 / (12 * h)) * (Wide(8) * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h)));
    const PrecessingKeplerOrbit orbit(d.elements, d.rates);
    const Vec3 got = orbit.velocity(d.t);
    worst.add(distance(got, want) / (eps * norm(got)));
    const auto dual = orbit.position(Dual<double, 1>::variable(d.t, 0));
    EXPECT_EQ((Vec3{dual.x.derivative[0], dual.y.derivative[0], dual.z.derivative[0]}), got);
    EXPECT_EQ(dual.x.value, orbit.position(d.t).x);
  }
  EXPECT_LE(worst.value(), budget::kepler_velocity_eps);
}

TEST(PrecessingKeplerOrbit, InDoubleDouble) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Drawn d = drawn(i, 2.0);
    const PrecessingKeplerOrbit orbit(d.elements, d.rates);
    const BasicVec3<DoubleDouble> x = orbit.position(DoubleDouble(d.t));
    const WideVec3 want = reference(d.elements, d.rates, d.t);
    const WideVec3 error = WideVec3{Wide(x.x.hi) + Wide(x.x.lo), Wide(x.y.hi) + Wide(x.y.lo),
                                    Wide(x.z.hi) + Wide(x.z.lo)} -
                           want;
    const double scale = norm(orbit.position(d.t)) + norm(orbit.velocity(d.t)) * std::abs(d.t);
    EXPECT_LE(static_cast<double>(sqrt(dot(error, error))),
              budget::kepler_wide_eps * epsilon<DoubleDouble>() * scale);
    const Vec3 v = orbit.velocity(d.t);
    EXPECT_LE(std::abs(orbit.velocity(DoubleDouble(d.t)).x.hi - v.x),
              budget::kepler_velocity_eps * eps * norm(v));
  }
}

TEST(PrecessingKeplerOrbit, WithoutRatesIsAKeplerOrbit) {
  const KeplerElements k{1.0, 0.8, 0.2, 0.5, 1.0, 2.0, 0.3, 0.1};
  const KeplerOrbit still(k);
  const PrecessingKeplerOrbit orbit(k, {});
  for (const double t : {-4.0, 0.1, 7.5}) {
    EXPECT_LE(norm(orbit.position(t) - still.position(t)), budget::kepler_position_eps * eps);
  }
}

// A circle 800 km above the Earth follows the Sun at 98.6 degrees; an orbit of the critical
// inclination keeps its pericentre.
TEST(PrecessingKeplerOrbit, J2Rates) {
  const double gm = 398600.4418, R = 6378.137, J2 = 1.08262668e-3, deg = 3.141592653589793 / 180.0;
  const SecularRates sun = j2_rates({gm, 7178.137, 0.0, 98.6 * deg}, J2, R);
  EXPECT_NEAR(sun.node * 86400.0 / deg, 360.0 / 365.2422, budget::sun_synchronous_deg_per_day);
  const double critical = std::asin(std::sqrt(0.8));
  const SecularRates molniya =
      j2_rates({gm, pericentre_distance(26560.0, 0.74), 0.74, critical}, J2, R);
  EXPECT_LE(std::abs(molniya.argument), budget::j2_rates_eps * eps * std::abs(molniya.node));
  // An equatorial circle advances by k (2 + 1 - 1): what a point there feels, to first order in J2.
  const SecularRates equator = j2_rates({1.0, 1.0, 0.0}, 1e-3, 1.0);
  EXPECT_NEAR(equator.node + equator.argument + equator.mean_anomaly, 3e-3,
              budget::j2_rates_eps * eps);
}

template <class Function>
bool refused(const Function& f) {
  try {
    f();
  } catch (const DomainError&) {
    return true;
  }
  return false;
}

TEST(PrecessingKeplerOrbit, RefusesWhatIsNoOrbit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const KeplerElements good{1.0, 1.0, 0.1}, parabola{1.0, 1.0, 1.0}, hyperbola{1.0, 1.0, 2.0};
  EXPECT_TRUE(refused([&] { PrecessingKeplerOrbit(parabola, {}); }));
  EXPECT_TRUE(refused([&] { PrecessingKeplerOrbit(good, {nan, 0.0, 0.0}); }));
  EXPECT_TRUE(refused([&] { PrecessingKeplerOrbit(good, {0.0, 0.0, -2.0}); }));
  EXPECT_TRUE(refused([&] { PrecessingKeplerOrbit(good, {0.0, 0.0, 0.0, nan}); }));
  EXPECT_TRUE(refused([&] { PrecessingKeplerOrbit(good, {0.0, 0.0, 0.0, 0.0, nan}); }));
  EXPECT_TRUE(refused([&] { PrecessingKeplerOrbit(hyperbola, {0.0, 0.0, 0.0, 0.0, 0.1}); }));
  EXPECT_TRUE(refused([&] { (void)j2_rates(hyperbola, 1e-3, 1.0); }));
  EXPECT_TRUE(refused([&] { (void)j2_rates(good, nan, 1.0); }));
  EXPECT_TRUE(refused([&] { (void)j2_rates(good, 1e-3, 0.0); }));
  EXPECT_FALSE(refused([&] { PrecessingKeplerOrbit(hyperbola, {0.1, 0.0, 0.0}); }));
}

const KeplerElements elements{1.5, 0.8, 0.2, 0.7, 0.3, -0.4, 0.5, 1.0};
const PrecessingKeplerOrbit inner(elements, {-0.01, 0.02, 0.003});

// The pole of the equator has the ecliptic latitude 90 degrees less the obliquity, longitude 90.
TEST(TurnedKeplerOrbit, TheEquatorialPoleLiesWhereTheSkyHasIt) {
  const KeplerElements in_equator{1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto orbit = TurnedKeplerOrbit::from_equator({in_equator, {}});
  const double obliquity = 84381.448 / 3600.0 * std::numbers::pi / 180.0;
  const double tol = budget::table_orbit_kepler;
  const Vec3 pole = cross(orbit.position(0.0), orbit.velocity(0.0));
  EXPECT_NEAR(pole.x, 0.0, tol);
  EXPECT_NEAR(pole.y, std::sin(obliquity), tol);
  EXPECT_NEAR(pole.z, std::cos(obliquity), tol);
}

TEST(TurnedKeplerOrbit, OneUndoesTheOther) {
  const TurnedKeplerOrbit there = TurnedKeplerOrbit::from_equator(inner);
  EXPECT_EQ(there.angle(), -TurnedKeplerOrbit::from_ecliptic(inner).angle());
  const double c = std::cos(there.angle()), s = std::sin(there.angle());
  for (const double t : {-3.0, 0.0, 17.0}) {
    const Vec3 x = there.position(t), back{x.x, c * x.y - s * x.z, s * x.y + c * x.z};
    EXPECT_LT(norm(back - inner.position(t)), budget::table_orbit_kepler);
  }
  EXPECT_EQ(there.gm(), elements.gm);
}

TEST(TurnedKeplerOrbit, EveryNumberTypeSeesOneOrbit) {
  const TurnedKeplerOrbit orbit(inner, 0.3);
  const Vec3 x = orbit.position(2.0), v = orbit.velocity(2.0);
  const auto d = orbit.position(Dual<double, 1>::variable(2.0, 0));
  const BasicVec3<DoubleDouble> wide = orbit.position(DoubleDouble(2.0));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(d[i].value, x[i]);
    EXPECT_EQ(d[i].derivative[0], v[i]);
    EXPECT_NEAR(to_double(wide[i]), x[i], budget::table_orbit_kepler);
  }
}

TEST(TurnedKeplerOrbit, RefusesAnAngleThatIsNone) {
  EXPECT_THROW(TurnedKeplerOrbit(inner, std::numeric_limits<double>::infinity()), DomainError);
}

// A point of an ellipse by its mean anomaly against the orbit that moves there.

TEST(MeanEllipse, IsWhereTheOrbitIs) {
  test::Worst worst;
  for (const double e : {0.0, 0.017, 0.5, 0.97})
    for (const double pericentre : {0.0, 0.3, -2.0})
      for (const double M : {0.0, 0.7, 3.0, -1.1}) {
        const KeplerOrbit orbit({.gm = 1.0,
                                 .pericentre = 1.5 * (1.0 - e),
                                 .eccentricity = e,
                                 .argument = pericentre,
                                 .mean_anomaly = M});
        worst.add(norm(on_ellipse(1.5, e, M, pericentre) - orbit.position(0.0)) /
                  (1.5 * (1.0 - e)));
      }
  EXPECT_LT(worst.value(), budget::mean_ellipse);
}

TEST(MeanEllipse, IsNaNWhereThereIsNone) {
  for (const double e : {-0.1, 1.0, std::nan("")})
    EXPECT_TRUE(std::isnan(on_ellipse(1.0, e, 0.5, 0.0).x)) << e;
}

}  // namespace
}  // namespace polhode::test
