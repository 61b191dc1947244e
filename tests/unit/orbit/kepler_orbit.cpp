// SPDX-License-Identifier: MIT
#include "polhode/orbit/kepler_orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/kepler.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using namespace oracle;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi_ = 3.141592653589793;

Wide wide(double x) { return x; }
Wide wide(const DoubleDouble& x) { return Wide(x.hi) + Wide(x.lo); }

template <Real T>
double distance(const BasicVec3<T>& got, const WideVec3& want) {
  const WideVec3 d{wide(got.x) - want.x, wide(got.y) - want.y, wide(got.z) - want.z};
  return static_cast<double>(sqrt(dot(d, d)));
}
double length(const WideVec3& v) { return static_cast<double>(sqrt(dot(v, v))); }

WideConic conic(const KeplerElements& k) {
  return {k.gm,   k.pericentre, k.eccentricity, k.inclination,
          k.node, k.argument,   k.mean_anomaly, k.epoch};
}

// Eccentricities of every kind: circular, prepared, general, next to a parabola, hyperbolas.
KeplerElements drawn(Draw& draw) {
  const double gap = draw.power_of_ten(-15.0, 0.0);
  const double choices[] = {
      0.0,       draw.uniform(0.0, 0.5), 0.5, draw.uniform(0.5, 1.0), 1.0 - gap,
      1.0 + gap, draw.uniform(1.0, 4.0)};
  return {draw.power_of_ten(-2.0, 2.0),
          draw.power_of_ten(-2.0, 2.0),
          choices[draw.index(7)],
          draw.uniform(0.0, 3.1),
          draw.uniform(-3.0, 3.0),
          draw.uniform(-3.0, 3.0),
          draw.chance(0.5) ? 0.0 : draw.uniform(-3.0, 3.0),
          draw.uniform(-5.0, 5.0)};
}

// A time up to some `spans` passages of the pericentre away from it.
double drawn_time(Draw& draw, const KeplerElements& k, double spans) {
  const double passage = std::sqrt(std::pow(k.pericentre, 3) / k.gm);
  return k.epoch + draw.sign() * passage * draw.power_of_ten(-3.0, std::log10(spans));
}

TEST(KeplerOrbit, PositionAndVelocityAgainst76Digits) {
  Worst worst, worst_velocity;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    Draw draw(411, i);
    const KeplerElements k = drawn(draw);
    const KeplerOrbit orbit(k);
    const WideConic reference = conic(k);
    const double t = drawn_time(draw, k, 1e4);
    const WideVec3 x = reference.position(t), v = reference.velocity(t);
    worst.add(distance(orbit.position(t), x) / (eps * length(x)));
    worst_velocity.add(distance(orbit.velocity(t), v) / (eps * length(v)));
  }
  EXPECT_LE(worst.value(), budget::kepler_position_eps);
  EXPECT_LE(worst_velocity.value(), budget::kepler_velocity_eps);
}

TEST(KeplerOrbit, PositionInDoubleDouble) {
  Worst worst;
  for (std::uint64_t i = 0; i < 300; ++i) {
    Draw draw(412, i);
    const KeplerElements k = drawn(draw);
    const DoubleDouble t = DoubleDouble::sum(drawn_time(draw, k, 1e4), 1e-20);
    const WideVec3 x = conic(k).position(wide(t)), v = conic(k).velocity(wide(t));
    const KeplerOrbit orbit(k);
    // The time since pericentre is a DoubleDouble too.
    const double unit = epsilon<DoubleDouble>(), r = length(x);
    const double times = std::abs(t.hi) + std::abs(k.epoch);
    worst.add(distance(orbit.position(t), x) / (unit * (r + length(v) * times)));
    worst.add(distance(orbit.velocity(t), v) / (unit * (length(v) + k.gm / (r * r) * times)));
  }
  EXPECT_LE(worst.value(), budget::kepler_wide_eps);
}

// The time is a double; nothing else is lost after any number of orbits.
TEST(KeplerOrbit, ManyOrbits) {
  Worst worst;
  for (std::uint64_t i = 0; i < 500; ++i) {
    Draw draw(413, i);
    KeplerElements k = drawn(draw);
    if (k.eccentricity >= 1.0) k.eccentricity = draw.uniform(0.0, 0.9);
    const double t = drawn_time(draw, k, 1e12);
    const WideVec3 x = conic(k).position(t);
    worst.add(distance(KeplerOrbit(k).position(t), x) / (eps * length(x)));
  }
  EXPECT_LE(worst.value(), budget::kepler_position_eps);
}

