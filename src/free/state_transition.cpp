// SPDX-License-Identifier: MIT
// The state transition matrix of the free flow, in the tangent of the hub.
#include <array>
#include <cmath>
#include <limits>

#include "free/detail/flow_tangent.hpp"
#include "polhode/free/detail/primed_arc.hpp"
#include "polhode/free/free_rotation.hpp"
#include "rotor/squared_moments.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using DD = DoubleDouble;
using Dual3 = Dual<DD, 3>;
using DDVec3 = BasicVec3<DD>;
using Columns = std::array<detail::FlowTangent<DD>, 3>;

// The three columns for dg0, in sorted axes; A maps body components at t to those at t0.
Columns momentum_columns(const Vec3& sorted_moments, const Vec3& g_sorted, const DD& time,
                         const BasicMat3<DD>& A) {
  const DDVec3 moments = detail::converted<DD>(sorted_moments);
  BasicVec3<Dual3> g0;
  for (int i = 0; i < 3; ++i) g0[i] = Dual3::variable(DD(g_sorted[i]), i);
  const BasicMat3<DD> At = transpose(A);
  Dual3 D2 = detail::separatrix_discriminant(moments, Dual3(g0.x * g0.x), Dual3(g0.z * g0.z));
  const auto exact = detail::exact_separatrix_distance(sorted_moments, g_sorted.x, g_sorted.z);
  D2.value = ldexp(exact.mantissa, exact.exponent);
  return detail::flow_tangents(detail::FlowBody<DD>(moments), g0, D2, time,
                               [&](const DDVec3& v) { return At * v; });
}

// At rest the momentum stays and the attitude answers by dtheta = I^-1 dg t.
Columns resting_columns(const DDVec3& moments, const DD& time) {
  Columns columns;
  for (int j = 0; j < 3; ++j) {
    const auto column = static_cast<std::size_t>(j);
    columns[column].momentum[j] = DD(1.0);
    columns[column].attitude[j] = time / moments[j];
  }
  return columns;
}

}  // namespace

Matrix6 FreeRotation::state_transition(double t) const {
  const Vec3 I = body_.moments();
  if (!std::isfinite(t) || !detail::squared_moments_are_doubles(body_)) {
    Matrix6 none;
    for (auto& row : none.a) row.fill(std::numeric_limits<double>::quiet_NaN());
    return none;
  }
  const detail::AxisOrder order = detail::ascending_order(body_.moments());
  const detail::Scale scale{detail::exponent_of_largest(body_.moments()),
                            detail::exponent_of_largest(s0_.g)};
  const Vec3 sorted_moments =
      detail::scaled({I[order.axis[0]], I[order.axis[1]], I[order.axis[2]]}, scale.moment);
  const DDVec3 moments = detail::converted<DD>(sorted_moments);
  const Vec3 g = detail::reordered(order, detail::scaled(s0_.g, scale.momentum));
  const DD time = ldexp(DD::sum(t, -epoch()), scale.rate());

  const Quaternion q = conj(at(epoch()).q) * at(t).q;
  const Mat3 A_body = rotation_matrix(q);
  BasicMat3<DD> A;  // sorted axes
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      A(i, j) =
          order.sign[static_cast<std::size_t>(i)] * order.sign[static_cast<std::size_t>(j)] *
          A_body(order.axis[static_cast<std::size_t>(i)], order.axis[static_cast<std::size_t>(j)]);
  const bool resting = g == Vec3{};
  const Columns c =
      resting ? resting_columns(moments, time) : momentum_columns(sorted_moments, g, time, A);

  Matrix6 stm;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) stm(i, j) = A_body(j, i);
  for (int j = 0; j < 3; ++j) {
    const auto column = static_cast<std::size_t>(j);
    const DD sign = order.sign[column];
    const DDVec3 dtheta = detail::restored(order, sign * c[column].attitude);
    const DDVec3 dg = detail::restored(order, sign * c[column].momentum);
    for (int i = 0; i < 3; ++i) {
      stm(i, 3 + order.axis[column]) = std::ldexp(dtheta[i].hi, -scale.momentum);
      stm(3 + i, 3 + order.axis[column]) = dg[i].hi;
    }
  }
  return stm;
}

}  // namespace v0
}  // namespace polhode
