// SPDX-License-Identifier: MIT
// Equations of motion of elements in every gauge, beside the quaternion-momentum equations of the
// same system: rates by differences along a motion, and a motion integrated in elements.
#include "polhode/system/element_rates.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "polhode/system/osculation.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

const Body body(3, 4, 6);
const RotorState start{normalized(Quaternion{0.5, -0.7, 0.3, 0.4}), {1.2, -0.7, 2.1}};

// dH'/dg is quadratic in g, turns with the reference axes, and depends on time.
System bent_system() {
  const auto H = []<class T>(const T& t, const BasicRotorState<T>& s) {
    using std::cos;
    const BasicVec3<T> n = rotate(conj(s.q), BasicVec3<T>{T(0.36), T(0.48), T(0.8)});
    const T along = dot(n, s.g);
    return T(T(0.002) * along * along * along + T(0.004) * cos(T(0.7) * t) * s.g.x * n.y);
  };
  return System(body, Frame::precessing({0.6, 0.0, 0.8}, 0.05),
                {AnyPerturbation("bent", HamiltonianTerm(H))});
}
System precessing_system() { return System(body, Frame::precessing({0.6, 0.0, 0.8}, 0.05)); }
// v on double alone, and a torque without an energy.
struct OnDouble {
  Effect effect(const Setting& at) const {
    const Vec3& g = at.s.g;
    return {{0.01 * g.y * g.z, 0.02 * std::sin(at.t), 0.01 * g.x}, {0.03, -0.02 * g.y, 0.01}};
  }
};
System narrow_system() {
  return System(body, Frame::inertial(), {AnyPerturbation("narrow", OnDouble{})});
}

// Phi of the elements and time.
rates::Gauge general_gauge() {
  return rates::Gauge([](const rates::Gauge::Elements& C, const Tangent& t) {
    using std::cos;
    using std::sin;
    return BasicVec3<Tangent>{Tangent(0.02) * sin(C[0] + Tangent(0.3) * t) * C[4],
                              Tangent(0.01) * C[3] + Tangent(0.02) * cos(C[1]),
                              Tangent(0.015) * sin(C[2]) + Tangent(0.004) * C[5]};
  });
}

template <class C>
std::array<double, 6> numbers(const C& c) {
  if constexpr (std::same_as<C, AndoyerState>)
    return {c.l, c.g, c.h, c.L, c.G, c.H};
  else if constexpr (std::same_as<C, FukushimaIshizakiState>)
    return {c.l0, c.g0, c.h, c.L0, c.G, c.H};
  else if constexpr (std::same_as<C, SerretState>)
    return {c.g0, c.h, -c.t0, c.G, c.H, c.T};
  else
    return {c.phi_l, c.phi_g, c.phi_h, c.I_l, c.I_g, c.I_h};
}

template <class S>
S end_of(const BasicTrajectory<S>& run) {
  EXPECT_TRUE(run.outcome().ok()) << run.outcome().advice;
  return run.at(run.stop());
}

RotorState at(const System& system, double t0, double t) {
  if (t == t0) return start;
  Problem p{system, start, t0, t, Collocation{.tolerance = 1e-15}};
  return end_of(integrate(p));
}

// d/dt of the elements along the motion by differences of order 8.
template <class C>
double error_of_rates(const System& system, const C& like, const rates::Gauge& gauge) {
  constexpr double t = 0.4, h = 0.04;
  constexpr std::array<double, 4> weights{672.0 / 840, -168.0 / 840, 32.0 / 840, -3.0 / 840};
  const C here = rates::elements_of_state(system, t, start, like, gauge);
  const std::array<double, 6> rates = rates::element_rates(system, t, here, gauge);
  Worst worst;
  std::array<double, 6> expected{};
  for (int k = 1; k <= 4; ++k) {
    const auto after =
        numbers(rates::elements_of_state(system, t + k * h, at(system, t, t + k * h), like, gauge));
    const auto before =
        numbers(rates::elements_of_state(system, t - k * h, at(system, t, t - k * h), like, gauge));
    for (std::size_t i = 0; i < 6; ++i) {
      double change = after[i] - before[i];
      if (i < 3 && !(i == 2 && std::same_as<C, SerretState>))
        change = std::remainder(change, 2.0 * std::numbers::pi);
      expected[i] += weights[static_cast<std::size_t>(k - 1)] * change / h;
    }
  }
  for (std::size_t i = 0; i < 6; ++i) worst.add(std::fabs(rates[i] - expected[i]));
  return worst.value();
}

template <class C>
void expect_rates(const C& like) {
  for (const rates::Gauge& gauge :
       {rates::Gauge::canonical(), rates::Gauge::osculating(), general_gauge()}) {
    EXPECT_LE(error_of_rates(precessing_system(), like, gauge), budget::element_rates);
    EXPECT_LE(error_of_rates(bent_system(), like, gauge), budget::element_rates);
    EXPECT_LE(error_of_rates(narrow_system(), like, gauge), budget::element_rates);
  }
}

// [SA (102), (104)]
TEST(ElementRates, AreThoseAlongAMotionInEverySetAndGauge) {
  expect_rates(AndoyerState{});
  expect_rates(FukushimaIshizakiState{0, 0, 0, 0, 0, 0, -0.3});
  expect_rates(SerretState{});
  expect_rates(SadovState{});
}

