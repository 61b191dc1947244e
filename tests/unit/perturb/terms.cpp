// SPDX-License-Identifier: MIT
// Constant torque, damping, terms of the user, and the list of terms.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/system/system.hpp"
#include "unit/perturb/every_term.hpp"
#include "unit/perturb/support.hpp"
#include "worst.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using polhode::test::larger;
using polhode::test::smaller;
using polhode::test::Worst;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// --- constant torque ---

TEST(ConstantTorque, StaysInItsAxes) {
  const Vec3 u{0.3, -0.2, 0.9};
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Case c = drawn_case(521, i);
    const Setting at = c.on<double>();
    EXPECT_EQ(ConstantTorque::in_body(u).effect(at).u, u);
    const Vec3 in_S = rotate(c.s.q, ConstantTorque::in_space(u, SpaceAxes::reference).effect(at).u);
    EXPECT_LE(norm(in_S - u), budget::perturb_eps * eps);
    const Vec3 in_I = rotate(c.q_IS, rotate(c.s.q, ConstantTorque::in_space(u).effect(at).u));
    EXPECT_LE(norm(in_I - u), budget::perturb_eps * eps);
  }
}

TEST(ConstantTorque, HasNoEnergy) {
  const AnyPerturbation term("jet", ConstantTorque::in_space({0.0, 0.0, 1.0}));
  EXPECT_MESSAGE(term.energy(drawn_case(522, 0).on<double>()),
                 "AnyPerturbation: term \"jet\" has no energy");
}

TEST(AnyPerturbation, GivesBackTheTermThatItHolds) {
  const AnyPerturbation jet("jet", ConstantTorque::in_space({1.0, 2.0, 3.0}));
  const AnyPerturbation thruster("thruster", ConstantTorque::in_body({1.0, 2.0, 3.0}));
  ASSERT_NE(jet.target<ConstantTorque>(), nullptr);
  EXPECT_EQ(jet.target<ConstantTorque>()->torque(), (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(jet.target<ConstantTorque>()->space_axes(), SpaceAxes::inertial);
  EXPECT_FALSE(thruster.target<ConstantTorque>()->space_axes().has_value());
  EXPECT_EQ(jet.target<LinearDamping>(), nullptr);
}

TEST(ConstantTorque, RefusesWhatIsNotFinite) {
  EXPECT_MESSAGE(ConstantTorque::in_body({0.0, not_a_number, 1.0}),
                 "ConstantTorque: torque (0, nan, 1) must be finite");
}

// --- damping ---

const Mat3 full{{{0.5, 0.1, -0.2}, {0.1, 0.3, 0.05}, {-0.2, 0.05, 0.4}}};
// The same friction about one oblique axis alone.
const Mat3 of_rank_one{{{1.0, 2.0, 2.0}, {2.0, 4.0, 4.0}, {2.0, 4.0, 4.0}}};

std::vector<LinearDamping> dampings(const Body& body) {
  return {LinearDamping(0.4), LinearDamping(Vec3{0.1, 0.0, 2.0}), LinearDamping(full, body),
          LinearDamping(of_rank_one, body)};
}

TEST(LinearDamping, OpposesTheRate) {
  const Case c = drawn_case(531, 0);
  const Setting at = c.on<double>();
  const Vec3 w = angular_velocity(c.body, c.s);
  EXPECT_LE(norm(LinearDamping(full, c.body).effect(at).u + full * w), budget::perturb_eps * eps);
  EXPECT_LE(norm(LinearDamping(0.4).effect(at).u + 0.4 * w), budget::perturb_eps * eps);
  for (const LinearDamping& term : dampings(c.body)) {
    EXPECT_LE(dot(term.effect(at).u, w), 0.0);
    EXPECT_EQ(term.effect(at).v, Vec3{});
  }
}

// exp(-h D I^-1) g by its Taylor series at 76 digits.
WideVec3 by_series(const Mat3& D, const Vec3& I, const Vec3& g, double h) {
  WideVec3 sum = wide(g), power = wide(g);
  for (int k = 1; k < 400; ++k) {
    WideVec3 next;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) next[i] -= Wide(D(i, j)) * power[j] / I[j] * h / k;
    }
    power = next;
    sum = sum + power;
  }
  return sum;
}

