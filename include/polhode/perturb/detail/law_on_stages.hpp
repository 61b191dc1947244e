// SPDX-License-Identifier: MIT
// The law of a term at the stages of a step, as many at a time as a register holds.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

#include "polhode/math/pack.hpp"
#include "polhode/perturb/effect.hpp"
#include "polhode/perturb/stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// How many numbers OfTime is made of.
template <class Law>
inline constexpr std::size_t numbers_of_time =
    std::is_empty_v<typename Law::template OfTime<double>>
        ? 0
        : sizeof(typename Law::template OfTime<double>) / sizeof(double);

// One row for each.
template <class Law>
using RowsOfTime = std::array<StageRow, numbers_of_time<Law>>;

template <class Law>
struct StepOfLaw {
  const Law& law;
  const Body& body;
  std::span<const double> sides;
  std::size_t count;
  const RowsOfTime<Law>& of_time;
};

// Compiled for a set of instructions where it is one of a processor's own.
template <InstructionSet isa, class Law>
[[gnu::flatten]] void law_on_stages(const StepOfLaw<Law>& step, const StageStates& states,
                                    StageEffects& effects) {
  using T = Pack<isa>;
  using OfTime = typename Law::template OfTime<T>;
  constexpr std::size_t numbers = numbers_of_time<Law>;
  for (std::size_t i = 0; i < filled_stages(step.count); i += T::width) {
    const auto state = [&](std::size_t n) { return T::loaded(states.rows[n].data() + i); };
    OfTime of_time;
    if constexpr (numbers > 0) {
      static_assert(sizeof(OfTime) == numbers * sizeof(T));
      T parts[numbers];
      for (std::size_t n = 0; n < numbers; ++n) parts[n] = T::loaded(step.of_time[n].data() + i);
      std::memcpy(&of_time, parts, sizeof parts);
    }
    const BasicRotorState<T> s{{state(0), state(1), state(2), state(3)},
                               {state(4), state(5), state(6)}};
    const BasicEffect<T> e = step.law.effect(of_time, BasicPose<T>{step.body, s, step.sides});
    const auto add = [i](StageRow& row, const T& x) {
      (T::loaded(row.data() + i) + x).store(row.data() + i);
    };
    if constexpr (Law::adds_rate) {
      add(effects.v[0], e.v.x);
      add(effects.v[1], e.v.y);
      add(effects.v[2], e.v.z);
    }
    add(effects.u[0], e.u.x);
    add(effects.u[1], e.u.y);
    add(effects.u[2], e.u.z);
  }
}

template <class Law>
using LawOnStages = void (*)(const StepOfLaw<Law>&, const StageStates&, StageEffects&);

// Those of the library's own terms are compiled for every set (src/perturb/lanes).
template <class Law>
LawOnStages<Law> library_law(InstructionSet set);
template <class Law>
concept LibraryLaw = requires { requires Law::in_library; };

template <class Law>
LawOnStages<Law> law_in_lanes(InstructionSet set) {
  if constexpr (LibraryLaw<Law>) {
    return library_law<Law>(set);
  } else {
    return &law_on_stages<InstructionSet::baseline, Law>;
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
