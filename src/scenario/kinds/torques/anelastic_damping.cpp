// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "anelastic-damping".
#include "polhode/perturb/internal_damping.hpp"
#include "scenario/detail/torque_kinds.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr KindKey<DampedMaterial> keys[] = {
    body_radius_key<&DampedMaterial::radius>(),
    quantity_key<&DampedMaterial::rigidity>("rigidity", Dimension::pressure,
                                            "Of the material of the body.")
        .required()
        .example("\"1 GPa\"")
        .positive(),
    quantity_key<&DampedMaterial::quality_factor>("quality_factor", Dimension::number,
                                                  "Q of its oscillations.")
        .required()
        .example("100")
        .positive(),
    quantity_key<&DampedMaterial::density>("body_density", Dimension::density,
                                           "Mean density of the body.")
        .required()
        .example("\"2000 kg/m3\"")
        .positive(),
    quantity_key<&DampedMaterial::shape_factor>(
        "shape_factor", Dimension::number,
        "K3 squared: about 0.1 for elongated bodies, 0.01 for nearly spherical ones.")
        .otherwise("0.1")
        .positive(),
};

MadeTerms made(const DampedMaterial& material, const TermContext& at) {
  return at.built("kind", [&]() -> AnyPerturbation {
    return {"internal damping", InternalDamping::of_material(at.body(), material)};
  });
}

}  // namespace

PerturbationKind anelastic_damping_kind() {
  return perturbation_kind<DampedMaterial>(
      "anelastic-damping", "Friction inside the body, from the material that it is made of.", keys,
      made,
      {{"burns1973",
        "Burns, J. A., Safronov, V. S. (1973). Asteroid nutation angles. Monthly Notices of the "
        "Royal Astronomical Society 165, 403-411.",
        "the time in which a wobble dies"}});
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
