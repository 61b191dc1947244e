// SPDX-License-Identifier: MIT
// The part of the table of scenario keys that says what moves the body and how it is integrated.
#pragma once

#include <span>

#include "polhode/io/schema.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::span<const Key> motion_keys();
std::span<const Alternatives> motion_alternatives();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
