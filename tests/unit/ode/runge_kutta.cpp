// SPDX-License-Identifier: MIT
// The coefficients of the pair, its order as observed, and the control of the step.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "budgets.hpp"
#include "polhode/detail/ode/adaptive_runge_kutta.hpp"
#include "polhode/detail/ode/verner98.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using DD = DoubleDouble;

DD wide(const TwoTerms<double>& x) { return {x.hi, x.lo}; }

// y' = y^2 cos t, y(0) = 1/2: y = 1 / (2 - sin t). Depends on t and on y, not linear.
struct Hill {
  template <Real T>
  std::array<T, 1> operator()(const DD& t, const std::array<T, 1>& y) const {
    if constexpr (std::same_as<T, double>) {
      return {y[0] * y[0] * std::cos(t.hi)};
    } else {
      return {y[0] * y[0] * T(cos(t))};
    }
  }
};
DD hill(double t) { return DD(1.0) / (DD(2.0) - sin(DD(t))); }

struct Largest {
  template <Real T, std::size_t N>
  double operator()(const std::array<T, N>& error, const std::array<T, N>&,
                    const std::array<T, N>&) const {
    test::Worst size;
    for (const T& e : error) size.add(std::abs(to_double(e)));
    return size.value();
  }
};

template <Real T, class F>
AdaptiveRungeKutta<Verner98, T, 1, F, Largest> solver(F f, double y, const StepControl& control,
                                                      double t = 0.0) {
  return {f, Largest{}, t, {T(y)}, control};
}
template <class Solver>
StepOutcome run(Solver& s, double stop) {
  StepOutcome outcome = StepOutcome::made;
  while (s.time() != DD(stop) && outcome == StepOutcome::made) outcome = s.advance(stop);
  return outcome;
}

TEST(Verner98, SatisfiesTheConditionsOfQuadrature) {
  for (int i = 0; i < Verner98::stages; ++i) {
    DD sum(0.0);
    for (int j = 0; j < i; ++j) sum += wide(Verner98::a[i][j]);
    EXPECT_LE(std::abs((sum - wide(Verner98::c[i])).hi), budget::ode_condition) << i;
  }
  for (int k = 0; k < 9; ++k) {
    DD high(0.0), low(0.0);
    for (int i = 0; i < Verner98::stages; ++i) {
      DD power(1.0);
      for (int m = 0; m < k; ++m) power *= wide(Verner98::c[i]);
      high += wide(Verner98::b[i]) * power;
      low += (wide(Verner98::b[i]) + wide(Verner98::e[i])) * power;
    }
    const DD value = DD(1.0) / DD(k + 1.0);
    EXPECT_LE(std::abs((high - value).hi), budget::ode_condition) << k;
    if (k < 8) {
      EXPECT_LE(std::abs((low - value).hi), budget::ode_condition) << k;
    } else {
      EXPECT_GT(std::abs((low - value).hi), budget::ode_not_of_order);
    }
  }
}

TEST(Verner98, RoundedCoefficientsKeepTheConditionsOfOrderTwo) {
  constexpr const auto& r = detail::rounded_tableau<Verner98>;
  DD one(-1.0), half(-0.5);
  for (std::size_t i = 0; i < 16; ++i) {
    one += DD(r.b[i]);
    half += DD::product(r.b[i], r.c[i]);
    DD sum(-r.c[i]);
    for (std::size_t j = 0; j < i; ++j) {
      sum += DD(r.a[i][j]);
      EXPECT_NEAR(r.a[i][j], Verner98::a[i][j].hi, budget::ode_rounded_coefficient);
    }
    // Row 5 has no small coefficient to take the rest, and no weight.
    EXPECT_LE(std::abs(sum.hi),
              i == 4 ? budget::ode_rounded_coefficient : budget::ode_rounded_condition)
        << i;
    EXPECT_NEAR(r.b[i], Verner98::b[i].hi, budget::ode_rounded_coefficient);
  }
  EXPECT_LE(std::abs(one.hi), budget::ode_rounded_condition);
  EXPECT_LE(std::abs(half.hi), budget::ode_rounded_condition);
}

TEST(AdaptiveRungeKutta, IsOfOrderNineAndItsEstimateToo) {
  std::vector<double> errors, estimates;
  for (const double h : {0.125, 0.0625, 0.03125}) {
    auto s = solver<DD>(Hill{}, 0.5, {1e-2, h, h});
    ASSERT_EQ(run(s, 2.0), StepOutcome::made);
    EXPECT_EQ(s.steps(), std::lround(2.0 / h));
    errors.push_back(std::abs((s.state().y[0] - hill(2.0)).hi));
    const std::array<DD, 1> y{DD(0.5)};
    estimates.push_back(std::abs(
        runge_kutta_step<Verner98>(Hill{}, DD(0.0), y, Hill{}(DD(0.0), y), h / 8).error[0].hi));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(std::log2(errors[i] / errors[i + 1]), 9.0, budget::ode_order);
    EXPECT_NEAR(std::log2(estimates[i] / estimates[i + 1]), 9.0, budget::ode_order);
  }
}

