// SPDX-License-Identifier: MIT
// ScenarioMap: a scenario over a grid of its own numbers, one cell at a time; and the rows of a map
// on their way to a file.
//
// Equations   those of chaos_indicator and of sections; or the extremes of a column over the rows
//             of [time].
// Units       those of the scenario: axes and results in the units of the file, the Lyapunov
//             indicator in 1 over its unit of time.
// Domain      a scenario with [map] and [time]. Cells are counted with the last axis the fastest.
//             Any number of the file may be an axis, perturbations and orbits included; of an array
//             one number: state.attitude-rate.omega_body[2], counted from 0. Every cell starts at
//             t = 0 and ends at the last row. A cell is one row of results, of a section one for
//             each of its points.
// Accuracy    axes are rounded once; the rest is that of the method.
// Errors      ScenarioError for what is no map. A cell that cannot be (a chart refuses its numbers)
//             or cannot go on has one row of NaN, and says why. DomainError and OutputError from
//             MapRows.
// Cost        a millisecond to read the scenario anew, one cell at a time, then its run.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/columns.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/trajectory/progress.hpp"

namespace polhode {
inline namespace v0 {

struct MapCell {
  std::vector<double> numbers;  // of the results, row by row; NaN where the cell failed
  std::string failure;          // empty: it did not
};

class ScenarioMap {
 public:
  // `name` stands for the file in messages and outputs.
  ScenarioMap(std::string_view text, const std::string& name);
  explicit ScenarioMap(Scenario scenario);
  ~ScenarioMap();
  ScenarioMap(const ScenarioMap&) = delete;
  ScenarioMap& operator=(const ScenarioMap&) = delete;

  const Scenario& scenario() const;
  const MapPlan& plan() const { return *scenario().map; }
  std::int64_t size() const;
  // The axes, one group each, then the results.
  std::vector<ColumnGroup> groups() const;
  // How many numbers of results a row has.
  std::size_t width() const;
  // The numbers of the axes at a cell.
  std::vector<double> place(std::int64_t index) const;
  // From any thread. What `progress` throws passes through.
  MapCell cell(std::int64_t index, const Progress& progress = {}) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The cells of a map as they come, kept in FIRST_FILE.cells: what a killed map goes on from. Cells
// are whole or they do not count.
class MapRows {
 public:
  // `outputs` as open_sink takes them; where none is a file nothing is kept. DomainError for
  // outputs that cannot be or that another process writes, for cells (or an unfinished run) that
  // are there when neither resume nor restart was asked for, and for cells of another map.
  MapRows(const ScenarioMap& map, std::vector<std::string> outputs, RunBegin begin,
          BeginWords words = {});
  ~MapRows();
  MapRows(const MapRows&) = delete;
  MapRows& operator=(const MapRows&) = delete;

  bool are_kept() const { return file_ != nullptr; }
  std::int64_t size() const { return static_cast<std::int64_t>(cells_.size()); }
  const std::vector<MapCell>& cells() const { return cells_; }
  void push(const MapCell& cell);
  // All rows so far, each with its place.
  void write(Sink& sink) const;
  // All rows to the outputs, which get their names; the cells go.
  void finish();

 private:
  void open();
  void read(RunBegin begin);
  void open_sinks();
  void put(const std::string& lines);
  std::string done_text() const;
  std::string next_text() const;

  const ScenarioMap& map_;
  std::vector<std::string> outputs_;
  BeginWords words_;
  std::string path_;
  std::string head_;
  std::FILE* file_ = nullptr;
  std::vector<MapCell> cells_;
  std::vector<std::unique_ptr<Sink>> sinks_;  // of the outputs, none of standard output
};

// Whether the map is complete in its outputs. DomainError where they are of another scenario, or
// cannot tell.
bool is_complete(const ScenarioMap& map, std::span<const std::string> outputs,
                 const BeginWords& words = {});

}  // namespace v0
}  // namespace polhode