// Also next to every boundary of the prepared intervals.
TEST(KeplerOrbit, PreparedPointsAndTheirMiddles) {
  Worst worst;
  for (const double e : {0.0, 0.1, 0.1999, 0.2, 0.36, 0.37, 0.5}) {
    const KeplerElements k{1.0, 1.0 - e, e};
    const KeplerOrbit orbit(k);
    for (int j = -260; j <= 520; ++j) {
      for (const double shift : {-1e-13, 0.0, 1e-13}) {
        const double t = 2.0 * pi_ * (j / 512.0 + shift);
        const WideVec3 x = conic(k).position(t);
        worst.add(distance(orbit.position(t), x) / (eps * length(x)));
      }
    }
  }
  EXPECT_LE(worst.value(), budget::kepler_tabulated_plane_eps);
}

// The table serves from 2^-24 to 2^40 turns of either sign, from an epoch that is far itself, where
// a rest is one; beyond, Kepler's equation.
TEST(KeplerOrbit, RestsOfTimes) {
  Worst worst, worst_tabulated;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Draw draw(416, i);
    KeplerElements k = drawn(draw);
    k.eccentricity = draw.uniform(0.0, 0.5);
    k.epoch = draw.sign() * draw.power_of_ten(-3.0, 9.0);
    const double turn = 2.0 * pi_ / mean_motion(k), turns = draw.power_of_ten(-9.0, 12.5);
    const double t = draw.sign() * turn * turns;
    const bool is_rest = draw.chance(0.7);
    const double rest = (is_rest ? 0.5 * eps * std::abs(t) : turn) * draw.uniform(-1.0, 1.0);
    const WideVec3 x = conic(k).position(Wide(t) + Wide(rest));
    const double error = distance(KeplerOrbit(k).position(t, rest), x) / (eps * length(x));
    const bool tabulated = is_rest && turns > 0x1p-23 && turns < 0x1p39;
    (tabulated ? worst_tabulated : worst).add(error);
  }
  EXPECT_LE(worst.value(), budget::kepler_position_eps);
  EXPECT_LE(worst_tabulated.value(), budget::kepler_tabulated_eps);
}

TEST(KeplerOrbit, FromStateReturnsTheState) {
  Worst worst;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Draw draw(414, i);
    const Vec3 x{draw.normal(), draw.normal(), draw.normal()};
    Vec3 v{draw.normal(), draw.normal(), draw.normal()};
    const double gm = draw.uniform(0.5, 2.0);
    if (draw.chance(0.3)) {  // next to escape
      const double scale = std::sqrt(2.0 * gm / norm(x)) / norm(v);
      v = (scale * (1.0 + draw.sign() * draw.power_of_ten(-15.0, -2.0))) * v;
    }
    const double epoch = draw.uniform(-10.0, 10.0);
    const KeplerOrbit orbit = KeplerOrbit::from_state(x, v, gm, epoch);
    const Vec3 dx = orbit.position(epoch) - x, dv = orbit.velocity(epoch) - v;
    worst.add(larger(norm(dx) / (eps * norm(x)), norm(dv) / (eps * norm(v))));
  }
  EXPECT_LE(worst.value(), budget::kepler_velocity_eps);
}

// The elements of a state, made into a state by the oracle.
TEST(KeplerOrbit, ElementsOfAState) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    Draw draw(415, i);
    const Vec3 x{draw.normal(), draw.normal(), draw.normal()};
    const Vec3 v{draw.normal(), draw.normal(), draw.normal()};
    const KeplerElements k = KeplerOrbit::from_state(x, v, 1.3, 0.25).elements();
    if (std::abs(k.eccentricity - 1.0) < 0.05 || k.eccentricity < 0.05) continue;
    EXPECT_LE(distance(x, conic(k).position(0.25)), budget::kepler_elements * norm(x));
    EXPECT_LE(distance(v, conic(k).velocity(0.25)), budget::kepler_elements * norm(v));
  }
}

