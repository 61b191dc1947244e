// SPDX-License-Identifier: MIT
#include "dynamics/variation/variation_collocation.hpp"

#include "math/gauss_legendre.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using DD = DoubleDouble;
constexpr std::size_t s = gauss_nodes;

GaussTableau made() {
  const GaussNodes<DD, s> nodes;
  const auto& [x, w, P] = nodes;
  GaussTableau g{};
  for (std::size_t i = 0; i < s; ++i) {
    g.c[i] = (0.5 * (1.0 + x[i])).hi;
    g.b[i] = (0.5 * w[i]).hi;
    for (std::size_t k = 0; k < s; ++k)
      g.all[k][i] = ((static_cast<double>(k) + 0.5) * (w[i] * P[i][k])).hi;
    for (std::size_t m = 0; m < 2; ++m) g.last[m][i] = g.all[s - 1 - m][i];
    for (std::size_t j = 0; j < s; ++j) g.a[i][j] = (0.25 * (w[j] * nodes.integral(i, j))).hi;
  }
  return g;
}

}  // namespace

const GaussTableau& gauss_tableau() {
  static const GaussTableau tableau = made();
  return tableau;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
