// SPDX-License-Identifier: MIT
// The momenta of size 1 and energy 2T = e that an attitude can have when their part along the third
// axis of the frame is known: roots of a trigonometric polynomial of degree 2.
//
// With the node vector n of the Euler angles, the momentum is H s3 - sqrt(1 - H^2) (sin a n +
// cos a (s3 x n)), and a = phi - h is the unknown.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "polhode/math/double_double.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The circle of momenta of size 1, in body axes: g = centre + cosine cos a + sine sin a.
struct MomentumCircle {
  BasicVec3<DoubleDouble> centre, cosine, sine;

  MomentumCircle(const BasicEulerAngles<DoubleDouble>& q, const DoubleDouble& H) {
    const auto [st, ct] = sincos(q.theta);
    const auto [sp, cp] = sincos(q.psi);
    const DoubleDouble across = sqrt(DoubleDouble(1.0) - H * H);
    centre = {H * st * sp, H * st * cp, H * ct};
    cosine = {-(across * ct * sp), -(across * ct * cp), across * st};
    sine = {-(across * cp), across * sp, DoubleDouble(0.0)};
  }
  BasicVec3<DoubleDouble> at(const DoubleDouble& a) const {
    const auto [s, c] = sincos(a);
    return centre + c * cosine + s * sine;
  }
};

// 2T - e along a circle of momenta, and the slope of it.
struct EnergyAlongCircle {
  MomentumCircle circle;
  BasicVec3<DoubleDouble> moments;  // in body axes
  DoubleDouble e;
  // mean - e + c1 cos a + s1 sin a + c2 cos 2a + s2 sin 2a, in double; the mean is not kept
  double c1 = 0.0, s1 = 0.0, c2 = 0.0, s2 = 0.0;

  EnergyAlongCircle(const MomentumCircle& on, const BasicVec3<DoubleDouble>& I,
                    const DoubleDouble& energy)
      : circle(on), moments(I), e(energy) {
    for (int i = 0; i < 3; ++i) {
      const double A = on.centre[i].hi, B = on.cosine[i].hi, C = on.sine[i].hi, m = I[i].hi;
      c1 += 2.0 * A * B / m;
      s1 += 2.0 * A * C / m;
      c2 += 0.5 * (B - C) * (B + C) / m;
      s2 += B * C / m;
    }
  }
  DoubleDouble value(const DoubleDouble& a) const {
    const BasicVec3<DoubleDouble> g = circle.at(a);
    return g.x * g.x / moments.x + g.y * g.y / moments.y + g.z * g.z / moments.z - e;
  }
  double slope(double a) const {
    return -c1 * std::sin(a) + s1 * std::cos(a) - 2.0 * c2 * std::sin(2.0 * a) +
           2.0 * s2 * std::cos(2.0 * a);
  }
  double curvature(double a) const {
    return -c1 * std::cos(a) - s1 * std::sin(a) - 4.0 * c2 * std::cos(2.0 * a) -
           4.0 * s2 * std::sin(2.0 * a);
  }
  double third_bound() const { return std::hypot(c1, s1) + 8.0 * std::hypot(c2, s2); }
};

// Finds the zeros of the slope within w of m. The interval is halved until a bound shows that it
// has none, or one.
inline void add_turning_points(const EnergyAlongCircle& f, double m, double w,
                               std::vector<double>& found) {
  const double third = f.third_bound(), d1 = std::abs(f.slope(m)), d2 = std::abs(f.curvature(m));
  if (d1 > d2 * w + 0.5 * third * w * w) return;
  if ((d1 + d2 * w + third * w * w) * w < 1e-20 * f.e.hi) return;  // flat to rounding
  if (!(d2 > third * w)) {
    add_turning_points(f, m - 0.5 * w, 0.5 * w, found);
    add_turning_points(f, m + 0.5 * w, 0.5 * w, found);
    return;
  }
  double low = m - w, high = m + w;
  const bool rising = f.slope(low) < 0.0;
  if (rising == (f.slope(high) < 0.0)) return;
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (low + high);
    ((f.slope(mid) < 0.0) == rising ? low : high) = mid;
  }
  found.push_back(0.5 * (low + high));
}

// The root between two turning points where the value changes sign: Newton's steps kept inside.
inline DoubleDouble attitude_root_between(const EnergyAlongCircle& f, DoubleDouble low,
                                          DoubleDouble high, bool rising) {
  DoubleDouble a = DoubleDouble(0.5) * (low + high);
  for (int i = 0; i < 200; ++i) {
    const DoubleDouble value = f.value(a);
    if (value == DoubleDouble(0.0)) break;
    ((value < DoubleDouble(0.0)) == rising ? low : high) = a;
    const double slope = f.slope(a.hi);
    DoubleDouble next = a - value / DoubleDouble(slope);
    if (!(next > low && next < high)) next = DoubleDouble(0.5) * (low + high);
    const double step = std::abs((next - a).hi);
    a = next;
    if (step < 1e-30 || !(high > low)) break;
  }
  return a;
}

struct AttitudeRoots {
  std::vector<DoubleDouble> angles;  // phi - h, rising from -pi
  double least, greatest;            // 2T over the circle
};

// Where two roots meet, or rounding has moved them past each other, at least one of them is found.
inline AttitudeRoots attitude_roots(const EnergyAlongCircle& f) {
  std::vector<double> turning;
  for (int i = 0; i < 8; ++i)
    add_turning_points(f, pi<double>() * (0.25 * i - 0.875), 0.125 * pi<double>(), turning);
  std::sort(turning.begin(), turning.end());
  AttitudeRoots roots{{}, (f.value(0.0) + f.e).hi, (f.value(0.0) + f.e).hi};
  const std::size_t n = turning.size();
  std::vector<DoubleDouble> value;
  for (const double a : turning) {
    value.push_back(f.value(a));
    const double energy = (value.back() + f.e).hi;
    roots.least = std::min(roots.least, energy);
    roots.greatest = std::max(roots.greatest, energy);
  }
  const double smallest = std::min({f.moments.x.hi, f.moments.y.hi, f.moments.z.hi});
  const double rounding = 0x1p-48 * (f.e.hi + std::sqrt(f.e.hi / smallest));
  const auto negative = [&](std::size_t i) { return value[i % n] < DoubleDouble(0.0); };
  for (std::size_t i = 0; i < n; ++i) {
    const bool touches = std::abs(value[i].hi) <= rounding && negative(i) == negative(i + 1) &&
                         negative(i) == negative(i + n - 1);
    if (touches) roots.angles.push_back(turning[i]);
    if (negative(i) == negative(i + 1)) continue;
    const DoubleDouble end = i + 1 < n ? DoubleDouble(turning[i + 1])
                                       : DoubleDouble(turning[0]) + DoubleDouble::two_pi();
    roots.angles.push_back(attitude_root_between(f, turning[i], end, negative(i)));
  }
  return roots;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
