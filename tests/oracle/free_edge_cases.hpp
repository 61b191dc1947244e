// SPDX-License-Identifier: MIT
// Free rotations past the edges: far beyond what an instrument measures, but numbers that doubles
// hold. Each class is drawn apart from the others (tests/oracle/free_cases.hpp has the hard ones).
#pragma once

#include <utility>

#include "oracle/free_cases.hpp"
#include "oracle/wide_real.hpp"

namespace oracle {

FreeCase middle_spin_case(Draw& draw);       // g across the middle axis of 1e-310 .. 1e-8 of G
FreeCase full_moments_case(Draw& draw);      // |2TI2/G^2 - 1| of 1e-30 .. 1e-9, 53-bit moments
FreeCase close_separatrix_case(Draw& draw);  // the same, 1e-15, times to be set
FreeCase extreme_momentum_case(Draw& draw);  // |g| of 1e-160 or 1e300, moments of order one

// One of the two transverse components is smaller still, or 0.
inline FreeCase middle_spin_case(Draw& draw) {
  const auto small = [&draw] {
    return draw.sign() * (draw.chance(0.15)  ? 0.0
                          : draw.chance(0.5) ? draw.power_of_ten(-310, -160)
                                             : draw.power_of_ten(-160, -8));
  };
  FreeCase c;
  const double scale = draw.power_of_ten(-3, 3), G = draw.chance(0.5) ? 1.0 : scale;
  double lo = small(), hi = small();
  if (draw.chance(0.5)) hi = lo * draw.power_of_ten(-3, 0);
  if (lo == 0.0 && hi == 0.0) lo = 1e-300;
  detail::place(c, draw, detail::scaled(draw.power_of_ten(-3, 3), detail::triaxial_moments(draw)),
                {G * lo, draw.sign() * G, G * hi});
  c.start.q = detail::any_attitude(draw);
  detail::draw_times(c, draw);
  // the body leaves the axis in some -ln(distance) / (2 pi) turns: up to 500 are needed to be there
  if (draw.chance(0.5)) set_time(c, draw.uniform(-500.0, 500.0));
  return c;
}

namespace detail {

// Moments of 53 bits, and a momentum whose |2TI2/G^2 - 1| is about `relative`: on the separatrix
// g3 / g1 is a root, and a convergent p / q of its continued fraction misses it by some 1 / q^2.
inline FreeCase at_distance(Draw& draw, double relative) {
  using Exact = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<154>,
                                              boost::multiprecision::et_off>;
  FreeCase c;
  const Triple I = triaxial_moments(draw);
  const Exact I1(I[0]), I2(I[1]), I3(I[2]);
  Exact rest = sqrt(Exact((I2 - I1) * I3 / ((I3 - I2) * I1)));
  double p = 1.0, q = 0.0, p_before = 0.0, q_before = 1.0;
  while (q * q * relative < 1.0) {  // 80 trips
    const auto whole = static_cast<double>(Exact(floor(rest)));
    const double next_p = whole * p + p_before, next_q = whole * q + q_before;
    if (!(next_p < 0x1p53 && next_q < 0x1p53)) break;
    p_before = std::exchange(p, next_p);
    q_before = std::exchange(q, next_q);
    rest = 1 / (rest - floor(rest));
  }
  const double scale = std::ldexp(1.0, static_cast<int>(draw.index(7)) - 3 - std::ilogb(p + q));
  const double middle = (p + q) * scale * draw.power_of_ten(-1, 1);
  place(c, draw, I, {draw.sign() * q * scale, draw.sign() * middle, draw.sign() * p * scale});
  c.start.q = any_attitude(draw);
  return c;
}

}  // namespace detail

inline FreeCase full_moments_case(Draw& draw) {
  FreeCase c = detail::at_distance(draw, draw.power_of_ten(-30, -9));
  detail::draw_times(c, draw);
  return c;
}

inline FreeCase close_separatrix_case(Draw& draw) {
  FreeCase c = detail::at_distance(draw, 1e-15);
  if (draw.chance(0.5)) c.t0 = draw.uniform(-10.0, 10.0) * detail::turn_length(c);
  return c;
}

inline FreeCase extreme_momentum_case(Draw& draw) {
  FreeCase c;
  const double size =
      draw.chance(0.5) ? draw.power_of_ten(-160, -150) : draw.power_of_ten(290, 304);
  detail::Triple direction = detail::any_direction(draw);
  if (draw.chance(0.25))
    direction = detail::direction_near_axis(draw, draw.index(3), draw.power_of_ten(-14, -3));
  detail::place(c, draw, detail::triaxial_moments(draw), detail::scaled(size, direction));
  c.start.q = detail::any_attitude(draw);
  detail::draw_times(c, draw);
  return c;
}

}  // namespace oracle
