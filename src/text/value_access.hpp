// SPDX-License-Identifier: MIT
// The values of a file by path, and what the library rejects of them as errors at their place. The
// table of keys has every path asked for here, and the reader has let its value pass.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/text/key_values.hpp"
#include "text/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// "perturbation[0]", ... of the tables of an array.
std::vector<std::string> array_paths(const Values& values, const std::string& array);

// True for a table itself and the keys and tables in it.
bool is_below(std::string_view path, std::string_view table);

const Value& value_at(const Values& values, std::string_view path);
const std::string& word(const Values& values, std::string_view path);
// Whether the file has it, and whether it or a fallback has.
bool is_explicit(const Values& values, std::string_view path);
bool has(const Values& values, std::string_view path);
// Whether the table has the line that replaces the key of `value` (Key::unused_with).
bool is_unused(const Values& values, const Value& value, std::string_view path);

// The place of a value; of one that is not there, that of the table which lacks it.
Place place_of(const Values& values, std::string_view path, const std::string& name);
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
}  // namespace io
}  // namespace v0
}  // namespace polhode
