// SPDX-License-Identifier: MIT
// Sadov's and Serret's sets where they are singular: the documented limit, never NaN.
#include <gmock/gmock.h>

#include <random>
#include <string_view>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "unit/free/support.hpp"
#include "worst.hpp"

namespace {

using namespace free_test;
using namespace polhode;
using free_test::pi;

bool finite(const SerretState& s) { return std::isfinite(s.g0 + s.h + s.t0 + s.G + s.H + s.T); }
bool finite(const SadovState& s) {
  return std::isfinite(s.phi_l + s.phi_g + s.phi_h + s.I_l + s.I_g + s.I_h);
}
// A state moved, with its moments, to other names of the body axes.
NamedMotion renamed(const NamedMotion& m, int shift) {
  NamedMotion r = m;
  for (int i = 0; i < 3; ++i) {
    r.moments[(i + shift) % 3] = m.moments[i];
    r.g[(i + shift) % 3] = m.g[i];
  }
  return r;
}

std::vector<NamedMotion> all_motions() {
  std::vector<NamedMotion> all;
  for (NamedMotion m : motions())
    for (int shift = 0; shift < 3; ++shift) all.push_back(renamed(m, shift));
  const Vec3 prolate{2.0, 5.0, 5.0}, oblate{3.0, 3.0, 5.0};
  for (const double sign : {1.0, -1.0}) {
    for (int shift = 0; shift < 3; ++shift) {
      for (const Vec3& g : {Vec3{sign, 0, 0}, Vec3{0, sign, 0}, Vec3{0, 0, sign}}) {
        all.push_back(renamed({"prolate about an axis", prolate, g, Regime::steady}, shift));
        all.push_back(renamed({"oblate about an axis", oblate, g, Regime::steady}, shift));
      }
    }
  }
  return all;
}

TEST(FlowAdaptedLimits, AreFiniteForEveryMotion) {
  for (const NamedMotion& m : all_motions()) {
    for (const double t : {0.0, 17.7, -1e9}) {
      EXPECT_TRUE(finite(to_serret(m.motion(), t))) << m.name << " " << t;
      EXPECT_TRUE(finite(to_sadov(m.motion(), t))) << m.name << " " << t;
    }
  }
}

// The axis of a steady rotation: how many principal axes have its moment, and where that is.
enum class Spin { long_axis, middle_axis, short_axis, any_of_two, any_of_three };
Spin spin_of(const NamedMotion& m) {
  const std::array<double, 3> I{m.moments.x, m.moments.y, m.moments.z};
  double spun = 0.0;
  for (int i = 0; i < 3; ++i)
    if (m.g[i] != 0.0) spun = m.moments[i];
  const auto equal = std::ranges::count(I, spun);
  if (equal == 3) return Spin::any_of_three;
  if (equal == 2) return Spin::any_of_two;
  if (spun == smaller(I[0], I[1], I[2])) return Spin::long_axis;
  return spun == larger(I[0], I[1], I[2]) ? Spin::short_axis : Spin::middle_axis;
}

bool is_still(const FreeRotation& m) {
  return m.regime() == Regime::steady || m.regime() == Regime::rest;
}

TEST(FlowAdaptedLimits, SadovBringsSteadyRotationsBack) {
  for (const NamedMotion& m : all_motions()) {
    const FreeRotation motion = m.motion();
    if (!is_still(motion)) continue;
    const SadovState s = to_sadov(motion, 17.7);
    EXPECT_LE(difference(to_rotor(m.body(), s), motion.at(17.7)), budget::free_state) << m.name;
    if (motion.regime() == Regime::rest) continue;
    if (spin_of(m) == Spin::short_axis) {
      EXPECT_EQ(s.phi_l, 0.0) << m.name;
      EXPECT_EQ(std::abs(s.I_l), s.I_g) << m.name;
    } else if (spin_of(m) == Spin::long_axis) {
      EXPECT_EQ(s.phi_l, 0.0) << m.name;
      EXPECT_LE(s.I_l, budget::sadov_long_spin * s.I_g) << m.name;
    } else if (spin_of(m) == Spin::middle_axis) {
      EXPECT_NEAR(std::abs(s.phi_l), 0.5 * pi, budget::free_state) << m.name;
    }
  }
}

TEST(FlowAdaptedLimits, SerretBringsSpinsBack) {
  for (const NamedMotion& m : all_motions()) {
    const FreeRotation motion = m.motion();
    if (!is_still(motion) || motion.regime() == Regime::rest) continue;
    const SerretState s = to_serret(motion, 17.7);
    switch (spin_of(m)) {
      case Spin::any_of_three:
        EXPECT_EQ(s.t0, 17.7) << m.name;
        EXPECT_REJECTED(to_rotor(m.body(), s, 17.7), "a sphere has no Serret elements");
        continue;
      case Spin::any_of_two: {  // l is lost, and nothing else
        EXPECT_EQ(s.t0, 17.7) << m.name;
        const RotorState back = to_rotor(m.body(), s, 17.7);
        EXPECT_LE(norm(inertial_momentum(back) - inertial_momentum(m.start())),
                  budget::free_invariants * norm(m.g))
            << m.name;
        EXPECT_LE(relative(kinetic_energy(m.body(), back), motion.energy()),
                  budget::free_invariants)
            << m.name;
        continue;
      }
      case Spin::long_axis:
      case Spin::short_axis:
        EXPECT_EQ(s.t0, 17.7) << m.name;
        EXPECT_LE(difference(to_rotor(m.body(), s, 17.7), motion.at(17.7)), budget::serret_spin)
            << m.name;
        continue;
      case Spin::middle_axis:
        EXPECT_LE(difference(to_rotor(m.body(), s, 17.7), motion.at(17.7)),
                  budget::serret_separatrix)
            << m.name;
    }
  }
}

// I = 0 and pi, to the rounding of the quaternion: there is no node, and h = 0.
TEST(FlowAdaptedLimits, MomentumAlongTheThirdInertialAxisHasNoNode) {
  for (const NamedMotion& m : all_motions()) {
    if (m.regime == Regime::rest || m.g == Vec3{0.0, 0.0, -norm(m.g)}) continue;
    for (const bool down : {false, true}) {
      const Vec3 k = (1.0 / norm(m.g)) * m.g;
      const Quaternion upright = normalized(Quaternion{1.0 + k.z, k.y, -k.x, 0.0});  // k to e_z
      const Quaternion flip{down ? 0.0 : 1.0, down ? 1.0 : 0.0, 0.0, 0.0};
      const RotorState s{flip * rotation_z(0.7) * upright, m.g};
      const FreeRotation motion(m.body(), s);
      if (spin_of(m) == Spin::any_of_three) continue;  // Andoyer's, of a rounded momentum
      const SadovState sadov = to_sadov(motion, 17.7);
      EXPECT_EQ(sadov.phi_h, 0.0) << m.name << " " << down;
      EXPECT_EQ(sadov.I_h, down ? -sadov.I_g : sadov.I_g) << m.name << " " << down;
      const std::string_view name = m.name;  // near the separatrix and b3 actions hold J badly
      const bool loses_more = name.find("next to") != name.npos || name.find("sepa") != name.npos;
      if (!loses_more) {
        EXPECT_LE(difference(to_rotor(m.body(), sadov), motion.at(17.7)), budget::free_invariants)
            << m.name << " " << down;
      }
      if (motion.regime() == Regime::steady) continue;
      const SerretState serret = to_serret(motion, 17.7);
      EXPECT_EQ(serret.h, 0.0) << m.name << " " << down;
      EXPECT_EQ(serret.H, down ? -serret.G : serret.G) << m.name << " " << down;
    }
  }
}

// So near to I = 0 that H is G to rounding, it is that of the set, bit by bit.
TEST(FlowAdaptedLimits, HIsExactlyGWhereItIsToRounding) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const Vec3 g{component(random), component(random), component(random)};
    const Vec3 axis = (1.0 / norm(g)) * g;
    const Quaternion upright = normalized(Quaternion{1.0 + axis.z, axis.y, -axis.x, 0.0});
    const Quaternion tilted = normalized(Quaternion{1.0, 1e-10, 0.0, 0.0});
    const FreeRotation motion(Body(1.0, 1.7, 2.1), {tilted * upright, g});
    const SadovState sadov = to_sadov(motion, 0.0);
    EXPECT_EQ(sadov.I_h, sadov.I_g) << k;
  }
}

// All four branches, from where they leave one spin about b2 to where they reach the other.
TEST(FlowAdaptedLimits, SerretBringsTheSeparatrixBack) {
  const Body body(3.0, 4.0, 6.0);
  const Quaternion q{0.6, -0.3, 0.7, 0.2};
  for (const double sign_1 : {1.0, -1.0}) {
    for (const double sign_3 : {1.0, -1.0}) {
      const FreeRotation motion(body, {q, {sign_1, 0.5, sign_3}});
      ASSERT_EQ(motion.regime(), Regime::separatrix);
      for (const double t : {-20.0, -5.0, -1.0, 0.0, 0.3, 3.0, 20.0}) {
        const SerretState s = to_serret(motion, t);
        EXPECT_EQ(s.sign_g1, sign_1);
        EXPECT_EQ(s.sign_g3, sign_3);
        EXPECT_LE(difference(to_rotor(body, s, t), motion.at(t)), budget::serret_separatrix) << t;
      }
    }
  }
}

}  // namespace
