// SPDX-License-Identifier: MIT
#include "polhode/output/columns.hpp"

#include <algorithm>
#include <iterator>

#include "output/detail/column_table.hpp"
#include "polhode/error.hpp"
#include "text/nearest.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::column_table;
using detail::GroupSpec;
using detail::Numbers;

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
  const std::string_view near = detail::nearest(name, known);
  return near.empty() ? "" : "; did you mean " + std::string(near) + "?";
}

std::size_t group_index(const std::string& name) {
  const std::span<const GroupSpec> specs = column_table();
  const auto found = std::find_if(specs.begin(), specs.end(),
                                  [&](const GroupSpec& spec) { return spec.name == name; });
  if (found != specs.end()) return static_cast<std::size_t>(found - specs.begin());
  throw DomainError("RowLayout: unknown column group \"" + name + "\"" +
                    did_you_mean(name, column_group_names()));
}

struct ColumnLocation {
  Numbers (*numbers)(const RowSample&);
  std::size_t index;
  Dimension dimension;
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

ColumnLocation place_of(std::string_view column) {
  for (const GroupSpec& spec : column_table())
    for (std::size_t i = 0; i < spec.columns.size() && !spec.columns[i].name.empty(); ++i)
      if (spec.columns[i].name == column) return {spec.numbers, i, spec.columns[i].dimension};
  throw DomainError("unknown column \"" + std::string(column) + "\"" +
                    did_you_mean(column, column_names()));
}

}  // namespace

std::vector<std::string_view> column_group_names() {
  std::vector<std::string_view> names;
  for (const GroupSpec& spec : column_table()) names.push_back(spec.name);
  return names;
}

std::vector<std::string_view> column_names() {
  std::vector<std::string_view> names;
  for (const GroupSpec& spec : column_table())
    for (const detail::ColumnSpec& column : spec.columns)
      if (!column.name.empty() && std::find(names.begin(), names.end(), column.name) == names.end())
        names.push_back(column.name);
  return names;
}

bool needs_energy(std::string_view group_or_column) {
  const std::string_view names[] = {"energy", "E", "dE"};
  return std::find(std::begin(names), std::end(names), group_or_column) != std::end(names);
}

Dimension column_dimension(std::string_view column) { return place_of(column).dimension; }

ScalarColumn scalar_column(std::string_view name, const System& system, double initial_energy) {
  const ColumnLocation place = place_of(name);
  return {place.dimension, [place, system, initial_energy](const DampedSample& at) {
            return of_row(RowOrigin{system, initial_energy}, at, place.numbers)[place.index];
          }};
}

RowLayout::RowLayout(std::span<const std::string> groups, const Units& units, Branch branch)
    : units_(units) {
  groups_.push_back({"t", {{"t", units.label(Dimension::time)}}});
  std::vector<std::string_view> taken;
  for (const std::string& name : groups) {
    const std::size_t group = group_index(name);
    const GroupSpec& spec = column_table()[group];
    ColumnGroup shown{name, {}};
    for (std::size_t i = 0; i < spec.columns.size(); ++i) {
      const detail::ColumnSpec& column = spec.columns[i];
      if (column.name.empty()) break;
      if (column.is_branch && branch == Branch::in_notes) continue;
      if (std::find(taken.begin(), taken.end(), column.name) != taken.end()) continue;
      taken.push_back(column.name);
      shown.columns.push_back({std::string(column.name), units.label(column.dimension)});
      cells_.push_back({group, i, column.dimension});
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
      numbers = column_table()[cell.group].numbers(sample);
    out[i + 1] = units_.from_core(numbers[cell.index], cell.dimension);
  }
}

void RowLayout::write_rows(const FreeRotation& motion, std::span<const double> times,
                           std::span<double> out) const {
  const System system(motion.body());
  const bool serret = std::any_of(cells_.begin(), cells_.end(), [](const Cell& cell) {
    return column_table()[cell.group].name == "serret";
  });
  const SerretState elements = serret ? to_serret(motion, 0.0) : SerretState{};
  RowSample sample{system,   energy(system, 0.0, motion.initial_state()), 0.0, {}, {}, &motion,
                   &elements};
  for (std::size_t k = 0; k < times.size(); ++k) {
    sample.t = times[k];
    sample.state = motion.at(times[k]);
    write_row(sample, out.subspan(k * width_, width_));
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
