// SPDX-License-Identifier: MIT
// The free flow over one short arc, for callers that take millions of them: no preparation, no
// allocation, no exception; momentum in two parts, of which |g| and the kinetic energy are kept
// beyond double precision.
#pragma once

#include <cmath>

#include "free/detail/euler_flow.hpp"
#include "polhode/free/detail/axis_order.hpp"
#include "polhode/free/detail/normalized_arc.hpp"
#include "polhode/free/detail/polhode_curve.hpp"
#include "polhode/free/detail/signed_order.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/rotor/body.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A momentum in body components as an unevaluated sum.
template <Number T>
struct BasicTwoPartMomentum {
  BasicVec3<T> hi;
  BasicVec3<T> lo;

  // Of packs, lane by lane.
  friend BasicTwoPartMomentum select(const Mask<T>& mask, const BasicTwoPartMomentum& a,
                                     const BasicTwoPartMomentum& b)
    requires(!Real<T>)
  {
    return {select(mask, a.hi, b.hi), select(mask, a.lo, b.lo)};
  }
};
using TwoPartMomentum = BasicTwoPartMomentum<double>;

template <Number T>
BasicTwoPartMomentum<T> operator+(const BasicTwoPartMomentum<T>& g, const BasicVec3<T>& change) {
  BasicTwoPartMomentum<T> r;
  for (int i = 0; i < 3; ++i) {
    const TwoTerms<T> s = two_sum(g.hi[i], change[i]);
    const TwoTerms<T> t = quick_two_sum(s.hi, T(s.lo + g.lo[i]));
    r.hi[i] = t.hi;
    r.lo[i] = t.lo;
  }
  return r;
}

// The square root of a complex number, up to a real factor of either sign: half of its argument.
template <Number T>
struct HalfTurn {
  T cos;
  T sin;
};
template <Number T>
HalfTurn<T> half_turn(const T& cos, const T& sin) {
  using std::sqrt;
  const T length = sqrt(cos * cos + sin * sin);
  const auto behind = cos < T(0.0);
  return {select(behind, sin, T(length + cos)),  // not length + cos there: cancels
          select(behind, T(length - cos), sin)};
}

// Body axes at the end of an arc -> body axes at its start, up to a sign. With p the pole, q =
// qz(-l0) qx(-J0) qz(precession) qx(J) qz(l) in axes whose third is p; the angles enter by their
// halves' cosines and sines, which no arc makes ambiguous.
template <Number T>
BasicQuaternion<T> relative_attitude(const BasicVec3<T>& g0, const EulerFlow<T>& flow) {
  using std::sqrt;
  const auto& first = flow.about_first;
  const auto third_is_pole = [&first](const BasicVec3<T>& g) {
    return BasicVec3<T>{select(first, g.y, g.x), select(first, g.z, g.y), select(first, g.x, g.z)};
  };
  const BasicVec3<T> a = third_is_pole(g0), b = third_is_pole(flow.g);
  const T C0 = sqrt(flow.G + a.z), S0 = sqrt(flow.G - a.z);
  const T C1 = sqrt(flow.G + b.z), S1 = sqrt(flow.G - b.z);
  const HalfTurn<T> node = half_turn(flow.node_cos, flow.node_sin);
  const SinCos<T> turn = sincos(T(T(0.5) * flow.turn));
  const T re = turn.cos * node.cos + turn.sin * node.sin;
  const T im = turn.sin * node.cos - turn.cos * node.sin;
  // Phasors of l are (g_y, g_x); that of l - l0 is their quotient.
  const HalfTurn<T> l = half_turn(T(b.y * a.y + b.x * a.x), T(b.x * a.y - b.y * a.x));
  const T rho = sqrt(a.x * a.x + a.y * a.y);
  const HalfTurn<T> sum{(l.cos * a.y - l.sin * a.x) / rho, (l.cos * a.x + l.sin * a.y) / rho};
  const T ar = re * (C0 * C1 + S0 * S1), ai = im * (C0 * C1 - S0 * S1);
  const T br = re * (C0 * S1 - S0 * C1), bi = im * (C0 * S1 + S0 * C1);
  const T w = ar * l.cos - ai * l.sin, z = ar * l.sin + ai * l.cos;
  const T x = br * sum.cos + bi * sum.sin, y = bi * sum.cos - br * sum.sin;
  const T f = T(1.0) / sqrt(w * w + x * x + y * y + z * z);
  const T fx = f * x, fy = f * y, fz = f * z;
  return {f * w, select(first, fz, fx), select(first, fx, fy), select(first, fy, fz)};
}

// One body, or a pack of bodies, each lane with its own order of axes.
template <Number T>
class BasicShortFlow {
 public:
  explicit BasicShortFlow(const Body& body) : BasicShortFlow(converted<T>(body.moments())) {}
  // Moments about the body axes, in any order.
  explicit BasicShortFlow(const BasicVec3<T>& moments)
      : BasicShortFlow(sorted_axes(moments), moments) {}