TEST(KeplerOrbit, CircularAndEquatorialStates) {
  for (const Vec3& v : {Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}, Vec3{0.0, -1.0, 0.0}}) {
    const KeplerOrbit orbit = KeplerOrbit::from_state({1.0, 0.0, 0.0}, v, 1.0);
    EXPECT_EQ(orbit.elements().eccentricity, 0.0);
    EXPECT_EQ(orbit.elements().pericentre, 1.0);
    const Vec3 x = orbit.position(pi_ / 2.0);
    EXPECT_LE(norm(x - v), budget::kepler_position_eps * eps);
  }
}

TEST(KeplerOrbit, DualTimes) {
  const KeplerElements k{2.0, 0.7, 0.3, 0.4, 1.0, 2.0, 0.5, 0.0};
  const KeplerOrbit orbit(k);
  using Second = Dual<Dual<double, 1>, 1>;
  const Second t(Dual<double, 1>::variable(1.7, 0), {Dual<double, 1>(1.0)});
  const BasicVec3<Second> x = orbit.position(t);
  const Wide h = 1e-12;
  const WideVec3 a =
      Wide(1 / (2 * h)) * (conic(k).velocity(Wide(1.7) + h) - conic(k).velocity(Wide(1.7) - h));
  EXPECT_EQ(x.x.value.value, orbit.position(1.7).x);
  EXPECT_EQ(x.y.derivative[0].value, orbit.velocity(1.7).y);
  const Vec3 second{x.x.derivative[0].derivative[0], x.y.derivative[0].derivative[0],
                    x.z.derivative[0].derivative[0]};
  EXPECT_LE(distance(second, a), budget::kepler_velocity_eps * eps * length(a));
}

