// SPDX-License-Identifier: MIT
// Bodies and states at the edges of every chart: sizes from 1e-300 to 1e300, distances down to
// 1e-300 from each axis and from the separatrix, needles, plates, symmetric bodies, axes in any
// order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "oracle/random_draw.hpp"
#include "property/chart_support.hpp"
#include "worst.hpp"

namespace chart_test {

using oracle::Draw;

struct EdgeCase {
  Vec3 moments;
  RotorState state;
  double t;
};

inline std::string text_of(const EdgeCase& c) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(),
                "Body(%a, %a, %a) q (%a, %a, %a, %a) g (%a, %a, %a) t %a [%.2g %.2g %.2g; %.3g "
                "%.3g %.3g]",
                c.moments.x, c.moments.y, c.moments.z, c.state.q.w, c.state.q.x, c.state.q.y,
                c.state.q.z, c.state.g.x, c.state.g.y, c.state.g.z, c.t, c.moments.x, c.moments.y,
                c.moments.z, c.state.g.x, c.state.g.y, c.state.g.z);
  return text.data();
}

inline constexpr std::array<double, 10> distances{1e-3,  1e-8,   1e-10,  1e-16,  1e-20,
                                                  1e-60, 1e-100, 1e-160, 1e-200, 1e-300};
inline constexpr std::array<double, 9> sizes{1e-300, 1e-200, 1e-158, 1e-100, 1.0,
                                             1e100,  1e152,  1e200,  1e300};
template <std::size_t N>
double picked(Draw& draw, const std::array<double, N>& values) {
  return values[draw.index(N)];
}

// Rising, of order one at the top.
inline std::array<double, 3> drawn_moments(Draw& draw) {
  const double a = draw.uniform(0.55, 0.95), b = draw.uniform(0.96, 1.0);
  const double ratio =
      std::pow(10.0, -picked(draw, std::array<double, 7>{3, 10, 50, 152, 160, 250, 300}));
  switch (draw.index(12)) {
    case 0:
      return {a, a, 1.0};
    case 1:
      return {a, 1.0, 1.0};
    case 2:
      return {1.0, 1.0, 1.0};
    case 3:
      return {ratio, 1.0, 1.0};
    case 4:
      return {ratio, 1.0, std::nextafter(1.0, 2.0)};
    case 5:
      return {0.25, 0.75, 1.0};  // a plate
    case 6:
      return {a, std::nextafter(a, 1.0), 1.0};
    case 7:
      return {a, std::nextafter(1.0, 0.0), 1.0};
    case 8:
      return {3.0, 4.0, 6.0};
    default:
      return {a, b, 1.0};
  }
}

inline std::array<double, 3> unit_direction_near(Draw& draw, std::size_t axis, double distance) {
  const double angle = draw.uniform(-3.14, 3.14);
  std::array<double, 3> k{};
  k[axis] = draw.sign();
  const bool along_one = draw.index(3) == 0;
  k[(axis + 1) % 3] = distance * (along_one ? draw.sign() : std::cos(angle));
  k[(axis + 2) % 3] = along_one ? 0.0 : distance * std::sin(angle);
  return k;
}

inline EdgeCase drawn_edge_case(std::uint64_t index) {
  Draw draw(20261122, index);
  Sampler sample(20261122 + index);
  const std::array<double, 3> I = drawn_moments(draw);
  std::array<double, 3> k{};
  RotorState s = sample.generic();
  const std::size_t place = draw.index(8);
  const double distance = picked(draw, distances);
  if (place < 3) {
    k = unit_direction_near(draw, place, distance);
  } else if (place == 3) {  // next to the separatrix
    const double A = (I[2] - I[1]) / I[2], C = (I[1] - I[0]) / I[0];
    const double middle = draw.index(2) == 0 ? draw.uniform(-0.9, 0.9) : 1.0 - distance;
    const double across = 1.0 - middle * middle, D2 = draw.sign() * distance * across;
    k = {draw.sign() * std::sqrt(polhode::test::larger(0.0, (A * across - D2) / (A + C))), middle,
         draw.sign() * std::sqrt(polhode::test::larger(0.0, (C * across + D2) / (A + C)))};
    if (!(A + C > 0.0)) k = {0.6, 0.48, 0.64};
  } else if (place == 4) {  // exactly on an axis, or on the separatrix of (3, 4, 6)
    if (draw.index(2) == 0)
      k[draw.index(3)] = draw.sign();
    else
      k = {draw.sign(), draw.uniform(-1.0, 1.0) * 16.0, draw.sign()};
  } else {
    const Vec3 g = sample.generic().g;
    k = {g.x, g.y, g.z};
  }
  if (place == 5) {  // I next to 0 or pi, or at pi/2
    const RotorState tilted =
        inclined_state({sample.uniform(0.2, 1.5), sample.coin(), distance, sample.coin()},
                       sample.angle(), sample.angle(), sample.angle());
    s = tilted;
    k = {tilted.g.x, tilted.g.y, tilted.g.z};
  }
  const double moment_size = draw.index(2) == 0 ? 1.0 : picked(draw, sizes);
  double momentum_size = draw.index(2) == 0 ? 1.0 : picked(draw, sizes);
  if (draw.index(2) == 0) momentum_size = moment_size;
  std::array<int, 3> axis{0, 1, 2};
  if (place != 5 && draw.index(2) == 0) {
    std::swap(axis[0], axis[draw.index(3)]);
    std::swap(axis[1], axis[1 + draw.index(2)]);
  }
  EdgeCase c{{}, s, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    c.moments[axis[i]] = moment_size * I[i];
    c.state.g[axis[i]] = momentum_size * k[i];
  }
  // t0 holds the phase only to the rounding of t: times of some turns, or 0
  const Vec3& g = c.state.g;
  const double rate = norm(Vec3{g.x / c.moments.x, g.y / c.moments.y, g.z / c.moments.z});
  const double t = draw.uniform(-10.0, 10.0) / rate;
  if (draw.index(2) == 0 && std::isfinite(t)) c.t = t;
  return c;
}

}  // namespace chart_test
