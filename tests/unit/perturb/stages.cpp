// SPDX-License-Identifier: MIT
// A term at many stages gives the bits of the term at one, by every set of instructions.
#include "polhode/perturb/stages.hpp"

#include <gtest/gtest.h>

#include <vector>

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
