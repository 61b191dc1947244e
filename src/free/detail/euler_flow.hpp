// SPDX-License-Identifier: MIT
// Euler's flow g0 -> g(t) and its precession angle as smooth functions of g0, in every number type:
// dual numbers get derivatives.
//
// The addition theorems of sn, cn, dn and Pi turn the solution into rational functions of g0 and of
// S = sn(nt)/n, C = cn(nt), D = dn(nt), which depend on g0 only through mu = n^2 and nu = k^2 n^2.
// Nothing here is singular: not at principal-axis spin (no phase u0 appears), not on the separatrix
// (no K), not for axisymmetric bodies or the sphere. docs/design/0003-transition-matrix.md
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "free/detail/flow_functions.hpp"
#include "polhode/free/detail/polhode_curve.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Quotients of the moments, which must be in ascending order.
template <Number S>
struct FlowBody {
  explicit FlowBody(const BasicVec3<S>& moments) {
    const S I1 = moments.x, I2 = moments.y, I3 = moments.z, one(1.0), zero(0.0);
    const S I21 = I2 - I1, I31 = I3 - I1, I32 = I3 - I2, product = I1 * I2 * I3;
    const S beta = select(I31 > zero, S(I21 / I31), zero);  // any value serves the sphere
    I = moments;
    inverse = {one / I1, one / I2, one / I3};
    share1 = I1 / I2 * (one - beta);
    share3 = I3 / I2 * beta;
    mu_a3 = I32 * I31 / (I3 * product);
    nu_a1 = I21 * I31 / (I1 * product);
    delta_D2 = I31 / product;
    k23 = I32 / (I2 * I3);  // not 1/I2 - 1/I3: cancels
    k13 = I31 / (I1 * I3);
    k12 = I21 / (I1 * I2);
  }
  BasicVec3<S> I, inverse;
  S share1, share3;  // a1 = g1^2 + share1 g2^2, a3 = g3^2 + share3 g2^2 are constant
  S mu_a3, nu_a1;    // mu / a3, nu / a1
  S delta_D2;        // delta / (G^2 - 2 T I2)
  S k23, k13, k12;   // 1/I2 - 1/I3 and so on, >= 0
};

// Where the momentum goes, and by which angle the node of body axis `pole` precesses about it:
// turn less the argument of (node_cos, node_sin).
template <Number T>
struct EulerFlow {
  BasicVec3<T> g;
  BasicVec3<T> change;  // g(t) - g0, with its own digits
  T G;
  T turn, node_cos, node_sin;
  // The pole is the axis of least moment, or else of greatest: whichever stays away from g.
  Mask<T> about_first;
};

// The precession at the rate of the pole's partner, G t / I.
template <Number T, class S>
T steady_turn(const T& G, const S& time, const S& moment, const S& inverse) {
  if constexpr (RealTraits<S>::epsilon() > 1e-20 && derivative_order<S> == 0) {
    // Rounded once per arc the quotient t / I would leave a phase that grows with every arc.
    const TwoTerms<S> p = two_prod(time, inverse), unit = two_prod(moment, inverse);
    return G * p.hi + G * (p.lo - p.hi * ((unit.hi - S(1.0)) + unit.lo));
  } else {
    return G * T(time) * inverse;
  }
}

// g(t) and its change.
template <Number T>
struct MomentumFlow {
  BasicVec3<T> g;
  BasicVec3<T> change;

  // Of packs, lane by lane.
  friend MomentumFlow select(const Mask<T>& mask, const MomentumFlow& a, const MomentumFlow& b)
    requires(!Real<T>)
  {
    return {select(mask, a.g, b.g), select(mask, a.change, b.change)};
  }
};

