// SPDX-License-Identifier: MIT
// The values of a file of keys by path, in core units, each with its place in the file, and the
// errors of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/text/detail/values_fwd.hpp"
#include "polhode/text/key.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct Position {
  unsigned line = 1;
  unsigned column = 1;
  auto operator<=>(const Position&) const = default;
};
// The position of values that are in no file.
constexpr Position nowhere{0, 0};

// The errors of one file, in the order of the file, at most most_diagnostics of them.
constexpr std::size_t most_diagnostics = 20;
class Diagnostics {
 public:
  explicit Diagnostics(std::string_view name);
  const std::string& name() const { return name_; }
  void add(Position where, std::string_view path, std::string_view text);
  // Errors of this table name keys only: nobody has the text that it stands in.
  void leave_out_places(std::string_view table);
  bool full() const { return entries_.size() >= most_diagnostics; }
  // One line per error.
  std::string text() const;
  // Throws ScenarioError with that text, unless there is none.
  void raise() const;

 private:
  struct Entry {
    Position where;
    std::string path, text;
  };
  std::string name_;
  std::vector<Entry> entries_;
};

struct Value {
  const Key* key = nullptr;
  Position where;
  bool is_explicit = true;         // false: the fallback of the schema
  std::string shown;               // as messages quote it
  std::vector<double> numbers;     // core units; a matrix row by row
  std::vector<std::string> units;  // that each was written in; empty: that of the file
  std::vector<std::string> words;
  std::int64_t whole = 0;
};

// The values of a file, its units, and what messages call it.
struct FileValues {
  const Values& values;
  const Units& units;
  const std::string& name;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
