// SPDX-License-Identifier: MIT
#include "polhode/system/andoyer_method.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/finite.hpp"
#include "polhode/system/canonical_rates.hpp"

namespace polhode {
inline namespace v0 {
namespace rates {
namespace detail {
namespace {

using Six = std::array<double, 6>;

// A vector of the tangent in its two halves.
struct Pair {
  Vec3 theta;
  Vec3 g;
};

Pair pair_of(const Six& x) { return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}}; }
Pair column(const Matrix6& B, int j) {
  return {{B(0, j), B(1, j), B(2, j)}, {B(3, j), B(4, j), B(5, j)}};
}

double bracket(const Pair& a, const Pair& b, const Vec3& g) {
  return dot(a.theta, b.g) - dot(a.g, b.theta) - dot(a.theta, cross(g, b.theta));
}

Vec3 magnitudes(const Vec3& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

// The sum of the magnitudes of the terms of a bracket.
double bracket_size(const Pair& a, const Pair& b, const Vec3& g) {
  const Vec3 ta = magnitudes(a.theta), tb = magnitudes(b.theta), h = magnitudes(g);
  const Vec3 moment{h.y * tb.z + h.z * tb.y, h.z * tb.x + h.x * tb.z, h.x * tb.y + h.y * tb.x};
  return dot(ta, magnitudes(b.g)) + dot(magnitudes(a.g), tb) + dot(ta, moment);
}

// The row at or below c whose entry in column c is largest relative to the rest of its row.
std::size_t pivot_row(const Matrix6& A, const Six& row_size, std::size_t c) {
  std::size_t best = c;
  for (std::size_t i = c + 1; i < 6; ++i)
    if (std::abs(A.a[i][c]) / row_size[i] > std::abs(A.a[best][c]) / row_size[best]) best = i;
  return best;
}

// x of A x = b by elimination; NaN where A is singular.
Six solved(Matrix6 A, Six b) {
  Six row_size{};
  for (std::size_t i = 0; i < 6; ++i)
    for (const double x : A.a[i]) row_size[i] = polhode::detail::larger(row_size[i], std::abs(x));
  for (std::size_t c = 0; c < 6; ++c) {
    const std::size_t p = pivot_row(A, row_size, c);
    std::swap(A.a[c], A.a[p]);
    std::swap(b[c], b[p]);
    std::swap(row_size[c], row_size[p]);
    for (std::size_t i = c + 1; i < 6; ++i) {
      const double factor = A.a[i][c] / A.a[c][c];
      for (std::size_t j = c; j < 6; ++j) A.a[i][j] -= factor * A.a[c][j];
      b[i] -= factor * b[c];
    }
  }
  for (std::size_t c = 6; c-- > 0;) {
    for (std::size_t j = c + 1; j < 6; ++j) b[c] -= A.a[c][j] * b[j];
    b[c] /= A.a[c][c];
  }
  for (double& x : b)
    if (!std::isfinite(x)) x = std::numeric_limits<double>::quiet_NaN();
  return b;
}

}  // namespace

Matrix6 lagrange_brackets(const VariablesAt& at) {
  Matrix6 L;
  for (int k = 0; k < 6; ++k) {
    for (int l = k + 1; l < 6; ++l) {
      L(k, l) = bracket(column(at.B, k), column(at.B, l), at.s.g);
      L(l, k) = -L(k, l);
    }
  }
  return L;
}

double canonical_defect(const VariablesAt& at) {
  double worst = 0.0;
  for (int k = 0; k < 6; ++k) {
    for (int l = k + 1; l < 6; ++l) {
      const Pair a = column(at.B, k), b = column(at.B, l);
      const double J = l == k + 3 ? 1.0 : 0.0;
      const double size = polhode::detail::larger(J, bracket_size(a, b, at.s.g));
      const double defect = std::abs(bracket(a, b, at.s.g) - J);
      if (defect != 0.0) worst = polhode::detail::larger(worst, defect / size);
    }
  }
  return worst;
}

std::array<double, 6> equations_of_motion(const VariablesAt& at, const System& system, double t) {
  const HubRates rates = hub_rates(system, t, {normalized(at.s.q), at.s.g});
  const Vec3 u = rates.g - cross(at.s.g, rates.theta);  // what is left is the force of the angles
  Six right{};
  for (int k = 0; k < 6; ++k) {
    const Pair z = column(at.B, k);
    const double dH = dot(z.g, rates.theta) - dot(z.theta, u);
    right[static_cast<std::size_t>(k)] = -(dH + bracket(z, pair_of(at.by_t), at.s.g));
  }
  return solved(lagrange_brackets(at), right);
}

}  // namespace detail
}  // namespace rates
}  // namespace v0
}  // namespace polhode
