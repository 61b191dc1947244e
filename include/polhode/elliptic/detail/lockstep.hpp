// SPDX-License-Identifier: MIT
// Loops to convergence that packs run too: until the last lane has converged, with the lanes that
// have kept as they are.
#pragma once

#include <cstddef>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {
namespace detail {

template <Number T>
class Lockstep {
 public:
  // Lanes whose value has converged; those with derivatives go on for as many trips more.
  void converge(const Mask<T>& small) {
    if constexpr (Real<T>) {
      done_ = small && more_-- == 0;
    } else {
      done_ = done_ || small;
    }
  }
  // Lanes that end here, whatever their derivatives.
  void stop(const Mask<T>& mask) { done_ = done_ || mask; }
  bool all_done() const { return all(done_); }
  // The new value where the loop goes on.
  T kept(const T& before, const T& now) const {
    if constexpr (Real<T>) {
      return now;
    } else {
      return select(done_, before, now);
    }
  }

 private:
  Mask<T> done_ = false;
  std::size_t more_ = derivative_order<T>;
};

}  // namespace detail
}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
