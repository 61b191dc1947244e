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
  const Quaternion& q_FB = at.scenario.body.q_FB();
  return built(at.values, key, at.name, [&]() -> AnyPerturbation {
    if (n.size() == 3 && q_FB == Quaternion{})
      return {"damping", LinearDamping(vector(at.values, key))};
    const Mat3 D_F = n.size() == 3 ? Mat3{{{n[0], 0.0, 0.0}, {0.0, n[1], 0.0}, {0.0, 0.0, n[2]}}}
                                   : Mat3{{{n.at(0), n.at(1), n.at(2)},
                                           {n.at(3), n.at(4), n.at(5)},
                                           {n.at(6), n.at(7), n.at(8)}}};
    const LinearDamping in_file_axes(D_F, at.scenario.body);  // refuses what is no damping
    const Mat3 R = rotation_matrix(q_FB);                     // v_F = R v_B
    const Mat3 D = transpose(R) * in_file_axes.matrix() * R;
    Mat3 even = D;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) even(i, k) = 0.5 * (D(i, k) + D(k, i));
    return {"damping", LinearDamping(even, at.scenario.body)};
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
