// SPDX-License-Identifier: MIT
// Text from outside as messages may show it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace detail {

// Printable ASCII, one line, cut to `longest`.
std::string printable(std::string_view text, std::size_t longest = 60);

// As much of a path as a message shows, and of the name of a file that was read.
inline constexpr std::size_t longest_path = 500, longest_name = 4096;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
