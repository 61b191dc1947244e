// SPDX-License-Identifier: MIT
// From the values of a file to magnetic torques.
#include "polhode/perturb/magnetic_torque.hpp"
#include "scenario/detail/perturbation_kinds.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

DipoleField dipole_at(const TermContext& at) {
  const Vec3 gauss = vector(at.values, at.key("gauss"));
  const std::string radius = at.key("reference_radius");
  if (!(number(at.values, radius) > 0.0))
    refuse(at.values, radius, at.name, "expected a positive length");
  const PrimaryRotation primary{.pole = vector(at.values, at.key("pole")),
                                .rate = number(at.values, at.key("rotation_rate")),
                                .meridian = number(at.values, at.key("meridian")),
                                .epoch = number(at.values, at.key("meridian_epoch"))};
  if (primary.pole == Vec3{})
    refuse(at.values, at.key("pole"), at.name, "expected a vector that is not zero");
  return built(at.values, at.key("gauss"), at.name, [&] {
    return DipoleField::from_gauss({gauss.x, gauss.y, gauss.z}, number(at.values, radius), primary);
  });
}

}  // namespace

AnyPerturbation residual_dipole_term(const TermContext& at) {
  const ScenarioOrbit& orbit = orbit_at(at);
  const DipoleField dipole = dipole_at(at);
  const Vec3 m = principal_components(at, vector(at.values, at.key("moment")));
  return std::visit(
      [&](const auto& motion) -> AnyPerturbation {
        return {"residual dipole, orbit " + orbit.name,
                ResidualDipole(m, FieldAlongOrbit(motion, dipole))};
      },
      orbit.motion);
}

AnyPerturbation eddy_currents_term(const TermContext& at) {
  const ScenarioOrbit& orbit = orbit_at(at);
  const DipoleField dipole = dipole_at(at);
  const std::string key = at.key("tensor");
  const FieldRate rate = value_at(at.values, at.key("field_rate")).whole == 1
                             ? FieldRate::along_orbit
                             : FieldRate::left_out;
  return built(at.values, key, at.name, [&] {
    return std::visit(
        [&](const auto& motion) -> AnyPerturbation {
          const FieldAlongOrbit field(motion, dipole);
          const EddyCurrents in_file_axes(matrix_at(at, "tensor"), field, rate);  // refuses
          return {"eddy currents, orbit " + orbit.name,
                  EddyCurrents(principal_matrix(at, in_file_axes.tensor()), field, rate)};
        },
        orbit.motion);
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
