// SPDX-License-Identifier: MIT
#include "polhode/perturb/oblate_gravity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "unit/perturb/support.hpp"
#include "worst.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using polhode::test::Worst;

// -grad of U = -gm/r (1 - J2 (R/r)^2 (3 s^2 - 1)/2), s the sine of the latitude, differentiated by
// its two arguments: dU/dr along r, and dU/ds (k - s n) / r.
WideVec3 pull(const WideVec3& r, const WideVec3& k, double gm, const Oblateness& of) {
  const Wide d = sqrt(dot(r, r)), s = dot(r, k) / d, q = Wide(of.J2) * pow(of.radius / d, 2);
  const WideVec3 n = (1 / d) * r;
  const Wide by_r = Wide(gm) / (d * d) * (1 - Wide(1.5) * q * (3 * s * s - 1));
  const Wide by_s = Wide(gm) / d * q * 3 * s;
  return -by_r * n - (by_s / d) * (k - s * n);
}

// Six points whose tensor is diagonal; so small that their moments of degree 4 do not show.
TEST(OblateGravity, WithGravityGradientIsThePullOnEveryPoint) {
  const double tiny = 0x1p-60;
  const Vec3 arms{1.0, 2.0, 3.0}, masses{1.0, 0.5, 0.25};
  const Vec3 J{2.0 * masses.x * arms.x * arms.x, 2.0 * masses.y * arms.y * arms.y,
               2.0 * masses.z * arms.z * arms.z};
  const Body body(J.y + J.z, J.z + J.x, J.x + J.y);
  Worst worst;
  for (std::uint64_t i = 0; i < 100; ++i) {
    Draw draw(801, i);
    const Vec3 r = drawn_vector(draw), pole = drawn_vector(draw);
    const Oblateness of{draw.uniform(-0.5, 0.5), draw.uniform(0.1, 2.0), pole};
    const Case c = drawn_case(802, i);
    const BasicSetting<Wide> at = c.on<Wide>();
    const WideVec3 r_B = seen_in_body(at, wide(r));
    const WideVec3 k_B = (1 / sqrt(dot(wide(pole), wide(pole)))) * seen_in_body(at, wide(pole));
    WideVec3 direct;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        WideVec3 x;
        x[axis] = Wide(side * arms[axis]) * Wide(tiny);
        direct = direct + (Wide(masses[axis]) / (Wide(tiny) * Wide(tiny))) *
                              cross(x, pull(r_B + x, k_B, 0.7, of));
      }
    }
    const BasicSetting<Wide> same{body, at.t, at.s, at.q_IS};
    const WideVec3 point = GravityGradient(0.7, Still{r}).effect(same).u;
    const Setting set{body, c.t, c.s, c.q_IS};
    const Vec3 got = OblateGravity(0.7, Still{r}, of).effect(set).u;
    const double size =
        0.7 * 15.0 * std::abs(of.J2) * of.radius * of.radius / std::pow(norm(r), 5) * 6.0;
    worst.add(largest(wide(got) - (direct - point)) / size);
  }
  EXPECT_LE(worst.value(), budget::perturb_eps * eps);
}

TEST(OblateGravity, IsTheDerivativeOfItsEnergy) {
  for (const SpaceAxes axes : {SpaceAxes::inertial, SpaceAxes::reference}) {
    const OblateGravity term(1.7, Curve{}, {0.3, 0.8, {0.2, -0.3, 0.9}}, axes);
    Worst worst;
    for (std::uint64_t i = 0; i < 100; ++i) {
      BasicSetting<Wide> at = drawn_case(803, i).on<Wide>();
      const Body body = drawn_case(803, i).body;
      const BasicSetting<Wide> unit{body, at.t, {normalized(at.s.q), at.s.g}, normalized(at.q_IS)};
      const BasicEffect<Wide> want = effect_by_differences(term, unit);
      worst.add(largest(term.effect(unit).u - want.u) / largest(want.u));
    }
    EXPECT_LE(worst.value(), budget::higher_gravity_difference);
  }
}

// Above the equator with the long axis at 45 degrees in the orbit plane: 3 gm/r^3 grows by (5/2)
// J2 (R/r)^2, as does the slope of the field's radial gradient.
TEST(OblateGravity, PitchInTheEquatorByHand) {
  const Body body(1.0, 2.0, 2.5);
  const double half = std::sqrt(0.5);
  const Still r{{2.0 * half, 2.0 * half, 0.0}};
  const Setting at{body, 0.0, {{}, {}}, {}};
  const Effect point = GravityGradient(8.0, r).effect(at);
  const Effect oblate = OblateGravity(8.0, r, {0.1, 0.5}).effect(at);
  EXPECT_NEAR(oblate.u.z / point.u.z, 2.5 * 0.1 * 0.0625, budget::perturb_eps * eps);
  EXPECT_EQ(oblate.u.x, 0.0);
  EXPECT_EQ(oblate.u.y, 0.0);
}

TEST(OblateGravity, SphereHasNone) {
  const Body sphere(2.0, 2.0, 2.0);
  const Case c = drawn_case(806, 0);
  const OblateGravity term(1.0, Curve{}, {0.1, 1.0});
  const Setting at{sphere, c.t, c.s, c.q_IS};
  EXPECT_EQ(term.effect(at), Effect{});
  EXPECT_EQ(term.energy(at), 0.0);
}

TEST(OblateGravity, RefusesWhatIsNoPlanet) {
  EXPECT_MESSAGE((Oblateness{1e-3, -1.0}), "Oblateness: radius -1 must be positive and finite");
  EXPECT_MESSAGE(OblateGravity(-1.0, Curve{}, {0.1, 1.0}),
                 "OblateGravity: gm -1 must be positive and finite");
  EXPECT_MESSAGE(OblateGravity(1.0, Curve{}, {0.1, 0.0}),
                 "Oblateness: radius 0 must be positive and finite");
  EXPECT_MESSAGE(OblateGravity(1.0, Curve{}, {HUGE_VAL, 1.0}), "Oblateness: J2 inf must be finite");
  EXPECT_MESSAGE(OblateGravity(1.0, Curve{}, {0.1, 1.0, {0.0, 0.0, 0.0}}),
                 "Oblateness: pole (0, 0, 0) must be a direction: finite and not 0");
}

}  // namespace
}  // namespace perturb_test
