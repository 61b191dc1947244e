// SPDX-License-Identifier: MIT
// What each golden case is: the numbers it starts from and the times it is asked for.
#pragma once

#include <span>
#include <string_view>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct GoldenStart {
  std::string_view name;
  std::string_view description;
  Vec3 moments;
  Quaternion q0;
  Vec3 omega0;
  std::span<const double> times;
};

std::span<const GoldenStart> golden_starts();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
