// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "residual-dipole".
#include <array>
#include <variant>

#include "scenario/detail/torque_kinds.hpp"
#include "scenario/kinds/torques/dipole_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct Arguments : DipoleArguments {
  Vec3 moment;
};

constexpr std::array own_keys = {
    quantity_key<&Arguments::moment>("moment", Dimension::magnetic_moment,
                                     "Magnetic moment of the body, along its axes.")
        .required()
        .example("{ value = [0.0, 0.0, 1.0], unit = \"A m2\" }"),
};
constexpr auto keys = joined(dipole_keys<Arguments>, own_keys);

MadeTerms made(const Arguments& a, const TermContext& at) {
  const ScenarioOrbit& orbit = at.orbit("orbit");
  const NamedDipole dipole = dipole_of(a, at);
  const Vec3 m = at.principal(a.moment);
  return std::visit(
      [&](const auto& motion) -> AnyPerturbation {
        return {"residual dipole, orbit " + orbit.name + dipole.text,
                ResidualDipole(m, FieldAlongOrbit(motion, dipole.field))};
      },
      orbit.motion);
}

}  // namespace

PerturbationKind residual_dipole_kind() {
  return perturbation_kind<Arguments>("residual-dipole",
                                      "A magnetic moment of the body in a dipole field.", keys,
                                      made, {dipole_citation()});
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
