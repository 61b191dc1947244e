// SPDX-License-Identifier: MIT
// A term at many stages gives the bits of the term at one, by every set of instructions.
#include "polhode/perturb/stages.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/higher_gravity.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/linear_damping.hpp"
#include "polhode/perturb/magnetic_field.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/perturb/oblate_gravity.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/perturb/tidal_torque.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "support.hpp"
#include "surfaces.hpp"

namespace {

using namespace polhode;
using perturb_test::Draw;

AnyOrbit orbit() { return AnyOrbit("orbit", KeplerOrbit({1.0, 0.9, 0.1, 0.5, 0.3, 0.2})); }

Mat3 matrix(const std::array<double, 9>& rows) {
  Mat3 m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = rows[static_cast<std::size_t>(i)];
  return m;
}

std::vector<AnyPerturbation> terms(const Body& body) {
  MassMoments moments;
  for (std::size_t i = 0; i < moments.third.size(); ++i)
    moments.third[i] = 0.01 * static_cast<double>(i + 1);
  for (std::size_t i = 0; i < moments.fourth.size(); ++i)
    moments.fourth[i] = 0.02 * static_cast<double>(i + 1);
  const DipoleField dipole({0.1, 0.2, 0.9}, {{0.1, 0.0, 1.0}, 0.7, 0.2, 0.0});
  const FieldAlongOrbit field(orbit(), dipole);
  const Surface surface = perturb_test::drawn_surface(3, 12);
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

void expect_bits(const AnyPerturbation& term, const Body& body, InstructionSet set,
                 std::size_t count) {
  StageTimes times;
  times.count = count;
  StageStates states;
  std::vector<Effect> alone;
  for (std::size_t i = 0; i < count; ++i) {
    const perturb_test::Case c = perturb_test::drawn_case(17, i);
    times.t[i] = c.t;
    times.t_rest[i] = 1e-17 * static_cast<double>(i);
    times.q_IS[i] = c.q_IS;
    const double numbers[] = {c.s.q.w, c.s.q.x, c.s.q.y, c.s.q.z, c.s.g.x, c.s.g.y, c.s.g.z};
    for (std::size_t n = 0; n < 7; ++n) states.rows[n][i] = numbers[n];
    alone.push_back(term.effect(Setting{body, c.t, c.s, c.q_IS, times.t_rest[i]}));
  }
  const auto on_stages = term.on_stages(body, set);
  StageEffects effects;
  on_stages->begin(times, {});
  on_stages->add_to(effects, states);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t n = 0; n < 3; ++n) {
      const int k = static_cast<int>(n);
      EXPECT_EQ(effects.u[n][i], alone[i].u[k]) << term.name() << " u" << k << " " << i;
      EXPECT_EQ(effects.v[n][i], alone[i].v[k]) << term.name() << " v" << k << " " << i;
      EXPECT_TRUE(on_stages->adds_rate() || alone[i].v[k] == 0.0) << term.name();
    }
}

TEST(Stages, GiveTheBitsOfOneByEverySet) {
  const Body body(1.0, 1.7, 2.1);
  for (const AnyPerturbation& term : terms(body))
    for (const InstructionSet set : supported_instruction_sets())
      for (const std::size_t count : {4U, 8U, 16U, 32U}) expect_bits(term, body, set, count);
}

// A sum of two terms: each adds to what is there.
TEST(Stages, Add) {
  const Body body(1.0, 1.7, 2.1);
  const AnyPerturbation term("constant", ConstantTorque::in_body({0.1, 0.2, 0.3}));
  const auto on_stages = term.on_stages(body, InstructionSet::baseline);
  StageTimes times;
  times.count = 8;
  StageEffects effects;
  on_stages->begin(times, {});
  on_stages->add_to(effects, {});
  on_stages->add_to(effects, {});
  EXPECT_EQ(effects.u[2][7], 0.6);
}

}  // namespace
