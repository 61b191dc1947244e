// SPDX-License-Identifier: MIT
// From one table [[ensemble.vary]] to its distribution.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/detail/scenario/ensemble_plan.hpp"
#include "scenario/number_location.hpp"
#include "scenario/table.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

enum class VaryKind {
  normal,
  uniform,
  log_uniform,
  joint_normal,
  direction,
  attitude,
  grid,
  table
};

struct VaryTable {
  VaryKind kind = VaryKind::normal;
  std::string key;                // of kinds that draw one number
  std::vector<std::string> keys;  // of those that draw several
  std::optional<double> mean, low, high;
  double sigma = 0.0;
  std::optional<std::vector<double>> means;
  SquareMatrix covariance;
  double from = 0.0, to = 0.0;
  std::int64_t count = 1;
  std::string file;
  std::optional<std::vector<std::string>> columns;
  ensemble::RowOrder order = ensemble::RowOrder::in_order;
};
extern const Table<VaryTable> vary_description;

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
// `name` is that of the key of the table which holds their key or keys.
VariedNumbers varied_numbers(const KeyValues& table, std::string_view name);

struct VariedTable {
  EnsembleVaried varied;
  ensemble::Distribution distribution;  // a grid has its own axis alone
};
VariedTable varied_table(const Placed<VaryTable>& table, const VariedNumbers& numbers);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
