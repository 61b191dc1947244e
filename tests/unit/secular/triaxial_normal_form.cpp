// SPDX-License-Identifier: MIT
// Normal form of the triaxial rotor. Oracle: Sadov's closed-form action-angle variables.
#include "polhode/secular/triaxial_normal_form.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/free/sadov.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::larger;
using polhode::test::Worst;

constexpr double degree = std::numbers::pi / 180.0;

// With the triaxiality e: a = 1, b = 1/4.
Body body(double e) { return {1.0 / (1.0 + 0.25 * e), 1.0 / (1.0 - 0.25 * e), 1.0 / 0.75}; }

AndoyerState state(double J, double l) {
  return {.l = l, .g = 0.7, .h = 0.3, .L = 2.0 * std::cos(J), .G = 2.0, .H = 1.1};
}

struct Errors {
  double energy, frequencies, actions, angles, back;
};
// Relative to G and the frequencies, over l, for J up to 30 degrees.
Errors errors(double e, int order) {
  const secular::TriaxialNormalForm form(body(e), order);
  Worst energy, frequencies, actions, angles, back;
  for (const double J : {10.0 * degree, 30.0 * degree})
    for (const double l : {0.2, 1.0, 2.1, 3.9, 5.5}) {
      const AndoyerState s = state(J, l);
      const FreeRotation motion(body(e), to_rotor(s), 0.0);
      const SadovState exact = to_sadov(motion, 0.0);
      const SadovFrequencies n = sadov_frequencies(motion);
      const secular::RotorFrequencies by_series = form.frequencies(exact.I_l, exact.I_g);
      frequencies.add(by_series.n_l / n.n_l - 1.0);
      frequencies.add(by_series.n_g / n.n_g - 1.0);
      energy.add(form.energy(exact.I_l, exact.I_g) / kinetic_energy(body(e), to_rotor(s)) - 1.0);
      const AndoyerState mean = form.mean(s);
      actions.add((mean.L - exact.I_l) / s.G);
      constexpr double turn = 2.0 * std::numbers::pi;
      angles.add(std::remainder(mean.l - exact.phi_l - 0.25 * turn, turn));
      angles.add(std::remainder(mean.g - exact.phi_g, turn));
      const AndoyerState again = form.osculating(mean);
      back.add(again.l - s.l);
      back.add((again.L - s.L) / s.G);
    }
  return {energy.value(), frequencies.value(), actions.value(), angles.value(), back.value()};
}

TEST(TriaxialNormalForm, FrequenciesAreSadovs) {
  const Errors of = errors(0.01, 8);
  EXPECT_LT(of.frequencies, budget::normal_form_frequencies);
  EXPECT_LT(of.energy, budget::normal_form_frequencies);
  EXPECT_LT(of.angles, budget::normal_form_angles);
  EXPECT_LT(of.actions, budget::normal_form_angles);
}

TEST(TriaxialNormalForm, ErrorsFallWithTheOrder) {
  for (int order = 1; order <= 8; ++order) {
    const Errors one = errors(0.2, order), half = errors(0.1, order);
    const auto slope = [](double a, double b) { return std::log2(a / b); };
    const double next_even = 2.0 * (order / 2) + 2.0;
    EXPECT_NEAR(slope(one.frequencies, half.frequencies), next_even, budget::normal_form_slope)
        << order;
    EXPECT_NEAR(slope(one.energy, half.energy), next_even, budget::normal_form_slope) << order;
    EXPECT_NEAR(slope(one.angles, half.angles), order + 1.0, budget::normal_form_slope) << order;
    EXPECT_NEAR(slope(one.actions, half.actions), order + 1.0, budget::normal_form_slope) << order;
    EXPECT_NEAR(slope(one.back, half.back), order + 1.0, budget::normal_form_slope) << order;
  }
}

