// SPDX-License-Identifier: MIT
// Derivatives of the free flow in the tangent of the hub: what a change of the momentum at the
// start of an arc makes of the momentum and of the attitude at its end.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "free/detail/euler_flow.hpp"
#include "polhode/free/detail/polhode_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Rotation, along g, of the frame (node of axis p, g) that follows a change dg: the connection.
template <Real T>
T turn_of_node(const BasicVec3<T>& g, const BasicVec3<T>& dg, bool about_first) {
  using std::sqrt;
  const T G2 = dot(g, g);
  const BasicVec3<T> c = cross(g, dg);
  const int pole = about_first ? 0 : 2;
  const T along = g[pole];
  const T across2 = G2 - along * along;  // >= G^2 / 2 by the choice of the pole
  return along * c[pole] / (sqrt(G2) * across2);
}

template <Number T>
struct FlowTangent {
  BasicVec3<T> momentum;  // dg_B at the end
  BasicVec3<T> attitude;  // dtheta_B at the end
};

// One for each variable of g0, which is in sorted axes and not zero; D2 is G^2 - 2 T I2 as a
// function of it. `to_end` takes components in body axes at the start to those at the end. The
// attitude moves across the momentum because the inertial momentum is conserved, and along it by
// the change of the precession.
template <Real T, int N, class S, class Rotation>
std::array<FlowTangent<T>, static_cast<std::size_t>(N)> flow_tangents(
    const FlowBody<S>& body, const BasicVec3<Dual<T, N>>& g0, const Dual<T, N>& D2, const S& time,
    const Rotation& to_end) {
  using std::sqrt;
  using D = Dual<T, N>;
  const EulerFlow<D> flow = euler_flow(body, g0, D2, time);
  const D turn = precession(flow);
  const auto value = [](const BasicVec3<D>& v) {
    return BasicVec3<T>{v.x.value, v.y.value, v.z.value};
  };
  const auto slope = [](const BasicVec3<D>& v, std::size_t j) {
    return BasicVec3<T>{v.x.derivative[j], v.y.derivative[j], v.z.derivative[j]};
  };
  const BasicVec3<T> g = value(flow.g), start = value(g0);
  const T G2 = dot(start, start);
  std::array<FlowTangent<T>, static_cast<std::size_t>(N)> tangents;
  constexpr bool wide = RealTraits<T>::epsilon() < 1e-20;  // a whole motion, not one short arc
  [[maybe_unused]] double terms = 0.0, sums = 0.0;         // of the attitude along g
  for (std::size_t j = 0; j < tangents.size(); ++j) {
    const BasicVec3<T> dg0 = slope(g0, j);
    BasicVec3<T> dg = slope(flow.g, j);
    // |g| is constant: g . dg = g0 . dg0. Next to the separatrix dg along g is otherwise what is
    // left of terms that are exp(nt) times larger.
    if constexpr (wide) dg = dg + ((dot(start, dg0) - dot(g, dg)) / G2) * g;
    const BasicVec3<T> across = (T(1.0) / G2) * cross(g, to_end(dg0) - dg);
    const T node0 = turn_of_node(start, dg0, flow.about_first),
            node = turn_of_node(g, dg, flow.about_first);
    const T along = turn.derivative[j] + node0 - node;
    tangents[j] = {dg, across + (along / sqrt(G2)) * g};
    if constexpr (wide) {
      const double sum = to_double(norm(tangents[j].attitude)), first = to_double(node0);
      terms = std::fmax(terms, std::abs(to_double(node)));
      sums = std::fmax(sums, std::fmax(std::abs(first), std::abs(sum)));
    }
  }
  // Where a flip takes back what grew like exp(nt), the terms may leave no digit: not a number
  // then.
  if constexpr (wide) {
    if (terms * epsilon<T>() > 1e-9 * sums)
      for (FlowTangent<T>& t : tangents) t.attitude = T(std::nan("")) * t.attitude;
  }
  return tangents;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
