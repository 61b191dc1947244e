// SPDX-License-Identifier: MIT
#include "polhode/rotor/andoyer.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

double component(const std::string& name, double value, double G) {
  if (std::abs(value) <= G) return value;
  if (!(std::abs(value) <= G * (1.0 + 4.0 * std::numeric_limits<double>::epsilon()))) {
    throw DomainError("andoyer_state: " + name + " = " + detail::number_text(value) +
                      " must be within +-G, G = " + detail::number_text(G));
  }
  return std::copysign(G, value);
}

}  // namespace

AndoyerState andoyer_state(double l, double g, double h, double L, double G, double H) {
  for (const double x : {l, g, h, L, G, H}) {
    if (!std::isfinite(x)) {
      throw DomainError("andoyer_state: " + detail::tuple_text({l, g, h, L, G, H}) +
                        " must be finite");
    }
  }
  if (G < 0.0) {
    throw DomainError("andoyer_state: G = " + detail::number_text(G) + " must not be negative");
  }
  return {l, g, h, component("L", L, G), G, component("H", H, G)};
}

template RotorState to_rotor(const AndoyerState&);
template AndoyerState to_andoyer(const RotorState&);

}  // namespace v0
}  // namespace polhode
