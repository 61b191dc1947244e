// SPDX-License-Identifier: MIT
// Second moments of quaternions at as many epochs as a register has lanes; compiled once for each
// set of instructions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ensemble/detail/attitude_sums.hpp"
#include "polhode/math/pack_rows.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The sums of one pack of epochs, in registers from one member to the next.
template <InstructionSet isa>
class AttitudePack {
 public:
  using T = Pack<isa>;
  static constexpr std::size_t width = T::width;

  [[gnu::always_inline]] explicit AttitudePack(AttitudeMoments* moments) : moments_(moments) {
    load();
  }
  [[gnu::always_inline]] void add(std::int64_t member, const RotorState* states) {
    static_assert(sizeof(RotorState) == 7 * sizeof(double));
    const std::array<T, 7> c = loaded_rows<7, isa>(&states->q.w);
    const auto all = AttitudeSums::products(c[0], c[1], c[2], c[3]);
    if (any(!(abs(all.square - T(1.0)) <= T(AttitudeSums::unit_slack))))
      return one_by_one(member, states);
#pragma GCC unroll 10
    for (int k = 0; k < 10; ++k) sums_[k] = sums_[k] + all.p[k];
    ++added_;
  }
  [[gnu::always_inline]] void store() {
    for (std::size_t i = 0; i < width; ++i) {
      double* const to = AttitudeSums::of(moments_[i]);
      for (int k = 0; k < 10; ++k) to[k] = sums_[k].lanes[i];
      AttitudeSums::count(moments_[i], added_);
    }
  }

 private:
  [[gnu::always_inline]] void load() {
    for (std::size_t i = 0; i < width; ++i) {
      const double* const from = AttitudeSums::of(moments_[i]);
      for (int k = 0; k < 10; ++k) sums_[k].lanes[i] = from[k];
    }
    added_ = 0;
  }
  [[gnu::always_inline]] void one_by_one(std::int64_t member, const RotorState* states) {
    store();
    for (std::size_t i = 0; i < width; ++i) moments_[i].add(member, states[i].q);
    load();
  }

  AttitudeMoments* moments_;
  T sums_[10];
  std::int64_t added_;
};

template <InstructionSet isa>
[[gnu::flatten]] void add_attitude_rows(AttitudeMoments* moments, std::size_t epochs,
                                        std::int64_t first, const RotorState* states,
                                        std::size_t members) {
  constexpr std::size_t width = Pack<isa>::width;
  std::size_t e = 0;
  for (; e + width <= epochs; e += width) {
    AttitudePack<isa> pack(moments + e);
    for (std::size_t m = 0; m < members; ++m)
      pack.add(first + static_cast<std::int64_t>(m), states + m * epochs + e);
    pack.store();
  }
  for (; e < epochs; ++e)
    for (std::size_t m = 0; m < members; ++m)
      moments[e].add(first + static_cast<std::int64_t>(m), states[m * epochs + e].q);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
