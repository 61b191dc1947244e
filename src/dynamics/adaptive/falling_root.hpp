// SPDX-License-Identifier: MIT
// Where a switching function falls through zero within a step.
#pragma once

#include <cmath>
#include <utility>

namespace polhode {
inline namespace v0 {
namespace detail {

// f is taken for positive at a; it is negative at b. x is the first try, `slope` that of f there or
// NaN. Secants, and a bisection where they leave the bracket and at every fourth trip: at most 200,
// and three as a rule.
template <class F>
double falling_root(const F& f, double a, double b, double x, double slope, double close) {
  if (!(a < x && x < b)) x = 0.5 * (a + b);
  double last = x, f_last = 0.0;
  for (int trip = 0; trip < 200; ++trip) {
    const double y = f(x);
    if (y == 0.0) return x;
    (y < 0.0 ? b : a) = x;
    if (trip > 0) slope = (y - f_last) / (x - last);
    double next = x - y / slope;
    if (trip % 4 == 3 || !(a < next && next < b)) next = 0.5 * (a + b);
    if (std::fabs(next - x) <= close || b - a <= close) return next;
    last = std::exchange(x, next);
    f_last = y;
  }
  return x;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
