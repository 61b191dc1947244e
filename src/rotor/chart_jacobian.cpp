// SPDX-License-Identifier: MIT
// Jacobians of the charts: of angles and momenta, and of angles and rates.
#include "polhode/rotor/chart_jacobian.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <initializer_list>

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

// Powers of two by which the unit of momentum is changed, so that double-double neither overflows
// nor runs out of low parts: exact. Even, because Poincare's pairs take half of it; 0 where nothing
// is near.
int unit_exponent(std::initializer_list<double> momenta) {
  double largest = 0.0;
  for (const double p : momenta) largest = std::max(largest, std::abs(p));
  if (!(largest > 0.0) || !std::isfinite(largest)) return 0;
  const int exponent = std::ilogb(largest);
  return std::abs(exponent) < 200 ? 0 : exponent - exponent % 2;
}
int unit_exponent(const Vec3& g) { return unit_exponent({g.x, g.y, g.z}); }

RotorState in_units(const RotorState& s, int exponent) {
  const auto scaled = [&](double p) { return std::ldexp(p, -exponent); };
  return {s.q, {scaled(s.g.x), scaled(s.g.y), scaled(s.g.z)}};
}

using Exponents = std::array<int, 6>;
Exponents hub_exponents(int e) { return {0, 0, 0, e, e, e}; }
Exponents coordinate_exponents(CanonicalSet set, int e) {
  if (set != CanonicalSet::poincare) return {0, 0, 0, e, e, e};
  return {0, e / 2, e / 2, e, e / 2, e / 2};
}

// Back in the user's units, in which entry (i, j) is 2^(row_i - column_j) times larger.
Matrix6 rounded(const WideMatrix6& m, const Exponents& row = {}, const Exponents& column = {}) {
  Matrix6 r;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) r.a[i][j] = std::ldexp(m.a[i][j].hi, row[i] - column[j]);
  return r;
}

WideMatrix6 jacobian(const detail::EulerAxes<Wide>& e) {
  return detail::sum_of_terms(e.s, Wide(1.0),
                              [&](const auto& by) { return detail::chart_jacobian(e, by); });
}
WideMatrix6 jacobian(const detail::AndoyerAxes<Wide>& a) {
  return detail::sum_of_terms(a.J.im, a.I.im,
                              [&](const auto& by) { return detail::chart_jacobian(a, by); });
}
WideMatrix6 jacobian(const detail::PoincareFactors<Wide>& f) {
  return detail::sum_of_terms(f.p1.w, f.p2.w,
                              [&](const auto& by) { return detail::chart_jacobian(f, by); });
}

WideMatrix6 wide_jacobian(const CanonicalChart& chart, const WideState& s) {
  switch (chart.set) {
    case CanonicalSet::euler:
      return jacobian(detail::euler_axes(s));
    case CanonicalSet::andoyer:
      return jacobian(detail::andoyer_axes(s));
    case CanonicalSet::poincare:
      break;
  }
  return jacobian(detail::poincare_factors(s, chart.pole_J, chart.pole_I));
}

// Nearer to a pole than this, theta x g + dg cancels more than double-double has to spare.
bool is_near(const Wide& sine, double unit = 1.0) {
  return sine.hi > 0.0 && sine.hi < 0x1p-40 * unit;
}

WideMatrix6 wide_inverse(const CanonicalChart& chart, const WideState& s) {
  if (chart.set == CanonicalSet::andoyer) {
    const detail::AndoyerAxes<Wide> a = detail::andoyer_axes(s);
    if (is_near(a.J.im) || is_near(a.I.im))
      return detail::inverse_of_columns(detail::sum_of_terms(
          a.J.im, a.I.im, [&](const auto& by) { return detail::inertial_columns(a, by); }));
    return detail::inverse_chart_jacobian(jacobian(a), s.g);
  }
  if (chart.set == CanonicalSet::poincare) {
    const detail::PoincareFactors<Wide> f = detail::poincare_factors(s, chart.pole_J, chart.pole_I);
    const double unit = std::sqrt(f.G.hi);
    if (is_near(f.p1.w, unit) || is_near(f.p2.w, unit))
      return detail::inverse_of_columns(detail::sum_of_terms(
          f.p1.w, f.p2.w, [&](const auto& by) { return detail::inertial_columns(f, by); }));
    return detail::inverse_chart_jacobian(jacobian(f), s.g);
  }
  return detail::inverse_chart_jacobian(jacobian(detail::euler_axes(s)), s.g);
}

