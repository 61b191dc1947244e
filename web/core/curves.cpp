// SPDX-License-Identifier: MIT
// Polhodes as curves: where the sphere |g| = G and the ellipsoid of an energy meet.
//
// About the axis c, with a the other end of the order of moments and b the middle one: in the two
// coordinates across c a polhode is an ellipse, g_a = A cos u, g_b = B sin u, and g_c is what the
// sphere leaves, C^2 cos^2 u + D^2 sin^2 u with C^2 = G^2 - A^2, D^2 = G^2 - B^2. D vanishes on the
// separatrix.
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "motion.hpp"
#include "numbers.hpp"
#include "polhode_web.h"

using namespace polhode;
using namespace polhode::web;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// The axes with the least, middle and greatest moment.
std::array<int, 3> axis_order(const Vec3& I) {
  std::array<int, 3> order{0, 1, 2};
  for (const std::size_t i : {0U, 1U, 0U})
    if (I[order[i + 1]] < I[order[i]]) std::swap(order[i], order[i + 1]);
  return order;
}

// The roles of the axes of a polhode about the long or the short one.
struct Roles {
  int a, b, c;
};
Roles roles(const std::array<int, 3>& order, bool is_long) {
  return is_long ? Roles{order[2], order[1], order[0]} : Roles{order[0], order[1], order[2]};
}

struct Amplitudes {
  double A, B, C, D;
};

void put_curve(const Roles& axes, const Amplitudes& of, double side, uint32_t points,
               double* rows) {
  for (uint32_t i = 0; i < points; ++i, rows += 3) {
    const double u = 2.0 * std::numbers::pi * (i + 1 == points ? 0 : i) / (points - 1);
    const double c = std::cos(u), s = std::sin(u);
    rows[axes.a] = of.A * c;
    rows[axes.b] = of.B * s;
    rows[axes.c] = side * std::hypot(of.C * c, of.D * s);
  }
}

// Half of the separatrix, from -b to b, through the direction (a, c) across b.
void put_half_circle(const Roles& axes, double a, double c, double G, uint32_t points,
                     double* rows) {
  for (uint32_t i = 0; i < points; ++i, rows += 3) {
    const double u = std::numbers::pi * (static_cast<double>(i) / (points - 1) - 0.5);
    rows[axes.a] = a * std::cos(u);
    rows[axes.b] = G * std::sin(u);
    rows[axes.c] = c * std::cos(u);
  }
}

// A^2 / B^2: (1/I_b - 1/I_c) / (1/I_a - 1/I_c).
double squared_ratio(const Vec3& I, const Roles& axes) {
  return (I[axes.a] / I[axes.b]) * ((I[axes.c] - I[axes.b]) / (I[axes.c] - I[axes.a]));
}

}  // namespace

uint32_t polhode_motion_curve(const polhode_motion* motion, uint32_t points, double* rows) {
  const FreeRotation& m = motion->rotation;
  const Vec3& I = m.body().moments();
  const Vec3& g = m.initial_state().g;
  const double G = m.momentum();
  if (m.regime() == Regime::rest || m.regime() == Regime::steady) {
    put(rows, g);
    return 1;
  }
  const Roles axes = roles(axis_order(I), m.regime() == Regime::long_axis);
  if (m.regime() == Regime::separatrix) {
    const double length = std::hypot(g[axes.a], g[axes.c]) / G;
    put_half_circle(axes, g[axes.a] / length, g[axes.c] / length, G, points, rows);
    return points;
  }
  // sums of squares alone: nothing cancels but what is G^2 - B^2, which the motion knows
  const double ratio = squared_ratio(I, axes), ga = g[axes.a], gb = g[axes.b], gc = g[axes.c];
  const double A2 = ga * ga + ratio * gb * gb;
  const double B = std::sqrt(A2 / ratio), C = std::sqrt(gc * gc + (1.0 - ratio) * gb * gb);
  const double D2 =
      std::abs(m.separatrix_distance()) * (I[axes.c] / std::abs(I[axes.c] - I[axes.b]));
  put_curve(axes, {std::sqrt(A2), B, C, std::sqrt(D2)}, std::copysign(1.0, gc), points, rows);
  return points;
}

double polhode_curve(const double* moments, double G, int is_long, int side, double angle,
                     uint32_t points, double* rows) {
  const Vec3 I = vector(moments);
  const Roles axes = roles(axis_order(I), is_long != 0);
  if (I[axes.b] == I[axes.c]) return none;
  const double ratio = squared_ratio(I, axes), B = G * std::sin(angle);
  const double A = B * std::sqrt(ratio), D = G * std::cos(angle);
  put_curve(axes, {A, B, std::sqrt((G - A) * (G + A)), D}, side, points, rows);
  return B * B / I[axes.b] + D * D / I[axes.c];
}

double polhode_half_separatrix(const double* moments, double G, int sign_long, int sign_short,
                               uint32_t points, double* rows) {
  const Vec3 I = vector(moments);
  const Roles axes = roles(axis_order(I), false);
  if (I[axes.a] == I[axes.b] || I[axes.b] == I[axes.c]) return none;
  const double along = std::sqrt(squared_ratio(I, axes));
  put_half_circle(axes, sign_long * G * along,
                  sign_short * G * std::sqrt((1.0 - along) * (1.0 + along)), G, points, rows);
  return G * G / I[axes.b];
}

void polhode_andoyer_plane(const double* momenta, uint32_t count, double* rows) {
  double before = 0.0;
  for (uint32_t i = 0; i < count; ++i, momenta += 3, rows += 2) {
    const double l = std::atan2(momenta[0], momenta[1]);
    const double turns = i == 0 ? 0.0 : std::round((before - l) / (2.0 * std::numbers::pi));
    before = rows[0] = l + 2.0 * std::numbers::pi * turns;
    rows[1] = momenta[2];
  }
}
