// SPDX-License-Identifier: MIT
#include "fit/detail/light_begun_anew.hpp"

#include <cmath>

#include "fit/detail/rotation_vector.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// How far the momentum is turned, rad.
constexpr double side_turn = 0.5;

Vec3 unit(const Vec3& v) { return (1.0 / norm(v)) * v; }

BrightEllipsoid turned(const BrightEllipsoid& body, const Vec3& by) {
  BrightEllipsoid found = body;
  found.spin.q = turn_by(by) * normalized(body.spin.q);
  return found;
}

// A quarter of a turn about the long axis of the motion, the shape staying along the axes.
BrightEllipsoid quarter_turned(const BrightEllipsoid& body) {
  BrightEllipsoid found = body;
  found.spin.q = normalized(body.spin.q) * turn_by({0.5 * pi<double>(), 0.0, 0.0});
  return found;
}

}  // namespace

std::vector<BrightEllipsoid> begun_anew(const BrightEllipsoid& body, const LightGeometry& g) {
  std::vector<BrightEllipsoid> found;
  for (const LightImage i : {LightImage::normal, LightImage::bisector, LightImage::difference})
    found.push_back(image_of(body, i, g.to_sun, g.to_observer));
  found.push_back(quarter_turned(body));
  const Vec3 L = unit(rotate(body.spin.q, body.spin.inertia_F * body.spin.w_F));
  found.push_back(turned(body, pi<double>() * L));
  const Vec3 to_sun = unit(g.to_sun);
  const Vec3 across = cross(L, to_sun);
  if (!(norm(across) > 0.0)) return found;
  const Vec3 first = unit(across), second = cross(L, first);
  found.push_back(turned(body, pi<double>() * first));
  for (const Vec3& axis : {first, second})
    for (const double angle : {side_turn, -side_turn}) found.push_back(turned(body, angle * axis));
  return found;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
