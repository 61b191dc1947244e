// SPDX-License-Identifier: MIT
// From the values of a file to a constant torque, damping.
#include "io/detail/perturbation_kinds.hpp"
#include "io/detail/value_access.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/linear_damping.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

AnyPerturbation constant_torque_term(const TermPlace& at) {
  const Vec3 torque = vector(at.values, at.key("torque"));
  if (word(at.values, at.key("axes")) == "inertial")
    return {"constant torque, inertial axes", ConstantTorque::in_space(torque)};
  return {"constant torque, body axes", ConstantTorque::in_body(principal_components(at, torque))};
}

// The body axes of the file are those of its tensor; the term wants principal axes.
AnyPerturbation damping_term(const TermPlace& at) {
  const std::string key = at.key("coefficients");
  const std::vector<double>& n = value_at(at.values, key).numbers;
  const Quaternion& q_FB = at.scenario.q_file;
  return built(at.values, key, at.name, [&]() -> AnyPerturbation {
    if (n.size() == 3 && q_FB == Quaternion{})
      return {"damping", LinearDamping(vector(at.values, key))};
    const LinearDamping in_file_axes(matrix_at(at, "coefficients"), at.scenario.body);
    const Mat3 D = principal_matrix(at, in_file_axes.matrix());
    return {"damping", LinearDamping(D, at.scenario.body)};
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
