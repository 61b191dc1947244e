// SPDX-License-Identifier: MIT
// Distributions of one number: against 50 digits of Boost, and drawn.
#include "polhode/ensemble/distributions.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "message_of.hpp"
#include "polhode/ensemble/draws.hpp"
#include "statistics.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;
using Exact = boost::multiprecision::cpp_bin_float_50;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();

Exact exact_quantile(const Exact& u) {
  return -sqrt(Exact(2)) * boost::math::erfc_inv(Exact(2 * u));
}
Exact exact_below(const Exact& z) { return boost::math::erfc(Exact(-z / sqrt(Exact(2)))) / 2; }

double ulps(double got, const Exact& want) {
  const double size = std::abs(static_cast<double>(want));
  return static_cast<double>(
      Exact(abs(Exact(got) - want) / (std::nextafter(size, infinity) - size)));
}

TEST(NormalQuantile, HasFullPrecisionUpToBothEnds) {
  Worst<> worst;
  const auto add = [&](double u) {
    worst.add(ulps(ensemble::normal_quantile(u), exact_quantile(u)), std::to_string(u));
  };
  std::mt19937_64 random(1);
  for (int i = 0; i < 1500; ++i) add(ensemble::open_uniform(random()));
  for (int e = 2; e <= 1022; e += e < 60 ? 1 : 13)  // and both sides of the bounds of its parts
    for (const double part : {1.0, 1.37, 1.89}) add(std::ldexp(part, -e));
  for (int e = 2; e <= 53; ++e) add(1.0 - std::ldexp(1.0, -e));
  for (const double bound : {0.075, 0.925, 1.3887943864964021e-11})
    for (const double side : {1.0 - 1e-9, 1.0 + 1e-9}) add(bound * side);
  for (const double q : {1e-17, 1e-12, 1e-7, 1e-3}) add(0.5 - q);
  EXPECT_LE(worst.value(), budget::normal_quantile_ulp) << worst.where();
}

TEST(NormalQuantile, IsOddAboutOneHalf) {
  EXPECT_EQ(ensemble::normal_quantile(0.5), 0.0);
  for (const double u : {0x1p-53, 0x3p-53, 0x1.8p-20, 0x1.4p-6, 0x1.3333p-2, 0x1.ffffp-2})
    EXPECT_EQ(ensemble::normal_quantile(1.0 - u), -ensemble::normal_quantile(u));
  for (const double u : {std::nan(""), 0.0, 1.0, -0.3, 1.7})
    EXPECT_TRUE(std::isnan(ensemble::normal_quantile(u))) << u;
}

// Grows with u, over the seams too.
TEST(NormalQuantile, Grows) {
  for (const double start : {1e-300, 1.38e-11, 0.07499, 0.4999, 0.92499}) {
    double before = -infinity;
    for (int i = 0; i < 2000; ++i) {
      const double z = ensemble::normal_quantile(start * (1.0 + 1e-6 * i));
      ASSERT_GE(z, before);
      before = z;
    }
  }
}

TEST(Uniform, IsAnInterval) {
  const ensemble::Uniform of(-3.0, 7.0);
  EXPECT_EQ(of.from_uniform(0.25), -0.5);
  EXPECT_LE(ensemble::Uniform(0.1, 0.3).from_uniform(1.0 - 0x1p-53), 0.3);
  EXPECT_GE(ensemble::Uniform(0.1, 0.3).from_uniform(0x1p-53), 0.1);
}

TEST(LogUniform, IsUniformInTheLogarithm) {
  Worst<> worst;
  for (const auto& [low, high] : {std::pair(1e-3, 20.0), {1.0, 1.0000001}, {1e-150, 1e140}})
    for (const double u : {0x1p-53, 0.01, 0.3, 0.5, 0.77, 1.0 - 0x1p-53}) {
      const Exact want = Exact(low) * pow(Exact(high) / Exact(low), Exact(u));
      const double got = ensemble::LogUniform(low, high).from_uniform(u);
      // in eps of the logarithm of the ratio, or of the number
      worst.add(static_cast<double>(Exact(abs(got / want - 1))) / eps /
                larger(1.0, std::log(high / low)));
    }
  EXPECT_LE(worst.value(), budget::log_uniform);
}

