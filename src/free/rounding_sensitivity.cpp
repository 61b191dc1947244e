// SPDX-License-Identifier: MIT
#include "polhode/free/rounding_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "math/larger.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
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

}  // namespace v0
}  // namespace polhode
