// SPDX-License-Identifier: MIT
// KeyValue: the value of one key, apart from any file: what a table says of it, or a program.
//
// Units       numbers are in core units (polhode/text/units.hpp).
// Domain      which of the members hold the value is said by the type of its key.
// Cost        a plain value.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

struct KeyValue {
  std::string_view key;              // its name
  std::vector<double> numbers = {};  // a matrix row by row
  std::vector<std::string> words = {};
  std::int64_t whole = 0;  // of a flag 0 or 1
  std::string shown = {};  // as messages quote it

  bool operator==(const KeyValue&) const = default;
};

}  // namespace v0
}  // namespace polhode