// Whatever rounds, nothing is beyond a bound.
TEST(Distributions, StayWithinTheirBounds) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const double low = ensemble::open_uniform(random()),
                 high = low * (1.0 + 1e-3 * ensemble::open_uniform(random()));
    for (const double u : {0x1p-53, 1.0 - 0x1p-53}) {
      for (const double x : {ensemble::Uniform(low, high).from_uniform(u),
                             ensemble::LogUniform(low, high).from_uniform(u),
                             ensemble::TruncatedNormal(0.3, 0.1, low, high).from_uniform(u)}) {
        ASSERT_GE(x, low);
        ASSERT_LE(x, high);
      }
    }
  }
}

TEST(TruncatedNormal, InvertsItsDistributionFunction) {
  Worst<> worst;
  for (const auto& [low, high] : {std::pair(-infinity, infinity),
                                  {-1.0, 2.0},
                                  {0.0, infinity},
                                  {-infinity, 0.0},
                                  {-infinity, -3.0},
                                  {3.0, infinity},
                                  {8.0, 9.0},
                                  {-20.0, -19.0},
                                  {36.0, infinity},
                                  {-2.0, 30.0},
                                  {0.7, 0.8},
                                  {-1e9, 0.25}}) {
    const ensemble::TruncatedNormal of(0.0, 1.0, low, high);
    const Exact from = low == -infinity ? Exact(0) : exact_below(low);
    const Exact above = high == infinity ? Exact(0) : exact_below(-Exact(high));
    for (const double u : {0x1p-53, 1e-6, 0.03, 0.4, 0.5, 0.6, 0.97, 1.0 - 1e-6, 1.0 - 0x1p-53}) {
      // by the smaller of both tails
      const Exact all = low > 0    ? exact_below(-Exact(low)) - above
                        : high < 0 ? exact_below(high) - from
                                   : 1 - above - from;
      const Exact p = from + u * all, q = above + (1 - Exact(u)) * all;
      const Exact want = low > 0 || p > q ? Exact(-exact_quantile(q)) : exact_quantile(p);
      const double got = of.from_uniform(u);
      EXPECT_GE(got, low);
      EXPECT_LE(got, high);
      worst.add(static_cast<double>(Exact(abs(got - want))) / eps /
                    larger(1.0, std::abs(static_cast<double>(want))),
                std::to_string(low) + ", " + std::to_string(high) + " at " + std::to_string(u));
    }
  }
  EXPECT_LE(worst.value(), budget::truncated_normal) << worst.where();
}

TEST(TruncatedNormal, OfSigmaZeroIsItsMean) {
  for (const double u : {1e-300, 0.2, 0.5, 0.8, 1.0 - 0x1p-53}) {
    EXPECT_EQ(ensemble::Normal(0.3, 0.0).from_uniform(u), 0.3);
    EXPECT_EQ(ensemble::TruncatedNormal(0.3, 0.0, -1.0, infinity).from_uniform(u), 0.3);
    EXPECT_EQ(ensemble::TruncatedNormal(0.3, 0.0, 0.3, 1.0).from_uniform(u), 0.3);
  }
}

TEST(TruncatedNormal, IsScaledAndTheNormalOneWithoutBounds) {
  const ensemble::TruncatedNormal all(2.0, 3.0, -infinity, infinity);
  for (const double u : {1e-9, 0.2, 0.5, 0.9})
    EXPECT_NEAR(all.from_uniform(u), ensemble::Normal(2.0, 3.0).from_uniform(u),
                budget::truncated_normal_scaled);
  const ensemble::TruncatedNormal mass(5.0, 2.0, 0.0, infinity),
      mirrored(-5.0, 2.0, -infinity, 0.0);
  for (const double u : {0x1p-53, 0.25, 0.5, 0.75}) {
    EXPECT_GE(mass.from_uniform(u), 0.0);
    EXPECT_NEAR(mass.from_uniform(u), -mirrored.from_uniform(1.0 - u),
                budget::truncated_normal_scaled);
  }
}

// Drawn by counter, each has its distribution function.
template <class Of, class Below>
void expect_distribution(const Of& of, const Below& below) {
  expect_as_it_should_be(over_seeds(12, [&](std::uint64_t seed) {
    const ensemble::CounterRandom random(seed, ensemble::key_of("x"));
    std::vector<double> sample;
    for (std::uint64_t m = 0; m < 8192; ++m)
      sample.push_back(of.from_uniform(random.uniform(m, 0)));
    return kolmogorov(sample, below);
  }));
}

