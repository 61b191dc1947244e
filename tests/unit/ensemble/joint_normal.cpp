// SPDX-License-Identifier: MIT
// Normal numbers with a covariance: its square root, what is drawn, and what is none.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "message_of.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/ensemble/draws.hpp"
#include "statistics.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;

constexpr double eps = std::numeric_limits<double>::epsilon();

// A A^T of n x rank random numbers, the rows scaled by 10^(3 i).
std::vector<double> drawn_covariance(std::size_t n, std::size_t rank, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> a(n * rank), c(n * n);
  for (double& x : a) x = normal(random);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < rank; ++k) c[i * n + j] += a[i * rank + k] * a[j * rank + k];
      c[i * n + j] *= std::pow(10.0, 3.0 * static_cast<double>(i + j));
    }
  return c;
}

// The covariance F F^T by the columns of F: draws at z = 0 but for one number.
std::vector<double> covariance_of(const ensemble::JointNormal& of) {
  const std::size_t n = of.size();
  std::vector<double> c(n * n), x(n);
  const double one = 0.3, z = ensemble::normal_quantile(one);
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> u(n, 0.5);
    u[k] = one;
    of.from_uniform(u, x);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) c[i * n + j] += x[i] * x[j] / (z * z);
  }
  return c;
}

TEST(JointNormal, HasTheCovarianceOfAnyRank) {
  for (const std::size_t n : {1u, 2u, 5u, 12u})
    for (std::size_t rank = 1; rank <= n; ++rank) {
      const std::vector<double> c = drawn_covariance(n, rank, 3);
      const std::vector<double> found = covariance_of({std::vector<double>(n), c});
      Worst<> worst;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          worst.add(std::abs(found[i * n + j] - c[i * n + j]) /
                    std::sqrt(c[i * n + i] * c[j * n + j]) / eps / static_cast<double>(n));
      EXPECT_LE(worst.value(), budget::joint_normal) << n << ", " << rank;
    }
}

TEST(JointNormal, OfOneNumberIsNormal) {
  const ensemble::JointNormal of({3.0}, {4.0});
  double x = 0.0;
  for (const double u : {1e-9, 0.2, 0.9}) {
    of.from_uniform({&u, 1}, {&x, 1});
    EXPECT_EQ(x, ensemble::Normal(3.0, 2.0).from_uniform(u));
  }
}

// What is left of a variance next to correlation 1 is kept.
TEST(JointNormal, KeepsSmallVariances) {
  const double r = 1.0 - 0x1p-40;
  const std::vector<double> found = covariance_of({{0.0, 0.0}, {1.0, r, r, 1.0}});
  EXPECT_LE(std::abs(found[3] - 1.0), budget::joint_normal * eps);
  EXPECT_LE(std::abs(found[1] - r), budget::joint_normal * eps);
}

// A covariance that was computed: its halves differ by roundings.
TEST(JointNormal, TakesRoundings) {
  EXPECT_EQ(message_of([] { ensemble::JointNormal({0.0, 0.0}, {1.0, 0.5, 0.5 + eps, 1.0}); }), "");
  EXPECT_NE(message_of([] { ensemble::JointNormal({0.0, 0.0}, {1.0, 0.5, 0.5 + 1e-9, 1.0}); }), "");
  EXPECT_EQ(message_of([] {
              ensemble::JointNormal({0.0, 0.0}, {1.0, 1.0 + eps, 1.0 + eps, 1.0});
            }),
            "");
  EXPECT_NE(message_of([] {
              ensemble::JointNormal({0.0, 0.0}, {1.0, 1.0 + 1e-9, 1.0 + 1e-9, 1.0});
            }),
            "");
}

// Two numbers that are one, and a fixed one.
TEST(JointNormal, MayBeFlat) {
  const ensemble::JointNormal of({1.0, 2.0, 7.0}, {4.0, -2.0, 0.0, -2.0, 1.0, 0.0, 0.0, 0.0, 0.0});
  const std::vector<double> u{0.2, 0.9, 0.4};
  std::vector<double> x(3);
  of.from_uniform(u, x);
  EXPECT_NE(x[0], 1.0);
  EXPECT_NEAR(x[0] - 1.0, -2.0 * (x[1] - 2.0), budget::joint_normal_flat);
  EXPECT_EQ(x[2], 7.0);
}

// The square of the distance from the mean, measured by the covariance, is chi-square of n; the
// correlations of the sample are those given.
TEST(JointNormal, IsDrawn) {
  const std::vector<double> c{4.0, 1.2, -0.5, 1.2, 1.0, 0.1, -0.5, 0.1, 0.25};
  const ensemble::JointNormal of({1.0, -1.0, 0.5}, c);
  // the inverse of c, by its cofactors
  const auto minor = [&](int i, int j) {
    const auto at = [&](int a, int b) { return c[static_cast<std::size_t>(a % 3 * 3 + b % 3)]; };
    return at(i + 1, j + 1) * at(i + 2, j + 2) - at(i + 1, j + 2) * at(i + 2, j + 1);
  };
  const double det = c[0] * minor(0, 0) + c[1] * minor(0, 1) + c[2] * minor(0, 2);
  std::vector<double> distances, products;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const ensemble::CounterRandom random(seed, ensemble::key_of("body.moments"));
    std::vector<double> squares, u(3), x(3), below(3);
    for (std::uint64_t m = 0; m < 8192; ++m) {
      random.uniforms(m, u);
      of.from_uniform(u, x);
      double square = 0.0;
      const double d[3] = {x[0] - 1.0, x[1] + 1.0, x[2] - 0.5};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) square += d[i] * minor(i, j) / det * d[j];
      squares.push_back(square);
      below.push_back(d[0] * d[1] - 1.2);
    }
    distances.push_back(
        kolmogorov(squares, [](double s) { return 1.0 - chi_square_above(s, 3.0); }));
    products.push_back(mean_is({below.begin() + 3, below.end()}, 0.0));
  }
  expect_as_it_should_be(pooled(distances));
  expect_as_it_should_be(pooled(products));
}

std::string refused(const std::vector<double>& mean, const std::vector<double>& covariance) {
  return message_of([&] { ensemble::JointNormal(mean, covariance); });
}

TEST(JointNormal, WhatIsNoCovarianceIsRefused) {
  const double nan = std::nan("");
  EXPECT_EQ(refused({}, {}), "JointNormal: a mean of 0 numbers must have one or more");
  EXPECT_EQ(refused({1, 2}, {1, 0, 0}),
            "JointNormal: a covariance of 3 numbers must have 4 for a mean of 2");
  EXPECT_EQ(refused({1, nan}, {1, 0, 0, 1}), "JointNormal: mean[1] = nan must be finite");
  EXPECT_EQ(refused({1, 2}, {1, nan, 0, 1}), "JointNormal: covariance[0][1] = nan must be finite");
  EXPECT_EQ(refused({1, 2}, {1, 0, 0, -0.5}),
            "JointNormal: covariance[1][1] = -0.5 must not be negative");
  EXPECT_EQ(refused({1, 2}, {1, 0.5, 0.25, 1}),
            "JointNormal: covariance[0][1] = 0.5 and covariance[1][0] = 0.25 must be equal");
  EXPECT_EQ(refused({1, 2}, {1, 0.5, 0.5, 0}),
            "JointNormal: covariance[0][1] = 0.5 must be 0 beside a variance of 0");
  EXPECT_EQ(refused({1, 2}, {4, 3, 3, 1}),
            "JointNormal: the least eigenvalue of the correlations, -0.5, must not be negative");
}

}  // namespace
