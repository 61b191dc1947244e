// SPDX-License-Identifier: MIT
// Conversions between charts and quaternion-momentum states, as many states at a time as a register
// holds; compiled once for each set of instructions.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "math/pack_functions.hpp"
#include "math/pack_rows.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "rotor/detail/chart_lanes_declared.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A state of doubles as a row of numbers, and of packs as their columns.
template <class State>
struct Rows;
template <>
struct Rows<RotorState> {
  static constexpr std::size_t numbers = 7;
  template <class T>
  [[gnu::always_inline]] static BasicRotorState<T> of(const std::array<T, 7>& c) {
    return {{c[0], c[1], c[2], c[3]}, {c[4], c[5], c[6]}};
  }
  template <class T>
  [[gnu::always_inline]] static std::array<T, 7> columns(const BasicRotorState<T>& s) {
    return {s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z};
  }
};
template <>
struct Rows<AndoyerState> {
  static constexpr std::size_t numbers = 6;
  template <class T>
  [[gnu::always_inline]] static BasicAndoyerState<T> of(const std::array<T, 6>& c) {
    return {c[0], c[1], c[2], c[3], c[4], c[5]};
  }
  template <class T>
  [[gnu::always_inline]] static std::array<T, 6> columns(const BasicAndoyerState<T>& s) {
    return {s.l, s.g, s.h, s.L, s.G, s.H};
  }
};
template <>
struct Rows<EulerState> {
  static constexpr std::size_t numbers = 6;
  template <class T>
  [[gnu::always_inline]] static BasicEulerState<T> of(const std::array<T, 6>& c) {
    return {c[0], c[1], c[2], c[3], c[4], c[5]};
  }
  template <class T>
  [[gnu::always_inline]] static std::array<T, 6> columns(const BasicEulerState<T>& s) {
    return {s.phi, s.theta, s.psi, s.Phi, s.Theta, s.Psi};
  }
};

// Stage by stage for a block of packs: within a stage their chains of operations overlap, where
// those of whole conversions are longer than the processor looks ahead.
inline constexpr std::size_t packs_of_block = 16;

template <InstructionSet isa, class To, class From>
class ChartBlock;

// From the hub: what angles are the arguments of, then the angles.
template <InstructionSet isa, class To>
class ChartBlock<isa, To, RotorState> {
 public:
  using T = Pack<isa>;
  static constexpr std::size_t in = 7 * T::width, out = 6 * T::width;

  [[gnu::flatten]] void convert(const double* from, double* to, std::size_t packs) {
    for (std::size_t n = 0; n < packs; ++n)
      put(n, phasors(Rows<RotorState>::of(loaded_rows<7, isa>(from + in * n))));
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t n = 0; n < packs; ++n) re_[j][n] = argument(Phasor<T>{re_[j][n], im_[j][n]});
    for (std::size_t n = 0; n < packs; ++n) {
      const T second = std::is_same_v<To, EulerState> ? re_[1][n] + re_[1][n] : re_[1][n];
      store_rows<6, isa>(
          {re_[0][n], second, re_[2][n], momenta_[0][n], momenta_[1][n], momenta_[2][n]},
          to + out * n);
    }
  }

 private:
  [[gnu::always_inline]] static auto phasors(const BasicRotorState<T>& s) {
    if constexpr (std::is_same_v<To, AndoyerState>)
      return andoyer_phasors(s);
    else
      return euler_phasors(s);
  }
  [[gnu::always_inline]] void put(std::size_t n, const AndoyerPhasors<T>& p) {
    put(n, {p.l, p.g, p.h}, {p.L, p.G, p.H});
  }
  [[gnu::always_inline]] void put(std::size_t n, const EulerPhasors<T>& p) {
    put(n, {p.phi, p.half_theta, p.psi}, {p.Phi, p.Theta, p.Psi});
  }
  [[gnu::always_inline]] void put(std::size_t n, const std::array<Phasor<T>, 3>& angles,
                                  const std::array<T, 3>& momenta) {
    for (std::size_t j = 0; j < 3; ++j) {
      re_[j][n] = angles[j].re;
      im_[j][n] = angles[j].im;
      momenta_[j][n] = momenta[j];
    }
  }

  T re_[3][packs_of_block], im_[3][packs_of_block], momenta_[3][packs_of_block];
};

