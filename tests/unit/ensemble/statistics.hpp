// SPDX-License-Identifier: MIT
// Probabilities that draws are what they should be, over fixed seeds: nothing flakes. A test pools
// those of several seeds into one.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "budgets/ensemble.hpp"
#include "worst.hpp"

namespace polhode::test {

// That chi-square of so many degrees of freedom is above x.
inline double chi_square_above(double x, double freedom) {
  return boost::math::gamma_q(0.5 * freedom, 0.5 * x);
}

// That the largest distance between the distribution functions of the sample and of `below` is as
// large as it is (Kolmogorov; Stephens 1970 for the size).
inline double kolmogorov(std::vector<double> sample, const std::function<double(double)>& below) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  Worst<> distance;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double p = below(sample[i]), k = static_cast<double>(i);
    distance.add((k + 1.0) / n - p);
    distance.add(p - k / n);
  }
  const double t = distance.value() * (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n));
  double sum = 0.0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 == 1 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * t * t);
  return t < 0.2 ? 1.0 : sum;
}

// That so many counts, each as probable, are as uneven as they are.
inline double evenness(const std::vector<double>& counts) {
  double total = 0.0, x = 0.0;
  for (const double count : counts) total += count;
  const double mean = total / static_cast<double>(counts.size());
  for (const double count : counts) x += (count - mean) * (count - mean) / mean;
  return chi_square_above(x, static_cast<double>(counts.size() - 1));
}

// That the mean of the sample is as far from `mean`, either way, for the deviation that it has.
inline double mean_is(const std::vector<double>& sample, double mean) {
  const auto n = static_cast<double>(sample.size());
  double sum = 0.0, squares = 0.0;
  for (const double x : sample) sum += x - mean;
  for (const double x : sample) squares += (x - mean - sum / n) * (x - mean - sum / n);
  const double t = sum / std::sqrt(squares);
  return std::erfc(std::abs(t) / std::sqrt(2.0));
}

// Fisher's: of independent probabilities, which are uniform where all is as it should be.
inline double pooled(const std::vector<double>& probabilities) {
  double x = 0.0;
  for (const double p : probabilities) x -= 2.0 * std::log(p);
  return chi_square_above(x, 2.0 * static_cast<double>(probabilities.size()));
}

// The pooled probability over the seeds 1 to `seeds`.
template <class Probability>
double over_seeds(int seeds, const Probability& probability) {
  std::vector<double> found;
  for (int seed = 1; seed <= seeds; ++seed)
    found.push_back(probability(static_cast<std::uint64_t>(seed)));
  return pooled(found);
}

inline void expect_as_it_should_be(double probability) {
  EXPECT_GE(probability, budget::improbable);
  EXPECT_LE(probability, budget::too_good);
}

}  // namespace polhode::test
