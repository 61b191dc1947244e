// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>

#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Half a turn about a direction; none where it is 0.
Quaternion half_turn(const Vec3& axis) {
  const double size = norm(axis);
  if (!(size > 0.0)) return {};
  const Vec3 n = (1.0 / size) * axis;
  return {0.0, n.x, n.y, n.z};
}

}  // namespace

BrightEllipsoid image_of(const BrightEllipsoid& body, LightImage image, const Vec3& to_sun,
                         const Vec3& to_observer) {
  const Vec3 s = (1.0 / norm(to_sun)) * to_sun, o = (1.0 / norm(to_observer)) * to_observer;
  BrightEllipsoid found = body;
  const auto turn = [&](const Vec3& axis) {
    found.spin.q = half_turn(axis) * normalized(body.spin.q);
  };
  if (image == LightImage::normal) turn(cross(s, o));
  if (image == LightImage::bisector) turn(s + o);
  if (image == LightImage::difference) turn(s - o);
  return found;
}

BrightEllipsoid nearest_of_same(const BrightEllipsoid& about, const BrightEllipsoid& body) {
  constexpr std::array<Quaternion, 4> turns{Quaternion{1.0, 0.0, 0.0, 0.0},
                                            {0.0, 1.0, 0.0, 0.0},
                                            {0.0, 0.0, 1.0, 0.0},
                                            {0.0, 0.0, 0.0, 1.0}};
  BrightEllipsoid nearest = body;
  double least = std::numeric_limits<double>::infinity();
  const double rate = norm(about.spin.w_F);
  for (const Quaternion& r : turns) {
    const Quaternion q = normalized(body.spin.q) * r;
    const Vec3 w = rotate(conj(r), body.spin.w_F);
    const double off = norm(attitude_residual(about.spin.q, q)) + norm(w - about.spin.w_F) / rate;
    if (!(off < least)) continue;
    least = off;
    nearest.spin.q = q;
    nearest.spin.w_F = w;
  }
  return nearest;
}

}  // namespace v0
}  // namespace polhode
