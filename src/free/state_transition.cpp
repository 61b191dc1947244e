// SPDX-License-Identifier: MIT
// Derivatives of the free flow by its initial state: the state transition matrix, in the tangent of
// the quaternion-momentum state, and the sensitivity to rounding.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "free/detail/euler_flow.hpp"
#include "math/finite.hpp"
#include "polhode/error.hpp"
#include "polhode/free/detail/normalized_arc.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/rounding_sensitivity.hpp"
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

namespace free {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

// |v| without overflow. Written out, since the last digit of std::hypot of three numbers is that of
// the standard library, and WebAssembly has another than this machine.
double length(const Vec3& v) {
  const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  const double a = std::max({x, y, z});
  if (!(a > 0.0)) return x + y + z;
  return a * std::sqrt((x / a) * (x / a) + (y / a) * (y / a) + (z / a) * (z / a));
}

// Of the rotation from a to b, right for small ones too.
double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = conj(a) * b;
  return 2.0 * std::atan2(length({d.x, d.y, d.z}), std::abs(d.w));
}

// A component that is zero stays zero: it was not rounded.
Vec3 nudged(const Vec3& v, int component, double towards) {
  Vec3 r = v;
  if (r[component] != 0.0) r[component] = std::nextafter(r[component], towards);
  return r;
}

std::optional<FreeRotation> rotation(const Vec3& moments, const RotorState& s, double t0) {
  try {
    return FreeRotation(Body(moments.x, moments.y, moments.z), s, t0);
  } catch (const DomainError&) {
    return std::nullopt;  // I3 > I1 + I2, or beyond double range
  }
}

}  // namespace

double rounding_sensitivity(const FreeRotation& motion, double t) {
  if (!std::isfinite(t)) return std::numeric_limits<double>::quiet_NaN();
  const Vec3 moments = motion.body().moments();
  const RotorState s = motion.initial_state();
  const Quaternion q = motion.at(t).q;
  // Beyond 1/eps rad a rounding of the rate is whole turns.
  const Vec3 w = angular_velocity(motion.body(), s);
  const double turned = length(w) * std::abs(t - motion.epoch());
  if (!(turned < 1.0 / std::numeric_limits<double>::epsilon())) return std::numbers::pi;
  double largest = 0.0;
  for (int component = 0; component < 3; ++component) {
    for (const double towards : {-unbounded, unbounded}) {
      const Vec3 g = nudged(s.g, component, towards);
      for (const auto& other : {rotation(nudged(moments, component, towards), s, motion.epoch()),
                                rotation(moments, {s.q, g}, motion.epoch())}) {
        if (other) largest = detail::larger(largest, angle_between(q, other->at(t).q));
      }
    }
  }
  return largest;
}

}  // namespace free
}  // namespace v0
}  // namespace polhode
