// SPDX-License-Identifier: MIT
// separated: the parts of a text between separators, such as the words of a list of the schema.
//
// Domain      any text; the parts point into it. An empty text has no parts.
// Cost        one pass.
#pragma once

#include <string_view>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace io {

// "a|b" as {a, b}.
std::vector<std::string_view> separated(std::string_view joined, char separator);

}  // namespace io
}  // namespace v0
}  // namespace polhode
