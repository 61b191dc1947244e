// SPDX-License-Identifier: MIT
// The equations of motion of a system with its damper.
#pragma once

#include "perturb/damper_kernel.hpp"
#include "system/rotor_equations.hpp"

namespace polhode {
inline namespace v0 {

template <Real T>
struct BasicDampedRates {
  BasicRotorRates<T> rotor;
  BasicVec3<T> damper_rate;
};

template <Real T>
class DampedEquations {
 public:
  // The system has a damper.
  explicit DampedEquations(const System& system)
      : rotor_(system), damper_(system.body(), *system.damper()) {}

  const RotorEquations<T>& rotor() const { return rotor_; }

  BasicDampedRates<T> operator()(const DoubleDouble& t, const BasicRotorState<T>& s,
                                 const BasicVec3<T>& damper_rate,
                                 const SwitchSides* sides = nullptr) const {
    const BasicVec3<T> w0 = rotor_.free_rate(s.g) + damper_.rate_of_body(damper_rate);
    const BasicRotorRates<T> r =
        rotor_.rates(t, s, sides, [&w0](const BasicVec3<T>&) { return w0; });
    return {r, damper_.acceleration(w0, r.g, damper_rate)};
  }

 private:
  RotorEquations<T> rotor_;
  detail::DamperKernel<T> damper_;
};

}  // namespace v0
}  // namespace polhode
