// SPDX-License-Identifier: MIT
// A scenario file after the checks that its table of keys can make: values by path, in core units,
// each with its place in the file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/io/schema.hpp"
#include "polhode/io/units.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct Position {
  unsigned line = 1;
  unsigned column = 1;
  auto operator<=>(const Position&) const = default;
};

struct Value {
  const Key* key = nullptr;
  Position where;
  bool given = true;            // false: the fallback of the schema
  std::string shown;            // as messages quote it
  std::vector<double> numbers;  // core units; a matrix row by row
  std::vector<std::string> words;
  std::int64_t whole = 0;
};

// By path as the file has it: "body.moments", "orbit.moon.period", "perturbation[0].kind". Tables
// have an entry too.
using Values = std::map<std::string, Value, std::less<>>;

// The errors of one file, in the order of the file, at most most_diagnostics of them.
constexpr std::size_t most_diagnostics = 20;
class Diagnostics {
 public:
  explicit Diagnostics(std::string_view name);
  void add(Position where, std::string_view path, std::string_view text);
  bool full() const { return entries_.size() >= most_diagnostics; }
  // Throws ScenarioError with one line per error, unless there is none.
  void raise() const;

 private:
  struct Entry {
    Position where;
    std::string line;
  };
  std::string name_;
  std::vector<Entry> entries_;
};

// Text from a file as a message may show it: printable ASCII, one line, cut to `longest`.
std::string printable(std::string_view text, std::size_t longest = 60);

// Throws DomainError unless the text is a date with its scale.
void require_epoch(std::string_view text);

struct Refusal {
  Position where;
  std::string text;
};
// Why a text must not reach the TOML parser: what it would crash on, or answer undefined.
std::optional<Refusal> refusal(std::string_view text);

struct ReadFile {
  Values values;
  Units units;
};
// Everything wrong goes to `diagnostics`; what is right is in the result.
ReadFile read_values(std::string_view text, const Schema& schema, Diagnostics& diagnostics);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
