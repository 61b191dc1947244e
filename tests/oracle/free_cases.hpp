// SPDX-License-Identifier: MIT
// Bodies, states and times on which free rotation is judged: a random set and the hard ones.
//
// Units       moments and momenta are scaled by powers of ten between 1e-3 and 1e3; times are drawn
//             in turns, a turn being 2 pi / |omega| at the start.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "oracle/random_draw.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "worst.hpp"

namespace oracle {

using polhode::test::larger;
using polhode::test::smaller;

struct FreeCase {
  polhode::Vec3 moments;
  polhode::RotorState start;
  double t0 = 0.0;
  double t = 0.0;
};

// In hexadecimal, so that a failure can be repeated.
std::string description(const FreeCase& c);

// How a case is drawn from its random numbers.
using CaseMaker = FreeCase (*)(Draw&);

FreeCase random_case(Draw& draw);            // random triaxial body, any state
FreeCase near_axis_case(Draw& draw);         // g within 1e-14 .. 1e-3 of a principal axis
FreeCase nearly_equal_case(Draw& draw);      // moments equal to within 1e-15 .. 1e-3, or exactly
FreeCase near_separatrix_case(Draw& draw);   // |2TI2/G^2 - 1| of 1e-16 .. 1e-3, both sides
FreeCase exact_separatrix_case(Draw& draw);  // 2TI2/G^2 - 1 = 0
FreeCase small_angle_case(Draw& draw);       // J, I within 1e-150 .. 1e-3 of 0 and pi
FreeCase extreme_case(Draw& draw);           // needles, discs, and units of 1e-140 .. 1e140
FreeCase long_time_case(Draw& draw);         // |2TI2/G^2 - 1| > 1e-3, times to be set

// t so that about `turns` turns pass after t0.
void set_time(FreeCase& c, double turns);

// --- implementation ---

namespace detail {

using Triple = std::array<double, 3>;

inline polhode::Vec3 vec(const Triple& a) { return {a[0], a[1], a[2]}; }

// Moments of a body with some mass along each axis: 0 < I1 < I2 < I3 < I1 + I2.
inline Triple triaxial_moments(Draw& draw) {
  Triple mass{draw.uniform(0.02, 1.0), draw.uniform(0.02, 1.0), draw.uniform(0.02, 1.0)};
  std::sort(mass.begin(), mass.end());
  return {mass[0] + mass[1], mass[0] + mass[2], mass[1] + mass[2]};
}

inline polhode::Quaternion any_attitude(Draw& draw) {
  return {draw.normal(), draw.normal(), draw.normal(), draw.normal()};
}

inline Triple any_direction(Draw& draw) {
  const Triple v{draw.normal(), draw.normal(), draw.normal()};
  const double n = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return {v[0] / n, v[1] / n, v[2] / n};
}

// Within delta of an axis.
inline Triple direction_near_axis(Draw& draw, std::size_t axis, double delta) {
  const double turn = draw.uniform(-3.2, 3.2);
  Triple v{};
  v[axis] = draw.sign() * std::sqrt((1.0 - delta) * (1.0 + delta));
  v[(axis + 1) % 3] = delta * std::cos(turn);
  v[(axis + 2) % 3] = delta * std::sin(turn);
  return v;
}

// Moments and momentum by axis of the body, from values sorted by moment: any order of axes.
inline void place(FreeCase& c, Draw& draw, const Triple& sorted_moments, const Triple& g) {
  std::array<std::size_t, 3> axis{0, 1, 2};
  for (std::size_t i = 2; i > 0; --i) std::swap(axis[i], axis[draw.index(i + 1)]);
  for (std::size_t i = 0; i < 3; ++i) {
    c.moments[static_cast<int>(axis[i])] = sorted_moments[i];
    c.start.g[static_cast<int>(axis[i])] = g[i];
  }
}

inline Triple scaled(double s, const Triple& a) { return {s * a[0], s * a[1], s * a[2]}; }

inline double turn_length(const FreeCase& c) {
  const polhode::Vec3 w{c.start.g.x / c.moments.x, c.start.g.y / c.moments.y,
                        c.start.g.z / c.moments.z};
  return 2.0 * 3.141592653589793 / polhode::norm(w);
}

// The epoch is 0, or some turns away; up to 100 turns pass.
inline void draw_times(FreeCase& c, Draw& draw) {
  if (draw.chance(0.5)) c.t0 = draw.uniform(-10.0, 10.0) * turn_length(c);
  set_time(c, draw.uniform(-100.0, 100.0));
}

// G^2 - 2 T I2 in units of G^2, in double precision.
inline double relative_d2(const Triple& I, const Triple& g) {
  const double G2 = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  return (g[2] * g[2] * (I[2] - I[1]) / I[2] - g[0] * g[0] * (I[1] - I[0]) / I[0]) / G2;
}

// q = qz(h) qx(I) qz(g) qx(J) qz(l) with I, J given by their distance from 0 or pi.
inline polhode::Quaternion tilt(double delta, bool near_pi) {
  const double c = std::cos(0.5 * delta), s = std::sin(0.5 * delta);
  return near_pi ? polhode::Quaternion{s, c, 0.0, 0.0} : polhode::Quaternion{c, s, 0.0, 0.0};
}

// Integers (lo, mid, hi, a, b): with momenta a x, b x about lo, hi the state is on the separatrix.
struct ExactSeparatrix {
  int lo, mid, hi;
  int g_lo, g_hi;
};
inline std::vector<ExactSeparatrix> exact_separatrices() {
  const auto root = [](int n) { return static_cast<int>(std::lround(std::sqrt(n))); };
  std::vector<ExactSeparatrix> found;
  for (int hi = 3; hi <= 40; ++hi)
    for (int mid = 2; mid < hi; ++mid)
      for (int lo = std::max<int>(1, hi - mid); lo < mid; ++lo) {
        const int p = lo * (hi - mid), q = hi * (mid - lo), d = std::gcd(p, q);
        const int a = root(p / d), b = root(q / d);
        if (a * a == p / d && b * b == q / d) found.push_back({lo, mid, hi, a, b});
      }
  return found;
}

}  // namespace detail

inline std::string description(const FreeCase& c) {
  std::array<char, 512> text{};
  const auto& [q, g] = c.start;
  std::snprintf(text.data(), text.size(),
                "moments {%a, %a, %a} q {%a, %a, %a, %a} g {%a, %a, %a} t0 %a t %a", c.moments.x,
                c.moments.y, c.moments.z, q.w, q.x, q.y, q.z, g.x, g.y, g.z, c.t0, c.t);
  return text.data();
}

inline void set_time(FreeCase& c, double turns) { c.t = c.t0 + turns * detail::turn_length(c); }

inline FreeCase random_case(Draw& draw) {
  FreeCase c;
  detail::place(c, draw, detail::scaled(draw.power_of_ten(-3, 3), detail::triaxial_moments(draw)),
                detail::scaled(draw.power_of_ten(-3, 3), detail::any_direction(draw)));
  c.start.q = detail::any_attitude(draw);
  detail::draw_times(c, draw);
  return c;
}

inline FreeCase near_axis_case(Draw& draw) {
  FreeCase c;
  const double delta = draw.power_of_ten(-14, -3);
  detail::place(c, draw, detail::scaled(draw.power_of_ten(-3, 3), detail::triaxial_moments(draw)),
                detail::scaled(draw.power_of_ten(-3, 3),
                               detail::direction_near_axis(draw, draw.index(3), delta)));
  c.start.q = detail::any_attitude(draw);
  detail::draw_times(c, draw);
  return c;
}

inline FreeCase nearly_equal_case(Draw& draw) {
  const auto small = [&draw] { return draw.chance(0.25) ? 0.0 : draw.power_of_ten(-15, -3); };
  FreeCase c;
  detail::Triple I{1.0, 1.0, 1.0};
  switch (draw.index(3)) {
    case 0:  // I1 ~ I2
      I[1] += small();
      I[2] = draw.uniform(I[1], 1.999);
      break;
    case 1:  // I2 ~ I3
      I[2] += small();
      I[0] = draw.uniform(0.01, 1.0);
      break;
    default:
      I[1] += small();
      I[2] += small();
      std::sort(I.begin(), I.end());
  }
  const bool near_axis = draw.chance(0.25);
  const detail::Triple direction =
      near_axis ? detail::direction_near_axis(draw, draw.index(3), draw.power_of_ten(-14, -3))
                : detail::any_direction(draw);
  const double scale = std::ldexp(1.0, static_cast<int>(draw.index(21)) - 10);  // keeps I1 = I2
  detail::place(c, draw, detail::scaled(scale, I),
                detail::scaled(draw.power_of_ten(-3, 3), direction));
  c.start.q = detail::any_attitude(draw);
  detail::draw_times(c, draw);
  return c;
}

inline FreeCase near_separatrix_case(Draw& draw) {
  FreeCase c;
  const detail::Triple I = detail::triaxial_moments(draw);
  const double alpha = (I[2] - I[1]) / I[2], beta = (I[1] - I[0]) / I[0];
  const double least = smaller(alpha, beta);
  double d2 = draw.sign() * draw.power_of_ten(-16, -3);
  if (std::abs(d2) > 0.5 * least) d2 *= 0.5 * least;
  // g1^2 + g3^2 = side G^2: the whole separatrix, or close to the middle axis
  const double smallest = std::abs(d2) / least;
  const double side = draw.chance(0.75) ? smallest + (1.0 - smallest) * draw.uniform(0.0, 1.0)
                                        : std::pow(smallest, draw.uniform(0.0, 1.0));
  const detail::Triple direction{
      draw.sign() * std::sqrt(larger(0.0, (alpha * side - d2) / (alpha + beta))),
      draw.sign() * std::sqrt(larger(0.0, 1.0 - side)),
      draw.sign() * std::sqrt(larger(0.0, (beta * side + d2) / (alpha + beta)))};
  detail::place(c, draw, detail::scaled(draw.power_of_ten(-3, 3), I),
                detail::scaled(draw.power_of_ten(-3, 3), direction));
  c.start.q = detail::any_attitude(draw);
  detail::draw_times(c, draw);
  return c;
}

inline FreeCase exact_separatrix_case(Draw& draw) {
  static const std::vector<detail::ExactSeparatrix> all = detail::exact_separatrices();
  const detail::ExactSeparatrix s =
      draw.chance(0.5) ? detail::ExactSeparatrix{3, 4, 6, 1, 1} : all[draw.index(all.size())];
  // 40 bits times a small integer is exact; the third component is free
  const double x = std::ldexp(std::floor(draw.uniform(0.1, 1.0) * 0x1p40), -40);
  const double wide = draw.chance(0.25) ? draw.power_of_ten(0.0, 6.0) : 1.0;  // close to b2
  FreeCase c;
  const double scale = std::ldexp(1.0, static_cast<int>(draw.index(21)) - 10);
  detail::place(c, draw, detail::scaled(scale, {1.0 * s.lo, 1.0 * s.mid, 1.0 * s.hi}),
                {draw.sign() * s.g_lo * x, wide * draw.normal(), draw.sign() * s.g_hi * x});
  c.start.q = detail::any_attitude(draw);
  detail::draw_times(c, draw);
  return c;
}

inline FreeCase small_angle_case(Draw& draw) {
  const auto small = [&draw] {
    return draw.chance(0.1) ? 0.0 : draw.power_of_ten(draw.chance(0.5) ? -150 : -16, -3);
  };
  FreeCase c;
  detail::place(c, draw, detail::scaled(draw.power_of_ten(-3, 3), detail::triaxial_moments(draw)),
                {});
  const double J = small(), I = draw.chance(0.7) ? small() : draw.uniform(0.1, 3.0);
  const double l = draw.uniform(-3.2, 3.2), G = draw.power_of_ten(-3, 3);
  const bool J_pi = draw.chance(0.5), I_pi = draw.chance(0.5);
  c.start.g = {G * std::sin(J) * std::sin(l), G * std::sin(J) * std::cos(l),
               (J_pi ? -G : G) * std::cos(J)};
  c.start.q = polhode::rotation_z(draw.uniform(-3.2, 3.2)) * detail::tilt(I, I_pi) *
              polhode::rotation_z(draw.uniform(-3.2, 3.2)) * detail::tilt(J, J_pi) *
              polhode::rotation_z(l);
  detail::draw_times(c, draw);
  return c;
}

inline FreeCase extreme_case(Draw& draw) {
  FreeCase c;
  const double thin = draw.power_of_ten(-15, -1), mass = draw.uniform(0.1, 1.0);
  const detail::Triple needle{thin, 1.0, 1.0 + thin * draw.uniform(0.0, 1.0)};
  const detail::Triple flat{mass, 1.0, 1.0 + mass};  // I3 = I1 + I2 to the last bit
  const detail::Triple shapes[] = {needle, flat, detail::triaxial_moments(draw)};
  detail::Triple direction = detail::any_direction(draw);
  if (draw.chance(0.25))
    direction = detail::direction_near_axis(draw, draw.index(3), draw.power_of_ten(-14, -3));
  detail::place(c, draw,
                detail::scaled(std::ldexp(1.0, static_cast<int>(draw.uniform(-465, 465))),
                               shapes[draw.index(3)]),
                detail::scaled(draw.power_of_ten(-140, 140), direction));
  c.start.q = detail::any_attitude(draw);
  const double length = draw.power_of_ten(-140, 140);
  c.start.q = {length * c.start.q.w, length * c.start.q.x, length * c.start.q.y,
               length * c.start.q.z};
  detail::draw_times(c, draw);
  return c;
}

inline FreeCase long_time_case(Draw& draw) {
  FreeCase c;
  detail::Triple I{}, direction{};
  do {
    I = detail::triaxial_moments(draw);
    direction = detail::any_direction(draw);
  } while (std::abs(detail::relative_d2(I, direction)) < 1e-3);
  detail::place(c, draw, detail::scaled(draw.power_of_ten(-3, 3), I),
                detail::scaled(draw.power_of_ten(-3, 3), direction));
  c.start.q = detail::any_attitude(draw);
  if (draw.chance(0.5)) c.t0 = draw.uniform(-10.0, 10.0) * detail::turn_length(c);
  return c;
}

}  // namespace oracle
