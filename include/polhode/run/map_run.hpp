// SPDX-License-Identifier: MIT
// In this header: map, map_run.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/column_kind.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// ScenarioMap: a scenario over a grid of its own numbers, one cell at a time.
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
//             or cannot go on has one row of NaN, and says why. cell_text throws DomainError for
//             an index that is out of range.
// Cost        its run, and some 20 us to make the experiment again: text is not read twice, and
//             tables, meshes and files are those of the scenario unless a number below them (or,
//             for positions of planets, the time of the run) is an axis.

struct MapCell {
  std::vector<double> numbers;  // of the results, row by row; NaN where the cell failed
  std::string failure;          // empty: it did not
};

class ScenarioMap {
 public:
  // `name` stands for the file in messages and outputs.
  ScenarioMap(std::string_view text, const std::string& name, const Kinds& kinds = default_kinds());
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
  std::vector<double> axis_values(std::int64_t index) const;
  // From any thread. What `progress` throws passes through.
  MapCell cell(std::int64_t index, const Progress& progress = {}) const;
  // The text of the scenario with the numbers of a cell, without its [map].
  std::string cell_text(std::int64_t index) const;
  // The scenario of this text, complete: it can be run and changed.
  Scenario cell_scenario(std::int64_t index) const {
    return cell_scenario(index, cell_text(index));
  }
  // The same for a caller that has the text.
  Scenario cell_scenario(std::int64_t index, std::string cell_text) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// MapRun: every cell of a map, on the processors of one machine or of several, into files that may
// be stopped, killed and resumed.
//
// Equations   those of the cells.
// Units       those of the map.
// Domain      rows go to the outputs in the order of the cells, block by block; files and
//             checkpoints as in polhode/run/scenario_run.hpp. Without outputs the rows go to
//             `extra_sink` alone.
// Accuracy    the files do not depend on the number of threads or processes (same build of polhode,
//             machines with the same elementary functions).
// Errors      the constructor as there, and DomainError for an executor with more processes than
//             cells. run() throws OutputError, ExecutorError, and RunInterrupted when `stop` said
//             so. If `progress` throws, the cells before it are kept.
// Cost        that of the cells. Memory does not grow with the number of cells, but for those that
//             fail, and for sections with how the numbers of their points change.

// What a map found, earlier parts of it included.
struct MapReport {
  struct Range {  // of a column, over the cells that did not fail; least > most: there is none
    double least;
    double most;
  };
  struct Failure {
    std::int64_t cell;
    std::string why;
  };
  struct Group {  // cells one after the other with as many rows each
    std::int64_t cells;
    std::int64_t rows;
  };

  std::int64_t cells = 0;
  std::int64_t points = 0;    // rows of cells that did not fail
  std::vector<Range> ranges;  // of the columns of results
  std::vector<Failure> failures;
  std::vector<Group> groups;
};

class MapRun : public ResumableRun {
 public:
  // Opens every output. `map` must outlive it.
  MapRun(const ScenarioMap& map, const std::vector<std::string>& outputs, RunOptions options);

  // Once.
  MapReport run();

 private:
  class Parts;
};

// The work of a process that computes cells of the map of a scenario for another process
// (RunOptions::executor). begin() throws DomainError for bytes of another map, with the difference;
// `any_machine` as in RunOptions.
std::unique_ptr<ensemble::ExecutorWork> map_work(Scenario scenario, bool any_machine = false);

}  // namespace io
}  // namespace v0
}  // namespace polhode
