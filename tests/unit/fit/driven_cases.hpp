// SPDX-License-Identifier: MIT
// Driven bodies whose motion is known to more than double: constant torques, eddy currents in a
// constant field, gravity through a flyby, jumps of the spin; integrated in axes that the library
// does not use (inertial momentum), by extrapolation.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "polhode/fit/driven_spin_fit.hpp"

namespace polhode::test {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<40>,
                                           boost::multiprecision::et_off>;
using WideVec3 = std::array<Wide, 3>;
using WideNumbers = std::array<Wide, 7>;  // q, inertial momentum

inline WideVec3 crossed(const WideVec3& a, const WideVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Wide dotted(const WideVec3& a, const WideVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline WideVec3 wide(const Vec3& v) { return {v.x, v.y, v.z}; }

// The columns of the rotation, body to inertial axes.
inline std::array<WideVec3, 3> columns_of(const WideNumbers& y) {
  const Wide &w = y[0], &a = y[1], &b = y[2], &c = y[3];
  return {WideVec3{w * w + a * a - b * b - c * c, 2 * (a * b + w * c), 2 * (a * c - w * b)},
          WideVec3{2 * (a * b - w * c), w * w - a * a + b * b - c * c, 2 * (b * c + w * a)},
          WideVec3{2 * (a * c + w * b), 2 * (b * c - w * a), w * w - a * a - b * b + c * c}};
}
inline WideVec3 to_body(const std::array<WideVec3, 3>& e, const WideVec3& x_I) {
  return {dotted(e[0], x_I), dotted(e[1], x_I), dotted(e[2], x_I)};
}
inline WideVec3 to_space(const std::array<WideVec3, 3>& e, const WideVec3& x_B) {
  WideVec3 x;
  for (std::size_t i = 0; i < 3; ++i) x[i] = e[0][i] * x_B[0] + e[1][i] * x_B[1] + e[2][i] * x_B[2];
  return x;
}

// A body with a spin at t0 = 0, the numbers of its torque, and its jumps.
struct WideSpin {
  std::array<Wide, 4> q;
  WideVec3 w, moments;
  std::vector<Wide> parameters;
  std::vector<WideVec3> changes;
};

// The torque in body axes at a time, with the axes of the body, its rate and its numbers.
using WideTorque = std::function<WideVec3(const Wide& t, const std::array<WideVec3, 3>& e,
                                          const WideVec3& w, const WideSpin& of)>;

// One step by extrapolated midpoints (Gragg, Bulirsch, Stoer): of order 2 n.
inline WideNumbers extrapolated(
    const std::function<WideNumbers(const Wide&, const WideNumbers&)>& f, const Wide& t,
    const WideNumbers& y, const Wide& H) {
  constexpr std::size_t n = 9;
  std::array<std::array<WideNumbers, n>, n> table;
  const WideNumbers first = f(t, y);
  for (std::size_t k = 0; k < n; ++k) {
    const int m = 2 * static_cast<int>(k + 1);
    const Wide h = H / m;
    WideNumbers a = y, b;
    for (std::size_t i = 0; i < 7; ++i) b[i] = y[i] + h * first[i];
    for (int j = 1; j < m; ++j) {
      const WideNumbers r = f(t + j * h, b);
      for (std::size_t i = 0; i < 7; ++i) a[i] += 2 * h * r[i];
      std::swap(a, b);
    }
    const WideNumbers last = f(t + H, b);
    for (std::size_t i = 0; i < 7; ++i) table[k][0][i] = (a[i] + b[i] + h * last[i]) / 2;
    for (std::size_t c = 1; c <= k; ++c) {
      const Wide ratio = Wide(static_cast<int>(k + 1)) / static_cast<int>(k + 1 - c);
      for (std::size_t i = 0; i < 7; ++i) {
        table[k][c][i] = table[k][c - 1][i] +
                         (table[k][c - 1][i] - table[k - 1][c - 1][i]) / (ratio * ratio - 1);
      }
    }
  }
  return table[n - 1][n - 1];
}

struct WidePoint {
  std::array<Wide, 4> q;
  WideVec3 w;
};

// The state at t; a jump of this kind acts after its time on the way.
inline WidePoint moved(const WideSpin& s, const WideTorque& torque,
                       const std::vector<fit::SpinJump>& jumps, double t) {
  const auto rate_of = [&s](const std::array<WideVec3, 3>& e, const WideNumbers& y) {
    WideVec3 w = to_body(e, {y[4], y[5], y[6]});
    for (std::size_t i = 0; i < 3; ++i) w[i] /= s.moments[i];
    return w;
  };
  const auto f = [&](const Wide& at, const WideNumbers& y) {
    const auto e = columns_of(y);
    const WideVec3 w = rate_of(e, y);
    const WideVec3 M = to_space(e, torque(at, e, w, s));
    const Wide half("0.5");
    return WideNumbers{half * (-y[1] * w[0] - y[2] * w[1] - y[3] * w[2]),
                       half * (y[0] * w[0] + y[2] * w[2] - y[3] * w[1]),
                       half * (y[0] * w[1] + y[3] * w[0] - y[1] * w[2]),
                       half * (y[0] * w[2] + y[1] * w[1] - y[2] * w[0]),
                       M[0],
                       M[1],
                       M[2]};
  };
  WideNumbers y{s.q[0], s.q[1], s.q[2], s.q[3], 0, 0, 0};
  WideVec3 L = s.w;
  for (std::size_t i = 0; i < 3; ++i) L[i] *= s.moments[i];
  L = to_space(columns_of(y), L);
  for (std::size_t i = 0; i < 3; ++i) y[4 + i] = L[i];
  Wide from = 0;
  const auto run = [&](double to) {
    const double span = to - static_cast<double>(from);
    const int steps = static_cast<int>(std::ceil(std::abs(span) / 0.5));
    const Wide H = steps > 0 ? (Wide(to) - from) / steps : Wide(0);
    for (int k = 0; k < steps; ++k) y = extrapolated(f, from + k * H, y, H);
    from = to;
  };
  const auto jump = [&](std::size_t j, int sign) {
    WideVec3 dL = s.changes[j];
    if (jumps[j].of == fit::SpinJump::Of::rate) {
      for (std::size_t i = 0; i < 3; ++i) dL[i] *= s.moments[i];
    }
    if (jumps[j].of != fit::SpinJump::Of::inertial_momentum) dL = to_space(columns_of(y), dL);
    for (std::size_t i = 0; i < 3; ++i) y[4 + i] += sign * dL[i];
  };
  // those of the tests stand in order of time
  for (std::size_t j = 0; j < jumps.size(); ++j) {
    if (jumps[j].t < 0.0 || jumps[j].t >= t) continue;
    run(jumps[j].t);
    jump(j, 1);
  }
  for (std::size_t j = jumps.size(); j-- > 0;) {
    if (jumps[j].t >= 0.0 || jumps[j].t < t) continue;
    run(jumps[j].t);
    jump(j, -1);
  }
  run(t);
  return {{y[0], y[1], y[2], y[3]}, rate_of(columns_of(y), y)};
}

}  // namespace polhode::test
