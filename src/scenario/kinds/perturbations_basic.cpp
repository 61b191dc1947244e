// SPDX-License-Identifier: MIT
// From the values of a file to a constant torque, damping, a Kane damper.
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/linear_damping.hpp"
#include "scenario/detail/perturbation_kinds.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

AnyPerturbation constant_torque_term(const TermContext& at) {
  const Vec3 torque = vector(at.values, at.key("torque"));
  if (word(at.values, at.key("axes")) == "inertial")
    return {"constant torque, inertial axes", ConstantTorque::in_space(torque)};
  return {"constant torque, body axes", ConstantTorque::in_body(principal_components(at, torque))};
}

// The body axes of the file are those of its tensor; the term wants principal axes.
AnyPerturbation damping_term(const TermContext& at) {
  const std::string key = at.key("coefficients");
  const std::vector<double>& n = value_at(at.values, key).numbers;
  const Quaternion& q_FB = at.q_FB();
  return built(at.values, key, at.name, [&]() -> AnyPerturbation {
    if (n.size() == 3 && q_FB == Quaternion{})
      return {"damping", LinearDamping(vector(at.values, key))};
    const LinearDamping in_file_axes(matrix_at(at, "coefficients"), at.body());
    const Mat3 D = principal_matrix(at, in_file_axes.matrix());
    return {"damping", LinearDamping(D, at.body())};
  });
}

DamperAtStart kane_damper(const TermContext& at) {
  const double friction = number(at.values, at.key("friction"));
  if (!(friction >= 0.0))
    refuse(at.values, at.key("friction"), at.name, "expected a friction that is not negative");
  const KaneDamper damper = built(at.values, at.key("sphere_moment"), at.name, [&] {
    const KaneDamper made(number(at.values, at.key("sphere_moment")), friction);
    made.require_room(at.body());
    return made;
  });
  const std::string rate = at.key("rate_relative");
  return {damper,
          has(at.values, rate) ? principal_components(at, vector(at.values, rate)) : Vec3{}};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
