// SPDX-License-Identifier: MIT
// One free arc in primed axes: sorted, scaled by powers of two, classified, with the phase at the
// epoch.
#pragma once

#include <algorithm>
#include <cmath>

#include "free/detail/axis_order.hpp"
#include "free/detail/polhode_curve.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/rotor/body.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Moments and momentum as m 2^e with the largest |m| in [1, 2): squares then neither overflow nor
// underflow to a wrong regime. Scaling by powers of two is exact.
struct Scale {
  int moment = 0;
  int momentum = 0;
  // A rate in the user's units from one in scaled units.
  int rate() const { return momentum - moment; }
};

inline int exponent_of_largest(const Vec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0.0 ? std::ilogb(largest) : 0;
}

inline Vec3 scaled(const Vec3& v, int exponent) {
  return {std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)};
}

template <Real T>
BasicVec3<T> converted(const Vec3& v) {
  return {T(v.x), T(v.y), T(v.z)};
}

inline Discriminants<DoubleDouble> rounded(const Discriminants<DoubleDouble>& d, DoubleDouble) {
  return d;
}
template <Real T>
Discriminants<T> rounded(const Discriminants<DoubleDouble>& d, T) {
  return {T(d.D1.hi), T(d.D2.hi), T(d.D3.hi)};
}

template <Real T>
struct PrimedArc {
  Scale scale;
  BasicVec3<T> sorted_moments;  // scaled
  BasicVec3<T> g;               // scaled, body axes of the user
  AxisOrder sorted;             // sorted axes <- body axes
  AxisOrder primed;             // primed axes <- body axes
  double s1 = 1.0, s3 = 1.0;    // signs of the momentum along unsigned primed axes 1 and 3
  PolhodeCurve<T> curve;        // scaled
  DoubleDouble D2;              // scaled, never rounded to double first
  T u0 = T(0.0);                // argument of the elliptic functions at the epoch, |u0| <= K
};

// Signs that make g1' >= 0 and g3' >= 0, by a rotation: diag(s1, s1 s3, s3).
inline AxisOrder primed_axes(bool long_axis, double s1, double s3) {
  AxisOrder p;
  if (long_axis) p = {{2, 1, 0}, {1.0, -1.0, 1.0}};
  return composed(p, AxisOrder{{0, 1, 2}, {s1, s1 * s3, s3}});
}

template <Real T>
PrimedArc<T> primed_arc(const Body& body, const Vec3& g_B) {
  PrimedArc<T> arc;
  arc.scale = {exponent_of_largest(body.moments()), exponent_of_largest(g_B)};
  arc.sorted = ascending_order(body.moments());
  const Vec3 moments =
      scaled({body.moments()[arc.sorted.axis[0]], body.moments()[arc.sorted.axis[1]],
              body.moments()[arc.sorted.axis[2]]},
             arc.scale.moment);
  const Vec3 g = scaled(g_B, arc.scale.momentum);
  const Vec3 g_sorted = reordered(arc.sorted, g);
  arc.sorted_moments = converted<T>(moments);
  arc.g = converted<T>(g);
  const Discriminants<DoubleDouble> d = discriminants(moments, g_sorted);
  arc.D2 = d.D2;
  const bool on_middle_axis = g_sorted.x == 0.0 && g_sorted.z == 0.0;
  arc.curve = polhode_curve(arc.sorted_moments, norm(arc.g), rounded(d, T(0.0)), on_middle_axis);

  const bool long_axis = arc.curve.long_axis;
  const Vec3 unsigned_g = reordered(primed_axes(long_axis, 1.0, 1.0), g_sorted);
  arc.s1 = unsigned_g.x < 0.0 ? -1.0 : 1.0;
  arc.s3 = unsigned_g.z < 0.0 ? -1.0 : 1.0;
  arc.primed = composed(arc.sorted, primed_axes(long_axis, arc.s1, arc.s3));
  if (arc.curve.steady || !(arc.curve.DC > T(0.0))) return arc;

  // u0 = F(am), tan am = (g2'/a2) / (g1'/a1), |am| <= pi/2.
  const BasicVec3<T> m = reordered(arc.primed, arc.g);
  const T c = m.x / arc.curve.a1, s = m.y / arc.curve.a2;
  const T r2 = c * c + s * s;  // 1 but for rounding
  const T c2 = c * c / r2, s2 = s * s / r2;
  using std::sqrt;
  arc.u0 = s / sqrt(r2) * carlson_rf(c2, c2 + arc.curve.kp2 * s2, T(1.0));
  return arc;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
