// SPDX-License-Identifier: MIT
// MapRun: every cell of a map, on the processors of one machine, into files that may be stopped,
// killed and continued.
//
// Equations   those of the cells.
// Units       those of the map.
// Domain      rows go to the outputs in the order of the cells, block by block. While it goes on,
//             FIRST_OUTPUT.checkpoint says how to go on, as that of a run does
//             (polhode/run/scenario_run.hpp). Outputs that are not files ("-", a pipe, a device)
//             make a map without checkpoints; without outputs its rows go to `extra_sink` alone.
// Accuracy    the files do not depend on the number of threads, nor on where a map was stopped,
//             killed and continued, however often: text files byte for byte, HDF5 with the same
//             contents (same build of polhode).
// Errors      the constructor throws DomainError as that of ScenarioRun. run() throws OutputError,
//             and MapInterrupted when `stop` said so. What `progress` throws ends the map and
//             passes through; the cells before it are kept.
// Cost        that of the cells. Memory does not grow with the number of cells, but for those that
//             fail, and for sections with how the numbers of their points change.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "polhode/output/sink.hpp"
#include "polhode/run/map.hpp"
#include "polhode/run/scenario_run.hpp"

namespace polhode {
inline namespace v0 {

// The map was stopped from outside. Its files are there, up to a cell.
class MapInterrupted : public std::runtime_error {
 public:
  MapInterrupted(const std::string& what, std::int64_t done, bool resumes)
      : std::runtime_error(what), cells(done), can_resume(resumes) {}
  std::int64_t cells;
  bool can_resume;  // whether there is a checkpoint of that moment
};

struct MapOptions {
  RunBegin begin = RunBegin::anew;
  double checkpoint_seconds = 5.0;  // between two checkpoints, at least
  int threads = 0;                  // cells at a time; 0: one on each processor
  // Called after each cell with their number so far, one call after the other, from any thread.
  std::function<void(std::int64_t cells)> progress = {};
  std::function<bool()> stop = {};        // asked after every step, from any thread
  std::unique_ptr<Sink> extra_sink = {};  // gets the rows of this part of the map too
  BeginWords words = {};
};

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

class MapRun {
 public:
  // Opens every output. `map` must outlive it.
  MapRun(const ScenarioMap& map, const std::vector<std::string>& outputs, MapOptions options);
  ~MapRun();
  MapRun(const MapRun&) = delete;
  MapRun& operator=(const MapRun&) = delete;

  // What it found: a map to continue, after cells() with rows() in its files; or all files
  // complete, nothing to do.
  bool continues() const;
  bool is_complete() const;
  std::int64_t cells() const;
  std::int64_t rows() const;

  // Once.
  MapReport run();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace v0
}  // namespace polhode
