// SPDX-License-Identifier: MIT
// [time]: the times of the rows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "polhode/scenario/rotation.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct TimeTable {
  double start = 0.0;
  std::optional<double> stop;
  std::optional<NumberOrAuto> step;
  std::optional<double> error;
  std::int64_t count = 0;
  std::optional<std::vector<double>> at;

  // True for step = "auto".
  bool is_automatic() const { return step && step->is_auto; }
};
SchemaPart time_keys();
Placed<TimeTable> time_table(const FileValues& file);

// A step is one from start towards stop; `any_sign`: whatever its sign is. None without [time].
std::optional<SaveAt> times_of(const Placed<TimeTable>& time, bool any_sign = false);
// step = "auto": start and stop, and the rows between them.
SaveAt automatic_span(const Placed<TimeTable>& time);
SaveAt automatic_times(const Rotation& rotation, const Placed<TimeTable>& time);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
