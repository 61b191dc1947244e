// SPDX-License-Identifier: MIT
// canonical_defect is a number that users read: the largest |[z_k, z_l] - J| over the sum of the
// magnitudes of the terms of [z_k, z_l], here term by term in the indices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "budgets.hpp"
#include "polhode/system/andoyer_method.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using polhode::test::larger;
// The Levi-Civita symbol.
int parity(int i, int j, int k) { return (i - j) * (j - k) * (k - i) / 2; }

struct Bracket {
  long double value = 0, size = 0;

  void add(long double term) {
    value += term;
    size += std::abs(term);
  }
};

// theta_k . g_l - g_k . theta_l - theta_k . (g x theta_l), columns of B.
Bracket bracket(const detail::VariablesAt& at, int k, int l) {
  Bracket b;
  for (int i = 0; i < 3; ++i) {
    b.add(static_cast<long double>(at.B(i, k)) * at.B(3 + i, l));
    b.add(-static_cast<long double>(at.B(3 + i, k)) * at.B(i, l));
    for (int m = 0; m < 3; ++m)
      for (int n = 0; n < 3; ++n)
        if (parity(i, m, n) != 0)
          b.add(-static_cast<long double>(at.B(i, k)) * parity(i, m, n) * at.s.g[m] * at.B(n, l));
  }
  return b;
}

TEST(AndoyersMethod, DefectIsOfTheSizeOfItsTerms) {
  std::mt19937_64 random(2024);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int draw = 0; draw < 40; ++draw) {
    detail::VariablesAt at{{{}, {uniform(random), uniform(random), uniform(random)}}, {}, {}};
    // A column alone stands out, so that every pair is the worst in some draw.
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) at.B(i, j) = uniform(random) * (j == draw % 6 ? 30.0 : 1.0);
    long double worst = 0;
    for (int k = 0; k < 6; ++k) {
      for (int l = k + 1; l < 6; ++l) {
        const Bracket b = bracket(at, k, l);
        EXPECT_NEAR(detail::lagrange_brackets(at)(k, l), static_cast<double>(b.value),
                    budget::andoyer_method * static_cast<double>(b.size));
        const long double J = l == k + 3 ? 1 : 0;
        const long double defect = std::abs(b.value - J) / larger(J, b.size);
        worst = larger(worst, defect);
      }
    }
    EXPECT_NEAR(detail::canonical_defect(at), static_cast<double>(worst), budget::andoyer_method);
  }
}

}  // namespace
}  // namespace polhode::test
