// SPDX-License-Identifier: MIT
// The generating functions of Sadov's transformation: derivatives by differences, the variables of
// the motion, the paper's quadratures, continuity, refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "budgets.hpp"
#include "polhode/free/generating_function.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;  // NOLINT
using polhode::AndoyerState;
using polhode::SadovRegion;
using polhode::SadovState;
using polhode::free::sadov_generating_function;
using polhode::free::sadov_parameters;
using polhode::free::sadov_quadratures;
using polhode::free::SadovGeneratingFunction;
using polhode::free::SadovParameters;
using polhode::free::SadovQuadratures;
using polhode::test::Worst;
namespace budget = polhode::budget;

// Motions of sorted axes, off the separatrix and the axes.
std::vector<FreeRotation> action_motions() {
  std::vector<FreeRotation> all;
  for (const Vec3& I : {Vec3{3.0, 4.0, 6.0}, Vec3{1.0, 2.0, 3.0}, Vec3{3.0, 3.0, 5.0}})
    for (const Vec3& g : {Vec3{0.3, 0.2, 1.0}, Vec3{0.3, -0.9, -1.0}, Vec3{1.0, 0.2, 0.3},
                          Vec3{-1.0, 0.8, -0.3}, Vec3{-1.2, -0.1, 0.4}})
      all.emplace_back(Body(I.x, I.y, I.z), RotorState{{0.6, -0.3, 0.7, 0.2}, g});
  return all;
}

double difference_of(double a, double b) { return std::remainder(a - b, 2.0 * std::numbers::pi); }

// [SA "transf. eqs"] the derivatives that are returned are the variables of the motion
TEST(SadovGeneratingFunction, DerivativesAreTheVariables) {
  Worst<> gap;
  for (const FreeRotation& m : action_motions())
    for (int i = 0; i < 20; ++i) {
      const double t = -4.0 + 0.83 * i;
      const AndoyerState a = polhode::to_andoyer(m.at(t));
      const SadovState s = to_sadov(m, t);
      if (s.region == SadovRegion::long_axis && std::abs(a.L) < 0.05 * a.G) continue;
      const SadovGeneratingFunction f = sadov_generating_function(m.body(), a.l, a.g, a.h, s);
      for (const double x : {difference_of(f.phi_l, s.phi_l), difference_of(f.phi_g, s.phi_g),
                             difference_of(f.phi_h, s.phi_h), (f.L - a.L) / a.G})
        gap.add(std::abs(x));
      EXPECT_EQ(f.G, s.I_g);
      EXPECT_EQ(f.H, s.I_h);
    }
  EXPECT_LT(gap.value(), budget::generating_motion);
}

double slope_of(const std::function<double(double)>& f, double h) {
  const double weight[] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  double sum = 0.0;
  for (int i = 1; i <= 4; ++i) sum += weight[i - 1] * (f(i * h) - f(-i * h));
  return sum / h;
}

TEST(SadovGeneratingFunction, GradientsAreDifferences) {
  Worst<> gap;
  for (const FreeRotation& m : action_motions())
    for (const double t : {0.3, 1.9, 3.3}) {
      const AndoyerState a = polhode::to_andoyer(m.at(t));
      const SadovState s = to_sadov(m, t);
      if (s.region == SadovRegion::long_axis && std::abs(a.L) < 0.2 * a.G) continue;
      const SadovGeneratingFunction f = sadov_generating_function(m.body(), a.l, a.g, a.h, s);
      const double exact[] = {f.L, f.G, f.H, f.phi_l, f.phi_g, f.phi_h};
      const auto at = [&](std::size_t i, double d) {
        double l = a.l, g = a.g, h = a.h;
        SadovState x = s;
        double* const of[] = {&l, &g, &h, &x.I_l, &x.I_g, &x.I_h};
        *of[i] += d;
        return sadov_generating_function(m.body(), l, g, h, x);
      };
      for (std::size_t i = 0; i < 6; ++i)
        gap.add(std::abs(slope_of([&](double d) { return at(i, d).W; }, 2e-4) - exact[i]));
      gap.add(std::abs(slope_of([&](double d) { return at(0, d).V; }, 2e-4) - f.L));
      gap.add(std::abs(slope_of([&](double d) { return at(3, d).V; }, 2e-4) - f.phi_l));
    }
  EXPECT_LT(gap.value(), budget::generating_gradient);
}

