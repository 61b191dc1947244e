// SPDX-License-Identifier: MIT
// The rows of a run in the columns that it asks for.
#include <algorithm>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/output/column_kind.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

namespace {

constexpr std::size_t times_at_once = 1024;  // so that memory does not grow with the rows

std::size_t group_index(const ColumnKinds& kinds, const std::string& name) {
  const ColumnKind* const found = kinds.group(name);
  if (found != nullptr) return static_cast<std::size_t>(found - kinds.all().data());
  throw DomainError("RowLayout: unknown column group \"" + name + "\"" +
                    detail::did_you_mean(name, column_group_names(kinds)));
}

// f(RowSample) of a sample, with the system at the rate of its damper.
template <class F>
auto of_row(const RowOrigin& origin, const Sample& at, const F& f) {
  const auto of = [&](const System& system) {
    return f(RowSample{system, origin.initial_energy, at.t, at.s, at.s.damper_rate});
  };
  return origin.system.damper() ? of(at_damper_rate(origin.system, at.s.damper_rate))
                                : of(origin.system);
}

bool is_shown(const GroupColumn& column, Branch branch, const RowReference& reference) {
  using enum Shown;
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

ScalarColumn scalar_column(std::string_view name, const System& system, double initial_energy,
                           const ColumnKinds& kinds) {
  const Dimension dimension = column_dimension(name, kinds);
  const ColumnKind& of = *kinds.of_column(name);
  const auto place = static_cast<std::size_t>(
      std::ranges::find(of.columns, name, &GroupColumn::name) - of.columns.begin());
  return {dimension, [numbers = of.numbers, place, system, initial_energy](const Sample& at) {
            return of_row(RowOrigin{system, initial_energy}, at,
                          [&](const RowSample& row) { return numbers(row)[place]; });
          }};
}

RowLayout::RowLayout(std::span<const std::string> groups, const Units& units, Branch branch,
                     const ColumnKinds& kinds, const RowReference& reference)
    : kinds_(kinds), units_(units) {
  groups_.push_back({"t", {{"t", units.label(Dimension::time)}}});
  std::vector<std::string_view> taken;
  for (const std::string& name : groups) {
    const std::size_t group = group_index(kinds_, name);
    const ColumnKind& kind = kinds_.all()[group];
    if (kind.is_date && reference.time_scale.empty())
      throw DomainError("RowLayout: column group \"date\" needs an epoch");
    ColumnGroup shown{name, {}};
    for (std::size_t place = 0; place < kind.columns.size(); ++place) {
      const GroupColumn& column = kind.columns[place];
      if (!is_shown(column, branch, reference)) continue;
      if (std::find(taken.begin(), taken.end(), column.name) != taken.end()) continue;
      taken.push_back(column.name);
      shown.columns.push_back({std::string(column.name),
                               kind.is_date ? reference.time_scale : units.label(column.dimension),
                               kind.is_date});
      cells_.push_back({group, place, column.dimension});
    }
    if (shown.columns.empty())
      throw DomainError("RowLayout: column group \"" + name + "\" is named twice");
    groups_.push_back(std::move(shown));
  }
  width_ = cells_.size() + 1;
}

void RowLayout::write_row(const RowSample& sample, std::span<const ColumnNumbers> constants,
                          std::span<double> out) const {
  out[0] = units_.from_core(sample.t, Dimension::time);
  ColumnNumbers numbers{};
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    if (i == 0 || cells_[i - 1].group != cell.group) {
      const ColumnKind& kind = kinds_.all()[cell.group];
      numbers =
          constants.empty() || !kind.is_constant ? kind.numbers(sample) : constants[cell.group];
    }
    out[i + 1] = units_.from_core(numbers[cell.place], cell.dimension);
  }
}

void RowLayout::write_rows(const FreeRotation& motion, std::span<const Sample> samples,
                           std::span<double> out) const {
  const System system(motion.body());
  const RotorState& start = motion.initial_state();
  RowSample row{system, energy(system, 0.0, start), motion.epoch(), start, {}, &motion};
  std::vector<ColumnNumbers> constants(kinds_.all().size());
  for (const Cell& cell : cells_)
    if (const ColumnKind& kind = kinds_.all()[cell.group]; kind.is_constant)
      constants[cell.group] = kind.numbers(row);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    row.t = samples[k].t;
    row.state = samples[k].s;
    write_row(row, constants, out.subspan(k * width_, width_));
  }
}

void RowLayout::write_rows(const FreeRotation& motion, std::span<const double> times,
                           std::span<double> out) const {
  std::vector<RotorState> states;
  std::vector<Sample> samples;
  for (std::size_t first = 0; first < times.size(); first += times_at_once) {
    const auto some = times.subspan(first, std::min(times_at_once, times.size() - first));
    states.resize(some.size());
    motion.at(some, states);
    samples.clear();
    for (std::size_t k = 0; k < some.size(); ++k) samples.push_back({some[k], states[k]});
    write_rows(motion, samples, out.subspan(first * width_, some.size() * width_));
  }
}

void RowLayout::write_rows(const RowOrigin& origin, std::span<const Sample> samples,
                           std::span<double> out) const {
  for (std::size_t k = 0; k < samples.size(); ++k)
    of_row(origin, samples[k],
           [&](const RowSample& row) { write_row(row, {}, out.subspan(k * width_, width_)); });
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
