// SPDX-License-Identifier: MIT
#include "polhode/output/columns.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "output/detail/column_table.hpp"
#include "polhode/error.hpp"
#include "text/nearest.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::ColumnSpec;
using detail::ColumnTable;
using detail::GroupSpec;
using detail::Numbers;

constexpr std::size_t states_at_a_time = 64;  // of a free motion, in the lanes of the processor

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
  const std::string_view near = detail::nearest(name, known);
  return near.empty() ? "" : "; did you mean " + std::string(near) + "?";
}

// Made once for the charts that nearly everybody has.
std::shared_ptr<const ColumnTable> table_of(std::span<const ChartKind> charts) {
  static const auto ours = std::make_shared<const ColumnTable>(default_charts());
  const bool are_ours =
      charts.data() == default_charts().data() && charts.size() == default_charts().size();
  return are_ours ? ours : std::make_shared<const ColumnTable>(charts);
}

std::size_t group_index(const ColumnTable& table, const std::string& name,
                        std::span<const ChartKind> charts) {
  const std::span<const GroupSpec> groups = table.groups();
  const auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const GroupSpec& group) { return group.name == name; });
  if (found != groups.end()) return static_cast<std::size_t>(found - groups.begin());
  throw DomainError("RowLayout: unknown column group \"" + name + "\"" +
                    did_you_mean(name, column_group_names(charts)));
}

struct ColumnLocation {
  std::shared_ptr<const ColumnTable> table;
  std::size_t group;
  ColumnSpec column;
};

// f(RowSample) of a sample, with the system at the rate of its damper.
template <class F>
auto of_row(const RowOrigin& origin, const DampedSample& at, const F& f) {
  const auto of = [&](const System& system) {
    return f(RowSample{system, origin.initial_energy, at.t, at.s.rotor, at.s.damper_rate});
  };
  return origin.system.damper() ? of(at_damper_rate(origin.system, at.s.damper_rate))
                                : of(origin.system);
}

ColumnLocation location_of(std::string_view name, std::span<const ChartKind> charts) {
  std::shared_ptr<const ColumnTable> table = table_of(charts);
  for (std::size_t group = 0; group < table->groups().size(); ++group)
    for (const ColumnSpec& column : table->groups()[group].columns)
      if (column.name == name && !table->groups()[group].is_date)
        return {std::move(table), group, column};
  throw DomainError("unknown column \"" + std::string(name) + "\"" +
                    did_you_mean(name, column_names(charts)));
}

bool is_shown(const ColumnSpec& column, Branch branch, const RowReference& reference) {
  using enum detail::Shown;
  switch (column.shown) {
    case on_branch:
      return branch == Branch::in_columns;
    case equatorial:
      return reference.is_equatorial;
    case not_equatorial:
      return !reference.is_equatorial;
    case always:
      break;
  }
  return true;
}

}  // namespace

std::vector<std::string_view> column_group_names(std::span<const ChartKind> charts) {
  std::vector<std::string_view> names;
  const std::shared_ptr<const ColumnTable> table = table_of(charts);
  for (const GroupSpec& group : table->groups()) names.push_back(group.name);
  return names;
}

std::vector<std::string_view> column_names(std::span<const ChartKind> charts) {
  std::vector<std::string_view> names;
  const std::shared_ptr<const ColumnTable> table = table_of(charts);
  for (const GroupSpec& group : table->groups())
    for (const ColumnSpec& column : group.columns)
      if (!group.is_date && std::find(names.begin(), names.end(), column.name) == names.end())
        names.push_back(column.name);
  return names;
}

bool needs_energy(std::string_view group_or_column) {
  const std::string_view names[] = {"energy", "E", "dE"};
  return std::find(std::begin(names), std::end(names), group_or_column) != std::end(names);
}

Dimension column_dimension(std::string_view column, std::span<const ChartKind> charts) {
  return location_of(column, charts).column.dimension;
}

ScalarColumn scalar_column(std::string_view name, const System& system, double initial_energy,
                           std::span<const ChartKind> charts) {
  const ColumnLocation of = location_of(name, charts);
  return {of.column.dimension, [of, system, initial_energy](const DampedSample& at) {
            return of_row(RowOrigin{system, initial_energy}, at, [&](const RowSample& row) {
              return numbers_of(of.table->groups()[of.group], row)[of.column.place];
            });
          }};
}

