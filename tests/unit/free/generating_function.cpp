// SPDX-License-Identifier: MIT
// The generating function of Serret's transformation as a function of its arguments: gradients by
// differences at fixed attitude, the Jacobi equation, continuity along a motion, branches,
// refusals.
#include "polhode/free/generating_function.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;  // NOLINT
using polhode::EulerAngles;
using polhode::EulerState;
using polhode::SerretState;
using polhode::free::generating_function;
using polhode::free::GeneratingFunction;
using polhode::test::Worst;
namespace budget = polhode::budget;

// Arguments of S, with the motion that says the branch.
struct Arguments {
  EulerAngles q;
  SerretState c;
  double t;
};

// (phi, theta, psi, G, H, T, t)
Arguments moved(Arguments x, std::size_t i, double d) {
  double* const of[] = {&x.q.phi, &x.q.theta, &x.q.psi, &x.c.G, &x.c.H, &x.c.T, &x.t};
  *of[i] += d;
  return x;
}
GeneratingFunction at(const Body& body, const Arguments& x) {
  return generating_function(body, x.q, x.c, x.t);
}

// Central difference of the eighth order.
double slope(const std::function<double(double)>& f, double h) {
  const double weight[] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  double sum = 0.0;
  for (int i = 1; i <= 4; ++i) sum += weight[i - 1] * (f(i * h) - f(-i * h));
  return sum / h;
}

// How far from a caustic: the sine between the third axis of the frame and the plane of g and
// omega, times that between g and omega.
double caustic_distance(const Body& body, const RotorState& s) {
  const Vec3 w = angular_velocity(body, s);
  const polhode::Mat3 R = polhode::attitude_matrix(s.q);
  const Vec3 s3{R(0, 2), R(1, 2), R(2, 2)};
  return std::abs(dot(s3, cross(s.g, w))) / (norm(s.g) * norm(w));
}

struct Case {
  Body body;
  FreeRotation motion;
};
std::vector<Case> generic_cases() {
  std::vector<Case> all;
  for (const NamedMotion& m : motions()) {
    const FreeRotation motion = m.motion();
    if (motion.regime() == Regime::steady || motion.regime() == Regime::rest) continue;
    if (std::string(m.name).starts_with("next to")) continue;
    all.push_back({m.body(), motion});
  }
  const Vec3 orders[] = {{6.0, 3.0, 4.0}, {4.0, 6.0, 3.0}, {4.0, 3.0, 6.0}, {6.0, 4.0, 3.0}};
  for (const Vec3& I : orders)
    for (const Vec3& g : {Vec3{0.3, 0.4, 1.0}, Vec3{-1.0, 0.5, 0.4}, Vec3{0.2, -1.1, 0.3}}) {
      const Body body(I.x, I.y, I.z);
      all.push_back({body, FreeRotation(body, {{0.6, -0.3, 0.7, 0.2}, g}, 0.5)});
    }
  return all;
}
EulerAngles angles(const RotorState& s) {
  const EulerState e = polhode::to_euler(s);
  return {e.phi, e.theta, e.psi};
}
double energy(const Body& body, const EulerAngles& q, const GeneratingFunction& f) {
  const RotorState s = to_rotor(EulerState{q.phi, q.theta, q.psi, f.Phi, f.Theta, f.Psi});
  return kinetic_energy(body, s);
}

