// SPDX-License-Identifier: MIT
// "Did you mean": the known word nearest to a misspelt one.
#pragma once

#include <span>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace detail {

// Edits (insert, delete, replace, swap of neighbours) that turn a into b; upper and lower case
// count as half an edit, so the result is in half edits.
int edit_distance(std::string_view a, std::string_view b);

// The nearest of `known`, or an empty view when none is near enough to be a slip.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
