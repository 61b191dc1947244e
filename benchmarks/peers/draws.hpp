// SPDX-License-Identifier: MIT
// Bodies, states and times that the seed draws, and how far a motion is from the exact one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include "contenders.hpp"
#include "worst.hpp"

namespace peers {

inline constexpr double farthest = 62831.853;  // 1e4 turns at a rate near 1

struct Draw {
  std::mt19937_64 engine;
  double uniform(double a, double b) {
    return a + (b - a) * std::ldexp(static_cast<double>(engine() >> 11U), -53);
  }
  double normal() {
    return std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0))) *
           std::cos(2.0 * M_PI * uniform(0.0, 1.0));
  }
  // Of a random ellipsoid with axes within a factor of two, sorted.
  std::array<double, 3> moments() {
    double a = uniform(1.5, 2.0), b = uniform(1.2, 1.45), c = uniform(0.8, 1.15);
    a *= a;
    b *= b;
    c *= c;
    return {(b + c) / 4.0, (a + c) / 4.0, (a + b) / 4.0};
  }
  // Short-axis mode of modulus k, any phase, a rate near 1.
  Start of_modulus(double k) {
    Start s{moments(), {}};
    const auto [A, B, C] = s.I;
    const double phi = uniform(-3.0, 3.0);
    const double x = k * std::sqrt((C - B) * A / ((B - A) * C));
    const double y = x * std::sqrt(B * (C - A) / (A * (C - B)));
    s.g = {x * std::cos(phi), y * std::sin(phi), std::sqrt(1.0 - std::pow(k * std::sin(phi), 2))};
    scale(s, B);
    return s;
  }
  Start any() {
    Start s{moments(), {normal(), normal(), normal()}};
    scale(s, s.I[1]);
    return s;
  }
  // Moved so far from the separatrix, relative; the momentum about the greatest moment changes.
  static void move_to_separatrix(Start& s, double distance) {
    const auto [A, B, C] = s.I;
    const double slope = std::sqrt(C * (B - A) / (A * (C - B)));
    s.g[2] = s.g[0] * slope * (1.0 + 0.5 * distance);
    scale(s, B);
  }
  static void scale(Start& s, double size) {
    const double n = size / std::hypot(s.g[0], s.g[1], s.g[2]);
    for (double& x : s.g) x *= n;
  }
};

// Of so few digits that all even times are doubles.
inline double even_step(std::size_t states) {
  int e = 0;
  const double part = std::frexp(farthest / static_cast<double>(states), &e);
  return std::ldexp(std::rint(std::ldexp(part, 20)), e - 20);
}

// Those of libraries that are here.
inline std::vector<Maker> present(std::vector<Maker> all) {
  std::vector<Maker> list;
  for (const Maker& m : all)
    if (m.make != nullptr)
      list.push_back(m);
    else
      std::printf("{\"missing\": \"%s\"}\n", m.who.c_str());
  return list;
}

inline double error_of(const Exact& exact, const Motion& motion, std::span<const double> t) {
  const std::size_t width = motion.width();
  std::vector<double> row(width), first(width);
  const double zero = 0.0;
  motion.rows({&zero, 1}, first.data());
  polhode::test::Worst worst;
  for (const double x : t) {
    motion.rows({&x, 1}, row.data());
    worst.add(exact.error(x, {row.data(), width == 12 ? 9 : width},
                          {first.data(), width == 12 ? 9 : width}));
  }
  return worst.value();
}

}  // namespace peers