TEST(GeneratingFunction, ElementsAndMomentaAreThoseOfTheMotion) {
  Worst<> elements, momenta;
  for (const Case& c : generic_cases()) {
    for (const double t : {-1.7, 0.4, 3.1}) {
      const RotorState s = c.motion.at(t);
      if (caustic_distance(c.body, s) < 0.02) continue;
      const SerretState x = to_serret(c.motion, 0.3);
      const GeneratingFunction f = generating_function(c.body, angles(s), x, t);
      const EulerState e = polhode::to_euler(s);
      momenta.add(larger(std::abs(f.Theta - e.Theta), std::abs(f.Psi - e.Psi)) / x.G);
      elements.add(larger(std::abs(f.g0 - x.g0), std::abs(f.h - x.h)));
      elements.add(std::abs(f.minus_t0 + x.t0) / (1.0 + std::abs(x.t0)));
      EXPECT_EQ(f.Phi, x.H);
      EXPECT_EQ(f.minus_T, -x.T);
    }
  }
  EXPECT_LT(momenta.value(), budget::generating_motion);
  EXPECT_LT(elements.value(), budget::generating_motion);
}

// [SA (41), (47), (56)-(62)] each derivative against differences at fixed other arguments, on the
// motion and off it
TEST(GeneratingFunction, GradientsAreDifferences) {
  Worst<> gap;
  int count = 0;
  for (const Case& c : generic_cases()) {
    for (const double off : {0.0, 0.05}) {
      const double t = 0.9;
      const RotorState s = c.motion.at(t);
      if (caustic_distance(c.body, s) < 0.1) continue;
      const SerretState x = to_serret(c.motion, t);
      EulerAngles q = angles(s);
      q.phi += 0.3 * off;
      q.theta -= 0.2 * off;
      q.psi += 0.2 * off;
      const Arguments given{q, x, t};
      const GeneratingFunction f = at(c.body, given);
      const double exact[] = {f.Phi, f.Theta, f.Psi, f.g0, f.h, f.minus_t0, f.minus_T};
      const double separatrix_step = c.motion.regime() == Regime::separatrix ? 0.0 : 1.0;
      for (std::size_t i = 0; i < 7; ++i) {
        // G and T on the separatrix: the sides have different branches of u
        if (separatrix_step == 0.0 && (i == 3 || i == 5)) continue;
        const double close =
            std::abs(c.motion.separatrix_distance()) / (c.motion.momentum() * c.motion.momentum());
        if (close < 1e-6 && (i == 3 || i == 5)) continue;
        const auto value = [&](double d) { return at(c.body, moved(given, i, d)).S; };
        gap.add(std::abs(slope(value, i == 5 ? 5e-5 : 4e-4) - exact[i]) /
                (1.0 + std::abs(exact[i])));
        ++count;
      }
    }
  }
  EXPECT_GT(count, 150);
  EXPECT_LT(gap.value(), budget::generating_gradient);
}

// [SA (43)] dS/dt + H(q, dS/dq) = 0, on the motion and off it
TEST(GeneratingFunction, JacobiEquation) {
  Worst<> gap;
  int count = 0;
  for (const Case& c : generic_cases()) {
    const SerretState x = to_serret(c.motion, 0.0);
    for (int i = 0; i < 40; ++i) {
      const double t = -3.0 + 0.37 * i;
      EulerAngles q = angles(c.motion.at(t));
      if (i % 2 == 1) {
        q.phi += 0.4;
        q.theta += 0.1 * std::sin(i);
        q.psi -= 0.1 * std::cos(i);
      }
      if (!(q.theta > 0.05 && q.theta < 3.09)) continue;
      GeneratingFunction f{};
      if (!message_of([&] { f = generating_function(c.body, q, x, t); }).empty()) continue;
      gap.add(std::abs(f.minus_T + energy(c.body, q, f)) / x.T);
      ++count;
    }
  }
  EXPECT_GT(count, 500);
  EXPECT_LT(gap.value(), budget::generating_jacobi);
}

