// SPDX-License-Identifier: MIT
#include "polhode/rotor/chart_jacobian.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "polhode/math/double_double.hpp"
#include "rotor/detail/chart_jacobian_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Entries of B cancel where axes of a chart come close to each other, not only at its poles: in
// double-double every entry is good to its last bit.
using Wide = DoubleDouble;
using WideMatrix6 = BasicMatrix6<Wide>;
using WideState = BasicRotorState<Wide>;

WideState wide(const RotorState& s) {
  return {{s.q.w, s.q.x, s.q.y, s.q.z}, {s.g.x, s.g.y, s.g.z}};
}

Matrix6 rounded(const WideMatrix6& m) {
  Matrix6 r;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) r(i, j) = m(i, j).hi;
  return r;
}

WideMatrix6 wide_jacobian(const CanonicalChart& chart, const WideState& s) {
  switch (chart.set) {
    case CanonicalSet::euler:
      return detail::chart_jacobian(detail::euler_axes(s));
    case CanonicalSet::andoyer:
      return detail::chart_jacobian(detail::andoyer_axes(s));
    case CanonicalSet::poincare:
      break;
  }
  return detail::chart_jacobian(detail::poincare_factors(s, chart.pole_J, chart.pole_I));
}

// The size of a chart's coordinates where the momentum has size G: what makes entries comparable.
std::array<double, 6> coordinate_sizes(const CanonicalChart& chart, double G) {
  if (chart.set != CanonicalSet::poincare) return {1.0, 1.0, 1.0, G, G, G};
  const double pair = std::sqrt(G);
  return {1.0, pair, pair, G, pair, pair};
}

// Puts 0 for entries that are nothing beside all others of their row or column: the rounding of
// double-double where the entry of the transformation is 0.
void clean(WideMatrix6& m, const std::array<double, 6>& to, const std::array<double, 6>& from) {
  constexpr double negligible = 0x1p-62;
  std::array<double, 6> row{}, column{};
  const auto size = [&](std::size_t i, std::size_t j) {
    return std::abs(m.a[i][j].hi) * (from[j] / to[i]);
  };
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      row[i] = std::max(row[i], size(i, j));
      column[j] = std::max(column[j], size(i, j));
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      if (size(i, j) < negligible * std::min(row[i], column[j])) m.a[i][j] = Wide(0.0);
    }
  }
}

}  // namespace

Matrix6 chart_jacobian(const EulerState& s) {
  const BasicEulerState<Wide> e{s.phi, s.theta, s.psi, s.Phi, s.Theta, s.Psi};
  return rounded(detail::chart_jacobian(detail::euler_axes(e)));
}

Matrix6 chart_jacobian(const AndoyerState& s) {
  const BasicAndoyerState<Wide> a{s.l, s.g, s.h, s.L, s.G, s.H};
  return rounded(detail::chart_jacobian(detail::andoyer_axes(a)));
}

Matrix6 chart_jacobian(const PoincareState& s) {
  const BasicPoincareState<Wide> p{s.sigma, s.Q1, s.Q2, s.G, s.P1, s.P2, s.pole_J, s.pole_I};
  return rounded(detail::chart_jacobian(detail::poincare_factors(p)));
}

Matrix6 chart_jacobian(const CanonicalChart& chart, const RotorState& s) {
  return rounded(wide_jacobian(chart, wide(s)));
}

Matrix6 inverse_chart_jacobian(const CanonicalChart& chart, const RotorState& s) {
  const WideState w = wide(s);
  return rounded(detail::inverse_chart_jacobian(wide_jacobian(chart, w), w.g));
}

Matrix6 canonical_transformation(const CanonicalChart& from, const CanonicalChart& to,
                                 const RotorState& s) {
  if (from == to) return Matrix6::identity();
  const WideState w = wide(s);
  const double G = norm(s.g);
  WideMatrix6 m =
      detail::inverse_chart_jacobian(wide_jacobian(to, w), w.g) * wide_jacobian(from, w);
  clean(m, coordinate_sizes(to, G), coordinate_sizes(from, G));
  return rounded(m);
}

Matrix6 inverse_chart_jacobian(const Matrix6& B, const Vec3& g_B) {
  return detail::inverse_chart_jacobian(B, g_B);
}

Matrix6 canonical_transformation(const Matrix6& B_from, const Matrix6& B_to, const Vec3& g_B) {
  return detail::inverse_chart_jacobian(B_to, g_B) * B_from;
}

}  // namespace v0
}  // namespace polhode
