// SPDX-License-Identifier: MIT
// Words in messages: lists of them, the nearest to a misspelt one, and printable text from outside.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Printable ASCII, one line, cut to `longest`.
std::string printable(std::string_view text, std::size_t longest = 60);

// As much of a path as a message shows, and of the name of a file that was read.
inline constexpr std::size_t longest_path = 500, longest_name = 4096;

// a, b or c; each in `quote`.
std::string one_of(std::span<const std::string_view> words, std::string_view quote = "");
// Sets of keys, "stop+step|at": stop with step, at.
std::string sets_in_words(std::string_view sets);
// What a file may call its own things, since names stand in paths, messages and outputs: up to 60
// letters, digits, - and _.
bool is_name(std::string_view text);

// Edits (insert, delete, replace, swap of neighbours) that turn a into b; upper and lower case
// count as half an edit, so the result is in half edits.
int edit_distance(std::string_view a, std::string_view b);

// The nearest of `known`, or an empty view when none is near enough to be a slip.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known);
// "; did you mean moon?", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
