// SPDX-License-Identifier: MIT
#include "dynamics/detail/adaptive_stepper.hpp"
#include "dynamics/detail/damper_field.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
Vec3 damper_rate_of(const DamperField<T>&, const DamperValues<T>& y) {
  return rounded(damper_rate<T>(y));
}
template <Real T>
DamperErrorSize error_size(const DamperField<T>& field) {
  return DamperErrorSize(field.system().body());
}
template <Real T>
DamperValues<T> start_values(const DamperField<T>&, const BasicRotorState<T>& s,
                             const Vec3& damper_rate) {
  return damper_values(s, damper_rate);
}

std::unique_ptr<Stepper> make_damper_stepper(const Problem& problem, const Adaptive& method) {
  return stepper_of<DamperField>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
