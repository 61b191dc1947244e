// SPDX-License-Identifier: MIT
// Residuals as functions of the unknowns: what solve() squares, at its solution and elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/fit/least_squares.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/spin_fit.hpp"

namespace {
using namespace polhode;
using test::message_of;

// y = a + b t with errors of 1/2, a prior of b.
fit::LeastSquares line(fit::Loss loss = {}) {
  fit::LeastSquares p;
  p.unknowns = {{.name = "a", .start = 1.0}, {.name = "b", .start = 0.0}};
  p.residuals.data = 3;
  p.residuals.at = [](std::span<const double> x, std::span<double> numbers,
                      std::span<double> jacobian) {
    constexpr double y[] = {1.0, 1.5, 5.0};
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = static_cast<double>(i);
      numbers[i] = 2.0 * (x[0] + x[1] * t - y[i]);
      if (jacobian.empty()) continue;
      jacobian[2 * i] = 2.0;
      jacobian[2 * i + 1] = 2.0 * t;
    }
    return x[0] > -10.0;
  };
  p.priors = {{{"b"}, {1.0}, {0.25}}};
  p.error_factor = 2.0;
  p.loss = loss;
  return p;
}

TEST(ResidualFunction, IsDataOverTheFactorThenPriors) {
  const fit::ResidualFunction f(line());
  ASSERT_EQ(f.data(), 3u);
  ASSERT_EQ(f.size(), 4u);
  ASSERT_EQ(f.unknowns(), 2u);
  std::vector<double> r(4), J(8);
  const std::vector<double> x{2.0, 0.5};
  ASSERT_TRUE(f.at(x, r, J));
  EXPECT_EQ(r, (std::vector<double>{1.0, 1.0, -2.0, -1.0}));
  EXPECT_EQ(J, (std::vector<double>{1.0, 0.0, 1.0, 1.0, 1.0, 2.0, 0.0, 2.0}));
  std::vector<double> alone(4);
  ASSERT_TRUE(f.at(x, alone, {}));
  EXPECT_EQ(alone, r);
}

TEST(ResidualFunction, HasNoSlopeWhereSolveEnds) {
  for (const fit::Loss loss : {fit::Loss{}, fit::Loss{fit::Loss::Kind::cauchy, 1.0}}) {
    const fit::LeastSquaresResult result = fit::solve(line(loss));
    ASSERT_TRUE(result.is_converged());
    const fit::ResidualFunction f(line(loss));
    std::vector<double> r(4), J(8);
    ASSERT_TRUE(f.at(result.x, r, J));
    double cost = 0.0, by_a = 0.0, by_b = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      cost += r[i] * r[i];
      by_a += r[i] * J[2 * i];
      by_b += r[i] * J[2 * i + 1];
    }
    EXPECT_NEAR(cost, result.cost, budget::fit_line);
    EXPECT_NEAR(by_a, 0.0, budget::fit_robust_gradient);
    EXPECT_NEAR(by_b, 0.0, budget::fit_robust_gradient);
  }
}

TEST(ResidualFunction, SaysWhereThereIsNoValue) {
  const fit::ResidualFunction f(line());
  std::vector<double> r(4);
  const std::vector<double> outside{-20.0, 0.0}, one{1.0};
  EXPECT_FALSE(f.at(outside, r, {}));
  EXPECT_REJECTED(f.at(one, r, {}), "got 1 unknowns and room for 4 numbers; expected 2 and 4");
}

const fit::LightModel body = fit::LightModel::homogeneous(
    0.0, normalized(Quaternion{0.6, 0.3, -0.5, 0.2}), {0.6, 0.5, 1.0}, {1.0, 0.85, 0.5});

TEST(ResidualFunction, OfFitsHasTheStartAtItsStart) {
  fit::SpinFit fit;
  fit.start = body.spin;
  fit.seen.rates = {{0.0, {0.6, 0.5, 1.1}, fit::covariance_of(0.1)}};
  fit.unknowns = {.attitude = false, .rate = true, .moment_ratios = false};
  const fit::ResidualFunction f(fit::least_squares_of(fit));
  std::vector<double> r(3);
  const std::vector<double> w{0.6, 0.5, 1.0};
  ASSERT_TRUE(f.at(w, r, {}));
  EXPECT_NEAR(std::abs(r[2]), 1.0, budget::fit_line);
  EXPECT_EQ(fit::state_at(fit, w).w_F.z, 1.0);
  EXPECT_REJECTED(fit::state_at(fit, {}), "expected 3");

  fit::LightFit light{.curves = {}, .start = body, .unknowns = {}, .loss = {}};
  EXPECT_NE(message_of([&] { static_cast<void>(fit::least_squares_of(light)); }), "");
  const std::vector<double> x{0.0, 0.0, 0.0, 0.6, 0.5, 1.0, 0.85, 0.5 / 0.85};
  EXPECT_EQ(fit::body_at(light, x).ellipsoid().b, 0.85);
  EXPECT_REJECTED(fit::body_at(light, w), "expected 8");
}

}  // namespace
