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

// Integrals of the Lagrange polynomials through Gauss' nodes by their expansion in Legendre
// polynomials, of which the integral is (P_(k+1) - P_(k-1)) / (2k + 1).
GaussTableau made() {
  const GaussRule<DD, s> rule = gauss_legendre<DD, s>();
  std::array<DD, s> x;
  const std::array<DD, s>& w = rule.w;
  std::array<std::array<DD, s + 1>, s> P;
  for (std::size_t i = 0; i < s; ++i) {
    x[i] = -rule.x[i];  // rising
    P[i] = legendre_polynomials<s>(x[i]);
  }
  GaussTableau g{};
  for (std::size_t i = 0; i < s; ++i) {
    g.c[i] = (0.5 * (1.0 + x[i])).hi;
    g.b[i] = (0.5 * w[i]).hi;
    for (std::size_t k = 0; k < s; ++k)
      g.all[k][i] = ((static_cast<double>(k) + 0.5) * (w[i] * P[i][k])).hi;
    for (std::size_t m = 0; m < 2; ++m) g.last[m][i] = g.all[s - 1 - m][i];
    for (std::size_t j = 0; j < s; ++j) {
      DD sum = 1.0 + x[i];
      for (std::size_t k = 1; k < s; ++k) sum += P[j][k] * (P[i][k + 1] - P[i][k - 1]);
      g.a[i][j] = (0.25 * (w[j] * sum)).hi;
    }
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
