// SPDX-License-Identifier: MIT
// The values of a scenario by path, the places of its numbers, and what the library rejects of them
// as errors at their place. The schema has every path asked for here, and the reader has let its
// value pass.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct NumberLocation {
  std::string path;
  std::size_t index;
};
// Where "state.euler.theta" or "body.moments[1]" is; none where there is no such number.
std::optional<NumberLocation> number_location(const Values& values, std::string_view key);

// The same, and all numbers of an array by its name alone; empty where there is none.
std::vector<NumberLocation> number_locations(const Values& values, std::string_view key);

// The numbers of a file by their keys, of arrays the first, or that with the index in `key`: what
// is near to a key that is none.
std::vector<std::string> number_keys(const Values& values, std::string_view key);

// A number of a value as the file has it: its unit, its own or that of [units], and the number in
// this unit; and back, into core units.
std::string unit_in_file(const Value& value, std::size_t index, const Units& units);
double number_in_file(const Value& value, std::size_t index, const Units& units);
double to_core(const Value& value, std::size_t index, double in_file, const Units& units);

// Whether a value is one number or an array of them.
bool is_number(const Value& value);

// "perturbation[0]", ... of the tables of an array.
std::vector<std::string> array_paths(const Values& values, const std::string& array);

const Value& value_at(const Values& values, std::string_view path);
const std::string& word(const Values& values, std::string_view path);
// Whether the file has it, and whether it or a fallback has.
bool is_explicit(const Values& values, std::string_view path);
bool has(const Values& values, std::string_view path);
// Whether the table has the line that replaces the key of `value` (Key::unused_with).
bool is_unused(const Values& values, const Value& value, std::string_view path);

// "FILE:LINE:COLUMN: KEY: got VALUE; MESSAGE", of the place of `path`, or of that of the key in it
// that the message names.
std::string message_at(const Values& values, std::string_view path, const std::string& name,
                       std::string_view message);
// Throws a ScenarioError at the place of `path`, or at that of the key in it that the message
// names.
[[noreturn]] void refuse(const Values& values, std::string_view path, const std::string& name,
                         std::string_view message);

// Refuses a number outside the range of its key.
void require_range(const Values& values, std::string_view path, const std::string& name);

// What a constructor of the library refuses becomes a message at the place of `path`.
template <class Build>
auto built(const Values& values, std::string_view path, const std::string& name,
           const Build& build) {
  try {
    return build();
  } catch (const ScenarioError&) {
    throw;
  } catch (const DomainError& error) {
    refuse(values, path, name, error.what());
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
