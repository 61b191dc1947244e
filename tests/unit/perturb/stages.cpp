// SPDX-License-Identifier: MIT
// A term at many stages gives the bits of the term at one, by every set of instructions.
#include "polhode/detail/perturb/stages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <vector>

#include "polhode/orbit/kepler_orbit.hpp"
#include "unit/perturb/every_term.hpp"

namespace {

using namespace polhode;
using perturb_test::every_term;

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
  for (const AnyPerturbation& term : every_term(body))
    for (const InstructionSet set : supported_instruction_sets())
      for (const std::size_t count : {4U, 8U, 16U, 32U}) expect_bits(term, body, set, count);
}

// Along orbits that compute many times in lanes, and along one that does not.
struct Circle {
  template <Real T>
    requires(std::same_as<T, double> || std::same_as<T, DoubleDouble>)
  BasicVec3<T> position(const T& t) const {
    using std::cos;
    using std::sin;
    return {cos(t), sin(t), T(0.3)};
  }
};

template <Orbit O>
void add_terms_along(const O& orbit, std::vector<AnyPerturbation>& terms) {
  shape::MassMoments moments;
  moments.third[1] = 0.02;
  moments.fourth[2] = 0.03;
  const DipoleField dipole({0.1, 0.2, 0.9}, {{0.1, 0.0, 1.0}, 0.7, 0.2, 0.0});
  const FieldAlongOrbit field(orbit, dipole);
  const FieldAlongOrbit given(orbit, FieldFunction([](const auto& t, const auto& x) {
                                auto B = x;
                                B.x = t * x.y;
                                return B;
                              }));
  const Mat3 M = perturb_test::matrix({0.1, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.3});
  const AnyOrbit any("any", orbit);
  const Surface surface = perturb_test::drawn_surface(3, 12);
  const AnyOrbit far("far", KeplerOrbit({1.0, 200.0, 0.01}));
  terms.emplace_back("gravity gradient", GravityGradient(1.0, orbit));
  terms.emplace_back("in S", GravityGradient(1.0, orbit, SpaceAxes::reference));
  terms.emplace_back("any", GravityGradient(1.0, any));
  terms.emplace_back("higher", HigherGravity(1.0, orbit, moments, OrbitOf::attractor));
  terms.emplace_back("oblate", OblateGravity(1.0, orbit, Oblateness{1e-3, 0.4, {0.1, 0.2, 0.9}}));
  terms.emplace_back("dipole", ResidualDipole({0.1, 0.2, 0.3}, field));
  terms.emplace_back("constant field", ResidualDipole({0.1, 0.2, 0.3}, ConstantField({1, 2, 3})));
  terms.emplace_back("given field", ResidualDipole({0.1, 0.2, 0.3}, given));
  terms.emplace_back("eddy without rate", EddyCurrents(M, field, FieldRate::left_out));
  terms.emplace_back("sunlight from the Sun", SolarPressure(surface, {0.1, 1.0}, {any, true}));
  terms.emplace_back("sunlight", SolarPressure(surface, {0.1, 200.0}, {any}, DirectedPath{far},
                                               Shadow::cylinder(0.5)));
  if constexpr (OrbitOn<O, Dual<double, 1>>) {
    terms.emplace_back("eddy", EddyCurrents(M, field));
    terms.emplace_back("eddy in a given field", EddyCurrents(M, given));
    terms.emplace_back("tide", TidalTorque(1.0, 1.0, orbit, TidalBody{0.3, 0.01, 0.5}));
    terms.emplace_back("any tide", TidalTorque(1.0, 1.0, any, TidalBody{0.3, 0.01, 0.5}));
    const Atmosphere air{0.1, 1.0, 0.3, {0.0, 0.0, 0.2}};
    terms.emplace_back("drag", AtmosphericDrag(surface, air, {any}, 0.05));
    terms.emplace_back("drag of the reverse", AtmosphericDrag(surface, air, {any, true}));
  }
}

std::vector<AnyPerturbation> terms_along_orbits() {
  std::vector<AnyPerturbation> terms;
  const KeplerElements round{1.0, 0.8, 0.2, 0.5, 0.3, 0.2}, long_one{1.0, 0.3, 0.7, 0.5, 0.3, 0.2};
  const SecularRates rates{1e-3, 2e-3, 3e-4}, all{1e-3, 2e-3, 3e-4, 1e-3, 1e-4};
  add_terms_along(KeplerOrbit(long_one), terms);
  add_terms_along(PrecessingKeplerOrbit(round, rates), terms);
  add_terms_along(PrecessingKeplerOrbit(long_one, all), terms);
  add_terms_along(TurnedKeplerOrbit::from_equator(PrecessingKeplerOrbit(round, rates)), terms);
  add_terms_along(Circle{}, terms);
  return terms;
}

TEST(Stages, AlongAnyOrbitGiveTheBitsOfOneByEverySet) {
  const Body body(1.0, 1.7, 2.1);
  for (const AnyPerturbation& term : terms_along_orbits())
    for (const InstructionSet set : supported_instruction_sets())
      for (const std::size_t count : {4U, 8U, 16U}) expect_bits(term, body, set, count);
}

// In an inertial frame of which it is said, by terms that know of each other's orbits.
TEST(Stages, ThatShareOrbitsGiveTheBitsOfOne) {
  const Body body(1.0, 1.7, 2.1);
  const std::vector<AnyPerturbation> terms = terms_along_orbits();
  StageTimes times;
  StageStates states;
  times.count = 8;
  times.is_inertial = true;
  for (std::size_t i = 0; i < 8; ++i) {
    const perturb_test::Case c = perturb_test::drawn_case(23, i);
    times.t[i] = c.t;
    times.t_rest[i] = 1e-17 * static_cast<double>(i);
    const double numbers[] = {c.s.q.w, c.s.q.x, c.s.q.y, c.s.q.z, c.s.g.x, c.s.g.y, c.s.g.z};
    for (std::size_t n = 0; n < 7; ++n) states.rows[n][i] = numbers[n];
  }
  for (const InstructionSet set : supported_instruction_sets()) {
    SharedPlaces known;
    times.known = &known;
    for (const AnyPerturbation& term : terms) {
      StageEffects effects;
      const auto on_stages = term.on_stages(body, set);
      on_stages->begin(times, {});
      on_stages->add_to(effects, states);
      for (std::size_t i = 0; i < 8; ++i) {
        const RotorState s = perturb_test::drawn_case(23, i).s;
        const Effect alone = term.effect(Setting{body, times.t[i], s, {}, times.t_rest[i]});
        for (std::size_t n = 0; n < 3; ++n)
          EXPECT_EQ(effects.u[n][i], alone.u[static_cast<int>(n)]) << term.name();
      }
    }
  }
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
