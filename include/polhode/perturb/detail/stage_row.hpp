// SPDX-License-Identifier: MIT
// Where the numbers of many stages lie: at the beginning of a line of the cache.
#pragma once

#include <array>
#include <cstddef>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace detail {

template <std::size_t count>
struct alignas(64) AlignedRow : std::array<double, count> {};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
