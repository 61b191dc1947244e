// SPDX-License-Identifier: MIT
// Splitting of a model that knows its motion while time stands still: that motion and the passing
// of time, in turn. Both are exact, so that a step keeps what the frozen motion keeps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "polhode/dynamics/detail/fixed_stepper.hpp"
#include "polhode/dynamics/detail/splitting_scheme.hpp"
#include "polhode/dynamics/model.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Why a step from t has no state.
std::string frozen_failure_text(std::string_view name, double t);

template <FrozenModel M>
struct FrozenTimeSplitting {
  using Shown = typename M::State;
  using State = TimedState<Shown>;

  M model;
  // Motions are its drifts, the passing of time its kicks.
  SplittingCoefficients parts;

  State stepped(State at, double h) const {
    if constexpr (requires { model.frozen(std::span<const FrozenPart>(), at.s); }) {
      std::array<FrozenPart, most_frozen_parts> all;
      std::size_t count = 0;
      each_part(at.t, h, [&](const DoubleDouble& t, double part) { all[count++] = {t.hi, part}; });
      at.s = model.frozen(std::span<const FrozenPart>(all.data(), count), at.s);
    } else {
      each_part(at.t, h,
                [&](const DoubleDouble& t, double part) { at.s = model.frozen(t, at.s, part); });
    }
    at.t = at.t + DoubleDouble(h);
    return at;
  }
  Shown state(const State& at) const { return at.s; }
  std::string failure(const State& from, State& to) const {
    return goes_on(to.s) ? std::string() : frozen_failure_text(M::name, from.t.hi);
  }
  std::int64_t evaluations(const State&, std::int64_t steps) const {
    return steps * static_cast<std::int64_t>(parts.drifts.size());
  }
  void serialize(Archive& bytes, State& at) const {
    bytes(at.t);
    bytes(at.s);
  }

 private:
  template <class Move>
  void each_part(DoubleDouble t, double h, const Move& move) const {
    const std::size_t later = parts.drift_first ? 0 : 1;
    for (std::size_t k = 0; k < parts.drifts.size() + later; ++k) {
      if (k >= later) move(t, parts.drifts[k - later] * h);
      if (k < parts.kicks.size()) t = t + DoubleDouble(parts.kicks[k] * h);
    }
  }
  bool goes_on(Shown& next) const {
    if constexpr (requires { model.goes_on(next); })
      return model.goes_on(next);
    else
      return has_finite_numbers(next);
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
