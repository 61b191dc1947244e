// SPDX-License-Identifier: MIT
// Motions of every regime, and differences of states.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "oracle/free_cases.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "worst.hpp"

namespace free_test {

using oracle::Draw;
using oracle::FreeCase;
using namespace polhode;
using polhode::test::larger;
using polhode::test::message_of;
using polhode::test::smaller;

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double pi = 3.141592653589793;

// The bits, with one pattern for every NaN: its sign and payload mean nothing.
inline std::array<std::uint64_t, 7> bits(const RotorState& s) {
  std::array<std::uint64_t, 7> b{};
  std::size_t i = 0;
  for (const double x : {s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z})
    b[i++] = std::bit_cast<std::uint64_t>(std::isnan(x) ? not_a_number : x);
  return b;
}

struct NamedMotion {
  const char* name;
  Vec3 moments;
  Vec3 g;
  Regime regime;

  Body body() const { return {moments.x, moments.y, moments.z}; }
  RotorState start() const { return {{0.6, -0.3, 0.7, 0.2}, g}; }
  FreeRotation motion(double t0 = 0.0) const { return {body(), start(), t0}; }
};

// Every regime, both senses, and the bodies and spins where formulas degenerate.
inline std::vector<NamedMotion> motions() {
  const Vec3 triaxial{3.0, 4.0, 6.0}, oblate{3.0, 3.0, 5.0}, prolate{2.0, 5.0, 5.0};
  const Vec3 sphere{2.0, 2.0, 2.0}, flat{1.0, 2.0, 3.0};
  const double tiny = 0x1p-40;
  return {{"SAM", triaxial, {0.3, 0.2, 1.0}, Regime::short_axis},
          {"SAM, other sense", triaxial, {0.3, -0.9, -1.0}, Regime::short_axis},
          {"LAM", triaxial, {1.0, 0.2, 0.3}, Regime::long_axis},
          {"LAM, other lobe", triaxial, {-1.0, 0.8, -0.3}, Regime::long_axis},
          {"flat body", flat, {0.2, 0.4, 1.3}, Regime::short_axis},
          {"above the separatrix", triaxial, {1.0, 0.5, 1.0 + tiny}, Regime::short_axis},
          {"below the separatrix", triaxial, {1.0 + tiny, 0.5, 1.0}, Regime::long_axis},
          {"separatrix", triaxial, {1.0, 0.5, 1.0}, Regime::separatrix},
          {"separatrix, another branch", triaxial, {-1.0, 0.5, 1.0}, Regime::separatrix},
          {"next to b1", triaxial, {1.0, tiny, -tiny}, Regime::long_axis},
          {"next to b2", triaxial, {tiny, 1.0, 2.0 * tiny}, Regime::short_axis},
          {"next to b3", triaxial, {tiny, -tiny, 1.0}, Regime::short_axis},
          {"about b1", triaxial, {1.0, 0.0, 0.0}, Regime::steady},
          {"about b2", triaxial, {0.0, -1.0, 0.0}, Regime::steady},
          {"about b3", triaxial, {0.0, 0.0, 1.0}, Regime::steady},
          {"oblate", oblate, {0.3, 0.2, 1.0}, Regime::short_axis},
          {"oblate, across its axis", oblate, {0.3, 0.2, 0.0}, Regime::steady},
          {"prolate", prolate, {1.0, 0.2, 0.3}, Regime::long_axis},
          {"prolate, across its axis", prolate, {0.0, 0.2, 0.3}, Regime::steady},
          {"sphere", sphere, {0.3, 0.2, 1.0}, Regime::steady},
          {"rest", triaxial, {0.0, 0.0, 0.0}, Regime::rest}};
}

inline FreeRotation motion_of(const FreeCase& c) {
  return {Body(c.moments.x, c.moments.y, c.moments.z), c.start, c.t0};
}

// Cases of every kind that the accuracy of FreeRotation is measured on; near the separatrix for a
// few turns, after which the last digit of a state decides where it goes.
inline std::vector<FreeCase> drawn_cases(std::uint64_t seed, std::size_t of_each) {
  std::vector<FreeCase> cases;
  std::uint64_t stream = 0;
  for (const oracle::CaseMaker maker :
       {oracle::random_case, oracle::near_axis_case, oracle::nearly_equal_case,
        oracle::near_separatrix_case, oracle::exact_separatrix_case, oracle::small_angle_case}) {
    ++stream;
    for (std::size_t i = 0; i < of_each; ++i) {
      Draw draw(seed + (stream << 32U), i);
      FreeCase c = maker(draw);
      const FreeRotation m = motion_of(c);
      if (std::abs(m.separatrix_distance()) < 1e-2 * m.momentum() * m.momentum())
        c.t = c.t0 + 0.03 * (c.t - c.t0);
      cases.push_back(c);
    }
  }
  return cases;
}

// Rotation angle between two attitudes, rad.
inline double attitude_difference(const Quaternion& p, const Quaternion& q) {
  const Quaternion d = conj(normalized(p)) * normalized(q);
  const double v = norm(Vec3{d.x, d.y, d.z});
  return std::isnan(v) ? v : 2.0 * std::asin(smaller(1.0, v));
}
// The larger of the attitude difference and the relative difference of the momenta.
inline double difference(const RotorState& a, const RotorState& b) {
  const double size = norm(a.g), dg = norm(a.g - b.g) / (size > 0.0 ? size : 1.0);
  const double angle = attitude_difference(a.q, b.q);
  return std::isnan(angle) || std::isnan(dg) ? not_a_number : larger(angle, dg);
}
inline double relative(double value, double expected) {
  if (value == expected) return 0.0;
  return std::abs(value - expected) / std::abs(expected);
}

// How far a relative change of the state at the epoch by 1 has moved the state at t.
inline double sensitivity(const FreeRotation& m, double t) {
  const polhode::Matrix6 phi = m.state_transition(t);
  const double G = m.momentum() > 0.0 ? m.momentum() : 1.0;
  double sum = 0.0;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double x = phi(i, j) * (j < 3 ? 1.0 : G) / (i < 3 ? 1.0 : G);
      sum += x * x;
    }
  }
  return std::sqrt(sum);
}

// The six orders of the axes as proper rotations, and the eighteen others with two signs turned.
struct Turn {
  std::array<int, 3> axis;
  std::array<double, 3> sign;
};
inline std::vector<Turn> proper_turns() {
  std::vector<Turn> turns;
  std::array<int, 3> axis{0, 1, 2};
  do {
    const bool even = (axis[1] - axis[0] + 3) % 3 == 1;
    for (unsigned bits = 0; bits < 8; ++bits) {
      std::array<double, 3> sign{};
      double product = 1.0;
      for (unsigned i = 0; i < 3; ++i) product *= sign[i] = (bits >> i) % 2 == 0 ? 1.0 : -1.0;
      if (product == (even ? 1.0 : -1.0)) turns.push_back({axis, sign});
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return turns;
}

}  // namespace free_test
