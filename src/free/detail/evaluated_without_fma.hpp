// SPDX-License-Identifier: MIT
// The path that a processor without FMA takes, for the test that its bits are the same.
#pragma once

#include "polhode/detail/free/free_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

RotorState evaluated_without_fma(const FreeKernel& k, double t) noexcept;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
