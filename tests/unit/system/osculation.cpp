// SPDX-License-Identifier: MIT
// Canonical momenta of osculating ones: affine and not, without an answer, and terms that know no
// derivatives.
#include "polhode/system/osculation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/system/axes.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;

const Body body(3, 4, 6);
const RotorState state{normalized(Quaternion{0.5, -0.7, 0.3, 0.4}), {1.2, -0.7, 2.1}};

template <class F>
System with_energy(F H) {
  return System(body, Frame::inertial(), {AnyPerturbation("term", HamiltonianTerm(H))});
}

TEST(OsculatingState, OfAFrameIsTheMomentumOfTheRelativeRate) {
  const Vec3 axis{0.6, 0.0, 0.8};
  const System system(body, Frame::precessing(axis, 0.25));
  const Vec3 mu = rotate(conj(state.q), 0.25 * axis);
  const Vec3 expected = state.g - Vec3{3 * mu.x, 4 * mu.y, 6 * mu.z};
  const RotorState osculating = charts::osculating_state(system, 0.0, state);
  EXPECT_LT(norm(osculating.g - expected), budget::rates_rounding);
  EXPECT_EQ(osculating.q, state.q);
  EXPECT_LT(norm(charts::canonical_state(system, 0.0, osculating).g - state.g),
            budget::rates_rounding);
}

TEST(OsculatingState, WithoutVTheTwoAgreeToTheLastBit) {
  const System system(body, Frame::inertial(),
                      {AnyPerturbation("torque", TorqueTerm([](double, const RotorState&) {
                                         return Vec3{0.1, 0.2, 0.3};
                                       }))});
  EXPECT_EQ(charts::osculating_state(system, 0.0, state), state);
  EXPECT_EQ(charts::canonical_state(system, 0.0, state), state);
}

// v = c g_i^3: one real root in each axis, far from the first guess.
TEST(OsculatingState, StronglyNonlinear) {
  const System system = with_energy([]<class T>(const T&, const BasicRotorState<T>& s) {
    const BasicVec3<T>& g = s.g;
    return T(g.x * g.x * g.x * g.x + g.y * g.y * g.y * g.y + g.z * g.z * g.z * g.z);
  });
  for (const double size : {1e-3, 1.0, 50.0}) {
    const RotorState s{state.q, size * state.g};
    const RotorState back =
        charts::canonical_state(system, 0.0, charts::osculating_state(system, 0.0, s));
    EXPECT_LT(norm(back.g - s.g) / norm(s.g), budget::osculation_round_trip) << size;
  }
}

// A term on double alone, whose v depends on g a little: found by iteration all the same.
struct WeakOnDouble {
  Effect effect(const Setting& at) const { return {0.01 * at.s.g, {}}; }
};
struct StrongOnDouble {
  Effect effect(const Setting& at) const { return {-2.0 * at.s.g, {}}; }
};

TEST(OsculatingState, TermsWithoutDerivatives) {
  const System weak(body, Frame::inertial(), {AnyPerturbation("weak", WeakOnDouble{})});
  const RotorState back =
      charts::canonical_state(weak, 0.0, charts::osculating_state(weak, 0.0, state));
  EXPECT_LT(norm(back.g - state.g) / norm(state.g), budget::osculation_round_trip);
}

TEST(OsculatingState, NoCanonicalMomentum) {
  // g + I v = g_x^2 + 1 along b1 has no root for g_osc = 0
  const System none = with_energy([]<class T>(const T&, const BasicRotorState<T>& s) {
    const T& x = s.g.x;
    return T(x * x * x / T(3.0) + x - T(0.5) * x * x) / T(3.0);
  });
  const RotorState still{state.q, {}};
  EXPECT_REJECTED(charts::canonical_state(none, 0.0, still), "no canonical momentum");
  // v cancels the free rate whatever g is: 1 + I dv/dg = 0
  const System frozen = with_energy([]<class T>(const T&, const BasicRotorState<T>& s) {
    const BasicVec3<T>& g = s.g;
    return T(-(g.x * g.x / T(6.0) + g.y * g.y / T(8.0) + g.z * g.z / T(12.0)));
  });
  EXPECT_REJECTED(charts::canonical_state(frozen, 0.0, state), "canonical_state");
  const System strong(body, Frame::inertial(), {AnyPerturbation("strong", StrongOnDouble{})});
  EXPECT_NE(message_of([&] { charts::canonical_state(strong, 0.0, state); }), "");
}

TEST(OsculatingState, NaNInNaNOut) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const System system(body, Frame::precessing({0, 0, 1}, 0.25));
  EXPECT_TRUE(std::isnan(charts::canonical_state(system, 0.0, {state.q, {none, 0, 0}}).g.x));
}

