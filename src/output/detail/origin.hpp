// SPDX-License-Identifier: MIT
// What an output says of the scenario that it is from, and whether that is another one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace detail {

constexpr std::string_view scenario_lead = "| ";
constexpr std::string_view file_lead = "file ";  // of a note: file_note

// What a scenario, its files and the rows are known by.
struct Origin {
  std::vector<std::string> scenario;
  std::vector<std::string> files;
  std::vector<std::string> columns;  // the head line of a text; groups of HDF5; not of an AEM
};

// Empty: there is none.
std::string difference(const Origin& found, const Origin& wanted);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
