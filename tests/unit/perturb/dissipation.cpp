// SPDX-License-Identifier: MIT
// What takes energy: friction inside the body, a Kane damper, and tides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/kane_damper.hpp"
#include "polhode/perturb/tidal_torque.hpp"
#include "unit/perturb/support.hpp"
#include "worst.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using polhode::test::Worst;

TEST(InternalDamping, IsCrossProductOfMomentumAndRate) {
  for (const InternalDamping& term :
       {InternalDamping(Vec3{0.3, 0.7, 1.1}),
        InternalDamping::of_material(Body(1.0, 2.0, 2.5), {3.0, 10.0, 2.0, 1.5, 0.05})}) {
    Worst worst;
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Case c = drawn_case(901, i);
      const Vec3& I = c.body.moments();
      const WideVec3 g = wide(c.s.g);
      const WideVec3 across = cross(g, {g.x / I.x, g.y / I.y, g.z / I.z});
      const Wide factor = term.grows_with_momentum() ? sqrt(dot(g, g)) : Wide(1);
      const Vec3& k = term.coefficients();
      const WideVec3 want{factor * k.x * across.x, factor * k.y * across.y,
                          factor * k.z * across.z};
      const Effect got = term.effect(c.on<double>());
      worst.add(largest(wide(got.v) - want) / largest(want));
      EXPECT_EQ(got.u, Vec3{});
      // dT/dt = v.(w x g) = -(g x w).k(g x w)
      EXPECT_LE(-dot(wide(got.v), across), 0);
    }
    EXPECT_LE(worst.value(), budget::perturb_eps * eps);
  }
}

TEST(InternalDamping, SphereKeepsItsRate) {
  const Body sphere(2.0, 2.0, 2.0);
  const Case c = drawn_case(902, 0);
  const InternalDamping term(0.7);
  EXPECT_EQ(term.effect(Setting{sphere, c.t, c.s, c.q_IS}), Effect{});
}

// mu Q / (rho K3^2 R^2 w^3) of a body of 1 km in round numbers: 5e9 Pa, Q = 100, 2000 kg/m3, one
// turn in 10 h: 5e11 / (200 x 1e6 x (1.745329e-4)^3) s.
TEST(InternalDamping, TimeOfBurnsAndSafronovByHand) {
  const DampedMaterial rock{5e9, 100.0, 2000.0, 1000.0};
  const double rate = 2.0 * 3.141592653589793 / 36000.0;
  EXPECT_NEAR(wobble_time(rock, rate) / (2500.0 / std::pow(rate, 3)), 1.0,
              budget::perturb_eps * eps);
  // twice the rate, an eighth of the time: k grows with |g|
  const Body body(1.0, 2.0, 2.5);
  const InternalDamping slow = InternalDamping::of_material(body, rock);
  const InternalDamping at_once =
      InternalDamping::of_wobble(body, wobble_time(rock, rate), 2.5 * rate);
  EXPECT_NEAR(slow.coefficients().x * 2.5 * rate / at_once.coefficients().x, 1.0,
              budget::perturb_eps * eps);
}

TEST(InternalDamping, RefusesWhatWouldDriveTheBody) {
  EXPECT_MESSAGE(InternalDamping(-1.0),
                 "InternalDamping: coefficients (-1, -1, -1) must be >= 0 and finite");
  EXPECT_MESSAGE(InternalDamping(Vec3{1.0, HUGE_VAL, 1.0}),
                 "InternalDamping: coefficients (1, inf, 1) must be >= 0 and finite");
  EXPECT_MESSAGE(InternalDamping::of_wobble(Body(2.0, 2.0, 2.0), 1.0, 1.0),
                 "InternalDamping: moments (2, 2, 2) of a sphere have no wobble to damp: give a "
                 "coefficient");
  EXPECT_MESSAGE(InternalDamping::of_wobble(Body(1.0, 2.0, 2.0), 0.0, 1.0),
                 "InternalDamping: time 0 must be positive and finite");
  EXPECT_MESSAGE(wobble_time({1.0, 0.0, 1.0, 1.0}, 1.0),
                 "InternalDamping: quality factor 0 must be positive and finite");
}

WideVec3 divided(const WideVec3& x, const WideVec3& by) {
  return {x.x / by.x, x.y / by.y, x.z / by.z};
}