// Continuous over many periods, turns of phi and psi, and caustics: dS/dt along the motion is
// 2T - T
TEST(GeneratingFunction, ContinuousAlongAMotion) {
  Worst<> gap;
  for (const Case& c : generic_cases()) {
    const SerretState x = to_serret(c.motion, 0.0);
    const double S0 = -2.0 * x.t0 * x.T + x.H * x.h + x.G * x.g0;
    for (int i = -200; i <= 200; ++i) {
      const double t = 0.37 * i;
      const EulerAngles q = angles(c.motion.at(t));
      if (!(q.theta > 0.0 && q.theta < 3.14159)) continue;
      if (c.motion.regime() == Regime::separatrix && std::abs(t) > 5.0) continue;
      const GeneratingFunction f = generating_function(c.body, q, x, t);
      const double close =
          std::abs(c.motion.separatrix_distance()) / (c.motion.momentum() * c.motion.momentum());
      if (close < 1e-6 && std::abs(t) > 5.0) continue;
      gap.add(std::abs(f.S - (S0 + t * x.T)) / (std::abs(S0) + x.G + std::abs(t) * x.T));
    }
  }
  EXPECT_LT(gap.value(), budget::generating_continuity);
}

TEST(GeneratingFunction, BranchesAreTheMotionsThroughAnAttitude) {
  Worst<> attitude, itself;
  std::array<int, 9> counts{};
  for (const Case& c : generic_cases()) {
    const double t = 0.9;
    const EulerAngles q = angles(c.motion.at(t));
    const SerretState x = to_serret(c.motion, t);
    const std::vector<SerretState> all = free::serret_branches(c.body, q, x.G, x.H, x.T, t);
    ++counts.at(all.size());
    for (const SerretState& b : all) {
      const double close = std::abs(c.motion.separatrix_distance()) / (x.G * x.G);
      if (close < 1e-6) continue;
      attitude.add(attitude_difference(to_rotor(c.body, b, t).q, polhode::attitude(q)));
      const GeneratingFunction f = generating_function(c.body, q, b, t);
      itself.add(
          larger(std::abs(f.g0 - b.g0), larger(std::abs(f.h - b.h), std::abs(f.minus_t0 + b.t0))));
    }
  }
  EXPECT_EQ(counts[0] + counts[1] + counts[3], 0);
  EXPECT_GT(counts[2], 0);
  EXPECT_GT(counts[4], 0);
  EXPECT_LT(attitude.value(), budget::generating_branches);
  EXPECT_LT(itself.value(), budget::generating_branches);
}

// Whole turns and periods that the branch asks for are added, and S by them.
TEST(GeneratingFunction, TurnsAndPeriodsOfTheBranch) {
  const Body body(3.0, 4.0, 6.0);
  const FreeRotation motion(body, {{0.6, -0.3, 0.7, 0.2}, {0.3, 0.2, 1.0}});
  const SerretState c = to_serret(motion, 0.0);
  const EulerAngles q = angles(motion.at(0.9));
  const double turn = 2.0 * std::numbers::pi, period = motion.polhode_period();
  SerretState d = c;
  d.g0 += 3.0 * turn;
  d.h -= 2.0 * turn;
  d.t0 += 4.0 * period;
  const GeneratingFunction f = generating_function(body, q, c, 0.9);
  const GeneratingFunction g = generating_function(body, q, d, 0.9);
  EXPECT_NEAR(g.h, f.h - 2.0 * turn, budget::generating_motion);
  EXPECT_NEAR(g.minus_t0, f.minus_t0 - 4.0 * period, budget::generating_motion);
  EXPECT_NEAR(g.S, (0.9 + 2.0 * g.minus_t0) * c.T + c.H * g.h + c.G * g.g0,
              budget::generating_motion);
  EXPECT_EQ(g.Psi, f.Psi);
}

