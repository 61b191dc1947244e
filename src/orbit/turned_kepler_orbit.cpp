// SPDX-License-Identifier: MIT
#include "polhode/orbit/turned_kepler_orbit.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

TurnedKeplerOrbit::TurnedKeplerOrbit(const PrecessingKeplerOrbit& orbit, double angle)
    : orbit_(orbit), angle_(angle), sine_(std::sin(angle)), cosine_(std::cos(angle)) {
  if (!std::isfinite(angle))
    throw DomainError("TurnedKeplerOrbit: angle " + detail::number_text(angle) + " must be finite");
}

}  // namespace v0
}  // namespace polhode