// To the hub: sines and cosines of the half angles, then the state.
template <InstructionSet isa, class From>
class ChartBlock<isa, RotorState, From> {
 public:
  using T = Pack<isa>;
  static constexpr std::size_t in = 6 * T::width, out = 7 * T::width;

  [[gnu::flatten]] void convert(const double* from, double* to, std::size_t packs) {
    for (std::size_t n = 0; n < packs; ++n) {
      const std::array<T, 6> c = loaded_rows<6, isa>(from + in * n);
      for (std::size_t j = 0; j < 3; ++j) {
        angle_[j][n] = T(0.5) * c[j];
        momenta_[j][n] = c[3 + j];
      }
    }
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t n = 0; n < packs; ++n) half_[j][n] = phasor(angle_[j][n]);
    if constexpr (std::is_same_v<From, AndoyerState>)
      for (std::size_t n = 0; n < packs; ++n) set_polar_angles(n);
    for (std::size_t n = 0; n < packs; ++n)
      store_rows<7, isa>(Rows<RotorState>::columns(state(n)), to + out * n);
  }

 private:
  // half_polar_angle of J and I, with one quotient for the two.
  [[gnu::always_inline]] void set_polar_angles(std::size_t n) {
    const T L = momenta_[0][n], G = momenta_[1][n], H = momenta_[2][n];
    const auto usual = T(0x1p-1000) < G && G < T(0x1p1000);
    const T half = T(0.5) / G;
    const auto fast = [&](const T& any) {
      const T p = clamped(any, G);
      return Phasor<T>{sqrt(T((G + p) * half)), sqrt(T((G - p) * half))};
    };
    J_[n] = where(
        usual, [&] { return fast(L); }, [&] { return half_polar_angle(L, G); });
    I_[n] = where(
        usual, [&] { return fast(H); }, [&] { return half_polar_angle(H, G); });
  }
  [[gnu::always_inline]] BasicRotorState<T> state(std::size_t n) const {
    if constexpr (std::is_same_v<From, AndoyerState>)
      return rotor_of_phasors(J_[n], I_[n], half_[0][n], half_[1][n], half_[2][n], momenta_[0][n],
                              momenta_[1][n]);
    else
      return rotor_of_euler(EulerPhasors<T>{half_[0][n], half_[1][n], half_[2][n], momenta_[0][n],
                                            momenta_[1][n], momenta_[2][n]});
  }

  T angle_[3][packs_of_block], momenta_[3][packs_of_block];
  Phasor<T> half_[3][packs_of_block], J_[packs_of_block], I_[packs_of_block];
};

template <InstructionSet isa, class To, class From, class... How>
void converted_in_lanes(const From* states, std::size_t count, To* results, How... how) {
  constexpr std::size_t width = Pack<isa>::width;
  constexpr std::size_t in = Rows<From>::numbers, out = Rows<To>::numbers;
  static_assert(sizeof(From) == in * sizeof(double) && sizeof(To) == out * sizeof(double));
  const auto* from = reinterpret_cast<const double*>(states);
  auto* to = reinterpret_cast<double*>(results);
  ChartBlock<isa, To, From> block{how...};
  std::size_t i = 0;
  while (count - i >= width) {
    const std::size_t packs = std::min((count - i) / width, packs_of_block);
    block.convert(from + in * i, to + out * i, packs);
    i += packs * width;
  }
  if (i == count) return;
  // the last ones next to copies of the first of them
  double rows[in * width], found[out * width];
  for (std::size_t j = 0; j < width; ++j)
    std::memcpy(rows + in * j, states + (i + j < count ? i + j : i), sizeof(From));
  block.convert(rows, found, 1);
  std::memcpy(results + i, found, (count - i) * sizeof(To));
}

// Six numbers of a Poincare-type set, and the two poles in the place of a seventh: the set of a
// lane may be any of the four.
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