template <class C>
void expect_maps(const C& like) {
  const System system = bent_system();
  for (const rates::Gauge& gauge :
       {rates::Gauge::canonical(), rates::Gauge::osculating(), general_gauge()}) {
    const C elements = rates::elements_of_state(system, 0.4, start, like, gauge);
    const RotorState back = rates::element_state(system, 0.4, elements, gauge);
    EXPECT_LE(norm(back.g - start.g), budget::element_maps);
    // the angular velocity is that of the free motion and the convective term
    const C canonical = rates::elements_of_state(system, 0.4, start, like);
    const Vec3 w = angular_velocity(system, 0.4, start).relative;
    const RotorState free = rates::element_state(System(body), 0.4, elements);
    const Vec3 phi = rates::element_convective_term(system, 0.4, elements, gauge);
    EXPECT_LE(norm(Vec3{free.g.x / 3, free.g.y / 4, free.g.z / 6} + phi - w), budget::element_maps);
    EXPECT_EQ(numbers(canonical) == numbers(elements), gauge.is_canonical());
  }
}

// [SA (106), (109), (111)]
TEST(ElementRates, MapsThereAndBackInEverySetAndGauge) {
  expect_maps(AndoyerState{});
  expect_maps(FukushimaIshizakiState{0, 0, 0, 0, 0, 0, -0.3});
  expect_maps(SerretState{});
  expect_maps(SadovState{});
}

TEST(ElementRates, CanonicalOnesAreTheCanonicalRates) {
  const System system = bent_system();
  const auto known = rates::canonical_rates(system, 0.4, start, {CanonicalSet::andoyer});
  const auto rates = rates::element_rates(system, 0.4, to_andoyer(start));
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(rates[k], known[k], budget::element_maps);
}

// Six elements as the state of a run.
struct Six {
  std::array<double, 6> z{};
  bool operator==(const Six&) const = default;
};
template <class Visit>
void each_number(Six& s, Visit&& visit) {
  for (double& x : s.z) visit(x);
}
struct InAndoyer {
  using State = Six;
  using Values = std::array<double, 6>;
  static constexpr std::string_view name = "Andoyer elements";

  System system;
  rates::Gauge gauge;

  template <class T>
    requires std::same_as<T, double>
  Values values(const State& s) const {
    return s.z;
  }
  State state(const Values& y) const { return {y}; }
  Values rates(const DoubleDouble& t, const Values& y) const {
    return rates::element_rates(system, to_double(t),
                                AndoyerState{y[0], y[1], y[2], y[3], y[4], y[5]}, gauge);
  }
  double error_size(const Values& error, const Values&, const Values&) const {
    double sum = 0.0;
    for (const double x : error) sum += x * x;
    return std::sqrt(sum);
  }
};

// Rotated from one attitude to the other.
double angle(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = conj(a) * b;
  return 2.0 * std::asin(std::hypot(d.x, d.y, d.z));
}

double error_of_motion(const System& system, const rates::Gauge& gauge, double revolutions) {
  const double stop = revolutions * 2.0 * std::numbers::pi / norm(angular_velocity(body, start));
  const AndoyerState C = rates::elements_of_state(system, 0.0, start, AndoyerState{}, gauge);
  const BasicProblem<InAndoyer> p{
      {system, gauge}, {numbers(C)}, 0.0, stop, Collocation{.tolerance = 1e-14}};
  const Six end = end_of(integrate(p));
  const RotorState found = rates::element_state(
      system, stop, AndoyerState{end.z[0], end.z[1], end.z[2], end.z[3], end.z[4], end.z[5]},
      gauge);
  return angle(found.q, at(system, 0.0, stop).q);
}

// Further revolutions, and a general gauge over 100: docs/accuracy/perturbed-rotation.md.
TEST(ElementRates, AMotionInElementsIsThatInQuaternionAndMomentum) {
  for (const System& system : {precessing_system(), bent_system()}) {
    EXPECT_LE(error_of_motion(system, rates::Gauge::canonical(), 100.0), budget::element_motion);
    EXPECT_LE(error_of_motion(system, rates::Gauge::osculating(), 10.0), budget::element_motion);
    EXPECT_LE(error_of_motion(system, general_gauge(), 3.0), budget::element_motion);
  }
}

TEST(ElementRates, SingularitiesAndGaugesWithoutAnAnswerAreRejected) {
  const System system = precessing_system();
  const RotorState about_axis{start.q, {0.0, 0.0, 2.0}};
  EXPECT_REJECTED(rates::element_rates(system, 0.0, to_andoyer(about_axis)),
                  "a singularity of Andoyer's variables");
  // I Phi = -gamma: gamma + I Phi is 0 whatever the elements are
  const rates::Gauge none([](const rates::Gauge::Elements& C, const Tangent&) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const Tangent across = sqrt(C[4] * C[4] - C[3] * C[3]);
    return BasicVec3<Tangent>{Tangent(-1.0 / 3) * across * sin(C[0]),
                              Tangent(-1.0 / 4) * across * cos(C[0]), Tangent(-1.0 / 6) * C[3]};
  });
  EXPECT_REJECTED(rates::element_rates(system, 0.0, to_andoyer(start), none), "singular");
}

}  // namespace
