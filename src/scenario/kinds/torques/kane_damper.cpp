// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "kane-damper", which is no term: a scenario has one at most.
#include <optional>

#include "scenario/detail/torque_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct Arguments {
  double sphere_moment;
  double friction;
  std::optional<Vec3> rate_relative;
};

constexpr KindKey<Arguments> keys[] = {
    quantity_key<&Arguments::sphere_moment>(
        "sphere_moment", Dimension::moment,
        "Moment of inertia of the sphere about its centre; the moments of the body are those of "
        "both.")
        .required()
        .example("0.1"),
    quantity_key<&Arguments::friction>("friction", Dimension::damping,
                                       "Torque on the sphere per rate relative to the body.")
        .required()
        .example("0.01"),
    quantity_key<&Arguments::rate_relative>(
        "rate_relative", Dimension::rate,
        "Rate of the sphere relative to the body at t = 0, along the body axes; left out, it turns "
        "with the body.")
        .example("[0.0, 0.0, 0.0]"),
};

MadeTerms made(const Arguments& a, const TermContext& at) {
  if (!(a.friction >= 0.0)) at.refuse("friction", "expected a friction that is not negative");
  const KaneDamper damper = at.built("sphere_moment", [&] {
    const KaneDamper one(a.sphere_moment, a.friction);
    one.require_room(at.body());
    return one;
  });
  return DamperAtStart{damper, a.rate_relative ? at.principal(*a.rate_relative) : Vec3{}};
}

}  // namespace

PerturbationKind kane_damper_kind() {
  return perturbation_kind<Arguments>(
      "kane-damper", "A sphere in a cavity of the body, with viscous friction between them.", keys,
      made,
      {{"kane1966",
        "Kane, T. R., Barba, P. M. (1966). Effects of energy dissipation on a spinning satellite. "
        "AIAA Journal 4, 1392-1394.",
        "a sphere in a cavity that damps"}});
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
