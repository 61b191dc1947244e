// SPDX-License-Identifier: MIT
// Conversions between Poincare-type sets and the hub in lanes; a lane's set may be any of the four.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "polhode/rotor/poincare.hpp"
#include "rotor/detail/chart_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Six numbers, and the two poles in the place of a seventh.
template <>
struct Rows<PoincareState> {
  static constexpr std::size_t numbers = 7;
};
struct PolePair {
  Pole J, I;
};
static_assert(sizeof(PolePair) == sizeof(double) &&
              offsetof(PoincareState, pole_J) == 6 * sizeof(double));

// The bits of the poles at pi, in a number that has the place of both.
inline constexpr auto bits_of_J = std::bit_cast<std::int64_t>(PolePair{Pole::pi, Pole::zero});
inline constexpr auto bits_of_I = std::bit_cast<std::int64_t>(PolePair{Pole::zero, Pole::pi});

// Where the sets of a pack are at pi.
template <InstructionSet isa>
struct PoleMasks {
  PackMask<isa> J, I;

  [[gnu::always_inline]] static PoleMasks of(const Pack<isa>& poles) {
    using Bits = typename Pack<isa>::Bits;
    const Bits bits = std::bit_cast<Bits>(poles.lanes);
    return {PackMask<isa>((bits & bits_of_J) != 0), PackMask<isa>((bits & bits_of_I) != 0)};
  }
  [[gnu::always_inline]] Pack<isa> poles() const {
    using Doubles = typename Pack<isa>::Doubles;
    return Pack<isa>(std::bit_cast<Doubles>((J.lanes & bits_of_J) | (I.lanes & bits_of_I)));
  }
};

template <InstructionSet isa>
class ChartBlock<isa, PoincareState, RotorState> {
 public:
  using T = Pack<isa>;
  static constexpr std::size_t in = 7 * T::width, out = 7 * T::width;

  explicit ChartBlock(const PolesOfSets& poles) : poles_(poles) {}

  [[gnu::flatten]] void convert(const double* from, double* to, std::size_t packs) {
    for (std::size_t n = 0; n < packs; ++n) {
      const BasicRotorState<T> s = Rows<RotorState>::of(loaded_rows<7, isa>(from + in * n));
      const InvariablePlane<T> plane = invariable_plane(s.q, s.g);
      pi_[n] = masks(plane);
      phasor_[n] = poincare_phasor(plane, pi_[n].J, pi_[n].I);
    }
    for (std::size_t n = 0; n < packs; ++n) sigma_[n] = argument(phasor_[n].sigma);
    for (std::size_t n = 0; n < packs; ++n) {
      const PoincarePhasor<T>& s = phasor_[n];
      store_rows<7, isa>({sigma_[n], s.p1.Q, s.p2.Q, s.G, s.p1.P, s.p2.P, pi_[n].poles()},
                         to + out * n);
    }
  }

 private:
  [[gnu::always_inline]] PoleMasks<isa> masks(const InvariablePlane<T>& plane) const {
    if (poles_.nearest) return {plane.k_B.z < T(0.0), plane.k_I.z < T(0.0)};
    return {PackMask<isa>(poles_.J == Pole::pi), PackMask<isa>(poles_.I == Pole::pi)};
  }

  PolesOfSets poles_;
  PoleMasks<isa> pi_[packs_of_block];
  PoincarePhasor<T> phasor_[packs_of_block];
  T sigma_[packs_of_block];
};

template <InstructionSet isa>
class ChartBlock<isa, RotorState, PoincareState> {
 public:
  using T = Pack<isa>;
  static constexpr std::size_t in = 7 * T::width, out = 7 * T::width;

  [[gnu::flatten]] void convert(const double* from, double* to, std::size_t packs) {
    for (std::size_t n = 0; n < packs; ++n) number_[n] = loaded_rows<7, isa>(from + in * n);
    for (std::size_t n = 0; n < packs; ++n) half_[n] = phasor(T(T(0.5) * number_[n][0]));
    for (std::size_t n = 0; n < packs; ++n)
      store_rows<7, isa>(Rows<RotorState>::columns(state(n)), to + out * n);
  }

 private:
  [[gnu::always_inline]] BasicRotorState<T> state(std::size_t n) const {
    const auto& [sigma, Q1, Q2, G, P1, P2, poles] = number_[n];
    const PoleMasks<isa> pi = PoleMasks<isa>::of(poles);
    return rotor_of_poincare(half_[n], poincare_pair(Q1, P1, G), poincare_pair(Q2, P2, G),
                             Phasor<T>{P1, Q1}, G, pi.J, pi.I);
  }

  std::array<T, 7> number_[packs_of_block];
  Phasor<T> half_[packs_of_block];
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
