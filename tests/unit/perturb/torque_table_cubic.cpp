// SPDX-License-Identifier: MIT
// The cubic of a TorqueTable between its rows, everywhere, against Hermite's basis on slopes that
// are formed another way: Brodlie's mean inside, the parabola of three rows at the ends.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "budgets.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "unit/perturb/support.hpp"

namespace perturb_test {
namespace {

using namespace polhode;

using Real = long double;

// Rising in x, falling in y, with bends that the rule for ends leaves alone.
const std::vector<TorqueRow> bent = {{-1.0, {0.0, 9.0, 1.0}},
                                     {0.5, {1.0, 5.0, 1.75}},
                                     {1.25, {2.0, 4.0, 2.25}},
                                     {4.0, {3.5, 1.0, 5.0}},
                                     {4.5, {4.25, 0.75, 5.75}}};

Real quotient(std::size_t k, int i) {
  return (Real(bent[k + 1].torque[i]) - bent[k].torque[i]) / (Real(bent[k + 1].t) - bent[k].t);
}

// Fritsch & Butland (1984): d0 d1 / (a d1 + (1 - a) d0), a = (1 + h1 / (h0 + h1)) / 3.
Real inner_slope(std::size_t k, int i) {
  const Real h0 = Real(bent[k].t) - bent[k - 1].t, h1 = Real(bent[k + 1].t) - bent[k].t;
  const Real a = (1 + h1 / (h0 + h1)) / 3, d0 = quotient(k - 1, i), d1 = quotient(k, i);
  return d0 * d1 / (a * d1 + (1 - a) * d0);
}

// Of Newton's parabola through three rows, at row `at`, the first or the last of them.
Real end_slope(std::size_t first, std::size_t at, int i) {
  const Real bend =
      (quotient(first + 1, i) - quotient(first, i)) / (Real(bent[first + 2].t) - bent[first].t);
  const Real t = bent[at].t;
  return quotient(first, i) + bend * ((t - bent[first].t) + (t - bent[first + 1].t));
}

Real slope(std::size_t k, int i) {
  if (k == 0) return end_slope(0, 0, i);
  if (k + 1 == bent.size()) return end_slope(k - 2, k, i);
  return inner_slope(k, i);
}

Real hermite(std::size_t k, Real x, int i) {
  const Real h = Real(bent[k + 1].t) - bent[k].t, y = 1 - x;
  return y * y * (1 + 2 * x) * bent[k].torque[i] + x * x * (1 + 2 * y) * bent[k + 1].torque[i] +
         h * x * y * (y * slope(k, i) - x * slope(k + 1, i));
}

TEST(TorqueTable, CubicIsHermitesBetweenAllRows) {
  const TorqueTable table(bent, {TorqueTable::Between::cubic, TorqueTable::Outside::refuse, {}});
  const Case c = drawn_case(1103, 0);
  for (std::size_t k = 0; k + 1 < bent.size(); ++k) {
    for (const double x : {0.0625, 0.25, 0.5, 0.8125, 0.9375}) {
      const double h = bent[k + 1].t - bent[k].t;
      const Vec3 u = table.effect(Setting{c.body, bent[k].t + x * h, c.s, c.q_IS}).u;
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(u[i], static_cast<double>(hermite(k, x, i)), budget::cubic_table_eps * eps)
            << "row " << k << " at " << x << ", component " << i;
    }
  }
}

}  // namespace
}  // namespace perturb_test
