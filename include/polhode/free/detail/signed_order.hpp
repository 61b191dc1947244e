// SPDX-License-Identifier: MIT
// An order of axes with signs as data of a kernel: in a pack every lane has its own.
#pragma once

#include <array>
#include <cstddef>

#include "polhode/free/detail/axis_order.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// New component i is sign[i] times old component 1 where first[i], 2 where second[i], else 3.
template <Number T>
struct SignedOrder {
  std::array<Mask<T>, 3> first{true, false, false};
  std::array<Mask<T>, 3> second{false, true, false};
  BasicVec3<T> sign{T(1.0), T(1.0), T(1.0)};

  [[gnu::always_inline]] BasicVec3<T> applied(const BasicVec3<T>& v) const {
    return {sign.x * chosen(0, v), sign.y * chosen(1, v), sign.z * chosen(2, v)};
  }
  // Without the signs.
  BasicVec3<T> permuted(const BasicVec3<T>& v) const {
    return {chosen(0, v), chosen(1, v), chosen(2, v)};
  }
  void set_lane(std::size_t lane, const AxisOrder& order) {
    using L = LaneTraits<T>;
    for (std::size_t i = 0; i < 3; ++i) {
      L::set_mask(first[i], lane, order.axis[i] == 0);
      L::set_mask(second[i], lane, order.axis[i] == 1);
      L::set(sign[static_cast<int>(i)], lane, ScalarOf<T>(order.sign[i]));
    }
  }
  void set_lane(std::size_t lane, const SignedOrder<ScalarOf<T>>& order) {
    using L = LaneTraits<T>;
    for (std::size_t i = 0; i < 3; ++i) {
      L::set_mask(first[i], lane, order.first[i]);
      L::set_mask(second[i], lane, order.second[i]);
      L::set(sign[static_cast<int>(i)], lane, order.sign[static_cast<int>(i)]);
    }
  }

 private:
  [[gnu::always_inline]] T chosen(std::size_t i, const BasicVec3<T>& v) const {
    if constexpr (Real<T>) {  // one load, and no branch on the order
      const T* const components[] = {&v.z, &v.y, &v.x};
      return *components[2 * first[i] + second[i]];
    } else {
      return select(first[i], v.x, select(second[i], v.y, v.z));
    }
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
