// SPDX-License-Identifier: MIT
#include "dynamics/adaptive/rotor_field.hpp"
#include "dynamics/adaptive/term_stepper.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Adaptive& method) {
  return term_stepper<RotorField>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
