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
  // Member after member, `stride` states apart; as many as are usual stay in registers.
  [[gnu::always_inline]] void add(std::int64_t first, const RotorState* states, std::size_t stride,
                                  std::size_t members) {
    static_assert(sizeof(RotorState) == 7 * sizeof(double));
    for (std::size_t m = 0; m < members; ++m) {
      T sums[10];
#pragma GCC unroll 10
      for (int k = 0; k < 10; ++k) sums[k] = sums_[k];
      for (; m < members; ++m) {
        const auto [w, x, y, z, gx, gy, gz] = loaded_rows<7, isa>(&states[m * stride].q.w);
        const auto all = AttitudeSums::products(w, x, y, z);
        if (any(!(abs(all.square - T(1.0)) <= T(AttitudeSums::unit_slack)))) break;
#pragma GCC unroll 10
        for (int k = 0; k < 10; ++k) sums[k] = sums[k] + all.p[k];
        ++added_;
      }
#pragma GCC unroll 10
      for (int k = 0; k < 10; ++k) sums_[k] = sums[k];
      if (m < members) one_by_one(first + static_cast<std::int64_t>(m), states + m * stride);
    }
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
    pack.add(first, states + e, epochs, members);
    pack.store();
  }
  for (; e < epochs; ++e)
    for (std::size_t m = 0; m < members; ++m)
      moments[e].add(first + static_cast<std::int64_t>(m), states[m * epochs + e].q);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
