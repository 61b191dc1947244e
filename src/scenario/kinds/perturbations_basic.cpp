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

void add_kane_damper(Scenario& scenario, const Values& values, const std::string& path,
                     const std::string& name) {
  if (scenario.damper)
    refuse(values, path + ".kind", name, "expected at most one perturbation of this kind");
  const double friction = number(values, path + ".friction");
  if (!(friction >= 0.0))
    refuse(values, path + ".friction", name, "expected a friction that is not negative");
  scenario.damper = built(values, path + ".sphere_moment", name, [&] {
    const KaneDamper damper(number(values, path + ".sphere_moment"), friction);
    damper.require_room(scenario.body);
    return damper;
  });
  const std::string rate = path + ".rate_relative";
  if (there(values, rate))
    scenario.damper_rate =
        principal_components({scenario, values, path, name}, vector(values, rate));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
