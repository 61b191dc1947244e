// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "constant-torque".
#include "polhode/perturb/constant_torque.hpp"

#include <optional>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct Arguments {
  Vec3 torque;
  TorqueAxes axes;
};

constexpr KindKey<Arguments> keys[] = {
    quantity_key<&Arguments::torque>("torque", Dimension::torque, "The torque.")
        .required()
        .example("[0.0, 0.0, 0.001]"),
    torque_axes_key<&Arguments::axes>(),
};

Arguments principal(Arguments a, const TermContext& at) {
  if (a.axes == TorqueAxes::body) a.torque = at.principal(a.torque);
  return a;
}

MadeTerms made(const Arguments& a, const TermContext& at) {
  const std::optional<SpaceAxes> axes = space_axes(a.axes);
  if (!axes)
    return AnyPerturbation(at.name("constant torque, body axes"),
                           ConstantTorque::in_body(a.torque));
  const bool inertial = *axes == SpaceAxes::inertial;
  return AnyPerturbation(
      at.name(inertial ? "constant torque, inertial axes" : "constant torque, reference axes"),
      ConstantTorque::in_space(a.torque, *axes));
}

}  // namespace

PerturbationKind constant_torque_kind() {
  return perturbation_kind<Arguments>("constant-torque",
                                      "A torque that is constant in the body or in space.", keys,
                                      made, {}, principal);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
