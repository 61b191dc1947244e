// SPDX-License-Identifier: MIT
// What refuses an oblateness that is none where it is made. It holds nothing.
#pragma once

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct ValidOblateness {
  ValidOblateness(double J2, double radius, const Vec3& pole);
  constexpr bool operator==(const ValidOblateness&) const = default;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
