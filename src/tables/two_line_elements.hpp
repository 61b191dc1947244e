// SPDX-License-Identifier: MIT
// Whether a file holds two-line elements of satellites, which are no table.
#pragma once

#include <string>

namespace polhode {
inline namespace v0 {
namespace detail {

// Of a file that can be read: its first lines are a name or none, then "1 25544U ..." and "2 25544
// ...". DomainError as from a table.
bool has_two_line_elements(const std::string& path);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
