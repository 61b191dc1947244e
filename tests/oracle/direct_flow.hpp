// SPDX-License-Identifier: MIT
// The plainest integration of free rotation, to check the oracle itself: Taylor series of
// dg/dt = g x omega and dq/dt = (1/2) q (0, omega), step by step, nothing else.
//
// Domain      moderate arcs: rounding grows next to the middle axis as the physics does.
#pragma once

#include <array>

#include "oracle/euler_taylor.hpp"
#include "worst.hpp"

namespace oracle {

using polhode::test::smaller;

class DirectFlow {
 public:
  explicit DirectFlow(const polhode::Vec3& moments, const TaylorSettings& settings = {})
      : moments_(widened(moments)), settings_(settings) {}

  // The state `elapsed` after `start`.
  WideState after(const WideState& start, const Wide& elapsed) const;

 private:
  using Series4 = std::array<Series, 4>;
  void append_order(Series3& g, Series3& w, Series4& q, std::size_t k) const;

  WideVec3 moments_;
  TaylorSettings settings_;
};

inline void DirectFlow::append_order(Series3& g, Series3& w, Series4& q, std::size_t k) const {
  const auto times = [k](const Series& a, const Series& b) { return convolution(a, b, k); };
  const WideVec3 g_dot{times(g[1], w[2]) - times(g[2], w[1]), times(g[2], w[0]) - times(g[0], w[2]),
                       times(g[0], w[1]) - times(g[1], w[0])};
  const std::array<Wide, 4> twice_q_dot{-times(q[1], w[0]) - times(q[2], w[1]) - times(q[3], w[2]),
                                        times(q[0], w[0]) + times(q[2], w[2]) - times(q[3], w[1]),
                                        times(q[0], w[1]) + times(q[3], w[0]) - times(q[1], w[2]),
                                        times(q[0], w[2]) + times(q[1], w[1]) - times(q[2], w[0])};
  for (std::size_t i = 0; i < 4; ++i) q[i].push_back(twice_q_dot[i] / (2 * (k + 1)));
  for (std::size_t i = 0; i < 3; ++i) {
    g[i].push_back(component(g_dot, i) / (k + 1));
    w[i].push_back(g[i].back() / component(moments_, i));
  }
}

inline WideState DirectFlow::after(const WideState& start, const Wide& elapsed) const {
  WideState now = start;
  Wide left = elapsed;
  while (left != 0) {
    Series3 g{Series{now.g.x}, Series{now.g.y}, Series{now.g.z}}, w;
    for (std::size_t i = 0; i < 3; ++i) w[i].push_back(g[i][0] / component(moments_, i));
    Series4 q{Series{now.q.w}, Series{now.q.x}, Series{now.q.y}, Series{now.q.z}};
    for (std::size_t k = 0; k < settings_.order; ++k) append_order(g, w, q, k);
    const Wide G = sqrt(dot(now.g, now.g));
    double log2_length = std::numeric_limits<double>::infinity();
    for (const Series& s : q) log2_length = smaller(log2_length, log2_step(s, settings_, 0.0));
    for (const Series& s : g)
      log2_length = smaller(log2_length, log2_step(s, settings_, log2_magnitude(G)));
    Wide h = smaller(Wide(pow(Wide(2), Wide(log2_length))), Wide(abs(left)));
    if (left < 0) h = -h;
    now = {{polynomial(q[0], h), polynomial(q[1], h), polynomial(q[2], h), polynomial(q[3], h)},
           polynomial(g, h)};
    left -= h;
  }
  return now;
}

}  // namespace oracle