TEST(LinearDamping, FlowIsTheExponential) {
  Worst worst;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Case c = drawn_case(532, i);
    for (const LinearDamping& term : dampings(c.body)) {
      for (const double h : {1e-6, 0.1, 3.0, -2.0}) {
        const RotorState after = term.flow(c.on<double>(), h);
        const Vec3& I = c.body.moments();
        const Mat3& D = term.matrix();
        const WideVec3 want = by_series(D, I, c.s.g, h);
        // A rounding of the exponent, at most h tr D / I, is one of the result.
        const double exponent =
            std::abs(h) * (D(0, 0) + D(1, 1) + D(2, 2)) / smaller(I.x, I.y, I.z);
        const double size = larger(norm(c.s.g), largest(want)) * (1.0 + exponent);
        worst.add(largest(wide(after.g) - want) / size);
        EXPECT_EQ(after.q, c.s.q);
      }
    }
  }
  EXPECT_LE(worst.value(), budget::damping_flow_eps * eps);
}

TEST(LinearDamping, FlowsFormAGroup) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Case c = drawn_case(533, i);
    for (const LinearDamping& term : dampings(c.body)) {
      const Setting at = c.on<double>();
      Setting half = at;
      half.s = term.flow(at, 0.3);
      const Vec3 twice = term.flow(half, 0.7).g, once = term.flow(at, 1.0).g;
      EXPECT_LE(norm(twice - once), budget::damping_flow_eps * eps * norm(c.s.g));
      EXPECT_EQ(term.flow(at, 0.0).g, c.s.g);
    }
  }
}

TEST(LinearDamping, FlowOfAnotherBody) {
  const Case c = drawn_case(534, 0);
  const LinearDamping made_for_another(full, Body(1.0, 1.0, 1.0)), own(full, c.body);
  EXPECT_EQ(made_for_another.flow(c.on<double>(), 0.4), own.flow(c.on<double>(), 0.4));
}

