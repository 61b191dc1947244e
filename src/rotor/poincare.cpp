// SPDX-License-Identifier: MIT
#include "polhode/rotor/poincare.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

void require_pair(const std::string& name, double Q, double P, double G) {
  // halves: Q^2 + P^2 <= 4 G without overflow of 4 G
  const double radius = std::hypot(0.5 * Q, 0.5 * P);
  if (radius > std::sqrt(G) * (1.0 + 4.0 * std::numeric_limits<double>::epsilon())) {
    throw DomainError("poincare_state: (Q" + name + ", P" + name +
                      ") = " + detail::tuple_text({Q, P}) +
                      " must have Q^2 + P^2 <= 4 G, G = " + detail::number_text(G));
  }
}

}  // namespace

PoincareState poincare_state(double sigma, double Q1, double Q2, double G, double P1, double P2,
                             Pole pole_J, Pole pole_I) {
  for (const double x : {sigma, Q1, Q2, G, P1, P2}) {
    if (!std::isfinite(x)) {
      throw DomainError("poincare_state: " + detail::tuple_text({sigma, Q1, Q2, G, P1, P2}) +
                        " must be finite");
    }
  }
  if (G < 0.0) {
    throw DomainError("poincare_state: G = " + detail::number_text(G) + " must not be negative");
  }
  require_pair("1", Q1, P1, G);
  require_pair("2", Q2, P2, G);
  return {sigma, Q1, Q2, G, P1, P2, pole_J, pole_I};
}

template RotorState to_rotor(const PoincareState&);
template PoincareState to_poincare(const RotorState&, Pole, Pole);
template PoincareState nearest_poincare(const RotorState&);

}  // namespace v0
}  // namespace polhode