std::string branch_note(std::string_view group, const FreeRotation& motion,
                        std::span<const ChartKind> charts) {
  const ChartKind* const chart = chart_named(group, charts);
  if (chart == nullptr || chart->from_motion == nullptr || chart->options.empty()) return {};
  const ChartNumbers numbers = chart->from_motion(motion, 0.0);
  std::string note;
  for (std::size_t i = 0; i < chart->options.size(); ++i) {
    const ChartOption& option = chart->options[i];
    const std::string_view word = option_word(option, numbers[chart->variables.size() + i]);
    if (word.empty()) continue;  // says nothing here
    note += (note.empty() ? "" : ", ") + std::string(option.name) + " " + std::string(word);
  }
  return std::string(group) + ": " + note;
}

RowLayout::RowLayout(std::span<const std::string> groups, const Units& units, Branch branch,
                     std::span<const ChartKind> charts, const RowReference& reference)
    : table_(table_of(charts)), units_(units) {
  groups_.push_back({"t", {{"t", units.label(Dimension::time)}}});
  std::vector<std::string_view> taken;
  for (const std::string& name : groups) {
    const std::size_t group = group_index(*table_, name, charts);
    const bool is_date = table_->groups()[group].is_date;
    if (is_date && reference.time_scale.empty())
      throw DomainError("RowLayout: column group \"date\" needs an epoch");
    ColumnGroup shown{name, {}};
    for (const ColumnSpec& column : table_->groups()[group].columns) {
      if (!is_shown(column, branch, reference)) continue;
      if (std::find(taken.begin(), taken.end(), column.name) != taken.end()) continue;
      taken.push_back(column.name);
      shown.columns.push_back({std::string(column.name),
                               is_date ? reference.time_scale : units.label(column.dimension),
                               is_date});
      cells_.push_back({group, column.place, column.dimension});
    }
    if (shown.columns.empty())
      throw DomainError("RowLayout: column group \"" + name + "\" is named twice");
    groups_.push_back(std::move(shown));
  }
  width_ = cells_.size() + 1;
}

void RowLayout::write_row(const RowSample& sample, std::span<double> out) const {
  out[0] = units_.from_core(sample.t, Dimension::time);
  Numbers numbers{};
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    if (i == 0 || cells_[i - 1].group != cell.group)
      numbers = sample.constants.empty() || !table_->is_constant(cell.group)
                    ? numbers_of(table_->groups()[cell.group], sample)
                    : sample.constants[cell.group];
    out[i + 1] = units_.from_core(numbers[cell.place], cell.dimension);
  }
}

void RowLayout::write_rows(const FreeRotation& motion, std::span<const double> times,
                           std::span<double> out) const {
  const System system(motion.body());
  const RotorState& start = motion.initial_state();
  RowSample sample{system, energy(system, 0.0, start), motion.epoch(), start, {}, &motion, {}};
  std::vector<Numbers> constants(table_->groups().size());
  for (const Cell& cell : cells_)
    if (table_->is_constant(cell.group))
      constants[cell.group] = numbers_of(table_->groups()[cell.group], sample);
  sample.constants = constants;
  std::array<RotorState, states_at_a_time> states;
  for (std::size_t first = 0; first < times.size(); first += states.size()) {
    const std::size_t count = std::min(states.size(), times.size() - first);
    motion.at(times.subspan(first, count), std::span(states).first(count));
    for (std::size_t k = 0; k < count; ++k) {
      sample.t = times[first + k];
      sample.state = states[k];
      write_row(sample, out.subspan((first + k) * width_, width_));
    }
  }
}

void RowLayout::write_rows(const RowOrigin& origin, std::span<const DampedSample> samples,
                           std::span<double> out) const {
  for (std::size_t k = 0; k < samples.size(); ++k)
    of_row(origin, samples[k],
           [&](const RowSample& row) { write_row(row, out.subspan(k * width_, width_)); });
}

}  // namespace v0
}  // namespace polhode
