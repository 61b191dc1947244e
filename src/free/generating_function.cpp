// SPDX-License-Identifier: MIT
#include "polhode/free/generating_function.hpp"

namespace polhode {
inline namespace v0 {

GeneratingFunction generating_function(const FreeRotation& motion, double t) {
  const SerretState c = to_serret(motion, t);
  const EulerState e = to_euler(motion.at(t));
  const double elapsed = t - c.t0;                                   // u/n
  const double S = (elapsed - c.t0) * c.T + c.H * c.h + c.G * c.g0;  // [SA (55)]
  return {S, e.Phi, e.Theta, e.Psi, c.g0, c.h, -c.t0, -c.T};
}

}  // namespace v0
}  // namespace polhode
