// SPDX-License-Identifier: MIT
// What is wrong in a file, and where.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace detail {

struct Position {
  unsigned line = 1;
  unsigned column = 1;
  auto operator<=>(const Position&) const = default;
};

// The errors of one file, in the order of the file, at most most_diagnostics of them.
constexpr std::size_t most_diagnostics = 20;
class Diagnostics {
 public:
  explicit Diagnostics(std::string_view name);
  void add(Position where, std::string_view path, std::string_view text);
  bool full() const { return entries_.size() >= most_diagnostics; }
  // One line per error.
  std::string text() const;
  // Throws ScenarioError with that text, unless there is none.
  void raise() const;

 private:
  struct Entry {
    Position where;
    std::string line;
  };
  std::string name_;
  std::vector<Entry> entries_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
