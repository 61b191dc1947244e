// SPDX-License-Identifier: MIT
// The free flow over one short arc, for callers that take millions of them: no preparation, no
// allocation, no exception; momentum in two parts, of which |g| and the kinetic energy are kept
// beyond double precision.
#pragma once

#include <algorithm>
#include <cmath>

#include "free/detail/axis_order.hpp"
#include "free/detail/flow_tangent.hpp"
#include "free/detail/polhode_curve.hpp"
#include "free/detail/primed_arc.hpp"
#include "polhode/math/error_free.hpp"
#include "polhode/rotor/body.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A momentum in body components as an unevaluated sum.
struct TwoPartMomentum {
  Vec3 hi;
  Vec3 lo;
};

inline TwoPartMomentum operator+(const TwoPartMomentum& g, const Vec3& change) {
  TwoPartMomentum r;
  for (int i = 0; i < 3; ++i) {
    const TwoTerms<double> s = two_sum(g.hi[i], change[i]);
    const TwoTerms<double> t = quick_two_sum(s.hi, s.lo + g.lo[i]);
    r.hi[i] = t.hi;
    r.lo[i] = t.lo;
  }
  return r;
}

// The square root of a complex number, up to a real factor of either sign: half of its argument.
template <Real T>
struct HalfTurn {
  T cos;
  T sin;
};
template <Real T>
HalfTurn<T> half_turn(const T& cos, const T& sin) {
  using std::sqrt;
  const T length = sqrt(cos * cos + sin * sin);
  if (!(cos < T(0.0))) return {length + cos, sin};
  return {sin, length - cos};  // not length + cos: cancels
}

// Body axes at the end of an arc -> body axes at its start, up to a sign. With p the pole, q =
// qz(-l0) qx(-J0) qz(precession) qx(J) qz(l) in axes whose third is p; the angles enter by their
// halves' cosines and sines, which no arc makes ambiguous.
template <Real T>
BasicQuaternion<T> relative_attitude(const BasicVec3<T>& g0, const EulerFlow<T>& flow) {
  using std::sqrt;
  const bool first = flow.pole == 0;
  const BasicVec3<T> a = first ? BasicVec3<T>{g0.y, g0.z, g0.x} : g0;
  const BasicVec3<T> b = first ? BasicVec3<T>{flow.g.y, flow.g.z, flow.g.x} : flow.g;
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
  return first ? BasicQuaternion<T>{f * w, f * z, f * x, f * y}
               : BasicQuaternion<T>{f * w, f * x, f * y, f * z};
}

class ShortFlow {
 public:
  explicit ShortFlow(const Body& body)
      : order_(ascending_order(body.moments())),
        moment_scale_(std::ldexp(1.0, -exponent_of_largest(body.moments()))),
        body_(moment_scale_ * reordered_moments(body)) {}

  struct Arc {
    Quaternion turn;    // body axes at the end -> body axes at the start
    TwoPartMomentum g;  // at the end
  };
  // After time + time_lo, of which the low part counts for the precession alone. A body at rest
  // stays; NaN in, NaN out.
  Arc after(const TwoPartMomentum& start, double time, double time_lo = 0.0) const noexcept {
    const Vec3 g0 = sorted(start.hi);
    EulerFlow<double> flow = flow_from(g0, time);
    if (flow.G == 0.0) return {{}, start};
    flow.turn += flow.G * (time_lo * body_.inverse[2 - flow.pole]);
    const Vec3 rest = correction(g0, sorted(start.lo), flow.change);
    return {turn(g0, flow), start + restored(flow.change) + restored(rest)};
  }

  // The same in double precision throughout.
  struct PlainArc {
    Quaternion turn;
    Vec3 g;
  };
  PlainArc plain(const Vec3& start, double time) const noexcept {
    const Vec3 g0 = sorted(start);
    const EulerFlow<double> flow = flow_from(g0, time);
    if (flow.G == 0.0) return {{}, start};
    return {turn(g0, flow), restored(flow.g)};
  }

