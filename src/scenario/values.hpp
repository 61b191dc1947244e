// SPDX-License-Identifier: MIT
// A scenario file after the checks that its table of keys can make: values by path, in core units,
// each with its place in the file; the errors of a file; and the reader of its text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/detail/values_fwd.hpp"
#include "polhode/scenario/document.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/units.hpp"

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

struct FitPlan;
namespace detail {

struct Refusal {
  Position where;
  std::string text;
};
// Why a text must not reach the TOML parser: what it would crash on, or answer undefined.
std::optional<Refusal> refusal(std::string_view text);
// What to do about a complaint of the TOML parser: "; text stands in quotes". "" where we know no
// more than it does.
std::string hint_for(std::string_view complaint);

struct MadeExperiment;

struct ReadFile {
  Values values;
  Units units;
  // What was made of the values, for those who make it again with other numbers.
  std::shared_ptr<const MadeExperiment> made = nullptr;
  std::shared_ptr<const FitPlan> fit = nullptr;  // of kind "fit"
};
inline FileValues file_values(const Document& of) {
  return {of.checked->values, of.units, of.path};
}
// Everything wrong goes to `diagnostics`; what is right is in the result.
ReadFile read_values(std::string_view text, const Schema& schema, Diagnostics& diagnostics);

// Why a text of TOML is no value of a key, in one line; nothing where it is one.
std::optional<std::string> why_not(const Key& key, std::string_view toml);

}  // namespace detail

}  // namespace v0
}  // namespace polhode