// A body with room for the sphere, and the two as they share the momentum.
struct Shared {
  Case c;
  KaneDamper damper;
  Vec3 s;
  Wide J;
  WideVec3 I, hub, g, h;

  explicit Shared(std::uint64_t index) : c(drawn_case(931, index)), damper(1.0, 0.0) {
    Draw draw(932, index);
    const Vec3& m = c.body.moments();
    double sorted[] = {m.x, m.y, m.z};
    std::sort(sorted, sorted + 3);
    damper = KaneDamper(draw.uniform(0.01, 0.99) * (sorted[0] - (sorted[2] - sorted[1])),
                        draw.uniform(0.0, 3.0));
    s = drawn_vector(draw);
    J = damper.moment();
    I = wide(m);
    hub = {I.x - J, I.y - J, I.z - J};
    g = wide(c.s.g);
    h = wide(damper.momentum(c.body, c.s.g, s));
  }
  // Of roundings, by I - J.
  double amplified() const { return static_cast<double>(I.x / hub.x + I.y / hub.y + I.z / hub.z); }
};

TEST(KaneDamper, SharesTheMomentumOfTwoBodies) {
  Worst worst;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Shared two(i);
    const WideVec3 w = divided(two.g - two.h, two.hub);
    const WideVec3 s = Wide(1) / two.J * two.h - w;
    const WideVec3 mean = divided(two.g, two.I);
    const double size = largest(mean) + largest(wide(two.s));
    const Vec3 v = two.damper.rate_of_body(two.c.body, two.s);
    const Vec3 back = two.damper.relative_rate(two.c.body, two.c.s.g,
                                               two.damper.momentum(two.c.body, two.c.s.g, two.s));
    const Wide T = (dot(two.g - two.h, w) + dot(two.h, two.h) / two.J) / 2;
    const Wide added = T - dot(two.g, mean) / 2;
    const double off = static_cast<double>(added - two.damper.energy(two.c.body, two.s));
    for (const double error :
         {largest(s - wide(two.s)) / size, largest(w - mean - wide(v)) / size,
          norm(back - two.s) / size, std::abs(off) / (two.damper.moment() * size * size)})
      worst.add(error / two.amplified());
  }
  EXPECT_LE(worst.value(), budget::perturb_eps * eps);
}

// d(h/J - (I - J)^-1 (g - h))/dt of dh/dt = h x w0 - c s.
TEST(KaneDamper, RateChangesAsThatOfTwoBodies) {
  Worst worst;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Shared two(i);
    Draw draw(933, i);
    const Vec3 dg = drawn_vector(draw);
    const WideVec3 w = divided(two.g - two.h, two.hub);
    const WideVec3 s = Wide(1) / two.J * two.h - w;
    const WideVec3 dh = cross(two.h, w) - Wide(two.damper.friction()) * s;
    const WideVec3 want = Wide(1) / two.J * dh - divided(wide(dg) - dh, two.hub);
    const double decay = two.damper.friction() / two.damper.moment();
    const double size =
        two.amplified() * (largest(divided(wide(dg), two.I)) + largest(s) * (largest(w) + decay));
    const Vec3 got = two.damper.acceleration(two.c.body, two.c.s.g, dg, two.s);
    worst.add(largest(wide(got) - want) / size);
  }
  EXPECT_LE(worst.value(), budget::perturb_eps * eps);
}

TEST(KaneDamper, RefusesWhatIsNoSphereInABody) {
  EXPECT_MESSAGE(KaneDamper(0.0, 1.0), "KaneDamper: moment 0 must be positive and finite");
  EXPECT_MESSAGE(KaneDamper(std::nan(""), 1.0),
                 "KaneDamper: moment nan must be positive and finite");
  EXPECT_MESSAGE(KaneDamper(1.0, -1.0), "KaneDamper: friction -1 must be >= 0 and finite");
  EXPECT_MESSAGE(
      KaneDamper(0.75, 1.0).require_room(Body(2.0, 1.5, 3.0)),
      "KaneDamper: moment 0.75 in a body of moments (2, 1.5, 3) must be at most 0.5, the sum of "
      "the two smaller ones less the largest, and less than each: what is left must be a body");
  KaneDamper(0.5, 1.0).require_room(Body(2.0, 1.5, 3.0));
  // nothing would be left about axis 1
  EXPECT_NE(message_of([] { KaneDamper(1.0, 1.0).require_room(Body(1.0, 2.0, 2.0)); }), "");
}

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
