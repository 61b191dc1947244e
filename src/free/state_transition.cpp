// SPDX-License-Identifier: MIT
// The state transition matrix of the free flow, in the tangent of the hub.
//
// dg(t) follows from g0 alone. The attitude moves with dtheta0, and with dg0 in two ways: across
// the momentum because the inertial momentum is conserved, and along it by the change of the
// precession.
#include <cmath>
#include <limits>

#include "free/detail/euler_flow.hpp"
#include "free/detail/primed_arc.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using DD = DoubleDouble;
using Dual3 = Dual<DD, 3>;
using DDVec3 = BasicVec3<DD>;

struct Columns {
  DDVec3 momentum[3];  // dg(t) / dg0_j
  DDVec3 attitude[3];  // dtheta_B(t) / dg0_j
};

DDVec3 values(const BasicVec3<Dual3>& v) { return {v.x.value, v.y.value, v.z.value}; }
DDVec3 derivatives(const BasicVec3<Dual3>& v, std::size_t j) {
  return {v.x.derivative[j], v.y.derivative[j], v.z.derivative[j]};
}

// Rotation, along g, of the frame (node of axis p, g) that follows a change dg: the connection.
DD turn_of_node(const DDVec3& g, const DDVec3& dg, int pole) {
  const DD G2 = dot(g, g);
  const DDVec3 c = cross(g, dg);
  const DD along = g[pole];
  const DD across2 = G2 - along * along;  // >= G^2 / 2 by the choice of the pole
  return along * c[pole] / (sqrt(G2) * across2);
}

// The three columns for dg0, in sorted axes; A maps body components at t to those at t0.
Columns momentum_columns(const DDVec3& moments, const Vec3& g_sorted, const DD& time,
                         const BasicMat3<DD>& A) {
  BasicVec3<Dual3> g0;
  for (int i = 0; i < 3; ++i) g0[i] = Dual3::variable(DD(g_sorted[i]), i);
  const Dual3 D2 = detail::separatrix_discriminant(moments, Dual3(g0.x * g0.x), Dual3(g0.z * g0.z));
  const detail::EulerFlow<Dual3> flow =
      detail::euler_flow(detail::FlowBody<DD>(moments), g0, D2, time);
  const Dual3 precession = detail::precession(flow);
  const DDVec3 g = values(flow.g), start = values(g0);
  const DD G2 = dot(start, start);
  const BasicMat3<DD> At = transpose(A);
  Columns columns;
  for (std::size_t j = 0; j < 3; ++j) {
    const DDVec3 dg0 = derivatives(g0, j);
    const DDVec3 dg = derivatives(flow.g, j);
    const DDVec3 across = (DD(1.0) / G2) * cross(g, At * dg0 - dg);
    const DD along = precession.derivative[j] + turn_of_node(start, dg0, flow.pole) -
                     turn_of_node(g, dg, flow.pole);
    columns.momentum[j] = dg;
    columns.attitude[j] = across + (along / sqrt(G2)) * g;
  }
  return columns;
}

// At rest the momentum stays and the attitude answers by dtheta = I^-1 dg t.
Columns resting_columns(const DDVec3& moments, const DD& time) {
  Columns columns;
  for (int j = 0; j < 3; ++j) {
    columns.momentum[j][j] = DD(1.0);
    columns.attitude[j][j] = time / moments[j];
  }
  return columns;
}

}  // namespace

Matrix6 FreeRotation::state_transition(double t) const {
  if (!std::isfinite(t)) {
    Matrix6 none;
    for (auto& row : none.a) row.fill(std::numeric_limits<double>::quiet_NaN());
    return none;
  }
  const detail::AxisOrder order = detail::ascending_order(body_.moments());
  const detail::Scale scale{detail::exponent_of_largest(body_.moments()),
                            detail::exponent_of_largest(s0_.g)};
  const Vec3 I = body_.moments();
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
      resting ? resting_columns(moments, time) : momentum_columns(moments, g, time, A);

  Matrix6 stm;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) stm(i, j) = A_body(j, i);
  for (int j = 0; j < 3; ++j) {
    const auto column = static_cast<std::size_t>(j);
    const DD sign = order.sign[column];
    const DDVec3 dtheta = detail::restored(order, sign * c.attitude[column]);
    const DDVec3 dg = detail::restored(order, sign * c.momentum[column]);
    for (int i = 0; i < 3; ++i) {
      stm(i, 3 + order.axis[column]) = std::ldexp(dtheta[i].hi, -scale.momentum);
      stm(3 + i, 3 + order.axis[column]) = dg[i].hi;
    }
  }
  return stm;
}

}  // namespace v0
}  // namespace polhode