// Bodies and states in short-axis mode at random, up to the separatrix: a result is within its own
// estimate of Sadov's, or it is NaN, and that only beyond the circle of convergence.
TEST(TriaxialNormalForm, IsWithinItsEstimateOrNaN) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int answered = 0, beyond = 0;
  for (int k = 0; k < 25; ++k) {
    const double e = 0.02 + 0.6 * uniform(engine);
    const secular::TriaxialNormalForm form(body(e), 8);
    for (int i = 0; i < 20; ++i) {
      const AndoyerState s = state(std::acos(uniform(engine)), 6.3 * uniform(engine));
      const double c2 = s.L * s.L / (s.G * s.G), wave = std::cos(2.0 * s.l);
      if (c2 < 1.001 * e * (1.0 - (1.0 - c2) * wave)) continue;  // long-axis mode, or next to it
      const FreeRotation motion(body(e), to_rotor(s), 0.0);
      const SadovState exact = to_sadov(motion, 0.0);
      const SadovFrequencies n = sadov_frequencies(motion);
      const AndoyerState mean = form.mean(s);
      const double ratio = e * (1.0 + (1.0 - c2) * std::fabs(wave)) / c2;
      EXPECT_EQ(std::isnan(mean.L), !(ratio < 1.0)) << ratio;
      if (ratio < 1.0) {
        ++answered;
        constexpr double turn = 2.0 * std::numbers::pi;
        const double error =
            larger(std::fabs(mean.L - exact.I_l) / s.G,
                   std::fabs(std::remainder(mean.l - exact.phi_l - 0.25 * turn, turn)),
                   std::fabs(std::remainder(mean.g - exact.phi_g, turn)));
        EXPECT_LT(error,
                  budget::normal_form_estimate * form.mean_error(s) + budget::normal_form_angles)
            << ratio;
      } else {
        ++beyond;
      }
      // of mean elements up to the separatrix itself
      const secular::RotorFrequencies by_series = form.frequencies(exact.I_l, exact.I_g);
      const double error =
          larger(std::fabs(by_series.n_l / n.n_l - 1.0), std::fabs(by_series.n_g / n.n_g - 1.0));
      EXPECT_LT(error, budget::normal_form_estimate * form.frequency_error(exact.I_l, exact.I_g) +
                           budget::normal_form_angles);
      const AndoyerState there = form.osculating({.l = exact.phi_l + 0.5 * std::numbers::pi,
                                                  .g = exact.phi_g,
                                                  .h = 0.3,
                                                  .L = exact.I_l,
                                                  .G = exact.I_g,
                                                  .H = 1.1});
      EXPECT_LT(std::fabs(there.L - s.L) / s.G,
                budget::normal_form_estimate *
                        form.osculating_error({.l = exact.phi_l + 0.5 * std::numbers::pi,
                                               .g = exact.phi_g,
                                               .h = 0.3,
                                               .L = exact.I_l,
                                               .G = exact.I_g,
                                               .H = 1.1}) +
                    budget::normal_form_angles);
    }
  }
  EXPECT_GT(answered, 100);
  EXPECT_GT(beyond, 30);
}

TEST(TriaxialNormalForm, WhatIsRefused) {
  const secular::TriaxialNormalForm wide(Body(0.5, 0.8, 1.0), 8);
  const auto at = [](double J) {
    return AndoyerState{.l = 0.3, .g = 0.0, .h = 0.0, .L = std::cos(J), .G = 1.0, .H = 0.4};
  };
  // L was -58.6 for |L| <= 1 here, and n_l 31.07 for -0.34599
  EXPECT_TRUE(std::isnan(wide.mean(at(50.0 * degree)).L));
  EXPECT_REJECTED(wide.mean(at(80.0 * degree)),
                  "is in long-axis mode; the series are those of short-axis mode");
  EXPECT_TRUE(std::isnan(wide.osculating(at(80.0 * degree)).L));
  EXPECT_TRUE(std::isnan(wide.frequencies(0.17, 1.0).n_l));
  EXPECT_TRUE(std::isnan(wide.energy(0.0, 1.0)));
  EXPECT_REJECTED(secular::TriaxialNormalForm(body(0.1), 0), "order 0 must be");
  EXPECT_REJECTED(secular::TriaxialNormalForm(Body(2.0, 1.5, 3.0), 2), "must rise");
  EXPECT_REJECTED(secular::TriaxialNormalForm(Body(1.0, 1.0, 1.0), 2), "must rise");
}

}  // namespace
