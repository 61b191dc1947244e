// SPDX-License-Identifier: MIT
// The free flow over one short arc, for callers that take millions of them: no preparation, no
// allocation, no exception; momentum in two parts, of which |g| and the kinetic energy are kept
// beyond double precision.
#pragma once

#include <cmath>

#include "free/detail/axis_order.hpp"
#include "free/detail/euler_flow.hpp"
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
struct HalfTurn {
  double cos;
  double sin;
};
inline HalfTurn half_turn(double cos, double sin) {
  const double length = std::sqrt(cos * cos + sin * sin);
  if (cos >= 0.0) return {length + cos, sin};
  return {sin, length - cos};  // not length + cos: cancels
}

class ShortFlow {
 public:
  explicit ShortFlow(const Body& body)
      : order_(ascending_order(body.moments())),
        moment_scale_(std::ldexp(1.0, -exponent_of_largest(body.moments()))),
        body_(moment_scale_ * reordered_moments(body)) {}

  struct Arc {
    Quaternion turn;    // body axes at the end -> body axes at the start; not normalised
    TwoPartMomentum g;  // at the end
  };
  // After time + time_lo, of which the low part counts for the precession alone. A body at rest
  // stays; NaN in, NaN out.
  Arc after(const TwoPartMomentum& start, double time, double time_lo = 0.0) const noexcept {
    const Vec3 g0 = moment_scale_ * reordered(order_, start.hi);
    const double D2 = separatrix_discriminant(body_.I, g0.x * g0.x, g0.z * g0.z);
    EulerFlow<double> flow = euler_flow(body_, g0, D2, time);
    if (flow.G == 0.0) return {{}, start};
    flow.turn += flow.G * (time_lo * body_.inverse[2 - flow.pole]);
    const Quaternion q = relative_attitude(g0, flow);
    const Vec3 v = restored(order_, Vec3{q.x, q.y, q.z});
    const Vec3 lo = moment_scale_ * reordered(order_, start.lo);
    const Vec3 rest = correction(g0, lo, flow.change);
    const double unscaled = 1.0 / moment_scale_;
    return {{q.w, v.x, v.y, v.z},
            start + restored(order_, unscaled * flow.change) + restored(order_, unscaled * rest)};
  }

 private:
  Vec3 reordered_moments(const Body& body) const {
    const Vec3 I = body.moments();
    return {I[order_.axis[0]], I[order_.axis[1]], I[order_.axis[2]]};
  }

  // With p the pole, q = qz(-l0) qx(-J0) qz(precession) qx(J) qz(l) in axes whose third is p; the
  // angles enter by their halves' cosines and sines, which no arc makes ambiguous.
  static Quaternion relative_attitude(const Vec3& g0, const EulerFlow<double>& flow) {
    const bool first = flow.pole == 0;
    const Vec3 a = first ? Vec3{g0.y, g0.z, g0.x} : g0;
    const Vec3 b = first ? Vec3{flow.g.y, flow.g.z, flow.g.x} : flow.g;
    const double C0 = std::sqrt(flow.G + a.z), S0 = std::sqrt(flow.G - a.z);
    const double C1 = std::sqrt(flow.G + b.z), S1 = std::sqrt(flow.G - b.z);
    const HalfTurn node = half_turn(flow.node_cos, flow.node_sin);
    const SinCos<double> turn = sincos(0.5 * flow.turn);
    const double re = turn.cos * node.cos + turn.sin * node.sin;
    const double im = turn.sin * node.cos - turn.cos * node.sin;
    // Phasors of l are (g_y, g_x); that of l - l0 is their quotient.
    const HalfTurn l = half_turn(b.y * a.y + b.x * a.x, b.x * a.y - b.y * a.x);
    const double rho = std::sqrt(a.x * a.x + a.y * a.y);
    const HalfTurn sum{(l.cos * a.y - l.sin * a.x) / rho, (l.cos * a.x + l.sin * a.y) / rho};
    const double ar = re * (C0 * C1 + S0 * S1), ai = im * (C0 * C1 - S0 * S1);
    const double br = re * (C0 * S1 - S0 * C1), bi = im * (C0 * S1 + S0 * C1);
    const double w = ar * l.cos - ai * l.sin, z = ar * l.sin + ai * l.cos;
    const double x = br * sum.cos + bi * sum.sin, y = bi * sum.cos - br * sum.sin;
    const double f = 1.0 / std::sqrt(w * w + x * x + y * y + z * z);
    return first ? Quaternion{f * w, f * z, f * x, f * y} : Quaternion{f * w, f * x, f * y, f * z};
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
