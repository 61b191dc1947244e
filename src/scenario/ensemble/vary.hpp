// SPDX-License-Identifier: MIT
// From one table [[ensemble.vary]] to its distribution.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scenario/ensemble/ensemble_plan.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The parts of the two angles that draw a direction, as their keys name them.
struct DirectionAngles {
  std::size_t around;  // the place of the longitude among the two keys; the other one tilts
  bool from_pole;      // an inclination, 0 at the pole; or a latitude, 0 at the equator
};

// Of pole.longitude and pole.latitude, ra and dec, orbit.earth.node and orbit.earth.inclination, in
// either order; none where their names are those of no such pair.
std::optional<DirectionAngles> direction_angles(std::span<const std::string> keys);

// The numbers that a table varies, as the file has them.
struct VariedNumbers {
  std::vector<std::string> keys;
  std::vector<NumberLocation> places;
  std::vector<std::string> units;  // as outputs name them
  std::vector<double> values;      // in these units
};
VariedNumbers varied_numbers(const FileValues& at, const std::string& path);

struct VariedTable {
  EnsembleVaried varied;
  std::optional<Distribution> distribution;  // none of a grid
  std::optional<DrawAxis> axis;              // of a grid
};
VariedTable varied_table(const FileValues& at, const std::string& path,
                         const VariedNumbers& numbers);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
