// SPDX-License-Identifier: MIT
// The light time as the root of tau = length(tau) / c, and what is said where there is none.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace light {
namespace detail {

[[noreturn]] void fail_light_time(const LightCurve& curve, std::size_t point, const char* what);
void require_speed_of_light(double c);

// Of light that arrives or leaves at t. NaN where it does not converge: at most 50 rounds, of which
// a body of a thousandth of c needs 6.
template <class Length>
double light_time_root(const Length& length_at, double t, double c) {
  constexpr double few_roundings = 4.0 * std::numeric_limits<double>::epsilon();
  double tau = 0.0;
  for (int round = 0; round < 50; ++round) {
    const double next = length_at(tau) / c;
    if (std::abs(next - tau) <= few_roundings * (std::abs(next) + std::abs(t))) return next;
    tau = next;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace detail
}  // namespace light
}  // namespace v0
}  // namespace polhode
