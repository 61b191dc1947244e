// SPDX-License-Identifier: MIT
// Which of two angles that draw a direction goes round, and from where the other one counts: their
// keys say it.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace polhode {
inline namespace v0 {
namespace detail {

struct DirectionAngles {
  std::size_t around;  // the place of the longitude among the two keys; the other one tilts
  bool from_pole;      // an inclination, 0 at the pole; or a latitude, 0 at the equator
};

// Of pole.longitude and pole.latitude, ra and dec, orbit.earth.node and orbit.earth.inclination, in
// either order; none where their names are those of no such pair.
std::optional<DirectionAngles> direction_angles(std::span<const std::string> keys);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
