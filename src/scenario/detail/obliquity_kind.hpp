// SPDX-License-Identifier: MIT
// The experiment of kind "obliquity" from the values of a file.
#pragma once

#include <memory>

#include "polhode/scenario/obliquity.hpp"
#include "scenario/detail/experiment_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// With a base, its orbit is used again.
Obliquity made_obliquity(const KindContext& at, const Obliquity* base = nullptr);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
