// SPDX-License-Identifier: MIT
// From the values of a file to a torque that is a table of time.
#include <filesystem>

#include "polhode/perturb/torque_table.hpp"
#include "polhode/tables/number_table.hpp"
#include "scenario/detail/perturbation_kinds.hpp"
#include "scenario/detail/table_check.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

const std::vector<double>& column(const TermContext& at, const char* own) {
  return value_at(at.values, at.key(own)).numbers;
}

// The columns of a file, side by side.
std::vector<TorqueRow> rows_at(const TermContext& at) {
  const std::vector<double>& t = column(at, "times");
  std::vector<TorqueRow> rows(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) rows[i].t = t[i];
  const char* const names[] = {"torque_1", "torque_2", "torque_3"};
  for (int axis = 0; axis < 3; ++axis) {
    if (!has(at.values, at.key(names[axis]))) continue;  // no torque about that axis
    const std::vector<double>& u = column(at, names[axis]);
    if (u.size() != t.size())
      refuse(at.values, at.key(names[axis]), at.name,
             "expected " + std::to_string(t.size()) + " numbers, as many as times has");
    for (std::size_t i = 0; i < t.size(); ++i) rows[i].torque[axis] = u[i];
  }
  return rows;
}

// What one unit of a column is in core units.
double unit_of(const TermContext& at, const char* own, Dimension dimension) {
  if (!has(at.values, at.key(own))) return 1.0;
  return built(at.values, at.key(own), at.name,
               [&] { return at.units.to_core(1.0, word(at.values, at.key(own)), dimension); });
}

std::vector<TorqueRow> rows_of_file(const TermContext& at) {
  const std::string key = at.key("file");
  const std::string path =
      (std::filesystem::path(at.name).parent_path() / word(at.values, key)).string();
  std::vector<std::string> columns{"1", "2", "3", "4"};
  if (has(at.values, at.key("columns"))) columns = value_at(at.values, at.key("columns")).words;
  if (columns.size() != 4)
    refuse(at.values, at.key("columns"), at.name, "expected 4 columns: time and three torques");
  const double time = unit_of(at, "time_unit", Dimension::time);
  const double torque = unit_of(at, "torque_unit", Dimension::torque);
  const NumberTable table = built(at.values, key, at.name, [&] {
    NumberTable read = read_number_table(path, columns);
    require_rising(read, 0, "time");
    const TableCheck check({at.values, at.units, at.path, at.name}, read, columns);
    check.unit(0, {"time_unit", time, Dimension::time});
    for (std::size_t k = 1; k < columns.size(); ++k)
      check.unit(k, {"torque_unit", torque, Dimension::torque});
    check.epoch();
    check.torque_axes(word(at.values, at.key("axes")));
    return read;
  });
  std::vector<TorqueRow> rows;
  rows.reserve(table.rows());
  const auto& c = table.columns;
  for (std::size_t k = 0; k < table.rows(); ++k)
    rows.push_back({time * c[0][k], {torque * c[1][k], torque * c[2][k], torque * c[3][k]}});
  return rows;
}

// Keys that belong to the other way of giving rows.
void require_one_way(const TermContext& at, bool by_file) {
  for (const char* own : {"columns", "time_unit", "torque_unit"})
    if (!by_file && is_explicit(at.values, at.key(own)))
      refuse(at.values, at.key(own), at.name, "expected a key file as well");
  for (const char* own : {"torque_1", "torque_2", "torque_3"})
    if (by_file && is_explicit(at.values, at.key(own)))
      refuse(at.values, at.key(own), at.name, "expected a key times as well, not file");
}

}  // namespace

AnyPerturbation torque_table_term(const TermContext& at) {
  using Between = TorqueTable::Between;
  using Outside = TorqueTable::Outside;
  const bool by_file = has(at.values, at.key("file"));
  require_one_way(at, by_file);
  std::vector<TorqueRow> rows = by_file ? rows_of_file(at) : rows_at(at);
  const std::string &between = word(at.values, at.key("between")),
                    &outside = word(at.values, at.key("outside"));
  TorqueTable::Rules rules;
  rules.between = between == "step"     ? Between::step
                  : between == "linear" ? Between::linear
                                        : Between::cubic;
  rules.outside = outside == "zero"   ? Outside::zero
                  : outside == "hold" ? Outside::hold
                                      : Outside::refuse;
  if (word(at.values, at.key("axes")) == "inertial") {
    rules.axes = SpaceAxes::inertial;
  } else {
    for (TorqueRow& row : rows) row.torque = principal_components(at, row.torque);
  }
  return built(at.values, at.key(by_file ? "file" : "times"), at.name, [&]() -> AnyPerturbation {
    return {"torque table", TorqueTable(rows, rules)};
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
