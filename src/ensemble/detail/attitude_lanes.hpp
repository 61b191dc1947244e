// SPDX-License-Identifier: MIT
// Moments of quaternions and of rotation vectors at as many epochs as a register has lanes;
// compiled once for each set of instructions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ensemble/detail/attitude_sums.hpp"
#include "math/pack_rows.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
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

// The sums of one pack of epochs, from one member to the next.
template <InstructionSet isa>
class SpreadPack {
 public:
  using T = Pack<isa>;
  static constexpr std::size_t width = T::width;

  [[gnu::always_inline]] explicit SpreadPack(AttitudeSpread* spreads) : spreads_(spreads) {
    load();
    for (std::size_t i = 0; i < width; ++i) {
      const Quaternion& r = SpreadSums::reference(spreads[i]);
      reference_[0].lanes[i] = r.w;
      reference_[1].lanes[i] = r.x;
      reference_[2].lanes[i] = r.y;
      reference_[3].lanes[i] = r.z;
    }
  }
  // Member after member, `stride` states apart.
  [[gnu::always_inline]] void add(std::int64_t first, const RotorState* states, std::size_t stride,
                                  std::size_t members) {
    static_assert(sizeof(RotorState) == 7 * sizeof(double));
    for (std::size_t m = 0; m < members; ++m) {
      SpreadSums::Sums<T> sums = sums_;
      for (; m < members; ++m) {
        const auto [w, x, y, z, gx, gy, gz] = loaded_rows<7, isa>(&states[m * stride].q.w);
        const T q[4] = {w, x, y, z};
        const TurnFrom<T> turn = SpreadSums::turn<isa>(reference_, q);
        if (any(!(turn.square > T(SpreadSums::least_square) &&
                  turn.square < T(SpreadSums::most_square))))
          break;
        SpreadSums::add(sums, turn, T(static_cast<double>(first + static_cast<std::int64_t>(m))));
      }
      sums_ = sums;
      if (m < members) one_by_one(first + static_cast<std::int64_t>(m), states + m * stride);
    }
  }
  [[gnu::always_inline]] void store() {
    for (std::size_t i = 0; i < width; ++i)
      SpreadSums::each(
          spreads_[i], sums_, [i](double& to, const T& from) __attribute__((always_inline)) {
            to = from.lanes[i];
          });
  }

 private:
  [[gnu::always_inline]] void load() {
    for (std::size_t i = 0; i < width; ++i)
      SpreadSums::each(
          spreads_[i], sums_, [i](const double& from, T& to) __attribute__((always_inline)) {
            to.lanes[i] = from;
          });
  }
  [[gnu::always_inline]] void one_by_one(std::int64_t member, const RotorState* states) {
    store();
    for (std::size_t i = 0; i < width; ++i) spreads_[i].add(member, states[i].q);
    load();
  }

  AttitudeSpread* spreads_;
  T reference_[4];
  SpreadSums::Sums<T> sums_;
};

template <InstructionSet isa>
[[gnu::flatten]] void add_spread_rows(AttitudeSpread* spreads, std::size_t epochs,
                                      std::int64_t first, const RotorState* states,
                                      std::size_t members) {
  constexpr std::size_t width = Pack<isa>::width;
  std::size_t e = 0;
  for (; e + width <= epochs; e += width) {
    SpreadPack<isa> pack(spreads + e);
    pack.add(first, states + e, epochs, members);
    pack.store();
  }
  for (; e < epochs; ++e)
    for (std::size_t m = 0; m < members; ++m)
      spreads[e].add(first + static_cast<std::int64_t>(m), states[m * epochs + e].q);
}

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