  // d(dtheta_B, dg_B) at the end of an arc by a change dg of the momentum at its start; `turn` is
  // that of the arc.
  FlowTangent<double> tangent(const Vec3& start, const Vec3& dg, double time,
                              const Quaternion& turn) const noexcept {
    using Dual1 = Dual<double, 1>;
    const Vec3 g = sorted(start), d = sorted(dg);
    if (g == Vec3{}) {
      const Vec3 rate{time * body_.inverse.x * d.x, time * body_.inverse.y * d.y,
                      time * body_.inverse.z * d.z};
      return {dg, detail::restored(order_, rate)};
    }
    const BasicVec3<Dual1> g0{{g.x, {d.x}}, {g.y, {d.y}}, {g.z, {d.z}}};
    const Vec3 axis = reordered(order_, Vec3{turn.x, turn.y, turn.z});
    const Quaternion back{turn.w, -axis.x, -axis.y, -axis.z};
    const Dual1 D2 = separatrix_discriminant(body_.I, Dual1(g0.x * g0.x), Dual1(g0.z * g0.z));
    const FlowTangent<double> t =
        flow_tangents(body_, g0, D2, time, [&](const Vec3& v) { return rotate(back, v); })[0];
    return {restored(t.momentum), detail::restored(order_, t.attitude)};
  }

  // A bound of the rate at which neighbouring motions part, the n of the elliptic functions.
  double polhode_rate(const Vec3& g_B) const noexcept {
    const Vec3 g = sorted(g_B);
    const double g2 = g.y * g.y;
    return std::sqrt(std::max(body_.mu_a3 * (g.z * g.z + body_.share3 * g2),
                              body_.nu_a1 * (g.x * g.x + body_.share1 * g2)));
  }

 private:
  Vec3 sorted(const Vec3& g) const { return moment_scale_ * reordered(order_, g); }
  Vec3 restored(const Vec3& g) const { return (1.0 / moment_scale_) * detail::restored(order_, g); }
  EulerFlow<double> flow_from(const Vec3& g0, double time) const {
    const double D2 = separatrix_discriminant(body_.I, g0.x * g0.x, g0.z * g0.z);
    return euler_flow(body_, g0, D2, time);
  }
  Quaternion turn(const Vec3& g0, const EulerFlow<double>& flow) const {
    const Quaternion q = relative_attitude(g0, flow);
    const Vec3 v = detail::restored(order_, Vec3{q.x, q.y, q.z});
    return {q.w, v.x, v.y, v.z};
  }
  Vec3 reordered_moments(const Body& body) const {
    const Vec3 I = body.moments();
    return {I[order_.axis[0]], I[order_.axis[1]], I[order_.axis[2]]};
  }

  // change_i (2 g_i + change_i): by how much the square of a component grows, in two parts.
  static DoubleDouble growth(double g, double lo, double change) {
    const TwoTerms<double> s = two_sum(2.0 * g, change);
    const TwoTerms<double> p = two_prod(change, s.hi);
    return {p.hi, p.lo + change * (s.lo + 2.0 * lo)};
  }

  // The least change that restores a1 = g1^2 + share1 g2^2 and a3 = g3^2 + share3 g2^2 (hence |g|
  // and the energy), which the rounded change leaves some eps |change| |g| away.
  Vec3 correction(const Vec3& g0, const Vec3& lo, const Vec3& change) const {
    const Vec3 g = g0 + change;
    const DoubleDouble d2 = growth(g0.y, lo.y, change.y);
    const double r1 = -residual(growth(g0.x, lo.x, change.x), body_.share1, d2);
    const double r3 = -residual(growth(g0.z, lo.z, change.z), body_.share3, d2);
    // Gradients, halved: (g1, share1 g2, 0) and (0, share3 g2, g3).
    const double y1 = body_.share1 * g.y, y3 = body_.share3 * g.y;
    const double m11 = g.x * g.x + y1 * y1, m33 = g.z * g.z + y3 * y3;
    const double xz = g.x * g.z, xy = g.x * y3, zy = g.z * y1;
    const double det = xz * xz + xy * xy + zy * zy;  // m11 m33 - (y1 y3)^2, without cancelling
    if (!(det > 1e-24 * (m11 * m33))) return {};     // steady: nothing moves
    const double half = 0.5 / det, m13 = y1 * y3;
    const double p = half * (m33 * r1 - m13 * r3), q = half * (m11 * r3 - m13 * r1);
    return {p * g.x, p * y1 + q * y3, q * g.z};
  }
  static double residual(const DoubleDouble& square, double share, const DoubleDouble& d2) {
    const TwoTerms<double> p = two_prod(share, d2.hi);
    const TwoTerms<double> s = two_sum(square.hi, p.hi);
    return s.hi + (s.lo + (square.lo + p.lo + share * d2.lo));
  }

  AxisOrder order_;
  double moment_scale_;  // a power of two: momenta become rates
  FlowBody<double> body_;
};

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
