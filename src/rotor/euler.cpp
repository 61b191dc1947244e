// SPDX-License-Identifier: MIT
#include "polhode/rotor/euler.hpp"

#include <cmath>
#include <limits>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

EulerState euler_state(double phi, double theta, double psi, double Phi, double Theta, double Psi) {
  for (const double x : {phi, theta, psi, Phi, Theta, Psi}) {
    if (!std::isfinite(x)) {
      throw DomainError("euler_state: " + detail::tuple_text({phi, theta, psi, Phi, Theta, Psi}) +
                        " must be finite");
    }
  }
  const bool at_zero = theta == 0.0, at_pi = std::abs(theta) == pi<double>();
  if ((at_zero && Phi != Psi) || (at_pi && Phi != -Psi)) {
    throw DomainError("euler_state: momenta (Phi, Psi) = " + detail::tuple_text({Phi, Psi}) +
                      " at theta = " + detail::number_text(theta) +
                      " must satisfy Phi = " + (at_zero ? "Psi" : "-Psi"));
  }
  return {phi, theta, psi, Phi, Theta, Psi};
}

template RotorState to_rotor(const EulerState&);
template EulerState to_euler(const RotorState&);
template RotorState to_rotor(const Body&, const EulerRates&);
template EulerRates to_euler_rates(const Body&, const RotorState&);

}  // namespace v0
}  // namespace polhode
