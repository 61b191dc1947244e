// SPDX-License-Identifier: MIT
// Every term of the library, and one of a user's, for tests of what asks them together.
#pragma once

#include <array>
#include <vector>

#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/magnetic_field.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/perturb/tidal_torque.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "unit/perturb/support.hpp"
#include "unit/perturb/surfaces.hpp"

namespace perturb_test {

using namespace polhode;

inline AnyOrbit orbit() { return AnyOrbit("orbit", KeplerOrbit({1.0, 0.9, 0.1, 0.5, 0.3, 0.2})); }

inline Mat3 matrix(const std::array<double, 9>& rows) {
  Mat3 m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = rows[static_cast<std::size_t>(i)];
  return m;
}

inline std::vector<AnyPerturbation> every_term(const Body& body) {
  shape::MassMoments moments;
  for (std::size_t i = 0; i < moments.third.size(); ++i)
    moments.third[i] = 0.01 * static_cast<double>(i + 1);
  for (std::size_t i = 0; i < moments.fourth.size(); ++i)
    moments.fourth[i] = 0.02 * static_cast<double>(i + 1);
  const DipoleField dipole({0.1, 0.2, 0.9}, {{0.1, 0.0, 1.0}, 0.7, 0.2, 0.0});
  const FieldAlongOrbit field(orbit(), dipole);
  const Surface surface = drawn_surface(3, 12);
  const DirectedPath path{orbit()};
  const AnyOrbit far("far", KeplerOrbit({1.0, 200.0, 0.01}));
  const auto own = [](const auto& t, const auto& s) {
    auto u = s.g;
    u.x = t * s.g.y;
    return u;
  };
  return {
      {"gravity gradient", GravityGradient(1.0, orbit())},
      {"in S", GravityGradient(1.0, orbit(), SpaceAxes::reference)},
      {"higher gravity", HigherGravity(1.0, orbit(), moments, OrbitOf::body)},
      {"oblate gravity", OblateGravity(1.0, orbit(), Oblateness{1e-3, 0.4, {0.1, 0.2, 0.9}})},
      {"constant in body", ConstantTorque::in_body({0.1, 0.2, 0.3})},
      {"constant in space", ConstantTorque::in_space({0.1, 0.2, 0.3})},
      {"damping", LinearDamping(0.1)},
      {"full damping",
       LinearDamping(matrix({0.3, 0.1, 0.0, 0.1, 0.2, 0.05, 0.0, 0.05, 0.4}), body)},
      {"internal damping", InternalDamping(Vec3{0.1, 0.2, 0.3}, true)},
      {"table",
       TorqueTable({{-4.0, {0.0, 0.1, 0.2}}, {1.0, {0.2, 0.1, 0.0}}, {4.0, {}}},
                   {TorqueTable::Between::cubic, TorqueTable::Outside::zero, SpaceAxes::inertial})},
      {"tide", TidalTorque(1.0, 1.0, orbit(), TidalBody{0.3, 0.01, 0.5})},
      {"dipole", ResidualDipole({0.1, 0.2, 0.3}, field)},
      {"eddy", EddyCurrents(matrix({0.1, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.3}), field)},
      {"sunlight",
       SolarPressure(surface, {0.1, 200.0}, path, DirectedPath{far}, Shadow::cone(0.5, 3.0))},
      {"drag", AtmosphericDrag(surface, {0.1, 1.0, 0.3, {0.0, 0.0, 0.2}}, path, 0.05)},
      {"own", TorqueTerm(own)},
  };
}

}  // namespace perturb_test
