// SPDX-License-Identifier: MIT
#pragma once

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
struct NormalizedArc;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
