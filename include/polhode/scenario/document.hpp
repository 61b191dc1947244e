// SPDX-License-Identifier: MIT
// Document: a scenario file that has been read and checked against the table of keys; what it
// describes is made of it by its kind (polhode/scenario/scenario.hpp).
//
// Units       the checked values are in core units (polhode/text/units.hpp).
// Domain      files of at most 16 MB, UTF-8. Paths of further files are relative to its folder.
// Accuracy    numbers are read to the nearest double; a unit costs at most two roundings.
// Errors      ScenarioError: one line per mistake, FILE:LINE:COLUMN: KEY: got VALUE; expected ...,
//             sorted by place, at most twenty.
// Cost        less than a millisecond; copies share the values.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "polhode/text/key_values.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
class Kinds;
namespace detail {
struct ReadFile;
}  // namespace detail

// A file that the scenario names: a table, a mesh, an OEM. As it was when it was read.
struct ScenarioFile {
  std::string path;  // as the scenario names it
  std::int64_t bytes;
  std::uint64_t fingerprint;  // FNV-1a of its bytes

  constexpr bool operator==(const ScenarioFile&) const = default;
};
// "moon.csv.gz: 12345 bytes, mark 1234567890123456789"
std::string file_note(const ScenarioFile& file);

struct Document {
  std::string path;    // what messages call it: "examples/apophis.toml", "<stdin>"
  std::string name;    // of the file, without its folder: "apophis.toml"
  std::string folder;  // of the file: paths in it start there; empty is the working folder
  std::string text;    // the file itself
  std::string title;   // may be empty
  std::string kind;    // of what it describes: "rotation"
  Units units;
  std::vector<ScenarioFile> files;  // each once, by path
  // Those that it was read with.
  std::shared_ptr<const Kinds> kinds;
  // The values by path, for the kinds and for the tables that wrap them.
  std::shared_ptr<const detail::ReadFile> checked;
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
