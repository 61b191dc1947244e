// SPDX-License-Identifier: MIT
#include "polhode/perturb/internal_damping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/perturb/any_perturbation.hpp"
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

}  // namespace
}  // namespace perturb_test
