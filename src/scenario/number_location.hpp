// SPDX-License-Identifier: MIT
// The places of the numbers of a scenario: those that a map, an ensemble or a fit varies.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct NumberLocation {
  std::string path;
  std::size_t index;
  std::size_t mirror;  // of a symmetric matrix, the element that has the same number; else index

  // The elements that the number stands in.
  std::array<std::size_t, 2> elements() const { return {index, mirror}; }
};
// The place of "state.euler.theta", "body.moments[1]" or "body.tensor[0][1]"; nullopt if there is
// no such number.
std::optional<NumberLocation> number_location(const Values& values, std::string_view key);

// The same, and all numbers of an array by its name alone. Of a symmetric matrix these are its
// upper half, row by row. Empty if there is none.
std::vector<NumberLocation> number_locations(const Values& values, std::string_view key);

// The numbers of a file by their keys, of arrays the first, or that with the index in `key`: what
// is near to a key that is none.
std::vector<std::string> number_keys(const Values& values, std::string_view key);

// A number of a value as the file has it: its unit, its own or that of [units], and the number in
// this unit; and back, into core units.
std::string unit_in_file(const Value& value, std::size_t index, const Units& units);
double number_in_file(const Value& value, std::size_t index, const Units& units);
double to_core(const Value& value, std::size_t index, double in_file, const Units& units);

// "body.moments[1]", as number_location finds it.
std::string key_text(const Values& values, const NumberLocation& place);

// True if a value is a number or an array of numbers, and if it is three rows of three.
bool is_number(const Value& value);
bool is_matrix(const Value& value);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
