// SPDX-License-Identifier: MIT
// From the values of a file to a torque that is a table of time.
#include "io/detail/perturbation_kinds.hpp"
#include "io/detail/value_access.hpp"
#include "polhode/perturb/torque_table.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

const std::vector<double>& column(const TermPlace& at, const char* own) {
  return value_at(at.values, at.key(own)).numbers;
}

// The columns of a file, side by side.
std::vector<TorqueRow> rows_at(const TermPlace& at) {
  const std::vector<double>& t = column(at, "times");
  std::vector<TorqueRow> rows(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) rows[i].t = t[i];
  const char* const names[] = {"torque_1", "torque_2", "torque_3"};
  for (int axis = 0; axis < 3; ++axis) {
    if (!there(at.values, at.key(names[axis]))) continue;  // no torque about that axis
    const std::vector<double>& u = column(at, names[axis]);
    if (u.size() != t.size())
      refuse(at.values, at.key(names[axis]), at.name,
             "expected " + std::to_string(t.size()) + " numbers, as many as times has");
    for (std::size_t i = 0; i < t.size(); ++i) rows[i].torque[axis] = u[i];
  }
  return rows;
}

}  // namespace

AnyPerturbation torque_table_term(const TermPlace& at) {
  using Between = TorqueTable::Between;
  using Outside = TorqueTable::Outside;
  std::vector<TorqueRow> rows = rows_at(at);
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
  return built(at.values, at.key("times"), at.name, [&]() -> AnyPerturbation {
    return {"torque table", TorqueTable(rows, rules)};
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
