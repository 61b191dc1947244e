// SPDX-License-Identifier: MIT
// A scenario file after the checks that its table of keys can make: values by path, in core units,
// each with its place in the file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "polhode/scenario/detail/values_fwd.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/units.hpp"
#include "scenario/diagnostics.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
