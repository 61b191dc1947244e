// SPDX-License-Identifier: MIT
// Euler's variables from Andoyer's by the paper's own closed formulas (the misprinted ones
// corrected): a way from one chart to the other that shares nothing with the hub.
#include <gtest/gtest.h>

#include <cmath>

#include "budgets.hpp"
#include "property/chart_support.hpp"

namespace {

using namespace chart_test;
namespace budget = polhode::budget;

polhode::EulerState euler_by_the_paper(const polhode::AndoyerState& a) {
  const double sl = std::sin(a.l), cl = std::cos(a.l), sg = std::sin(a.g), cg = std::cos(a.g),
               sh = std::sin(a.h), ch = std::cos(a.h);
  const double rL = std::sqrt((a.G - a.L) * (a.G + a.L)), rH = std::sqrt((a.G - a.H) * (a.G + a.H));
  // [SA (78)], corrected [SA (79)], [SA (80)] with its quadrant
  const double cos_theta = (a.L * a.H - cg * rL * rH) / (a.G * a.G);
  const double psi = std::atan2(rH * (a.G * sg * cl + a.L * sl * cg) + a.H * sl * rL,
                                -rH * (a.G * sg * sl - a.L * cl * cg) + a.H * cl * rL);
  const double phi = std::atan2(rL * (a.G * sg * ch + a.H * sh * cg) + a.L * sh * rH,
                                -(rL * (a.G * sg * sh - a.H * ch * cg) - a.L * ch * rH));
  // [SA (76)], corrected equation for Theta after [SA (80)], [SA (75)]
  return {phi, std::acos(cos_theta), psi, a.H, rL * std::sin(a.l - psi), a.L};
}

TEST(ChartIdentities, EulerFromAndoyerByThePaper) {
  Sampler sample(20250120);
  for (int k = 0; k < 2000; ++k) {
    const RotorState s = inclined_state(
        {sample.uniform(0.2, 1.5), sample.coin(), sample.uniform(0.2, 1.5), sample.coin()},
        sample.angle(), sample.angle(), sample.angle());
    const polhode::EulerState e = euler_by_the_paper(to_andoyer(s)), f = to_euler(s);
    const double sine = std::sin(f.theta);
    EXPECT_LE(numbers_difference({e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi},
                                 {f.phi, f.theta, f.psi, f.Phi, f.Theta, f.Psi}, 3),
              budget::andoyer_generic / sine);
  }
}

}  // namespace