  struct Arc {
    BasicQuaternion<T> turn;    // body axes at the end -> body axes at the start
    BasicTwoPartMomentum<T> g;  // at the end
  };
  // After time + time_lo, of which the low part counts for the precession alone. A body at rest
  // stays; NaN in, NaN out, and NaN where squares of rates leave the range of a double.
  Arc after(const BasicTwoPartMomentum<T>& start, const T& time,
            const T& time_lo = T(0.0)) const noexcept {
    const BasicVec3<T> g0 = sorted(start.hi);
    EulerFlow<T> flow = flow_from(g0, time);
    const auto rests = flow.G == T(0.0);
    if (all(rests)) return {{}, start};
    const T inverse = select(flow.about_first, body_.inverse.z, body_.inverse.x);
    flow.turn = flow.turn + flow.G * (time_lo * inverse);
    const BasicVec3<T> rest = correction(g0, sorted(start.lo), flow.change);
    const Arc arc{turn(g0, flow), start + restored(flow.change) + restored(rest)};
    if (!any(rests)) return arc;
    return {select(rests, BasicQuaternion<T>{}, arc.turn), select(rests, start, arc.g)};
  }

  // The same in one number throughout.
  struct PlainArc {
    BasicQuaternion<T> turn;
    BasicVec3<T> g;
  };
  PlainArc plain(const BasicVec3<T>& start, const T& time) const noexcept {
    const BasicVec3<T> g0 = sorted(start);
    const EulerFlow<T> flow = flow_from(g0, time);
    const auto rests = flow.G == T(0.0);
    if (all(rests)) return {{}, start};
    const PlainArc arc{turn(g0, flow), restored(flow.g)};
    if (!any(rests)) return arc;
    return {select(rests, BasicQuaternion<T>{}, arc.turn), select(rests, start, arc.g)};
  }

  // d(dtheta_B, dg_B) at the end of an arc by a change dg of the momentum at its start; `turn` is
  // that of the arc.
  FlowTangent<T> tangent(const BasicVec3<T>& start, const BasicVec3<T>& dg, const T& time,
                         const BasicQuaternion<T>& turn) const noexcept
    requires Real<T>
  {
    using Dual1 = Dual<T, 1>;
    const BasicVec3<T> g = sorted(start), d = sorted(dg);
    if (g == BasicVec3<T>{}) {
      const BasicVec3<T> rate{time * body_.inverse.x * d.x, time * body_.inverse.y * d.y,
                              time * body_.inverse.z * d.z};
      return {dg, from_sorted_.applied(rate)};
    }
    const BasicVec3<Dual1> g0{{g.x, {d.x}}, {g.y, {d.y}}, {g.z, {d.z}}};
    const BasicVec3<T> axis = to_sorted_.applied(BasicVec3<T>{turn.x, turn.y, turn.z});
    const BasicQuaternion<T> back{turn.w, -axis.x, -axis.y, -axis.z};
    const Dual1 D2 = separatrix_discriminant(body_.I, Dual1(g0.x * g0.x), Dual1(g0.z * g0.z));
    const FlowTangent<T> t = flow_tangents(
        body_, g0, D2, time, [&](const BasicVec3<T>& v) { return rotate(back, v); })[0];
    return {restored(t.momentum), from_sorted_.applied(t.attitude)};
  }

  // A bound of the rate at which neighbouring motions part, the n of the elliptic functions.
  T polhode_rate(const BasicVec3<T>& g_B) const noexcept {
    using std::sqrt;
    const BasicVec3<T> g = sorted(g_B);
    const T g2 = g.y * g.y;
    const T mu = body_.mu_a3 * (g.z * g.z + body_.share3 * g2);
    const T nu = body_.nu_a1 * (g.x * g.x + body_.share1 * g2);
    return sqrt(select(mu < nu, nu, mu));
  }

 private:
  // Sorted axes <- body axes, and a power of two that makes rates of momenta.
  struct Sorting {
    SignedOrder<T> to_sorted, from_sorted;
    T scale = T(1.0);
  };
  static Sorting sorted_axes(const BasicVec3<T>& moments) {
    using L = LaneTraits<T>;
    Sorting s;
    for (std::size_t i = 0; i < L::count; ++i) {
      const Vec3 I{to_double(L::get(moments.x, i)), to_double(L::get(moments.y, i)),
                   to_double(L::get(moments.z, i))};
      const AxisOrder order = ascending_order(I);
      s.to_sorted.set_lane(i, order);
      s.from_sorted.set_lane(i, inverse(order));
      L::set(s.scale, i, ScalarOf<T>(std::ldexp(1.0, -exponent_of_largest(I))));
    }
    return s;
  }
  BasicShortFlow(const Sorting& s, const BasicVec3<T>& moments)
      : to_sorted_(s.to_sorted),
        from_sorted_(s.from_sorted),
        moment_scale_(s.scale),
        body_(s.scale * s.to_sorted.permuted(moments)) {}

