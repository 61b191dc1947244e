// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "polhode/fit/light_search.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace {

// Half a turn about a direction; none where it is 0.
Quaternion half_turn(const Vec3& axis) {
  const double size = norm(axis);
  if (!(size > 0.0)) return {};
  const Vec3 n = (1.0 / size) * axis;
  return {0.0, n.x, n.y, n.z};
}

// Whether moments are those of an even filling, so that both say which axis is the longest.
bool is_filled(const LightModel& body) {
  constexpr double same = 1e-9;
  const light::Ellipsoid& s = body.ellipsoid();
  const Mat3 even = LightModel::homogeneous(0.0, {}, {}, s).spin.inertia_F;
  const Mat3& T = body.spin.inertia_F;
  return s.a >= s.b && s.b >= s.c && std::abs(T(0, 0) / T(2, 2) - even(0, 0)) < same &&
         std::abs(T(1, 1) / T(2, 2) - even(1, 1)) < same;
}

// Rotations that take axes to axes, in which row i has axis order[i]: 4 where none is exchanged.
void add_turns(const std::array<int, 3>& order, std::vector<Mat3>& found) {
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0}) {
      Mat3 R;
      R(0, order[0]) = x;
      R(1, order[1]) = y;
      R.row[2] = cross(R.row[0], R.row[1]);
      found.push_back(R);
    }
}

std::vector<Mat3> half_turns() {
  std::vector<Mat3> found;
  add_turns({0, 1, 2}, found);
  return found;
}

std::vector<Mat3> turns_of_axes() {
  std::vector<Mat3> found;
  std::array<int, 3> order{0, 1, 2};
  do add_turns(order, found);
  while (std::ranges::next_permutation(order).found);
  return found;
}

Vec3 permuted(const Mat3& R, const Vec3& v) {
  const Vec3 w = R * v;
  return {std::abs(w.x), std::abs(w.y), std::abs(w.z)};
}

// The same body in axes of which row i of R is number i, with a = 1 and Izz as the unit.
LightModel in_axes(const Mat3& R, const LightModel& body) {
  LightModel found = body;
  found.spin.q = normalized(body.spin.q) * attitude(R);
  found.spin.w_F = R * body.spin.w_F;
  const Mat3& T = body.spin.inertia_F;
  const Vec3 I = permuted(R, {T(0, 0), T(1, 1), T(2, 2)});
  for (int i = 0; i < 3; ++i) found.spin.inertia_F(i, i) = I[i] / I.z;
  const light::Ellipsoid& e = body.ellipsoid();
  const Vec3 s = permuted(R, {e.a, e.b, e.c});
  found.shape = light::Ellipsoid{1.0, s.y / s.x, s.z / s.x};
  return found;
}

double shape_distance(const light::Ellipsoid& a, const light::Ellipsoid& b) {
  return std::abs(std::log(a.b / b.b)) + std::abs(std::log(a.c / b.c));
}

}  // namespace

LightModel image_of(const LightModel& body, LightImage image, const Vec3& to_sun,
                    const Vec3& to_observer) {
  const Vec3 s = (1.0 / norm(to_sun)) * to_sun, o = (1.0 / norm(to_observer)) * to_observer;
  LightModel found = body;
  const auto turn = [&](const Vec3& axis) {
    found.spin.q = half_turn(axis) * normalized(body.spin.q);
  };
  if (image == LightImage::normal) turn(cross(s, o));
  if (image == LightImage::bisector) turn(s + o);
  if (image == LightImage::difference) turn(s - o);
  return found;
}

LightModel nearest_of_same(const LightModel& about, const LightModel& body) {
  const bool in_order = is_filled(about) && is_filled(body);
  const double rate = norm(about.spin.w_F);
  LightModel nearest = body;
  double least = std::numeric_limits<double>::infinity();
  for (const Mat3& R : in_order ? half_turns() : turns_of_axes()) {
    const LightModel same = in_axes(R, body);
    const double off = norm(attitude_residual(about.spin.q, same.spin.q)) +
                       norm(same.spin.w_F - about.spin.w_F) / rate +
                       (in_order ? 0.0 : shape_distance(about.ellipsoid(), same.ellipsoid()));
    if (!(off < least)) continue;
    least = off;
    nearest = same;
  }
  return nearest;
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