TEST(KeplerOrbit, RefusesWhatIsNoOrbit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto made = [](const KeplerElements& k) {
    return message_of([&] { KeplerOrbit orbit(k); });
  };
  EXPECT_EQ(made({1.0, 1.0, 1.0}),
            "KeplerOrbit: eccentricity 1 is a parabola, which has no mean motion; use an "
            "eccentricity next to it, 0.9999999999999999 or 1.0000000000000002, with the same "
            "pericentre");
  EXPECT_EQ(made({1.0, 1.0, -0.5}),
            "KeplerOrbit: eccentricity -0.5 must be in [0, 1) (ellipse) or above 1 (hyperbola)");
  EXPECT_NE(made({1.0, 1.0, nan}).find("eccentricity nan"), std::string::npos);
  EXPECT_EQ(made({0.0, 1.0, 0.1}), "KeplerOrbit: gm 0 must be positive");
  EXPECT_EQ(made({1.0, -2.0, 0.1}), "KeplerOrbit: pericentre -2 must be positive");
  EXPECT_NE(made({1.0, 1.0, 0.1, nan}).find("must be finite"), std::string::npos);
  EXPECT_NE(made({1e300, 1e-200, 0.1}).find("out of range"), std::string::npos);
  const auto from = [](const Vec3& x, const Vec3& v, double gm) {
    return message_of([&] { KeplerOrbit::from_state(x, v, gm); });
  };
  EXPECT_NE(from({1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, 1.0).find("one line"), std::string::npos);
  EXPECT_NE(from({1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, 2.0).find("parabola"), std::string::npos);
  EXPECT_NE(from({1.0, nan, 0.0}, {0.0, 1.0, 0.0}, 1.0).find("finite"), std::string::npos);
}

// At times whose rounding is more than an orbit the place is some place on the ellipse.
TEST(KeplerOrbit, FarTimesAndNoTimes) {
  for (const double e : {0.0, 0.3, 0.8}) {
    const KeplerOrbit orbit({1.0, 1.0 - e, e, 0.3, 0.2, 0.1});
    for (const double t : {1e16, -1e18, 1e31, 1e40, -1e100, 1e250}) {
      const double r = norm(orbit.position(t)), slack = budget::kepler_position_eps * eps;
      EXPECT_GE(r, (1.0 - e) * (1.0 - slack)) << e << ' ' << t;
      EXPECT_LE(r, (1.0 + e) * (1.0 + slack)) << e << ' ' << t;
    }
    EXPECT_TRUE(std::isnan(orbit.position(std::numeric_limits<double>::quiet_NaN()).x));
    EXPECT_TRUE(std::isnan(orbit.position(HUGE_VAL).x));
    EXPECT_TRUE(std::isnan(orbit.velocity(HUGE_VAL).x));
  }
  // A hyperbola far out: a straight line, at the speed sqrt(gm (e - 1) / q).
  const KeplerOrbit orbit({1.0, 1.0, 1.5});
  EXPECT_NEAR(norm(orbit.position(1e200)) / 1e200, std::sqrt(0.5),
              budget::kepler_velocity_eps * eps);
  EXPECT_NEAR(norm(orbit.velocity(1e200)), std::sqrt(0.5), budget::kepler_velocity_eps * eps);
}

TEST(KeplerOrbit, SemiMajorAxisAndMeanMotion) {
  const KeplerElements k{8.0, pericentre_distance(2.0, 0.25), 0.25};
  EXPECT_EQ(semi_major_axis(k), 2.0);
  EXPECT_EQ(mean_motion(k), 1.0);
  EXPECT_EQ(KeplerOrbit(k).mean_motion(), 1.0);
  EXPECT_EQ(semi_major_axis({8.0, pericentre_distance(-2.0, 1.5), 1.5}), -2.0);
}

// A position alone: an orbit without a velocity.
struct Fixed {
  Vec3 position(double) const { return {1.0, 2.0, 3.0}; }
  BasicVec3<DoubleDouble> position(const DoubleDouble&) const { return {1.0, 2.0, 3.0}; }
};

TEST(AnyOrbit, HoldsAnyOrbit) {
  const KeplerOrbit orbit({1.0, 1.0, 0.2, 0.3});
  const AnyOrbit any("moon", orbit);
  EXPECT_EQ(any.name(), "moon");
  EXPECT_TRUE(any.supports_velocity());
  EXPECT_EQ(any.position(0.3), orbit.position(0.3));
  EXPECT_EQ(any.position(DoubleDouble(0.3)), orbit.position(DoubleDouble(0.3)));
  EXPECT_EQ(any.velocity(0.3), orbit.velocity(0.3));
  const auto at = any.position(Dual<double, 2>::variable(0.3, 1));
  EXPECT_EQ(at.z.derivative[1], orbit.velocity(0.3).z);
  EXPECT_EQ(at.z.derivative[0], 0.0);
}

TEST(AnyOrbit, SaysThatAnOrbitHasNoVelocity) {
  const AnyOrbit any("star", Fixed{});
  EXPECT_FALSE(any.supports_velocity());
  EXPECT_EQ(any.position(1.0), (Vec3{1.0, 2.0, 3.0}));
  EXPECT_MESSAGE(any.velocity(1.0),
                 "AnyOrbit: orbit \"star\" has no velocity: write position(t) as a template on the "
                 "number type");
}

// Kepler's equation at M = 0, where nothing is left to solve.

template <Real T>
void at_periapsis(double e) {
  for (const double M : {0.0, -0.0}) {
    const BasicKeplerAnomaly<T> x = eccentric_anomaly(T(M), BasicEccentricity<T>::of(T(e)));
    EXPECT_EQ(to_double(x.anomaly), 0.0) << e;
    EXPECT_EQ(to_double(x.sine), 0.0) << e;
    EXPECT_EQ(to_double(x.versine), 0.0) << e;
  }
}

TEST(KeplerEquation, NothingIsLeftAtPeriapsis) {
  for (const double e : {0.0, 0.3, 0.999, 1.001, 2.0, 1e6}) {
    at_periapsis<double>(e);
    at_periapsis<DoubleDouble>(e);
  }
}

// The exceptions for M = 0 are for no other M: e sinh H - H = M at whole numbers.
TEST(KeplerEquation, WholeMeanAnomaliesOfHyperbolas) {
  for (const double M : {1.0, -1.0, 2.0, 100.0}) {
    for (const double e : {1.5, 4.0}) {
      const auto x = eccentric_anomaly(DoubleDouble(M), BasicEccentricity<DoubleDouble>::of(e));
      EXPECT_LE(std::abs((e * sinh(x.anomaly) - x.anomaly - M).hi),
                budget::kepler_wide_eps * epsilon<DoubleDouble>() * e * std::cosh(x.anomaly.hi) *
                    std::abs(M));
      EXPECT_NEAR(x.sine.hi, std::sinh(x.anomaly.hi), std::abs(x.sine.hi) * budget::kepler_rounded);
      const double half = std::sinh(0.5 * x.anomaly.hi);
      EXPECT_NEAR(x.versine.hi, 2.0 * half * half, x.versine.hi * budget::kepler_rounded);
    }
  }
}

}  // namespace
}  // namespace polhode::test