double normal_below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

TEST(Distributions, AreDrawn) {
  expect_distribution(ensemble::Uniform(-2.0, 5.0), [](double x) { return (x + 2.0) / 7.0; });
  expect_distribution(ensemble::LogUniform(0.01, 100.0),
                      [](double x) { return std::log(x / 0.01) / std::log(1e4); });
  expect_distribution(ensemble::Normal(3.0, 0.5),
                      [](double x) { return normal_below((x - 3.0) / 0.5); });
  expect_distribution(ensemble::TruncatedNormal(1.0, 2.0, 0.0, 4.0), [](double x) {
    const double from = normal_below(-0.5);
    return (normal_below((x - 1.0) / 2.0) - from) / (normal_below(1.5) - from);
  });
}

TEST(CounterRandom, NormalNumbersHaveTheirTailsAndMoments) {
  std::vector<double> tails, kurtosis;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const ensemble::CounterRandom random(seed, ensemble::key_of("z"));
    double beyond = 0.0;
    std::vector<double> fourth;
    constexpr std::uint64_t members = 100'000;
    for (std::uint64_t m = 0; m < members; ++m) {
      const double z = random.normal(m, 2);
      if (std::abs(z) > 3.0) ++beyond;
      fourth.push_back(z * z * z * z);
    }
    const double p = std::erfc(3.0 / std::sqrt(2.0)), mean = p * members;
    tails.push_back(chi_square_above((beyond - mean) * (beyond - mean) / (mean * (1.0 - p)), 1.0));
    kurtosis.push_back(mean_is(fourth, 3.0));
  }
  expect_as_it_should_be(pooled(tails));
  expect_as_it_should_be(pooled(kurtosis));
}

TEST(Distributions, WhatIsNoneIsRefused) {
  EXPECT_MESSAGE(ensemble::Uniform(2.0, 1.0), "Uniform: low 2 must be below high, which is 1");
  EXPECT_MESSAGE(ensemble::Uniform(1.0, 1.0), "Uniform: low 1 must be below high, which is 1");
  EXPECT_MESSAGE(ensemble::Uniform(0.0, infinity), "Uniform: high inf must be finite");
  EXPECT_MESSAGE(ensemble::Uniform(-1.5e308, 1.5e308), "Uniform: high - low inf must be finite");
  EXPECT_MESSAGE(ensemble::LogUniform(0.0, 1.0), "LogUniform: low 0 must be positive");
  EXPECT_MESSAGE(ensemble::LogUniform(3.0, 2.0),
                 "LogUniform: low 3 must be below high, which is 2");
  EXPECT_MESSAGE(ensemble::LogUniform(1e-200, 1e200),
                 "LogUniform: high / low inf must be at most 1e300");
  EXPECT_MESSAGE(ensemble::Normal(std::nan(""), 1.0), "Normal: mean nan must be finite");
  EXPECT_MESSAGE(ensemble::Normal(0.0, -1.0), "Normal: sigma -1 must not be negative");
  EXPECT_MESSAGE(ensemble::TruncatedNormal(0.0, -1.0, -1.0, 1.0),
                 "TruncatedNormal: sigma -1 must not be negative");
  EXPECT_MESSAGE(ensemble::TruncatedNormal(0.0, 0.0, 1.0, 2.0),
                 "TruncatedNormal: low 1 must be at most the mean, where sigma is 0");
  EXPECT_MESSAGE(ensemble::TruncatedNormal(0.0, 0.0, -2.0, -1.0),
                 "TruncatedNormal: high -1 must be at least the mean, where sigma is 0");
  EXPECT_MESSAGE(ensemble::TruncatedNormal(0.0, 1.0, 1.0, -1.0),
                 "TruncatedNormal: low 1 must be below high, which is -1");
  EXPECT_MESSAGE(ensemble::TruncatedNormal(0.0, 1.0, std::nan(""), 1.0),
                 "TruncatedNormal: low nan must be below high, which is 1");
  EXPECT_MESSAGE(ensemble::TruncatedNormal(0.0, 2.0, 75.0, 80.0),
                 "TruncatedNormal: low 75 must be at most 37 sigma above the mean");
  EXPECT_MESSAGE(ensemble::TruncatedNormal(0.0, 2.0, -80.0, -75.0),
                 "TruncatedNormal: high -75 must be at most 37 sigma below the mean");
}

}  // namespace
