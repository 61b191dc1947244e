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
  return {T(d.D1.hi), T(d.D2.hi), T(d.D3.hi), d.D2_exponent};
}

// D2 where it must be exact: from the moments and momentum as given, since scaling to a common
// power of two may round what is tiny.
inline FloatingDoubleDouble separatrix_distance(const Vec3& moments, const Vec3& g,
                                                const Scale& scale) {
  FloatingDoubleDouble d = exact_separatrix_distance(moments, g.x, g.z);
  d.exponent -= d.mantissa.hi == 0.0 ? 0 : 2 * scale.momentum;
  return d;
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
  FloatingDoubleDouble D2;      // scaled, never rounded to double first
  T u0 = T(0.0);                // argument of the elliptic functions at the epoch, |u0| <= K
};

// Signs that make g1' >= 0 and g3' >= 0, by a rotation: diag(s1, s1 s3, s3).
inline AxisOrder primed_axes(bool long_axis, double s1, double s3) {
  AxisOrder p;
  if (long_axis) p = {{2, 1, 0}, {1.0, -1.0, 1.0}};
  return composed(p, AxisOrder{{0, 1, 2}, {s1, s1 * s3, s3}});
}

// F(am, k) for k = 1 and tan am = s/c beyond 2^100: ln(4/(|c| + sqrt(c^2 + k'^2)))  [DLMF 19.27.2],
// c = g1/a1, with the exponents of c and of k'^2 apart.
template <Real T>
T merging_argument(const PolhodeCurve<T>& curve, double g1, int g_exponent) {
  using std::abs;
  using std::log;
  using std::sqrt;
  int e = 0;
  const T c = abs(T(std::frexp(g1, &e))) / curve.a1;
  e -= g_exponent;
  const int half = curve.kp2_exponent / 2;
  const int common = g1 == 0.0 || (!curve.separatrix && half > e) ? half : e;
  // without a g1 the exponent means nothing, and 2^(e - common) may overflow
  const T x = g1 == 0.0 ? T(0.0) : T(c * T(std::ldexp(1.0, e - common)));
  const T y2 = x * x + curve.kp2_mantissa * T(std::ldexp(1.0, curve.kp2_exponent - 2 * common));
  return log(T(2.0)) * T(2.0 - common) - log(T(x + sqrt(y2)));
}

template <Real T>
PrimedArc<T> primed_arc(const Body& body, const Vec3& g_B) {
  PrimedArc<T> arc;
  arc.scale = {exponent_of_largest(body.moments()), exponent_of_largest(g_B)};
  arc.sorted = ascending_order(body.moments());
  const Vec3 given_moments{body.moments()[arc.sorted.axis[0]], body.moments()[arc.sorted.axis[1]],
                           body.moments()[arc.sorted.axis[2]]};
  const Vec3 given_g = reordered(arc.sorted, g_B);
  const Vec3 moments = scaled(given_moments, arc.scale.moment);
  const Vec3 g = scaled(g_B, arc.scale.momentum);
  const Vec3 g_sorted = reordered(arc.sorted, g);
  arc.sorted_moments = converted<T>(moments);
  arc.g = converted<T>(g);
  Discriminants<DoubleDouble> d = discriminants(moments, g_sorted);
  arc.D2 = plain_separatrix_distance(moments, g_sorted)
               ? floating(d.D2)
               : separatrix_distance(given_moments, given_g, arc.scale);
  d.D2 = arc.D2.mantissa;
  d.D2_exponent = arc.D2.exponent;
  const bool on_middle_axis = given_g.x == 0.0 && given_g.z == 0.0;
  arc.curve = polhode_curve(arc.sorted_moments, norm(arc.g), rounded(d, T(0.0)), on_middle_axis);

  const bool long_axis = arc.curve.long_axis;
  const Vec3 unsigned_g = reordered(primed_axes(long_axis, 1.0, 1.0), given_g);
  arc.s1 = unsigned_g.x < 0.0 ? -1.0 : 1.0;
  arc.s3 = unsigned_g.z < 0.0 ? -1.0 : 1.0;
  arc.primed = composed(arc.sorted, primed_axes(long_axis, arc.s1, arc.s3));
  if (arc.curve.steady || !(arc.curve.DC > T(0.0))) return arc;

  // u0 = F(am), tan am = (g2'/a2) / (g1'/a1), |am| <= pi/2.
  const BasicVec3<T> m = reordered(arc.primed, arc.g);
  const T c = m.x / arc.curve.a1, s = m.y / arc.curve.a2;
  if (arc.curve.merging && !(c > T(0x1p-100))) {
    const T u = merging_argument(arc.curve, unsigned_g.x, arc.scale.momentum);
    arc.u0 = s < T(0.0) ? T(-u) : u;
    return arc;
  }
  const T r2 = c * c + s * s;  // 1 but for rounding
  const T c2 = c * c / r2, s2 = s * s / r2;
  using std::sqrt;
  arc.u0 = s / sqrt(r2) * carlson_rf(c2, c2 + arc.curve.kp2 * s2, T(1.0));
  return arc;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
