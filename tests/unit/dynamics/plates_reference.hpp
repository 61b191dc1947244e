// SPDX-License-Identifier: MIT
// Two plates in a stream whose direction turns with a circular orbit, in long double: Gragg's
// extrapolation of 12th order, which is on one side of every edge and ends its steps there by
// bisection. It shares no formula with the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "worst.hpp"

namespace polhode_test {

class PlatesReference {
 public:
  using Wide = long double;
  using Values = std::array<Wide, 7>;  // q, g
  using Three = std::array<Wide, 3>;

  Three moments{2.0L, 3.0L, 4.5L};
  std::array<Three, 2> normals{{{1.0L, 0.0L, 0.0L}, {0.0L, 0.6L, 0.8L}}};
  std::array<Three, 2> centres{{{0.0L, 0.3, 0.1}, {0.2, 0.0L, 0.1}}};
  std::array<Wide, 2> areas{1.0L, 2.0L};
  Wide pressure = 0.01L, orbit_rate = 0.25L;

  Values after(Values y, Wide end, Wide longest) {
    edges = 0;
    Wide t = 0.0L;
    for (std::size_t k = 0; k < 2; ++k) lit_[k] = cosine(k, t, y) > 0.0L;
    while (t < end) {
      const Wide h = polhode::test::smaller(longest, end - t);
      const Values next = stepped(t, y, h);
      Wide shortest = h;
      std::size_t first = 2;
      for (std::size_t k = 0; k < 2; ++k) {
        if ((cosine(k, t + h, next) > 0.0L) == lit_[k]) continue;
        Wide a = 0.0L, b = h;
        for (int trip = 0; trip < 64; ++trip) {
          const Wide m = 0.5L * (a + b);
          ((cosine(k, t + m, stepped(t, y, m)) > 0.0L) == lit_[k] ? a : b) = m;
        }
        if (first < 2 && shortest < b) continue;  // the other plate's edge comes first
        shortest = b;
        first = k;
      }
      y = first < 2 ? stepped(t, y, shortest) : next;
      t += shortest;
      if (first < 2) {
        lit_[first] = !lit_[first];
        ++edges;
      }
    }
    return y;
  }

  int edges = 0;  // that the run met

 private:
  // Against the velocity of a circular orbit in the plane z = 0, in body axes.
  Three stream(Wide t, const Values& y) const {
    const Three v{-std::sin(orbit_rate * t), std::cos(orbit_rate * t), 0.0L};
    const Wide w = y[0], x = y[1], j = y[2], k = y[3];
    const Wide n = w * w + x * x + j * j + k * k;
    // the rows of the transposed matrix of q
    return {((w * w + x * x - j * j - k * k) * v[0] + 2 * (x * j + w * k) * v[1]) / n,
            (2 * (x * j - w * k) * v[0] + (w * w - x * x + j * j - k * k) * v[1]) / n,
            (2 * (x * k + w * j) * v[0] + 2 * (j * k - w * x) * v[1]) / n};
  }
  Wide cosine(std::size_t k, Wide t, const Values& y) const {
    const Three e = stream(t, y);
    return normals[k][0] * e[0] + normals[k][1] * e[1] + normals[k][2] * e[2];
  }
  Values rates(Wide t, const Values& y) const {
    const Three e = stream(t, y);
    Three u{};
    for (std::size_t k = 0; k < 2; ++k) {
      if (!lit_[k]) continue;
      const Three &n = normals[k], &r = centres[k];
      const Wide f = -pressure * areas[k] * (n[0] * e[0] + n[1] * e[1] + n[2] * e[2]);
      u[0] += f * (r[1] * e[2] - r[2] * e[1]);
      u[1] += f * (r[2] * e[0] - r[0] * e[2]);
      u[2] += f * (r[0] * e[1] - r[1] * e[0]);
    }
    const Wide a = y[4] / moments[0], b = y[5] / moments[1], c = y[6] / moments[2];
    return {-(y[1] * a + y[2] * b + y[3] * c) / 2,
            (y[0] * a + y[2] * c - y[3] * b) / 2,
            (y[0] * b - y[1] * c + y[3] * a) / 2,
            (y[0] * c + y[1] * b - y[2] * a) / 2,
            y[5] * c - y[6] * b + u[0],
            y[6] * a - y[4] * c + u[1],
            y[4] * b - y[5] * a + u[2]};
  }
  Values stepped(Wide t, const Values& y, Wide H) const {
    std::array<std::array<Values, 6>, 6> T;
    for (std::size_t j = 0; j < 6; ++j) {
      const std::size_t n = 2 * (j + 1);
      const Wide h = H / static_cast<Wide>(n);
      Values a = y, b = y, k = rates(t, y);
      for (std::size_t i = 0; i < 7; ++i) b[i] = a[i] + h * k[i];
      for (std::size_t m = 1; m < n; ++m) {
        k = rates(t + static_cast<Wide>(m) * h, b);
        for (std::size_t i = 0; i < 7; ++i) a[i] = std::exchange(b[i], a[i] + 2 * h * k[i]);
      }
      k = rates(t + H, b);
      for (std::size_t i = 0; i < 7; ++i) T[j][0][i] = (a[i] + b[i] + h * k[i]) / 2;
      for (std::size_t c = 1; c <= j; ++c) {
        const Wide ratio = static_cast<Wide>(j + 1) / static_cast<Wide>(j + 1 - c);
        for (std::size_t i = 0; i < 7; ++i)
          T[j][c][i] = T[j][c - 1][i] + (T[j][c - 1][i] - T[j - 1][c - 1][i]) / (ratio * ratio - 1);
      }
    }
    return T[5][5];
  }

  std::array<bool, 2> lit_{};
};

}  // namespace polhode_test
