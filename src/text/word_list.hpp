// SPDX-License-Identifier: MIT
// Lists of words in messages.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace detail {

// a, b or c; each in `quote`.
std::string one_of(std::span<const std::string_view> words, std::string_view quote = "");
// Sets of keys, "stop+step|at": stop with step, at.
std::string sets_in_words(std::string_view sets);
// What a file may call its own things, since names stand in paths, messages and outputs: up to 60
// letters, digits, - and _.
bool is_name(std::string_view text);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