  BasicVec3<T> sorted(const BasicVec3<T>& g) const { return moment_scale_ * to_sorted_.applied(g); }
  BasicVec3<T> restored(const BasicVec3<T>& g) const {
    return T(T(1.0) / moment_scale_) * from_sorted_.applied(g);
  }
  EulerFlow<T> flow_from(const BasicVec3<T>& g0, const T& time) const {
    const T D2 = separatrix_discriminant(body_.I, T(g0.x * g0.x), T(g0.z * g0.z));
    return euler_flow(body_, g0, D2, time);
  }
  BasicQuaternion<T> turn(const BasicVec3<T>& g0, const EulerFlow<T>& flow) const {
    const BasicQuaternion<T> q = relative_attitude(g0, flow);
    const BasicVec3<T> v = from_sorted_.applied(BasicVec3<T>{q.x, q.y, q.z});
    return {q.w, v.x, v.y, v.z};
  }

  // change_i (2 g_i + change_i): by how much the square of a component grows, in two parts.
  static TwoTerms<T> growth(const T& g, const T& lo, const T& change) {
    const TwoTerms<T> s = two_sum(T(T(2.0) * g), change);
    const TwoTerms<T> p = two_prod(change, s.hi);
    return {p.hi, p.lo + change * (s.lo + T(2.0) * lo)};
  }

  // The least change that restores a1 = g1^2 + share1 g2^2 and a3 = g3^2 + share3 g2^2 (hence |g|
  // and the energy), which the rounded change leaves some eps |change| |g| away.
  BasicVec3<T> correction(const BasicVec3<T>& g0, const BasicVec3<T>& lo,
                          const BasicVec3<T>& change) const {
    const BasicVec3<T> g = g0 + change;
    const TwoTerms<T> d2 = growth(g0.y, lo.y, change.y);
    const T r1 = -residual(growth(g0.x, lo.x, change.x), body_.share1, d2);
    const T r3 = -residual(growth(g0.z, lo.z, change.z), body_.share3, d2);
    // Gradients, halved: (g1, share1 g2, 0) and (0, share3 g2, g3).
    const T y1 = body_.share1 * g.y, y3 = body_.share3 * g.y;
    const T m11 = g.x * g.x + y1 * y1, m33 = g.z * g.z + y3 * y3;
    const T xz = g.x * g.z, xy = g.x * y3, zy = g.z * y1;
    const T det = xz * xz + xy * xy + zy * zy;        // m11 m33 - (y1 y3)^2, without cancelling
    const auto moves = det > T(1e-24) * (m11 * m33);  // steady: nothing moves
    const T half = T(0.5) / det, m13 = y1 * y3;
    const T p = half * (m33 * r1 - m13 * r3), q = half * (m11 * r3 - m13 * r1);
    return select(moves, BasicVec3<T>{p * g.x, p * y1 + q * y3, q * g.z}, BasicVec3<T>{});
  }
  static T residual(const TwoTerms<T>& square, const T& share, const TwoTerms<T>& d2) {
    const TwoTerms<T> p = two_prod(share, d2.hi);
    const TwoTerms<T> s = two_sum(square.hi, p.hi);
    return s.hi + (s.lo + (square.lo + p.lo + share * d2.lo));
  }

  SignedOrder<T> to_sorted_, from_sorted_;
  T moment_scale_;  // a power of two: momenta become rates
  FlowBody<T> body_;
};
using ShortFlow = BasicShortFlow<double>;

// The state after a time, in double-double: once in a while, in tens of microseconds.
inline BasicRotorState<DoubleDouble> carried(const Body& body,
                                             const BasicRotorState<DoubleDouble>& s,
                                             const DoubleDouble& time) {
  using DD = DoubleDouble;
  const AxisOrder order = ascending_order(body.moments());
  const int scale = exponent_of_largest(body.moments());
  const BasicVec3<DD> I = converted<DD>(scaled(body.moments(), scale));
  const FlowBody<DD> moments(BasicVec3<DD>{I[order.axis[0]], I[order.axis[1]], I[order.axis[2]]});
  const BasicVec3<DD> g0 = DD(std::ldexp(1.0, -scale)) * reordered(order, s.g);
  if (g0 == BasicVec3<DD>{}) return s;
  const DD D2 = separatrix_discriminant(moments.I, DD(g0.x * g0.x), DD(g0.z * g0.z));
  const EulerFlow<DD> flow = euler_flow(moments, g0, D2, time);
  const BasicQuaternion<DD> q = relative_attitude(g0, flow);
  const BasicVec3<DD> v = restored(order, BasicVec3<DD>{q.x, q.y, q.z});
  return {normalized(s.q * BasicQuaternion<DD>{q.w, v.x, v.y, v.z}),
          DD(std::ldexp(1.0, scale)) * restored(order, flow.g)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
