// SPDX-License-Identifier: MIT
// Problem: what moves, its state at the start, and how it is brought to the end.
//
// Equations   those of the system.
// Units       those of the system.
// Domain      any model of polhode/dynamics/model.hpp, or a System: its state is that of a rotor
//             and of the damper, if it has one.
// Errors      DomainError where it is made with a time that is not finite. It is a plain value:
//             functions that integrate it check it, all of it.
#pragma once

#include <optional>
#include <type_traits>
#include <vector>

#include "polhode/dynamics/detail/finite_span.hpp"
#include "polhode/dynamics/event.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/system/system.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {

// That of a run which names none.
template <class M>
constexpr auto default_method() {
  if constexpr (std::is_same_v<M, System>)
    return default_rotor_method;
  else
    return default_model_method;
}

template <class M>
struct BasicProblem {
  using State = typename M::State;

  M system;
  State initial;  // at `start`; of a system q_SB, g_B, and the rate of the damper
  double start;
  double stop;
  Method method = default_method<M>();
  std::vector<BasicEvent<State>> events = {};
  // This run continues one that ended at `start`, which has already reported any event there.
  bool continues = false;
  // Last, and left out: it looks at the times, and holds nothing.
  [[no_unique_address]] detail::FiniteSpan span = {start, stop};
};
using Problem = BasicProblem<System>;

// What to keep in memory.
struct Keep {
  std::optional<SaveAt> samples = std::nullopt;  // none: the end of every step
  bool dense = true;
  // Of dense output, and of samples at the end of every step. A run that needs more fails there.
  double most_bytes = 1e9;
};

}  // namespace v0
}  // namespace polhode
