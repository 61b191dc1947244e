// SPDX-License-Identifier: MIT
// A method from outside: the classical Runge-Kutta of order 4 on (q, g).
#pragma once

#include "polhode/dynamics/custom_method.hpp"

namespace polhode::test {

// s + h r, not normalised.
inline RotorState moved(const RotorState& s, const BasicRotorRates<double>& r, double h) {
  return {{s.q.w + h * r.q.w, s.q.x + h * r.q.x, s.q.y + h * r.q.y, s.q.z + h * r.q.z},
          s.g + h * r.g};
}

inline RotorState runge_kutta_4(const System& system, double t, const RotorState& s, double h) {
  const auto k1 = rotor_rates(system, t, s);
  const auto k2 = rotor_rates(system, t + 0.5 * h, moved(s, k1, 0.5 * h));
  const auto k3 = rotor_rates(system, t + 0.5 * h, moved(s, k2, 0.5 * h));
  const auto k4 = rotor_rates(system, t + h, moved(s, k3, h));
  const RotorState first = moved(moved(s, k1, h / 6.0), k4, h / 6.0);
  return moved(moved(first, k2, h / 3.0), k3, h / 3.0);
}

inline CustomMethod runge_kutta_4(double step) {
  return custom_method({.kind = "runge-kutta-4",
                        .step = step,
                        .map = [](const System& system, double t, const RotorState& s, double h) {
                          return runge_kutta_4(system, t, s, h);
                        }});
}

}  // namespace polhode::test