TEST(LinearDamping, RefusesWhatDrives) {
  const Body body(1.0, 1.0, 1.0);
  EXPECT_MESSAGE(LinearDamping(-0.1),
                 "LinearDamping: coefficients (-0.1, -0.1, -0.1) must be >= 0 and finite");
  EXPECT_NE(message_of([] { LinearDamping(Vec3{0.0, not_a_number, 0.0}); }), "");
  const Mat3 driving{{{1.0, 2.0, 0.0}, {2.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  EXPECT_REJECTED(LinearDamping(driving, body), "has the eigenvalue -");
  const Mat3 skew{{{1.0, 0.5, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  EXPECT_REJECTED(LinearDamping(skew, body), "must be symmetric");
  Mat3 hole = Mat3::identity();
  hole(1, 2) = not_a_number;
  EXPECT_REJECTED(LinearDamping(hole, body), "must be finite");
}

TEST(LinearDamping, InAListOfTerms) {
  const AnyPerturbation term("air", LinearDamping(0.2));
  const Case c = drawn_case(535, 0);
  EXPECT_EQ(term.flow(c.on<double>(), 0.3), LinearDamping(0.2).flow(c.on<double>(), 0.3));
}

// --- all terms ---

// What methods ask a term for; a kick changes the momentum alone.
TEST(EveryTerm, SaysWhatItHas) {
  const struct {
    const char* name;
    bool has_energy, has_flow, is_kick;
  } rows[] = {{"gravity gradient", true, true, true},
              {"in S", true, true, true},
              {"higher gravity", true, true, true},
              {"oblate gravity", true, true, true},
              {"constant in body", false, true, true},
              {"constant in space", false, true, true},
              {"damping", false, true, false},
              {"full damping", false, true, false},
              {"internal damping", false, false, false},
              {"table", false, false, false},
              {"tide", false, false, false},
              {"dipole", true, true, true},
              {"eddy", false, true, false},
              {"sunlight", false, true, true},
              {"drag", false, true, true},
              {"own", false, false, false}};
  const Case c = drawn_case(508, 0);
  const Setting at = c.on<double>();
  const std::vector<AnyPerturbation> terms = every_term(c.body);
  ASSERT_EQ(terms.size(), std::size(rows));
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const AnyPerturbation& term = terms[i];
    SCOPED_TRACE(term.name());
    EXPECT_EQ(term.name(), rows[i].name);
    EXPECT_EQ(term.supports_energy(), rows[i].has_energy);
    EXPECT_EQ(term.supports_flow(), rows[i].has_flow);
    EXPECT_EQ(term.is_kick(), rows[i].is_kick);
    EXPECT_TRUE(term.supports_any_real());
    if (!rows[i].has_energy) {
      EXPECT_REJECTED(term.energy(at), "has no energy");
    }
    if (!rows[i].has_flow) {
      EXPECT_REJECTED(term.flow(at, 0.5), "has no exact flow");
    }
    if (!term.is_kick()) continue;
    const RotorState after = term.flow(at, 0.5);
    EXPECT_EQ(after.q, c.s.q);
    EXPECT_EQ(after.g, c.s.g + 0.5 * term.effect(at).u);
  }
}

// --- terms of the user ---

// Momentum-dependent, explicit in time, without any symmetry.
struct Generic {
  template <Real T>
  T operator()(const T& t, const BasicRotorState<T>& s) const {
    using std::sin;
    const BasicVec3<T> k = rotate(conj(s.q), BasicVec3<T>{T(0.6), T(0.0), T(0.8)});
    return sin(t) * dot(k, s.g) + T(0.3) * s.g.x * s.g.y * k.z + T(0.5) * k.x * k.x * k.y +
           s.q.w * s.q.x / dot(k, k);
  }
};

TEST(HamiltonianTerm, EffectIsTheDerivativeOfAnyHamiltonian) {
  const HamiltonianTerm term{Generic{}};
  Worst worst, worst_wide;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = drawn_case(541, i);
    const BasicEffect<Wide> want = effect_by_differences(term, c.on<Wide>());
    const Effect got = term.effect(c.on<double>());
    const BasicEffect<DoubleDouble> fine = term.effect(c.on<DoubleDouble>());
    const double size = 1.0 + dot(c.s.g, c.s.g);
    worst.add(larger(largest(wide(got.u) - want.u) / size, largest(wide(got.v) - want.v) / size));
    worst_wide.add(
        larger(largest(wide(fine.u) - want.u) / size, largest(wide(fine.v) - want.v) / size));
  }
  EXPECT_LE(worst.value(), budget::perturb_eps * eps);
  EXPECT_LE(worst_wide.value(), budget::perturb_difference);
}

// H' = a.g + (g1 g2): v = a + (g2, g1, 0), u = 0, by hand.
TEST(HamiltonianTerm, MomentumTermsByHand) {
  const HamiltonianTerm term{
      [](const auto&, const auto& s) { return 2.0 * s.g.x - 0.5 * s.g.z + s.g.x * s.g.y; }};
  const Case c = drawn_case(542, 0);
  const Effect e = term.effect(c.on<double>());
  EXPECT_EQ(e.v, (Vec3{2.0 + c.s.g.y, c.s.g.x, -0.5}));
  EXPECT_EQ(e.u, Vec3{});
}

// H' = -B.(R m), a magnet m of the body in a field B of S: the torque is m x (R^T B).
TEST(HamiltonianTerm, MagnetByHand) {
  const Vec3 B{0.2, -0.4, 0.7}, m{0.0, 0.3, 0.1};
  const HamiltonianTerm term{[=](const auto&, const auto& s) {
    using T = std::decay_t<decltype(s.g.x)>;
    const BasicVec3<T> m_S = rotate(s.q, BasicVec3<T>{T(m.x), T(m.y), T(m.z)});
    return -(T(B.x) * m_S.x + T(B.y) * m_S.y + T(B.z) * m_S.z);
  }};
  const Case c = drawn_case(543, 0);
  const Vec3 want = cross(m, rotate(conj(c.s.q), B));
  EXPECT_LE(norm(term.effect(c.on<double>()).u - want), budget::perturb_eps * eps);
  EXPECT_EQ(term.effect(c.on<double>()).v, Vec3{});
}

// The frame's own term, which System adds, is H' = -mu.g [SA (118)], written by hand as a user's
// term in an inertial frame.
TEST(HamiltonianTerm, FrameTermByHandIsThatOfSystem) {
  const Vec3 mu{0.3, -0.5, 0.2};
  const HamiltonianTerm by_hand{[=](const auto&, const auto& s) {
    using T = std::decay_t<decltype(s.g.x)>;
    return -dot(BasicVec3<T>{T(mu.x), T(mu.y), T(mu.z)}, rotate(s.q, s.g));
  }};
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Case c = drawn_case(544, i);
    const System moving(c.body, Frame::precessing(mu, norm(mu)));
    const System still(c.body, Frame::inertial(), {AnyPerturbation("frame", by_hand)});
    const Effect want = effect(moving, c.t, c.s), got = effect(still, c.t, c.s);
    const double bound = budget::perturb_eps * eps * (1.0 + norm(c.s.g));
    EXPECT_LE(norm(got.v - want.v), bound);
    EXPECT_LE(norm(got.u - want.u), bound);
    EXPECT_LE(std::abs(energy(still, c.t, c.s) - energy(moving, c.t, c.s)), 4.0 * bound);
  }
}

TEST(HamiltonianTerm, WithTangentStates) {
  const AnyPerturbation term("generic", HamiltonianTerm{Generic{}});
  EXPECT_TRUE(term.supports_any_real());
  EXPECT_TRUE(term.supports_energy());
  EXPECT_FALSE(term.supports_flow());
  const Case c = drawn_case(545, 0);
  BasicSetting<Tangent> at = c.on<Tangent>();
  at.s.g.y = Tangent::variable(c.s.g.y, 4);
  const BasicEffect<Tangent> e = term.effect(at);
  // v_x = sin(t) k_x + 0.3 g_y k_z: by g_y it is 0.3 k_z
  const Vec3 k = rotate(conj(c.s.q), Vec3{0.6, 0.0, 0.8});
  EXPECT_NEAR(e.v.x.derivative[4], 0.3 * k.z, budget::perturb_eps * eps);
  EXPECT_MESSAGE(term.flow(c.on<double>(), 0.1),
                 "AnyPerturbation: term \"generic\" has no exact flow: use a method that needs "
                 "none (Collocation)");
}

TEST(TorqueTerm, OnDoubleAlone) {
  const AnyPerturbation term("thruster", TorqueTerm{[](double t, const RotorState& s) {
                               return Vec3{t, 0.0, -s.g.z};
                             }});
  EXPECT_FALSE(term.supports_any_real());
  EXPECT_FALSE(term.supports_energy());
  EXPECT_FALSE(term.supports_flow());
  const Case c = drawn_case(546, 0);
  EXPECT_EQ(term.effect(c.on<double>()).u, (Vec3{c.t, 0.0, -c.s.g.z}));
  EXPECT_MESSAGE(term.effect(c.on<DoubleDouble>()),
                 "AnyPerturbation: term \"thruster\" works on double alone: write it as a template "
                 "on the number type");
}

TEST(TorqueTerm, Generic) {
  const AnyPerturbation term(
      "drag", TorqueTerm{[](const auto& t, const auto& s) { return -(t * t) * s.g; }});
  EXPECT_TRUE(term.supports_any_real());
  const Case c = drawn_case(547, 0);
  EXPECT_EQ(term.effect(c.on<double>()).u, -(c.t * c.t) * c.s.g);
  EXPECT_EQ(term.effect(c.on<Tangent>()).u.x.value, -(c.t * c.t) * c.s.g.x);
}

TEST(TorqueTerm, ExceptionsPassThrough) {
  const AnyPerturbation term("broken", TorqueTerm{[](double, const RotorState&) -> Vec3 {
                               throw std::runtime_error("no fuel");
                             }});
  EXPECT_THROW((void)term.effect(drawn_case(548, 0).on<double>()), std::runtime_error);
}

}  // namespace
}  // namespace perturb_test