template <Number T, class S>
MomentumFlow<T> momentum_flow(const FlowBody<S>& body, const BasicVec3<T>& g0,
                              const FlowParameters<T>& p, const FlowFunctions<T>& v) {
  const S one(1.0);
  const T g1 = g0.x, g2 = g0.y, g3 = g0.z, g22 = g2 * g2, g33 = g3 * g3;
  const T SS = v.S * v.S;
  // sn^2 and the like of the sum u0 + nt: 1 - k^2 sn^2 sn^2 = C^2 + mu (g3/a3)^2 S^2.
  const T n3 = body.mu_a3 * (g33 * SS);
  const T denominator = v.C * v.C + n3;
  const T inverse = one / denominator;
  const T g2S = g2 * v.S;
  // A long arc next to the separatrix: the sum below would leave C D of 1 - 1.
  const auto far = [&] {
    MomentumFlow<T> r;
    r.g.x = (g1 * v.C - body.k23 * (g3 * g2S * v.D)) * inverse;
    r.g.y = (g2 * (v.C * v.D) + body.k13 * (g1 * g3 * v.S)) * inverse;
    r.g.z = (g3 * v.D - body.k12 * (g1 * g2S * v.C)) * inverse;
    r.change = r.g - g0;
    return r;
  };
  const auto sum = [&] {
    // 1 - C, 1 - D and D - C; not by subtraction on short arcs: cancels
    using Decision = DecisionOf<T>;
    const auto near = decision_of(v.C) > Decision(0.0) && decision_of(v.D) > Decision(0.0);
    using Differences = BasicVec3<T>;
    const Differences d = where(
        near,
        [&] {
          return Differences{p.mu * SS / (one + v.C), p.nu * SS / (one + v.D),
                             p.delta * SS / (v.C + v.D)};
        },
        [&] {
          return Differences{one - v.C, one - v.D, v.D - v.C};
        });
    MomentumFlow<T> r;
    r.change.x = (g1 * (v.C * d.x - n3) - body.k23 * (g3 * g2S * v.D)) * inverse;
    r.change.y = (g2 * (v.C * d.z - n3) + body.k13 * (g1 * g3 * v.S)) * inverse;
    r.change.z =
        (g3 * (body.mu_a3 * ((body.share3 * g22) * SS) - d.y) - body.k12 * (g1 * g2S * v.C)) *
        inverse;
    r.g = g0 + r.change;
    return r;
  };
  return where(decision_of(denominator) < DecisionOf<T>(0x1p-20), far, sum);
}

// t may be any time, D2 is G^2 - 2 T I2 as a function of g0.
template <Number T, class S>
EulerFlow<T> euler_flow(const FlowBody<S>& body, const BasicVec3<T>& g0, const T& D2,
                        const S& time) {
  using std::sqrt;
  const T a1 = g0.x * g0.x + body.share1 * (g0.y * g0.y);  // squared amplitudes at g2 = 0
  const T a3 = g0.z * g0.z + body.share3 * (g0.y * g0.y);

  EulerFlow<T> r;
  r.G = sqrt(a1 + a3);
  r.about_first = decision_of(a1) <= decision_of(a3);
  const auto& first = r.about_first;
  FlowParameters<T> p;
  p.mu = body.mu_a3 * a3;
  p.nu = body.nu_a1 * a1;
  p.delta = body.delta_D2 * D2;
  p.epsilon = select(first, T(body.mu_a3 * a1), T(body.nu_a1 * a3));
  p.weight = select(first, S(-body.k13), body.k13) * r.G;

  const FlowFunctions<T> v = flow_over(p, time);
  const MomentumFlow<T> m = momentum_flow(body, g0, p, v);
  r.g = m.g;
  r.change = m.change;

  const T across = select(first, r.g.z, r.g.x);
  const T slope = select(first, S(-body.k23), body.k12) * (g0.y * v.S);
  // The pole's node turns with the other extreme moment.
  const S partner = select(first, body.I.z, body.I.x);
  const S inverse = select(first, body.inverse.z, body.inverse.x);
  r.turn = steady_turn(r.G, time, partner, inverse) - v.whole - v.angle;
  const T sway = slope * (r.g.x * r.g.z);
  r.node_cos = across * across + r.g.y * r.g.y + select(first, sway, T(-sway));
  r.node_sin = r.G * (slope * r.g.y);
  return r;
}

template <Number T>
T precession(const EulerFlow<T>& flow) {
  using std::atan2;
  return flow.turn - atan2(flow.node_sin, flow.node_cos);
}

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

// The changes of the momentum and of the attitude at the end of an arc by one of the momentum at
// its start.
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
