// SPDX-License-Identifier: MIT
// Sink: where a run puts its rows, block by block, so that any number of rows needs constant
// memory. CSV, HDF5 and CCSDS AEM files are sinks.
//
// Equations   none.
// Units       those that the columns name.
// Domain      open_sink: "-" (CSV to standard output), PATH.csv, PATH.h5 or PATH.aem. A file is
//             written as PATH.part, flushed after each block, and renamed by finish(); a run that
//             fails or is killed leaves PATH.part, readable up to its last block, and PATH as it
//             was. With a position, open_sink cuts PATH.part back to it and goes on from there.
// Accuracy    CSV numbers are the shortest that read back to the same double; HDF5 holds doubles.
// Errors      DomainError for a path that cannot be an output, and for a PATH.part that is not what
//             a position belongs to; OutputError when writing fails.
// Cost        CSV about 60 ns per number. No time stamps: equal runs give equal files.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "polhode/output/aem_options.hpp"
#include "polhode/output/columns.hpp"

namespace polhode {
inline namespace v0 {

// A disk that is full, a pipe that is closed: the run failed, its input was right.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What an output says of its origin.
struct Provenance {
  std::string version;                 // of polhode
  std::string title;                   // may be empty
  std::string scenario_name;           // "apophis.toml"
  std::string scenario_text;           // may be empty
  std::vector<std::string> notes;      // one sentence each: epoch, axes
  std::vector<std::string> citations;  // one line each
  AemOutput aem = {};                  // what only an AEM needs
};

// How far an output has been written.
struct SinkPosition {
  std::int64_t bytes = 0;
  std::int64_t rows = 0;

  constexpr bool operator==(const SinkPosition&) const = default;
};

class Sink {
 public:
  virtual ~Sink() = default;
  // Whole rows, one after the other.
  virtual void push(std::span<const double> rows) = 0;
  // What a checkpoint keeps of this output. All that has been pushed is on the disk then, whatever
  // becomes of the process or the machine. None: the output cannot be continued (a pipe).
  virtual std::optional<SinkPosition> position() { return std::nullopt; }
  // The position reported last is in a checkpoint: none before it will be asked for.
  virtual void kept() {}
  // The output is complete: gives it its name. Without this PATH.part stays.
  virtual void finish() = 0;
};

std::unique_ptr<Sink> open_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                                const Provenance& provenance,
                                const std::optional<SinkPosition>& from = std::nullopt);

}  // namespace v0
}  // namespace polhode
