// SPDX-License-Identifier: MIT
// What the numbers of a chart hold when they are doubles: how far the state moves when each of them
// moves by half an ulp, to first order, in a thousand digits and without the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include "oracle/flow_charts.hpp"

namespace oracle {

using SixNumbers = std::array<Long, 6>;
using SixSquare = std::array<SixNumbers, 6>;

// Elements -t0 apart by `halves` half periods from those of FlowCharts: (g0, h, t - t0, G, H, T).
inline SixNumbers serret_numbers(const FlowCharts& c, int halves) {
  const Long more = halves == 0 || c.u == 0 ? Long(0) : Long(2 * halves * c.K / c.u);
  return {c.g0 - more * (c.phi_g - c.g0), c.h, c.elapsed * (1 + more), c.G, c.H, c.T};
}
inline SixNumbers sadov_numbers(const FlowCharts& c, int) {
  return {c.phi_l, c.phi_g, c.h, c.action * c.G, c.G, c.H};
}

namespace detail {

// Gauss-Jordan with pivots; false where singular to all digits.
inline bool inverted(SixSquare a, SixSquare& r) {
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) r[i][j] = i == j ? 1 : 0;
  for (std::size_t k = 0; k < 6; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < 6; ++i)
      if (abs(a[i][k]) > abs(a[best][k])) best = i;
    if (a[best][k] == 0) return false;
    std::swap(a[k], a[best]);
    std::swap(r[k], r[best]);
    const Long pivot = a[k][k];
    for (std::size_t j = 0; j < 6; ++j) {
      a[k][j] /= pivot;
      r[k][j] /= pivot;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      const Long factor = a[i][k];
      if (i == k || factor == 0) continue;
      for (std::size_t j = 0; j < 6; ++j) {
        a[i][j] -= factor * a[k][j];
        r[i][j] -= factor * r[k][j];
      }
    }
  }
  return true;
}

}  // namespace detail

// The sum over the six numbers, the first three of them angles or times, of the turn or the change
// of g / G that half an ulp of it makes. Infinite where the numbers do not tell the state.
inline double moved_by_half_ulps(const polhode::Vec3& moments, const polhode::RotorState& s,
                                 const std::function<SixNumbers(const FlowCharts&, int)>& numbers,
                                 int halves, const std::array<double, 6>& held) {
  const Long step = pow(Long(10), -400);
  const LongQuaternion q = lengthened(s.q);
  const LongVec3 g = lengthened(s.g);
  const FlowCharts here = flow_charts(moments, q, g);
  const SixNumbers base = numbers(here, halves);
  SixSquare slope, inverse;
  for (int j = 0; j < 6; ++j) {
    LongQuaternion q1 = q;
    LongVec3 g1 = g;
    if (j < 3) {
      LongQuaternion turn{Long(1), Long(0), Long(0), Long(0)};
      (j == 0 ? turn.x : j == 1 ? turn.y : turn.z) = step / 2;
      q1 = q * turn;
    } else {
      g1[j - 3] += here.G * step;
    }
    const SixNumbers moved = numbers(flow_charts(moments, q1, g1), halves);
    for (std::size_t i = 0; i < 6; ++i) {
      Long change = moved[i] - base[i];
      if (i < 2 && abs(change) > 1) change -= 2 * long_pi() * round(change / (2 * long_pi()));
      slope[i][static_cast<std::size_t>(j)] = change / step;
    }
  }
  if (!detail::inverted(slope, inverse)) return std::numeric_limits<double>::infinity();
  Long sum = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const Long half_ulp =
        Long(std::abs(held[k])) * Long(std::numeric_limits<double>::epsilon()) / 2;
    Long turn = 0, change = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      turn += inverse[i][k] * inverse[i][k];
      change += inverse[i + 3][k] * inverse[i + 3][k];
    }
    sum += half_ulp * sqrt(turn > change ? turn : change);
  }
  return static_cast<double>(sum);
}

}  // namespace oracle