// Powers of two that bring a row or a column next to a pole to order 1, where its products with
// others are in the range of double-double; 0 for most.
template <class Entry>
int line_exponent(const Entry& entry) {
  double largest = 0.0;
  for (int k = 0; k < 6; ++k) largest = std::max(largest, std::abs(entry(k).hi));
  return largest > 0x1p400 && std::isfinite(largest) ? std::ilogb(largest) : 0;
}

WideMatrix6 product(WideMatrix6 a, WideMatrix6 b) {
  Exponents row{}, column{};
  for (int i = 0; i < 6; ++i) {
    const auto at = static_cast<std::size_t>(i);
    row[at] = line_exponent([&](int k) { return a(i, k); });
    column[at] = line_exponent([&](int k) { return b(k, i); });
    for (int k = 0; k < 6; ++k) {
      a(i, k) = ldexp(a(i, k), -row[at]);
      b(k, i) = ldexp(b(k, i), -column[at]);
    }
  }
  WideMatrix6 m = a * b;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) m.a[i][j] = ldexp(m.a[i][j], row[i] + column[j]);
  return m;
}

// The size of a chart's coordinates where the momentum has size G: what makes entries comparable.
std::array<double, 6> coordinate_sizes(const CanonicalChart& chart, double G) {
  if (chart.set != CanonicalSet::poincare) return {1.0, 1.0, 1.0, G, G, G};
  const double pair = std::sqrt(G);
  return {1.0, pair, pair, G, pair, pair};
}

// Puts 0 for entries that are nothing next to all others of their row or column: the rounding of
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
  const int e = unit_exponent({s.Phi, s.Theta, s.Psi});
  const auto scaled = [&](double p) { return Wide(std::ldexp(p, -e)); };
  const BasicEulerState<Wide> w{s.phi,         s.theta,         s.psi,
                                scaled(s.Phi), scaled(s.Theta), scaled(s.Psi)};
  return rounded(jacobian(detail::euler_axes(w)), hub_exponents(e), hub_exponents(e));
}

Matrix6 chart_jacobian(const AndoyerState& s) {
  const int e = unit_exponent({s.G});
  const auto scaled = [&](double p) { return Wide(std::ldexp(p, -e)); };
  const BasicAndoyerState<Wide> w{s.l, s.g, s.h, scaled(s.L), scaled(s.G), scaled(s.H)};
  return rounded(jacobian(detail::andoyer_axes(w)), hub_exponents(e), hub_exponents(e));
}

Matrix6 chart_jacobian(const PoincareState& s) {
  const int e = unit_exponent({s.G});
  const auto pair = [&](double p) { return Wide(std::ldexp(p, -e / 2)); };
  const BasicPoincareState<Wide> w{s.sigma,    pair(s.Q1), pair(s.Q2), std::ldexp(s.G, -e),
                                   pair(s.P1), pair(s.P2), s.pole_J,   s.pole_I};
  return rounded(jacobian(detail::poincare_factors(w)), hub_exponents(e),
                 coordinate_exponents(CanonicalSet::poincare, e));
}

Matrix6 chart_jacobian(const RotorState& s, const CanonicalChart& chart) {
  const int e = unit_exponent(s.g);
  return rounded(wide_jacobian(chart, wide(in_units(s, e))), hub_exponents(e),
                 coordinate_exponents(chart.set, e));
}

Matrix6 inverse_chart_jacobian(const RotorState& s, const CanonicalChart& chart) {
  const int e = unit_exponent(s.g);
  return rounded(wide_inverse(chart, wide(in_units(s, e))), coordinate_exponents(chart.set, e),
                 hub_exponents(e));
}

