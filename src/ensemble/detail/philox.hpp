// SPDX-License-Identifier: MIT
// Philox4x64-10 of Random123.
#pragma once

#include <array>
#include <cstdint>

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

using PhiloxCounter = std::array<std::uint64_t, 4>;
using PhiloxKey = std::array<std::uint64_t, 2>;

PhiloxCounter philox(const PhiloxCounter& counter, const PhiloxKey& key);

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