// [SA "phiSadov", "phiSadovProv", "quad L dl", "quad dL/dlambda", "IellSadov"] the paper's formulas
// in double give the same, and derivatives by lambda are differences
TEST(SadovGeneratingFunction, QuadraturesOfThePaper) {
  Worst<> gap;
  int count = 0;
  for (const FreeRotation& m : action_motions()) {
    const Vec3& I = m.body().moments();
    if (I.x == I.y) continue;
    const SadovParameters p = sadov_parameters(m.body(), m.momentum(), m.energy());
    for (int i = 0; i < 20; ++i) {
      const double t = -4.0 + 0.83 * i;
      const AndoyerState a = polhode::to_andoyer(m.at(t));
      const SadovState s = to_sadov(m, t);
      const bool is_long = s.region == SadovRegion::long_axis;
      if (is_long && a.L < 0.05 * a.G) continue;  // the branch L > 0
      SadovState near = s;
      if (!is_long)
        near.phi_l =
            a.l - 0.5 * std::numbers::pi;  // l, not modulo 2 std::numbers::pi, says the turn
      const SadovGeneratingFunction f = sadov_generating_function(m.body(), a.l, a.g, a.h, near);
      const SadovQuadratures q = sadov_quadratures(p, s.I_g, a.l);
      const double sign = !is_long && s.I_l < 0.0 ? -1.0 : 1.0;
      for (const double x :
           {(sign * q.I_l - s.I_l) / s.I_g, (sign * q.L_dl - f.V) / s.I_g,
            difference_of(q.phi_l, f.phi_l), difference_of(a.g + sign * q.phi_g_minus_g, f.phi_g)})
        gap.add(std::abs(x));
      ++count;
    }
    const SadovQuadratures q = sadov_quadratures(p, 1.0, 0.5 * std::numbers::pi + 0.1);
    const double by_lambda = slope_of(
        [&](double d) {
          return sadov_quadratures({p.kappa, p.lambda + d}, 1.0, 1.6).I_l;
        },
        1e-3);
    EXPECT_NEAR(q.dI_l_dlambda, by_lambda, budget::generating_gradient);
    EXPECT_NEAR(q.dlambda_dI_l * q.dI_l_dlambda, 1.0, budget::generating_quadrature);
    const double integral = slope_of(
        [&](double d) {
          return sadov_quadratures({p.kappa, p.lambda + d}, 1.0, 0.5 * std::numbers::pi + 0.1).L_dl;
        },
        1e-3);
    EXPECT_NEAR(q.dL_dlambda_dl, integral, budget::generating_gradient);
  }
  EXPECT_GT(count, 60);
  EXPECT_LT(gap.value(), budget::generating_quadrature);
}

// With the unwrapped angles of the motion as branch, W goes along: I_l phi_l + I_g phi_g + I_h
// phi_h
TEST(SadovGeneratingFunction, ContinuousAlongAMotion) {
  Worst<> gap;
  for (const FreeRotation& m : action_motions()) {
    const polhode::SadovFrequencies n = sadov_frequencies(m);
    const SadovState s0 = to_sadov(m, 0.0);
    for (int i = -300; i <= 300; ++i) {
      const double t = 0.29 * i;
      const AndoyerState a = polhode::to_andoyer(m.at(t));
      SadovState s = s0;
      s.phi_l += n.n_l * t;
      s.phi_g += n.n_g * t;
      SadovGeneratingFunction f{};
      // at the end of a libration l may be beyond it by rounding
      if (!message_of([&] { f = sadov_generating_function(m.body(), a.l, a.g, a.h, s); }).empty())
        continue;
      const double expected = s.I_l * s.phi_l + s.I_g * s.phi_g + s.I_h * s.phi_h;
      gap.add(std::abs(f.W - expected) / (s.I_g * (1.0 + std::abs(s.phi_g))));
    }
  }
  EXPECT_LT(gap.value(), budget::generating_turning);
}

TEST(SadovGeneratingFunction, RejectsWhatHasNoMotion) {
  const Body body(3.0, 4.0, 6.0);
  const SadovState s{0.1, 0.2, 0.3, 0.9, 1.0, 0.4};
  SadovState l = s;
  l.region = SadovRegion::long_axis;
  l.I_l = 0.1;
  const auto refusal = [&](double angle, const SadovState& x) {
    return message_of([&] { sadov_generating_function(body, angle, 0.0, 0.0, x); });
  };
  const auto with = [](SadovState x, double SadovState::*member, double value) {
    x.*member = value;
    return x;
  };
  const auto expect = [](const std::string& text, std::string_view part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << "\n  lacks " << part;
  };
  EXPECT_EQ(refusal(0.4, s), "");
  EXPECT_EQ(refusal(1.5, l), "");
  expect(refusal(0.4, with(s, &SadovState::I_l, 1.2)), "|I_l| <= I_g");
  expect(refusal(0.4, with(s, &SadovState::I_h, 1.2)), "|I_h| <= I_g");
  expect(refusal(0.4, with(s, &SadovState::I_l, 0.2)), "is not in the short-axis region");
  expect(refusal(0.4, with(s, &SadovState::I_l, 1.0)), "|I_l| < I_g");
  expect(refusal(0.4, with(l, &SadovState::I_l, 0.0)), "I_l > 0");
  expect(refusal(0.1, l), "l = 0.1 must be within");
  expect(refusal(-1.5, l), "of pi/2");
  expect(refusal(not_a_number, s), "finite");
  const auto bad = [](auto f) { return message_of(f); };
  expect(bad([&] { sadov_parameters(body, 1.0, 0.3); }), "T = 0.3 of G = 1 must be in");
  expect(bad([&] { sadov_parameters(Body(3, 3, 5), 1.0, 0.15); }), "three different");
  expect(bad([] { sadov_quadratures({1.0, 1.0}, 1.0, 1.0); }), "lambda not 1");
  expect(bad([] { sadov_quadratures({1.0, 0.5}, -1.0, 1.0); }), "I_g positive");
  expect(bad([] { sadov_quadratures({1.0, 3.0}, 1.0, 0.1); }), "l = 0.1");
}

}  // namespace
