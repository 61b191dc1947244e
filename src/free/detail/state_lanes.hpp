// SPDX-License-Identifier: MIT
// One free arc at many times, as many at a time as a register holds; compiled once for each set of
// instructions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "polhode/detail/math/pack.hpp"
#include "polhode/free/detail/kernel_pack.hpp"
#include "polhode/free/detail/state_at.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <InstructionSet isa>
BasicFreeKernel<Pack<isa>> in_all_lanes(const FreeKernel& kernel) {
  BasicFreeKernel<Pack<isa>> pack;
  for (std::size_t i = 0; i < Pack<isa>::width; ++i) LaneOfKernel(pack, i).write(kernel);
  return pack;
}

// The numbers of a pack of states, one state after another.
template <InstructionSet isa>
[[gnu::always_inline]] inline void write_states(const BasicRotorState<Pack<isa>>& s,
                                                std::size_t count, RotorState* states) {
  alignas(64) double numbers[7][Pack<isa>::width];
  const Pack<isa>* const from[] = {&s.q.w, &s.q.x, &s.q.y, &s.q.z, &s.g.x, &s.g.y, &s.g.z};
  for (std::size_t j = 0; j < 7; ++j) from[j]->store(numbers[j]);
  for (std::size_t i = 0; i < count; ++i)
    states[i] = {{numbers[0][i], numbers[1][i], numbers[2][i], numbers[3][i]},
                 {numbers[4][i], numbers[5][i], numbers[6][i]}};
}

// Times i, i + 1, ... of `count`, as many as there are.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> times_from(const double* times, std::size_t i,
                                                   std::size_t count) {
  if (i + Pack<isa>::width <= count) return Pack<isa>::loaded(times + i);
  Pack<isa> t(times[i]);
  for (std::size_t j = 1; i + j < count; ++j) t.lanes[j] = times[i + j];
  return t;
}

// detail::state_at of the arcs that are not steady and have the trigonometric form, as most have.
// Stage by stage for a block of packs: within a stage their chains of operations overlap, where
// those of whole states are longer than the processor looks ahead.
template <InstructionSet isa, class Arithmetic>
class TrigonometricBlock {
 public:
  using T = Pack<isa>;
  static constexpr std::size_t packs = 16;
  static constexpr std::size_t states = packs * T::width;

  explicit TrigonometricBlock(const FreeKernel& kernel) : k_(in_all_lanes<isa>(kernel)) {}

  [[gnu::flatten]] void write(const double* times, std::size_t count, RotorState* to) {
    const std::size_t n = (count + T::width - 1) / T::width;
    for (std::size_t i = 0; i < n; ++i) reduce(i, times_from<isa>(times, i * T::width, count));
    for (std::size_t i = 0; i < n; ++i) x_[i] = Arithmetic::sincos(phase_[i]);
    for (std::size_t i = 0; i < n; ++i) turned_[i] = Arithmetic::sincos(turn_[i]);
    for (std::size_t i = 0; i < n; ++i) {
      p_[i] = trigonometric_sum(k_.series, x_[i].sin, x_[i].cos);
      inverse_n2_[i] = inverse_norm2(p_[i]);
    }
    for (std::size_t i = 0; i < n; ++i)
      write_states(turned_by(k_, p_[i], turned_[i], inverse_n2_[i]),
                   std::min(T::width, count - i * T::width), to + i * T::width);
  }

 private:
  // What is left of both phases without whole periods.
  [[gnu::always_inline]] void reduce(std::size_t i, const T& t) {
    const TwoTerms<T> since = Arithmetic::sum(t, T(-k_.epoch));
    const TwoTerms<T> elapsed{k_.time_scale * since.hi, k_.time_scale * since.lo};
    const TwoTerms<T> turn =
        bounded(phase_at<Arithmetic>(k_.half_precession, elapsed, TwoTerms<T>{T(0.0), T(0.0)}), t);
    turn_[i] = whole_turns_off<Arithmetic>(turn);
    phase_[i] =
        reduced<Arithmetic>(bounded(phase_at<Arithmetic>(k_.phase_rate, elapsed, k_.phase0), t),
                            k_.phase_period, k_.inverse_phase_period)
            .rest;
  }

  BasicFreeKernel<T> k_;
  TwoTerms<T> phase_[packs], turn_[packs];
  SinCos<T> x_[packs], turned_[packs];
  BasicQuaternion<T> p_[packs];
  T inverse_n2_[packs];
};

template <InstructionSet isa, class Arithmetic>
[[gnu::flatten]] void states_of_any_form(const FreeKernel& kernel, const double* times,
                                         std::size_t count, RotorState* states) {
  const BasicFreeKernel<Pack<isa>> pack = in_all_lanes<isa>(kernel);
  constexpr std::size_t width = Pack<isa>::width;
  for (std::size_t i = 0; i < count; i += width)
    write_states(state_at<Arithmetic>(pack, times_from<isa>(times, i, count)),
                 std::min(width, count - i), states + i);
}

// The state of a kernel at `count` times. Instantiated in a source of its own for each set.
template <InstructionSet isa>
void states_in_lanes(const FreeKernel& kernel, const double* times, std::size_t count,
                     RotorState* states) {
  using Arithmetic =
      std::conditional_t<isa == InstructionSet::baseline, DekkerArithmetic, FmaArithmetic>;
  if (kernel.steady || kernel.series.hyperbolic)
    return states_of_any_form<isa, Arithmetic>(kernel, times, count, states);
  TrigonometricBlock<isa, Arithmetic> block(kernel);
  for (std::size_t i = 0; i < count; i += block.states)
    block.write(times + i, std::min(block.states, count - i), states + i);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
