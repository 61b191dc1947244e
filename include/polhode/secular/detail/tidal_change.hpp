// SPDX-License-Identifier: MIT
// What tides do to a spin while the orbit stays.
#pragma once

#include "polhode/secular/detail/spin_model.hpp"
#include "polhode/secular/tides.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

// How s, w and a change by tides alone.
TidalSpin tidal_change(const TidalRates& tides, double e2, const Vec3& n, const TidalSpin& at);
inline TidalSpin plus(const TidalSpin& at, double h, const TidalSpin& change) {
  return {at.s + h * change.s, at.spin + h * change.spin, at.distance + h * change.distance};
}

// The state after h of tides and of a turn about -n at rate(state). Tides move s in the plane of s
// and n, and what they do does not depend on where that plane has turned to: one step of order 4
// moves s in it, w and a, and adds up the turn.
template <class Rate>
TidalSpin tidal_step(const TidalRates& tides, double e2, const Vec3& n, const TidalSpin& at,
                     double h, const Rate& rate) {
  const TidalSpin k1 = tidal_change(tides, e2, n, at), at2 = plus(at, 0.5 * h, k1),
                  k2 = tidal_change(tides, e2, n, at2), at3 = plus(at, 0.5 * h, k2),
                  k3 = tidal_change(tides, e2, n, at3), at4 = plus(at, h, k3),
                  k4 = tidal_change(tides, e2, n, at4);
  TidalSpin next = plus(plus(at, h / 6.0, k1), h / 6.0, k4);
  next = plus(plus(next, h / 3.0, k2), h / 3.0, k3);
  const double turn = h / 6.0 * (rate(at) + 2.0 * (rate(at2) + rate(at3)) + rate(at4));
  // not a number where a satellite has come down: the run says so
  next.s = turned({(1.0 / norm(next.s)) * next.s}, n, -turn).s;
  return next;
}

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
