// SPDX-License-Identifier: MIT
// One free arc in primed axes: sorted, scaled by powers of two, classified, with the phase at the
// epoch.
#pragma once

#include <algorithm>
#include <cmath>

#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/free/detail/axis_order.hpp"
#include "polhode/free/detail/polhode_curve.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
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

template <Real T>
BasicVec3<T> scaled(const BasicVec3<T>& v, int exponent) {
  using std::ldexp;
  return {ldexp(v.x, -exponent), ldexp(v.y, -exponent), ldexp(v.z, -exponent)};
}

inline Vec3 scaled(const Vec3& v, int exponent) { return scaled<double>(v, exponent); }

template <Number T>
BasicVec3<T> converted(const Vec3& v) {
  return {T(v.x), T(v.y), T(v.z)};
}
template <Number T>
BasicQuaternion<T> converted(const Quaternion& q) {
  return {T(q.w), T(q.x), T(q.y), T(q.z)};
}

template <Real T>
Vec3 values_of(const BasicVec3<T>& v) {
  return {to_double(v.x), to_double(v.y), to_double(v.z)};
}
template <Real T>
Quaternion values_of(const BasicQuaternion<T>& q) {
  return {to_double(q.w), to_double(q.x), to_double(q.y), to_double(q.z)};
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
struct NormalizedArc {
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

// What a decision looks at, to its own digits.
inline const DoubleDouble& value_of(const DoubleDouble& x) { return x; }
template <Real T, int N>
const T& value_of(const Dual<T, N>& x) {
  return x.value;
}
// x 2^-exponent, of which the value is known better.
inline DoubleDouble scaled_with_value(const DoubleDouble& /*x*/, int /*exponent*/,
                                      const DoubleDouble& value) {
  return value;
}
template <Real T, int N>
Dual<T, N> scaled_with_value(const Dual<T, N>& x, int exponent, const T& value) {
  return {value, ldexp(x, -exponent).derivative};
}

// The discriminants with a D2 that is exact, its exponent apart; that D2.
template <Real T>
struct ExactDiscriminants {
  Discriminants<T> d;
  FloatingDoubleDouble D2;
};

// Moments and momentum in sorted axes: as given, and scaled.
template <Real T>
ExactDiscriminants<T> exact_discriminants(const Vec3& given_moments, const Vec3& given_g,
                                          const BasicVec3<T>& moments, const BasicVec3<T>& g,
                                          const Scale& scale) {
  ExactDiscriminants<T> r{discriminants(moments, g), {}};
  if (plain_separatrix_distance(values_of(moments), values_of(g))) {
    r.D2 = floating(value_of(r.d.D2));
  } else {
    r.D2 = separatrix_distance(given_moments, given_g, scale);
  }
  r.d.D2 = scaled_with_value(r.d.D2, r.D2.exponent, r.D2.mantissa);
  r.d.D2_exponent = r.D2.exponent;
  return r;
}
// In double: rounded from double-double.
inline ExactDiscriminants<double> exact_discriminants(const Vec3& given_moments,
                                                      const Vec3& given_g, const Vec3& moments,
                                                      const Vec3& g, const Scale& scale) {
  const auto wide = exact_discriminants(given_moments, given_g, converted<DoubleDouble>(moments),
                                        converted<DoubleDouble>(g), scale);
  return {{wide.d.D1.hi, wide.d.D2.hi, wide.d.D3.hi, wide.d.D2_exponent}, wide.D2};
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

// u0 = F(am), tan am = s/c, |am| <= pi/2, of a point next to the ellipse c^2 + s^2 = 1.
template <Real T>
T argument_at(const PolhodeCurve<T>& curve, const T& c, const T& s) {
  using std::sqrt;
  const T r2 = c * c + s * s;  // 1 but for rounding
  if constexpr (derivative_order<T> > 0) {
    // along the ellipse, not through c^2: at c = 0 its root has no derivative
    const T r = sqrt(r2);
    return elliptic::legendre_f(T(s / r), T(c / r),
                                elliptic::BasicModulus<T>::from_ratio(curve.k2, curve.kp2));
  } else {
    const T c2 = c * c / r2, s2 = s * s / r2;
    return s / sqrt(r2) * elliptic::carlson_rf(c2, c2 + curve.kp2 * s2, T(1.0));
  }
}

// The values of moments and momentum are doubles; derivatives ride along.
template <Real T>
NormalizedArc<T> normalized_arc(const BasicVec3<T>& moments_B, const BasicVec3<T>& g_B) {
  NormalizedArc<T> arc;
  const Vec3 I = values_of(moments_B), g_value = values_of(g_B);
  arc.scale = {exponent_of_largest(I), exponent_of_largest(g_value)};
  arc.sorted = ascending_order(I);
  const Vec3 given_moments = permuted(arc.sorted, I), given_g = reordered(arc.sorted, g_value);
  arc.sorted_moments = scaled(permuted(arc.sorted, moments_B), arc.scale.moment);
  arc.g = scaled(g_B, arc.scale.momentum);
  const ExactDiscriminants<T> exact = exact_discriminants(
      given_moments, given_g, arc.sorted_moments, reordered(arc.sorted, arc.g), arc.scale);
  arc.D2 = exact.D2;
  const bool on_middle_axis = given_g.x == 0.0 && given_g.z == 0.0;
  arc.curve = polhode_curve(arc.sorted_moments, norm(arc.g), exact.d, on_middle_axis);

  const bool long_axis = arc.curve.long_axis;
  const Vec3 unsigned_g = reordered(primed_axes(long_axis, 1.0, 1.0), given_g);
  arc.s1 = unsigned_g.x < 0.0 ? -1.0 : 1.0;
  arc.s3 = unsigned_g.z < 0.0 ? -1.0 : 1.0;
  arc.primed = composed(arc.sorted, primed_axes(long_axis, arc.s1, arc.s3));
  if (arc.curve.steady || !(arc.curve.DC > T(0.0))) return arc;

  const BasicVec3<T> m = reordered(arc.primed, arc.g);
  const T c = m.x / arc.curve.a1, s = m.y / arc.curve.a2;
  if (arc.curve.merging && !(c > T(0x1p-100))) {
    const T u = merging_argument(arc.curve, unsigned_g.x, arc.scale.momentum);
    arc.u0 = s < T(0.0) ? T(-u) : u;
    return arc;
  }
  arc.u0 = argument_at(arc.curve, c, s);
  return arc;
}
template <Real T>
NormalizedArc<T> normalized_arc(const Body& body, const Vec3& g_B) {
  return normalized_arc(converted<T>(body.moments()), converted<T>(g_B));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
