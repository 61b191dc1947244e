// SPDX-License-Identifier: MIT
#include "dynamics/detail/adaptive_stepper.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
Vec3 damper_rate_of(const RotorField<T>&, const RotorValues<T>&) {
  return {};
}
template <Real T>
RotorErrorSize error_size(const RotorField<T>&) {
  return {};
}
template <Real T>
RotorValues<T> start_values(const RotorField<T>&, const BasicRotorState<T>& s, const Vec3&) {
  return rotor_values(s);
}

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Adaptive& method) {
  require_valid(method);
  if (problem.system.damper()) return make_damper_stepper(problem, method);
  return stepper_of<RotorField>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
