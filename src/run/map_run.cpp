// SPDX-License-Identifier: MIT
// The run of a map into files.
#include "polhode/run/map_run.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "polhode/run/run.hpp"
#include "run/detail/machine.hpp"
#include "run/detail/sweep.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr std::size_t longest_reason = 1000;

// Cells of a section have several rows.
Provenance provenance_of(const ScenarioMap& map) {
  Provenance origin = provenance(map.scenario());
  const MapPlan& plan = map.plan();
  const bool is_section =
      plan.kind == MapKind::andoyer_section || plan.kind == MapKind::spin_orbit_section;
  if (plan.axes.size() == 1 && !is_section) origin.row_dimension = plan.axes.front().key;
  return origin;
}

// Each reason once: many cells fail for the same one.
void serialize_failures(Archive& bytes, std::vector<MapReport::Failure>& failures) {
  std::vector<std::string> reasons;
  std::map<std::string, std::uint64_t> numbers;
  if (!bytes.reads())
    for (const MapReport::Failure& failure : failures)
      if (numbers.try_emplace(failure.why, reasons.size()).second) reasons.push_back(failure.why);
  bytes(reasons);
  bytes.list(failures, [&](MapReport::Failure& failure) {
    std::uint64_t number = bytes.reads() ? 0 : numbers.at(failure.why);
    bytes.all(failure.cell, number);
    if (bytes.reads()) failure.why = reasons.at(number);
  });
}

// The cells of a map on threads and in other processes.
class MapCells final : public detail::SourceWork {
 public:
  MapCells(const ScenarioMap& map, bool any_machine)
      : SourceWork(map.scenario(), "map", map.groups(), any_machine), map_(map) {}

  detail::Source<std::vector<MapCell>> cells(const detail::CellRange& range) {
    return {.range = range,
            .members =
                [this](std::int64_t begin, std::int64_t end, const Progress& look) {
                  std::vector<MapCell> some;
                  for (std::int64_t k = begin; k < end; ++k) some.push_back(map_.cell(k, look));
                  return some;
                },
            .work = this,
            .stage = [](Archive&) {},
            .serialize =
                [](Archive& bytes, std::vector<MapCell>& some) {
                  bytes.list(some, [&](MapCell& one) { bytes.all(one.numbers, one.failure); });
                }};
  }

 private:
  void begin_stage(const detail::CellRange& range, Archive&) override { computes(cells(range)); }

  const ScenarioMap& map_;
};

// What is reported of a map, cell after cell.
void add(MapReport& report, const MapCell& cell, std::size_t width) {
  const auto rows = static_cast<std::int64_t>(cell.numbers.size() / width);
  if (report.groups.empty() || report.groups.back().rows != rows)
    report.groups.push_back({0, rows});
  ++report.groups.back().cells;
  if (cell.failure.empty()) {
    report.points += rows;
    for (std::size_t k = 0; k < cell.numbers.size(); ++k) {
      MapReport::Range& range = report.ranges[k % width];
      if (cell.numbers[k] < range.least) range.least = cell.numbers[k];
      if (cell.numbers[k] > range.most) range.most = cell.numbers[k];
    }
  } else {
    report.failures.push_back({report.cells, detail::printable(cell.failure, longest_reason)});
  }
  ++report.cells;
}

}  // namespace

class MapRun::Parts final : public detail::Sweep {
 public:
  Parts(const ScenarioMap& map, const std::vector<std::string>& paths, RunOptions options)
      : Sweep(map.scenario(),
              detail::with_machine(detail::setup_of_tables({"map", "runs this one anew"},
                                                           map.scenario(), map.groups(), paths),
                                   options),
              map.groups(), provenance_of(map), std::move(options)),
        map_(map),
        cells_(map, options_.any_machine),
        width_(map.width()) {
    require_cells_for_all(map.size(), "map", "cells", "cell");
    constexpr double infinity = std::numeric_limits<double>::infinity();
    report_.ranges.assign(width_, {infinity, -infinity});
    if (outputs_.is_complete()) return;
    resume();
    open();
  }

  MapReport run() {
    if (outputs_.is_complete()) return report_;
    outputs_.with_remedy([&] {
      compute(cells_.cells({report_.cells, map_.size(), together()}),
              [&](std::int64_t, const std::vector<MapCell>& some) {
                for (const MapCell& cell : some) reduce(cell);
              });
      push_rows();
      for (const std::unique_ptr<Sink>& sink : sinks_) sink->finish();
      outputs_.forget();
    });
    return std::move(report_);
  }

 private:
  void serialize(Archive& bytes) override {
    bytes.all(report_.cells, report_.points);
    bytes.list(report_.ranges, [&](MapReport::Range& r) { bytes.all(r.least, r.most); });
    serialize_failures(bytes, report_.failures);
    bytes.list(report_.groups, [&](MapReport::Group& g) { bytes.all(g.cells, g.rows); });
    serialize_rows(bytes);
  }
  double reached() const override { return static_cast<double>(report_.cells); }
  detail::CheckpointPlace place() const override { return place_among(map_.size(), "cells"); }

  // Cells that go together: a message costs as much as a short cell. An executor that does not say
  // how many cells it computes at a time joins short ones itself.
  std::int64_t together() const {
    constexpr std::int64_t most = 16, messages = 32;  // of each worker
    const std::int64_t workers = options_.executor == nullptr ? 1 : options_.executor->at_a_time();
    return workers == 1 ? 1 : std::clamp<std::int64_t>(map_.size() / (messages * workers), 1, most);
  }

  void reduce(const MapCell& cell) {
    const std::vector<double> axes = map_.axis_values(report_.cells);
    for (std::size_t k = 0; k < cell.numbers.size(); k += width_) {
      add_rows(axes);
      add_rows(std::span(cell.numbers).subspan(k, width_));
    }
    add(report_, cell, width_);
  }

  const ScenarioMap& map_;
  MapCells cells_;
  std::size_t width_;
  MapReport report_;
};

MapRun::MapRun(const ScenarioMap& map, const std::vector<std::string>& outputs, RunOptions options)
    : ResumableRun(std::make_unique<Parts>(map, outputs, std::move(options))) {}
MapReport MapRun::run() { return static_cast<Parts&>(*sweep_).run(); }

std::unique_ptr<ensemble::ExecutorWork> map_work(Scenario scenario, bool any_machine) {
  return detail::work_of<MapCells, ScenarioMap>(std::move(scenario), any_machine);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
