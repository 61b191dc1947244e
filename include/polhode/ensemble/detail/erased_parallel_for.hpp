// SPDX-License-Identifier: MIT
// ordered_parallel_for without the type of a result.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

void erased_parallel_for(std::int64_t first, std::int64_t count, int threads,
                         const std::function<std::shared_ptr<const void>(std::int64_t)>& cell,
                         const std::function<void(std::int64_t, const void*)>& sink);

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
