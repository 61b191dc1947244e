// SPDX-License-Identifier: MIT
// Sink: where a run puts its rows, block by block, so that any number of rows needs constant
// memory. A file is one, of the format that its extension says (polhode/output/output_format.hpp).
//
// Units       those that the columns name.
// Domain      a file is written as PATH.part, flushed after each block, and renamed by finish(); a
//             run that fails or is killed leaves PATH.part, readable up to its last block, and PATH
//             as it was.
// Accuracy    that of the format.
// Errors      OutputError when writing fails.
// Cost        that of the format. No time stamps: equal runs give equal files.
#pragma once

#include <any>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "polhode/output/column_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// A disk that is full, a pipe that is closed: the run failed, its input was right.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What [output.NAME] asks of formats: by the name of each, its own struct.
using FormatOptions = std::map<std::string, std::any, std::less<>>;

// What the rows of a run stand on, for formats whose files say it.
struct RunFacts {
  std::string name;   // of what turns: the title of the scenario, or else the name of its file
  std::string epoch;  // of t = 0; empty: there is none
  std::string axes;
  bool moving_frame = false;
  double seconds = 1.0;  // in the unit of time of the rows
  double first = 0.0;    // times of the rows, in that unit
  double last = 0.0;
  bool rising = true;  // whether each row is later than the one before
  double rate = 0.0;   // |omega| of the initial state, rad in that unit
};

// What an output says of its origin.
struct Provenance {
  std::string version;                 // of polhode
  std::string title;                   // may be empty
  std::string scenario_name;           // "apophis.toml"
  std::string scenario_text;           // may be empty
  std::vector<std::string> notes;      // one sentence each: epoch, axes
  std::vector<std::string> citations;  // one line each
  RunFacts run = {};
  FormatOptions options = {};
  // The dimension of rows in formats that name it: the first column, if it differs from row to row,
  // or a word. Empty: t if it is the first column, else "row".
  std::string row_dimension = {};
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
  // What a reader of the complete file should know before using it, one sentence each.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