Matrix6 canonical_transformation(const RotorState& s, const CanonicalChart& from,
                                 const CanonicalChart& to) {
  if (from == to) return Matrix6::identity();
  const int e = unit_exponent(s.g);
  const RotorState scaled = in_units(s, e);
  const WideState w = wide(scaled);
  const double G = norm(scaled.g);
  WideMatrix6 m = product(wide_inverse(to, w), wide_jacobian(from, w));
  clean(m, coordinate_sizes(to, G), coordinate_sizes(from, G));
  return rounded(m, coordinate_exponents(to.set, e), coordinate_exponents(from.set, e));
}

Matrix6 inverse_chart_jacobian(const Vec3& g_B, const Matrix6& B) {
  return detail::inverse_chart_jacobian(B, g_B);
}

Matrix6 canonical_transformation(const Vec3& g_B, const Matrix6& B_from, const Matrix6& B_to) {
  return detail::inverse_chart_jacobian(B_to, g_B) * B_from;
}

namespace {

Mat3 diagonal(const Vec3& d) { return {{{d.x, 0.0, 0.0}, {0.0, d.y, 0.0}, {0.0, 0.0, d.z}}}; }

Mat3 inertia(const Body& body) { return diagonal(body.moments()); }

Mat3 inverse_inertia(const Body& body) {
  const Vec3& I = body.moments();
  return diagonal({1.0 / I.x, 1.0 / I.y, 1.0 / I.z});
}

Matrix6 lower_triangular(const Mat3& upper_left, const Mat3& lower_left, const Mat3& lower_right) {
  Matrix6 m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      m(i, j) = upper_left(i, j);
      m(i + 3, j) = lower_left(i, j);
      m(i + 3, j + 3) = lower_right(i, j);
    }
  }
  return m;
}

Mat3 columns(const Vec3& a, const Vec3& b, const Vec3& c) { return transpose(Mat3{{a, b, c}}); }

Mat3 negated(const Mat3& m) { return {{-m.row[0], -m.row[1], -m.row[2]}}; }

// omega_B = E (phid, thetad, psid), and C = d omega_B / d(phi, theta, psi).
struct EulerKinematics {
  Mat3 E;
  Mat3 inverse_E;
  Mat3 C;
};

EulerKinematics kinematics(const EulerRates& e) {
  const double s = std::sin(e.theta), c = std::cos(e.theta);
  const double sp = std::sin(e.psi), cp = std::cos(e.psi);
  const Vec3 m{sp, cp, 0.0}, n{cp, -sp, 0.0}, b3{0.0, 0.0, 1.0};
  const Vec3 d_theta = e.phi_dot * (c * m - s * b3);
  const Vec3 d_psi = (e.phi_dot * s) * n - e.theta_dot * m;
  return {columns(s * m + c * b3, n, b3),
          {{(1.0 / s) * m, n, b3 - (c / s) * m}},
          columns({}, d_theta, d_psi)};
}

}  // namespace

Matrix6 chart_jacobian(const Body& body, const EulerRates& s) {
  const EulerKinematics k = kinematics(s);
  return lower_triangular(k.E, inertia(body) * k.C, inertia(body) * k.E);
}

Matrix6 inverse_chart_jacobian(const Body& body, const EulerRates& s) {
  const EulerKinematics k = kinematics(s);
  return lower_triangular(k.inverse_E, negated(k.inverse_E * (k.C * k.inverse_E)),
                          k.inverse_E * inverse_inertia(body));
}

Matrix6 body_rate_jacobian(const Body& body) {
  return lower_triangular(Mat3::identity(), {}, inertia(body));
}

Matrix6 inverse_body_rate_jacobian(const Body& body) {
  return lower_triangular(Mat3::identity(), {}, inverse_inertia(body));
}

// d omega_B = A^T d omega_I + omega_B x dtheta_B
Matrix6 inertial_rate_jacobian(const Body& body, const RotorState& s) {
  return lower_triangular(Mat3::identity(), inertia(body) * hat(angular_velocity(body, s)),
                          inertia(body) * attitude_matrix(s.q));
}

Matrix6 inverse_inertial_rate_jacobian(const Body& body, const RotorState& s) {
  const Mat3 A = transpose(attitude_matrix(s.q));
  return lower_triangular(Mat3::identity(), negated(A * hat(angular_velocity(body, s))),
                          A * inverse_inertia(body));
}

}  // namespace v0
}  // namespace polhode
