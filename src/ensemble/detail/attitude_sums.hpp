// SPDX-License-Identifier: MIT
// Second moments of quaternions: one quaternion, or a register of epochs.
#pragma once

#include <cstddef>
#include <cstdint>

#include "polhode/ensemble/attitude_moments.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct AttitudeSums {
  // A quaternion whose square is so near to 1 is taken as it is.
  static constexpr double unit_slack = 0x1p-49;  // 8 eps

  template <class T>
  struct Products {
    T p[10];
    T square;
  };
  template <class T>
  [[gnu::always_inline]] static Products<T> products(const T& w, const T& x, const T& y,
                                                     const T& z) {
    const T ww = w * w, xx = x * x, yy = y * y, zz = z * z;
    return {{ww, w * x, w * y, w * z, xx, x * y, x * z, yy, y * z, zz}, (ww + xx) + (yy + zz)};
  }

  [[gnu::always_inline]] static double* of(AttitudeMoments& moments) { return moments.sums_; }
  [[gnu::always_inline]] static void count(AttitudeMoments& moments, std::int64_t more) {
    moments.count_ += more;
  }
};

// add_rows in the lanes of a set; members * epochs states.
template <InstructionSet isa>
void add_attitude_rows(AttitudeMoments* moments, std::size_t epochs, std::int64_t first,
                       const RotorState* states, std::size_t members);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
