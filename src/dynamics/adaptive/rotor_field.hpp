// SPDX-License-Identifier: MIT
// The equations of motion of a rotor as an ode sees them: an array of (q, g) and its rates.
#pragma once

#include "dynamics/adaptive/rotor_values.hpp"
#include "polhode/system/rotor_equations.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
class RotorField {
 public:
  using Number = T;
  using Values = RotorValues<T>;
  using State = RotorState;

  explicit RotorField(const System& system) : equations_(system) {}

  const System& system() const { return equations_.system(); }
  const RotorEquations<T>& equations() const { return equations_; }
  // The field whose stages say what is not finite.
  const RotorField& watched() const { return *this; }

  [[gnu::always_inline]] Values operator()(const DoubleDouble& t, const Values& y,
                                           const SwitchSides* sides = nullptr) const {
    return equations_(t, rotor_state<T>(y), sides, AsValues{});
  }

  static Values start(const RotorState& s) { return rotor_values(widened<T>(s)); }
  static Values values(const RotorState& s) { return rotor_values(s); }
  static RotorState state(const Values& y) { return rounded(rotor_state<T>(y)); }
  static RotorState rotor(const Values& y) { return state(y); }
  static double error_size(const Values& error, const Values& y, const Values& increment) {
    return RotorErrorSize()(error, y, increment);
  }
  static void settle(CompensatedState<T, rotor_size<T>>& s) { restore_norm(s); }

 private:
  struct AsValues {
    [[gnu::always_inline]] Values operator()(const BasicRotorRates<T>& r) const {
      return {r.q.w, r.q.x, r.q.y, r.q.z, r.g.x, r.g.y, r.g.z};
    }
  };

  RotorEquations<T> equations_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