TEST(Axes, PolesAndNothing) {
  EXPECT_EQ(charts::axis_angles({0, 0, 2}), (charts::AxisAngles{0.0, 0.0}));
  EXPECT_EQ(charts::axis_angles({0, 0, -2}), (charts::AxisAngles{std::acos(-1.0), 0.0}));
  EXPECT_TRUE(std::isnan(charts::axis_angles({}).I) && std::isnan(charts::axis_angles({}).h));
  EXPECT_EQ(charts::axis_angles({1e-300, 0, 1}).I, 1e-300);  // a tiny inclination is kept
  EXPECT_EQ(charts::axis_angles({1, 0, 0}).h, std::acos(0.0));
  EXPECT_EQ(charts::axis_angles({0, -1, 0}).h, 0.0);
}

// Figure and momentum axes agree with the charts; a body that turns with the frame has no relative
// rotation axis.
TEST(Axes, AgreeWithTheCharts) {
  const double rate = 0.25;
  const System system(body, Frame::precessing({0, 0, 1}, rate));
  const charts::RotorAxes axes = charts::relative_axes(system, 1.0, state);
  const EulerState e = to_euler(state);
  const AndoyerState a = to_andoyer(state);
  EXPECT_NEAR(axes.figure.I, e.theta, budget::rates_rounding);
  EXPECT_NEAR(axes.figure.h, e.phi, budget::rates_rounding);
  EXPECT_NEAR(axes.momentum.I, std::acos(a.H / a.G), budget::rates_rounding);
  EXPECT_NEAR(axes.momentum.h, a.h, budget::rates_rounding);
  const RotorState carried{{1, 0, 0, 0}, {0, 0, 6 * rate}};
  EXPECT_TRUE(std::isnan(charts::relative_axes(system, 0.0, carried).rotation.I));
  EXPECT_EQ(charts::inertial_axes(system, 0.0, carried).rotation.I, 0.0);
}

TEST(ModifiedAndoyer, IsTheRegularSetAtItsEpoch) {
  const AndoyerState C = charts::modified_andoyer(body, 2.0, state, 2.0), a = to_andoyer(state);
  EXPECT_NEAR(C.l, a.l, budget::rates_rounding);
  EXPECT_NEAR(C.g, a.g, budget::rates_rounding);
  EXPECT_NEAR(C.L, a.L, budget::rates_rounding);
  const System system(body, Frame::precessing({0, 0, 1}, 0.25));
  const rates::AndoyerRates there = charts::modified_andoyer_rates(system, 2.0, state, 2.0);
  const rates::CanonicalRates added =
      rates::perturbation_rates(system, 2.0, state, CanonicalChart{CanonicalSet::andoyer});
  EXPECT_NEAR(there.l, added[0], budget::rates_rounding);
  EXPECT_NEAR(there.g, added[1], budget::rates_rounding);
  EXPECT_NEAR(there.h, added[2], budget::rates_rounding);
  EXPECT_NEAR(there.H, added[5], budget::rates_rounding);
}

// Written in Andoyer variables: derivatives of the canonical state by the osculating one.
TEST(CanonicalState, OfDualAndDoubleDoubleIsTheInverse) {
  const auto H = []<class T>(const T&, const BasicRotorState<T>& s) {
    return T(T(0.01) * s.g.x * s.g.y * s.g.z + T(0.02) * s.q.x * s.q.y * s.g.x);
  };
  const System system(body, Frame::precessing({0.6, 0.0, 0.8}, 0.05),
                      {AnyPerturbation("bent", HamiltonianTerm(H))});
  const AndoyerState C = to_andoyer(state);
  const auto variable = [](double x, int k) { return Tangent::variable(x, k); };
  const BasicAndoyerState<Tangent> z{variable(C.l, 0), variable(C.g, 1), variable(C.h, 2),
                                     variable(C.L, 3), variable(C.G, 4), variable(C.H, 5)};
  const auto canonical = charts::canonical_state(system, 0.2, to_rotor(z));
  const BasicAndoyerState<Tangent> back =
      to_andoyer(charts::osculating_state(system, 0.2, canonical));
  const std::array<Tangent, 6> found{back.l, back.g, back.h, back.L, back.G, back.H};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_NEAR(found[i].derivative[j], i == j ? 1.0 : 0.0, budget::osculation_derivatives);
  EXPECT_GT(std::fabs(canonical.g.x.derivative[3] - to_rotor(z).g.x.derivative[3]), 1e-3);

  using DD = DoubleDouble;
  const BasicRotorState<DD> wide{{DD(0.5) / sqrt(DD(0.99)), DD(-0.7) / sqrt(DD(0.99)),
                                  DD(0.3) / sqrt(DD(0.99)), DD(0.4) / sqrt(DD(0.99))},
                                 {DD(1.2), DD(-0.7), DD(2.1)}};
  const BasicVec3<DD> missing =
      charts::osculating_state(system, 0.2, charts::canonical_state(system, 0.2, wide)).g - wide.g;
  EXPECT_LT(std::fabs(to_double(norm(missing))), budget::osculation_double_double);
}

}  // namespace
