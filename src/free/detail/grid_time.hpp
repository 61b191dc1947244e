// SPDX-License-Identifier: MIT
// The times of an even grid in the lanes of a pack.
#pragma once

#include <cstddef>

#include "polhode/free/detail/phase_arithmetic.hpp"
#include "polhode/free/free_kernel.hpp"
#include "polhode/free/states_on_grid.hpp"
#include "polhode/math/pack.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// States 64 n, ..., 64 n + 63 of a grid share the angles that are reduced for the first of them.
inline constexpr std::size_t tile = 64;

template <InstructionSet isa>
BasicQuaternion<Pack<isa>> in_all_lanes(const Quaternion& q) {
  using T = Pack<isa>;
  return {T(q.w), T(q.x), T(q.y), T(q.z)};
}

// Time of the grid's state i since the epoch, in the kernel's units. `i` may be anything below
// 2^53.
template <class Arithmetic, Number T>
class ElapsedTime {
 public:
  ElapsedTime(const BasicFreeKernel<T>& k, const TimeGrid& grid)
      : step_(k.time_scale * T(grid.step)) {
    const TwoTerms<T> since = Arithmetic::sum(T(grid.start), T(-k.epoch));
    start_ = {k.time_scale * since.hi, k.time_scale * since.lo};
  }
  [[gnu::always_inline]] TwoTerms<T> since_start(const T& i) const {
    return Arithmetic::product(step_, i);
  }
  [[gnu::always_inline]] TwoTerms<T> operator()(const T& i) const {
    const TwoTerms<T> p = since_start(i), s = Arithmetic::sum(start_.hi, p.hi);
    return quick_two_sum(s.hi, T(s.lo + (start_.lo + p.lo)));
  }

 private:
  T step_;
  TwoTerms<T> start_;
};

// `first`, `first` + each, ... of a pack.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> indices_from(double first, double each) {
  Pack<isa> i(first);
  for (std::size_t j = 1; j < Pack<isa>::width; ++j)
    i.lanes[j] = first + each * static_cast<double>(j);
  return i;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