TEST(AdaptiveRungeKutta, KeepsToTheToleranceForwardsAndBackwards) {
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    auto s = solver<double>(Hill{}, 0.5, {tolerance});
    ASSERT_EQ(run(s, 10.0), StepOutcome::made);
    EXPECT_LE(std::abs(s.state().y[0] - hill(10.0).hi), budget::ode_per_tolerance * tolerance);
    auto back = solver<double>(Hill{}, hill(10.0).hi, {tolerance}, 10.0);
    ASSERT_EQ(run(back, 0.0), StepOutcome::made);
    EXPECT_LE(std::abs(back.state().y[0] - 0.5), budget::ode_per_tolerance * tolerance);
    EXPECT_LE(s.rejected(), s.steps() / 4 + 3);
  }
}

TEST(AdaptiveRungeKutta, StepsDoNotCollapseWhereTheEstimateIsRounding) {
  auto s = solver<double>(Hill{}, 0.5, {1e-15});
  ASSERT_EQ(run(s, 10.0), StepOutcome::made);
  EXPECT_LE(std::abs(s.state().y[0] - hill(10.0).hi), budget::ode_tightest);
  auto sharper = solver<double>(Hill{}, 0.5, {1e-16});
  ASSERT_EQ(run(sharper, 10.0), StepOutcome::made);
  EXPECT_LE(sharper.steps(), 3 * s.steps());
}

TEST(AdaptiveRungeKutta, ReachesThirtyDigitsInDoubleDouble) {
  auto s = solver<DD>(Hill{}, 0.5, {1e-30});
  ASSERT_EQ(run(s, 2.0), StepOutcome::made);
  EXPECT_LE(std::abs((s.state().y[0] - hill(2.0)).hi), budget::ode_double_double);
}

TEST(AdaptiveRungeKutta, CarriesWhatASumOfDoublesLoses) {
  CompensatedState<double, 1> s{{1.0}};
  for (int i = 0; i < 1000000; ++i) s.add({0x1p-54});
  EXPECT_EQ(s.y[0], 1.0 + 1000000 * 0x1p-54);
}

TEST(AdaptiveRungeKutta, TimeIsExactBeyondDouble) {
  // A step of 0.1 from 1e9, a hundred thousand times: the clock of f shows each of them.
  const auto slope = [](const DD& t, const std::array<double, 1>&) {
    return std::array<double, 1>{2.0 * (t - 1e9).hi};
  };
  auto s = solver<double>(slope, 0.0, {1e-2, 0.1, 0.1}, 1e9);
  ASSERT_EQ(run(s, 1e9 + 100.0), StepOutcome::made);
  EXPECT_NEAR(s.state().y[0], 1e4, 1e4 * budget::ode_clock);
}

TEST(AdaptiveRungeKutta, SaysWhyAStepCannotBeMade) {
  const auto root = [](const DD& t, const std::array<double, 1>&) {
    return std::array<double, 1>{std::sqrt(1.0 - t.hi)};
  };
  auto s = solver<double>(root, 0.0, {1e-9});
  const StepOutcome outcome = run(s, 2.0);
  EXPECT_NE(outcome, StepOutcome::made);
  EXPECT_LE(s.time().hi, 1.0);
  EXPECT_GT(s.time().hi, 0.99);

  const auto nan_beyond = [](const DD& t, const std::array<double, 1>&) {
    return std::array<double, 1>{t.hi > 1.0 ? std::nan("") : 1.0};
  };
  auto n = solver<double>(nan_beyond, 0.0, {1e-9});
  EXPECT_EQ(run(n, 2.0), StepOutcome::not_finite);
  EXPECT_NEAR(n.time().hi, 1.0, budget::ode_edge);
  EXPECT_NEAR(n.state().y[0], n.time().hi, budget::ode_edge);

  const auto jump = [](const DD& t, const std::array<double, 1>&) {
    return std::array<double, 1>{t.hi > 1.0 / 3.0 ? 1e9 : 1.0};
  };
  auto j = solver<double>(jump, 1.0, {1e-12});
  EXPECT_EQ(run(j, 2.0), StepOutcome::made);
  EXPECT_NEAR(j.state().y[0] / (4.0 / 3.0 + 1e9 * 5.0 / 3.0), 1.0, budget::ode_jump);

  // a new jump at every rounding of t is no place that a step could pass
  const auto jumps = [](const DD& t, const std::array<double, 1>&) {
    return std::array<double, 1>{t.hi > 1.0 / 3.0 && std::fmod(t.hi * 0x1p53, 2.0) < 1.0 ? 1e9
                                                                                         : 1.0};
  };
  auto all = solver<double>(jumps, 1.0, {1e-12});
  EXPECT_EQ(run(all, 2.0), StepOutcome::too_small);
  EXPECT_NEAR(all.time().hi, 1.0 / 3.0, budget::ode_jumps);

  auto at_once = solver<double>(nan_beyond, 0.0, {1e-9}, 3.0);
  EXPECT_EQ(run(at_once, 4.0), StepOutcome::not_finite);
  EXPECT_EQ(at_once.time().hi, 3.0);
}

TEST(AdaptiveRungeKutta, PassesExceptionsOnAndStaysWhereItWas) {
  const auto throws = [](const DD& t, const std::array<double, 1>&) {
    if (t.hi > 1.0) throw std::runtime_error("beyond 1");
    return std::array<double, 1>{1.0};
  };
  auto s = solver<double>(throws, 0.0, {1e-9, 0.25, 0.25});
  EXPECT_THROW(run(s, 2.0), std::runtime_error);
  EXPECT_EQ(s.time().hi, 1.0);
  EXPECT_EQ(s.state().y[0], 1.0);
}

}  // namespace
