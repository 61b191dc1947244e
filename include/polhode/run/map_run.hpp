// SPDX-License-Identifier: MIT
// MapRun: every cell of a map, on the processors of one machine or of several, into files that may
// be stopped, killed and resumed.
//
// Equations   those of the cells.
// Units       those of the map.
// Domain      rows go to the outputs in the order of the cells, block by block; files and
//             checkpoints as in polhode/run/resumable_run.hpp. Without outputs the rows go to
//             `extra_sink` alone.
// Accuracy    the files do not depend on the number of threads or processes (same build of polhode,
//             machines with the same elementary functions).
// Errors      the constructor as there, and DomainError for an executor with more processes than
//             cells. run() throws OutputError, ExecutorError, and RunInterrupted when `stop` said
//             so. If `progress` throws, the cells before it are kept.
// Cost        that of the cells. Memory does not grow with the number of cells, but for those that
//             fail, and for sections with how the numbers of their points change.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "polhode/run/map.hpp"
#include "polhode/run/resumable_run.hpp"

namespace polhode {
inline namespace v0 {

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
std::unique_ptr<ExecutorWork> map_work(Scenario scenario, bool any_machine = false);

}  // namespace v0
}  // namespace polhode
