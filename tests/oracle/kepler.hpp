// SPDX-License-Identifier: MIT
// Kepler's equation and motion on a conic at 76 digits, from the textbook form.
#pragma once

#include "oracle/wide_real.hpp"
#include "worst.hpp"

namespace oracle {

inline Wide wide_pi() { return 4 * atan(Wide(1)); }

// M = E - e sin E or e sinh H - H, M > 0 (E not reduced beyond 0 <= M <= pi), by Newton's method
// from the side where the convex function is positive: it descends to the root.
inline Wide kepler_root(const Wide& M, const Wide& e) {
  const bool ellipse = e < 1;
  const Wide gap = ellipse ? Wide(1 - e) : Wide(e - 1);
  // x^3 / pi^2 <= x - sin x on [0, pi], x^3 / 6 <= sinh x - x
  Wide x = cbrt((ellipse ? 10 : 6) * M / e);
  x = polhode::test::smaller(x, Wide(M / gap));
  if (ellipse && x > wide_pi()) x = wide_pi();
  if (!ellipse) x = asinh((M + x) / e);
  for (int step = 0; step < 60; ++step) {
    const Wide f = ellipse ? Wide(x - e * sin(x) - M) : Wide(e * sinh(x) - x - M);
    const Wide slope = ellipse ? Wide(1 - e * cos(x)) : Wide(e * cosh(x) - 1);
    const Wide d = f / slope;
    x -= d;
    if (abs(d) < x * Wide(1e-60)) break;
  }
  return x;
}

struct WideConic {
  Wide gm, pericentre, e, inclination, node, argument, n, pericentre_time;

  WideConic(const Wide& gm_, const Wide& q, const Wide& e_, const Wide& i, const Wide& node_,
            const Wide& argument_, const Wide& M0, const Wide& epoch)
      : gm(gm_), pericentre(q), e(e_), inclination(i), node(node_), argument(argument_) {
    const Wide a = q / abs(Wide(1 - e));
    n = sqrt(gm / (a * a * a));
    pericentre_time = epoch - M0 / n;
  }

  WideVec3 position(const Wide& t) const {
    Wide M = n * (t - pericentre_time);
    if (e < 1) M -= 2 * wide_pi() * round(M / (2 * wide_pi()));
    const Wide sign = M < 0 ? -1 : 1;
    const Wide E = M == 0 ? Wide(0) : kepler_root(abs(M), e);
    const Wide a = pericentre / (1 - e);
    const Wide x = e < 1 ? Wide(a * (cos(E) - e)) : Wide(a * (cosh(E) - e));
    const Wide y =
        sign * (e < 1 ? Wide(a * sqrt(1 - e * e) * sin(E)) : Wide(-a * sqrt(e * e - 1) * sinh(E)));
    return turned(x, y);
  }
  // By the difference quotient of fourth order.
  WideVec3 velocity(const Wide& t) const {
    const Wide h = Wide(1e-14) * sqrt(pericentre * pericentre * pericentre / gm);
    const WideVec3 near = position(t + h) - position(t - h);
    const WideVec3 far = position(t + 2 * h) - position(t - 2 * h);
    return Wide(1 / (12 * h)) * (Wide(8) * near - far);
  }

 private:
  WideVec3 turned(const Wide& x, const Wide& y) const {
    const Wide u = x * cos(argument) - y * sin(argument);
    const Wide v = x * sin(argument) + y * cos(argument);
    const Wide w = v * cos(inclination);
    return {u * cos(node) - w * sin(node), u * sin(node) + w * cos(node), v * sin(inclination)};
  }
};

}  // namespace oracle