// Units: another unit of momentum and time, by powers of two, gives the same digits.
TEST(GeneratingFunction, UnitsDoNotMatter) {
  const Body body(3.0, 4.0, 6.0);
  const double huge = 0x1p300, small = 0x1p-320;
  const FreeRotation motion(body, {{0.6, -0.3, 0.7, 0.2}, {0.3, 0.2, 1.0}});
  const SerretState c = to_serret(motion, 0.0);
  const EulerAngles q = angles(motion.at(0.9));
  const GeneratingFunction f = generating_function(body, q, c, 0.9);
  const Body heavy(3.0 * huge, 4.0 * huge, 6.0 * huge);
  const double momentum = huge * small, energy = huge * small * small, time = 1.0 / small;
  const SerretState d{c.g0,           c.h,          c.t0 * time, c.G * momentum,
                      c.H * momentum, c.T * energy, c.sign_g1,   c.sign_g3};
  const GeneratingFunction g = generating_function(heavy, q, d, 0.9 * time);
  EXPECT_EQ(g.S, f.S * momentum);
  EXPECT_EQ(g.minus_t0, f.minus_t0 * time);
  EXPECT_EQ(g.g0, f.g0);
  EXPECT_EQ(g.Theta, f.Theta * momentum);
}

TEST(GeneratingFunction, RejectsWhatHasNoMotion) {
  const Body body(3.0, 4.0, 6.0);
  const EulerAngles q{0.3, 1.0, 0.2};
  const SerretState c{0.1, 0.2, 0.3, 1.0, 0.4, 0.1, 1, 1};
  const auto refusal = [&](const Body& of, EulerAngles angles_, SerretState elements) {
    return message_of([&] { generating_function(of, angles_, elements, 0.0); });
  };
  const auto with = [](auto x, auto member, double value) {
    x.*member = value;
    return x;
  };
  const auto expect = [](const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << text << "\n  lacks " << part;
  };
  EXPECT_EQ(refusal(body, q, with(c, &SerretState::T, 0.11)), "");
  expect(refusal(body, q, with(c, &SerretState::T, 0.2)), {"0.2", "T in [G^2/2I3, G^2/2I1]"});
  expect(refusal(body, q, with(c, &SerretState::T, 1.0 / 12.0)), {"inside (G^2/2I3, G^2/2I1)"});
  expect(refusal(body, q, with(c, &SerretState::H, 1.5)), {"1.5", "|H| <= G"});
  expect(refusal(body, q, with(c, &SerretState::H, -1.0)), {"H = -1", "|H| < G"});
  expect(refusal(body, with(q, &EulerAngles::theta, 0.0), c), {"theta = 0", "(0, pi)"});
  expect(refusal(body, with(q, &EulerAngles::theta, 3.141592653589793), c), {"theta = 3.14"});
  expect(refusal(body, with(q, &EulerAngles::theta, -0.2), c), {"theta = -0.2"});
  expect(refusal(body, with(q, &EulerAngles::psi, not_a_number), c), {"psi", "finite"});
  expect(refusal(Body(2.0, 2.0, 2.0), q, with(c, &SerretState::T, 0.25)), {"sphere"});
  // b3 near the plane across a momentum along the frame's axis: T is that of a near spin about it
  expect(refusal(body, {0.3, 0.05, 0.2}, with(c, &SerretState::H, 0.999)),
         {"T = 0.1 must be in [0.08", "to have (phi, theta, psi) = (0.3, 0.05, 0.2)"});
  expect(message_of([&] {
           free::serret_branches(body, {0.3, 0.05, 0.2}, 1.0, 0.999, 0.1, 0.0);
         }),
         {"serret_branches: T = 0.1 must be in [0.08", "to have (phi, theta, psi)"});
  // both motions through this attitude circulate the other way
  const EulerAngles tilted{1.58, 2.86, 0.52};
  const std::vector<SerretState> through = free::serret_branches(body, tilted, 1.0, 0.9, 0.09, 0.0);
  for (const SerretState& b : through) EXPECT_EQ(b.sign_g3, -1);
  expect(refusal(body, tilted, {0.0, 0.0, 0.0, 1.0, 0.9, 0.09, 1, 1}), {"sign_g3 = 1: no motion"});
  EXPECT_TRUE(std::isnan(free::generating_function(body, q, c, not_a_number).S));
}

}  // namespace
