// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "constant-torque".
#include "polhode/perturb/constant_torque.hpp"

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

enum class Axes { body, inertial };

struct Arguments {
  Vec3 torque;
  Axes axes;
};

constexpr KindKey<Arguments> keys[] = {
    quantity_key<&Arguments::torque>("torque", Dimension::torque, "The torque.")
        .required()
        .example("[0.0, 0.0, 0.001]"),
    torque_axes_key<&Arguments::axes, Axes::body, Axes::inertial>(),
};

MadeTerms made(const Arguments& a, const TermContext& at) {
  if (a.axes == Axes::inertial)
    return AnyPerturbation("constant torque, inertial axes", ConstantTorque::in_space(a.torque));
  return AnyPerturbation("constant torque, body axes",
                         ConstantTorque::in_body(at.principal(a.torque)));
}

}  // namespace

PerturbationKind constant_torque_kind() {
  return perturbation_kind<Arguments>(
      "constant-torque", "A torque that is constant in the body or in inertial axes.", keys, made);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
