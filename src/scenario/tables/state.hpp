// SPDX-License-Identifier: MIT
// [state]: the date of t = 0, the inertial axes, and the state of the body in one of its forms: as
// observers describe a tumbling body, an attitude with a rate, or the variables of a chart.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "polhode/scenario/rotation.hpp"
#include "polhode/tables/convert.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct StateTable {
  std::optional<std::string> epoch;
  std::optional<double> dut1;
  std::string axes = "inertial";
};
Placed<StateTable> state_table(const FileValues& file);

// The rows of [state] with a table for each chart that scenarios know. They must outlive part().
class StateRows : public TableRows {
 public:
  explicit StateRows(std::span<const ChartKind> charts);

 private:
  void add_chart(const ChartKind& chart);
};

// The form that the file has, "tumbler", and the state in it.
std::string state_form(const FileValues& file, std::span<const ChartKind> charts);
InitialState state_of(const FileValues& file, const std::string& form,
                      std::span<const ChartKind> charts, const Body& body);
// Refuses angles of a tumbler that its motion does not reach, in the units of the file.
void require_angles(const FileValues& file, const Body& body, const TumblerState& state);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
