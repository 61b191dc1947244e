// SPDX-License-Identifier: MIT
#include "dynamics/variation/variation_collocation.hpp"

#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using DD = DoubleDouble;
constexpr std::size_t s = gauss_nodes;

// P_0 ... P_s at x.
std::array<DD, s + 1> legendre(const DD& x) {
  std::array<DD, s + 1> P{DD(1.0), x};
  for (std::size_t k = 1; k < s; ++k) {
    const double n = static_cast<double>(k);
    P[k + 1] = ((2.0 * n + 1.0) * (x * P[k]) - n * P[k - 1]) / DD(n + 1.0);
  }
  return P;
}

// The roots of P_s and Gauss' weights; integrals of the Lagrange polynomials through their
// expansion in Legendre polynomials, of which the integral is (P_(k+1) - P_(k-1)) / (2k + 1).
GaussTableau made() {
  std::array<DD, s> x, w;
  std::array<std::array<DD, s + 1>, s> P;
  const double n = static_cast<double>(s);
  for (std::size_t i = 0; i < s; ++i) {
    x[i] = -std::cos(3.141592653589793 * (static_cast<double>(i) + 0.75) / (n + 0.5));
    DD slope = 1.0;
    for (int trip = 0; trip < 8; ++trip) {  // 8 trips, quadratic
      P[i] = legendre(x[i]);
      slope = n * (P[i][s - 1] - x[i] * P[i][s]) / (1.0 - x[i] * x[i]);
      x[i] -= P[i][s] / slope;
    }
    P[i] = legendre(x[i]);
    w[i] = 2.0 / ((1.0 - x[i] * x[i]) * slope * slope);
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
