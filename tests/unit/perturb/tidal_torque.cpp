// SPDX-License-Identifier: MIT
#include "polhode/perturb/tidal_torque.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "unit/perturb/support.hpp"
#include "worst.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using polhode::test::Worst;

struct NoVelocity {
  Vec3 position(double) const { return {1.0, 0.0, 0.0}; }
  BasicVec3<DoubleDouble> position(DoubleDouble) const { return {}; }
};

// Mignard's force on the point mass, -3 k2 G M^2 R^5 lag / r^10 (2 (r.v) r + r^2 (r x w + v)), and
// the opposite of its moment.
TEST(TidalTorque, MomentOfMignardsForce) {
  const TidalTorque term(0.7, 0.3, Curve{}, {0.9, 0.01, 0.4});
  Worst worst, worst_wide, worst_any;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Case c = drawn_case(1001, i);
    const BasicSetting<Wide> at = c.on<Wide>();
    const Wide t = at.t;
    const WideVec3 r = Curve{}.position(t);
    const WideVec3 v{2 * t, -1, Wide(0.4)};
    const WideQuaternion q = normalized(at.q_IS) * normalized(at.s.q);
    const Vec3& I = c.body.moments();
    const WideVec3 w = rotate(q, WideVec3{at.s.g.x / I.x, at.s.g.y / I.y, at.s.g.z / I.z});
    const Wide r2 = dot(r, r);
    const Wide strength = Wide(3 * 0.9) * 0.7 * 0.3 * pow(Wide(0.4), 5) * Wide(0.01);
    const WideVec3 force =
        (-strength / pow(r2, 5)) * ((2 * dot(r, v)) * r + r2 * (cross(r, w) + v));
    const WideVec3 want = rotate(conj(q), cross(force, r));
    const double size =
        static_cast<double>(strength / pow(r2, 4) * (r2 * sqrt(dot(w, w)) + sqrt(r2 * dot(v, v))));
    worst.add(largest(wide(term.effect(c.on<double>()).u) - want) / size);
    worst_wide.add(largest(wide(term.effect(c.on<DoubleDouble>()).u) - want) / size);
    const TidalTorque any(0.7, 0.3, AnyOrbit("curve", Curve{}), {0.9, 0.01, 0.4});
    worst_any.add(largest(wide(any.effect(c.on<double>()).u) - want) / size);
  }
  EXPECT_LE(worst.value(), budget::tidal_eps * eps);
  EXPECT_LE(worst_any.value(), budget::tidal_eps * eps);
  // the strength is a double
  EXPECT_LE(worst_wide.value(), budget::tidal_eps * eps);
}

// Before the expansion: the pull on the bulge 3 k2 G M^2 R^5 (r.s)(s x r) / (r s)^5 of the position
// s a lag ago, which the body has carried on meanwhile.
TEST(TidalTorque, FirstOrderOfABulgeThatLags) {
  const KeplerOrbit orbit({1.0, 0.7, 0.3, 0.5, 0.4, 0.3, 0.2});
  const Case c = drawn_case(1002, 3);
  const Vec3& I = c.body.moments();
  const Vec3 w_B{c.s.g.x / I.x, c.s.g.y / I.y, c.s.g.z / I.z};
  const Vec3 w = rotate(c.q_IS * c.s.q, w_B);
  const double rate = norm(w);
  const auto lagging = [&](double lag) {
    const Vec3 r = orbit.position(c.t), before = orbit.position(c.t - lag);
    const double half = 0.5 * rate * lag;
    const Vec3 axis = (std::sin(half) / rate) * w;
    const Vec3 s = rotate(Quaternion{std::cos(half), axis.x, axis.y, axis.z}, before);
    return (3.0 * dot(r, s) / std::pow(norm(r) * norm(s), 5)) * cross(s, r);
  };
  const double lag = 1e-4;
  const Vec3 want = (0.5 / lag) * (lagging(lag) - lagging(-lag));  // what is even in the lag is not
  const Vec3 got = rotate(c.q_IS * c.s.q,
                          TidalTorque(1.0, 1.0, orbit, {1.0, 1.0, 1.0}).effect(c.on<double>()).u);
  EXPECT_LE(norm(got - want), budget::tidal_lag * norm(want));
}

// Hut (1981, eq. 11): over an ellipse, the spin along its normal: 3 k2 gm M (R/a)^6 lag / R
// (n f2(e) (1 - e^2)^-6 - w f5(e) (1 - e^2)^(-9/2)).
TEST(TidalTorque, AveragedOverAnEllipse) {
  for (const double e : {0.0, 0.2, 0.5}) {
    const KeplerOrbit orbit({1.0, 1.0 - e, e});
    const double w = 1.4, e2 = e * e;
    const Body body(1.0, 1.0, 2.0);
    const TidalTorque term(1.0, 0.3, orbit, {0.9, 0.01, 0.4});
    Setting at{body, 0.0, {{}, {0.0, 0.0, 2.0 * w}}, {}};
    double mean = 0.0;
    constexpr int samples = 512;
    for (int i = 0; i < samples; ++i) {
      at.t = 2.0 * 3.141592653589793 * i / samples;
      mean += term.effect(at).u.z / samples;
    }
    const double f2 = 1.0 + 7.5 * e2 + 45.0 / 8.0 * e2 * e2 + 5.0 / 16.0 * e2 * e2 * e2;
    const double f5 = 1.0 + 3.0 * e2 + 0.375 * e2 * e2;
    const double want = 3.0 * 0.9 * 0.3 * std::pow(0.4, 5) * 0.01 *
                        (f2 * std::pow(1.0 - e2, -6.0) - w * f5 * std::pow(1.0 - e2, -4.5));
    EXPECT_NEAR(mean / want, 1.0, budget::tidal_average) << e;
  }
}

TEST(TidalTorque, InAListOfTerms) {
  const AnyPerturbation term("tide",
                             TidalTorque(1.0, 1.0, KeplerOrbit({1.0, 1.0, 0.1}), {0.3, 0.1, 0.5}));
  const BasicEffect<Tangent> e = term.effect(drawn_case(1003, 0).on<Tangent>());
  EXPECT_EQ((Vec3{e.u.x.value, e.u.y.value, e.u.z.value}),
            term.effect(drawn_case(1003, 0).on<double>()).u);
}

// Nothing lags, or nothing is raised: a body may have either.
TEST(TidalTorque, IsZeroWithoutALagOrALoveNumber) {
  const KeplerOrbit orbit({1.0, 1.0, 0.1});
  for (const TidalBody& of : {TidalBody{0.3, 0.0, 0.5}, TidalBody{0.0, 0.1, 0.5}}) {
    const Case c = drawn_case(1003, 0);
    EXPECT_EQ(TidalTorque(1.0, 1.0, orbit, of).effect(c.on<double>()).u, Vec3{});
  }
}

TEST(TidalTorque, RefusesWhatIsNoTide) {
  EXPECT_MESSAGE(TidalTorque(1.0, 0.0, Curve{}, {0.3, 0.1, 0.5}),
                 "TidalTorque: mass 0 must be positive and finite");
  EXPECT_MESSAGE(TidalTorque(1.0, 1.0, Curve{}, {0.3, -0.1, 0.5}),
                 "TidalTorque: lag -0.1 must be >= 0 and finite");
  EXPECT_MESSAGE(TidalTorque(1.0, 1.0, AnyOrbit("table", NoVelocity{}), {0.3, 0.1, 0.5}),
                 "TidalTorque: orbit \"table\" must have a velocity");
}

}  // namespace
}  // namespace perturb_test
