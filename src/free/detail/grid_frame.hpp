// SPDX-License-Identifier: MIT
// What a free arc on an even grid of times needs besides its kernel.
#pragma once

#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// left qz(0) right of a kernel and left qz(pi) right, each with the rounding of the result alone.
struct GridFrame {
  Quaternion now, quarter_turn_on;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
