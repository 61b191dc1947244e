// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "eddy-currents".
#include <array>
#include <variant>

#include "scenario/detail/torque_kinds.hpp"
#include "scenario/kinds/torques/dipole_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct Arguments : DipoleArguments {
  LinearMap tensor;
  bool field_rate;
};

constexpr std::array own_keys = {
    quantity_key<&Arguments::tensor>(
        "tensor", Dimension::magnetic_tensor,
        "Magnetic tensor M of the torque (M (omega x B - dB/dt)) x B in body axes: its diagonal, "
        "or three rows.")
        .required()
        .example("{ value = [500, 500, 500], unit = \"S m4\" }"),
    flag_key<&Arguments::field_rate>(
        "field_rate", "Whether dB/dt along the orbit counts; false: currents by omega x B alone.")
        .otherwise("true"),
};
constexpr auto keys = joined(dipole_keys<Arguments>, own_keys);

MadeTerms made(const Arguments& a, const TermContext& at) {
  const ScenarioOrbit& orbit = at.orbit("orbit");
  const NamedDipole dipole = dipole_of(a, at);
  const FieldRate rate = a.field_rate ? FieldRate::along_orbit : FieldRate::left_out;
  return at.built("tensor", [&] {
    return std::visit(
        [&](const auto& motion) -> AnyPerturbation {
          const FieldAlongOrbit field(motion, dipole.field);
          const EddyCurrents in_file_axes(a.tensor.matrix, field, rate);  // refuses
          return {"eddy currents, orbit " + orbit.name + dipole.text,
                  EddyCurrents(at.principal(in_file_axes.tensor()), field, rate)};
        },
        orbit.motion);
  });
}

}  // namespace

PerturbationKind eddy_currents_kind() {
  return perturbation_kind<Arguments>(
      "eddy-currents", "Currents that a magnetic field induces in a body that turns in it.", keys,
      made,
      {{"praly2012",
        "Praly, N., Hillion, M., Bonnal, C., Laurent-Varin, J., Petit, N. (2012). Study on the "
        "eddy current damping of the spin dynamics of space debris from the Ariane launcher upper "
        "stages. Acta Astronautica 76, 145-153.",
        "the torque on eddy currents"},
       dipole_citation()});
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
