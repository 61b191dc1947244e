// SPDX-License-Identifier: MIT
// Tumblers that are drawn: by which seeds, how many, and whether distances of their truths are
// those of the errors that fits give.
#pragma once

#include <gtest/gtest.h>

#include <boost/math/special_functions/gamma.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "budgets.hpp"

namespace polhode::test {

inline bool is_full() { return std::getenv("POLHODE_TEST_FULL") != nullptr; }

// One seed; three with POLHODE_TEST_FULL; and the one that POLHODE_TEST_SEED gives.
inline std::vector<std::uint64_t> drawn_seeds() {
  std::vector<std::uint64_t> seeds{11};
  if (is_full()) seeds.insert(seeds.end(), {12, 13});
  if (const char* given = std::getenv("POLHODE_TEST_SEED")) seeds.push_back(std::stoull(given));
  return seeds;
}

// Squares of Mahalanobis' distances of truths, of 8 unknowns each.
struct PooledDistance {
  double sum = 0.0;
  std::size_t count = 0;

  void add(double squared) {
    sum += squared;
    ++count;
  }
  // How probable such a sum or a greater one is.
  double above() const { return boost::math::gamma_q(4.0 * static_cast<double>(count), 0.5 * sum); }
  std::string text() const {
    return std::to_string(sum) + " on " + std::to_string(8 * count) +
           ", p = " + std::to_string(above());
  }
  void expect_probable() const {
    EXPECT_GT(above(), budget::fit_improbable) << text();
    EXPECT_LT(above(), 1.0 - budget::fit_improbable) << text();
  }
};

}  // namespace polhode::test
