// SPDX-License-Identifier: MIT
// Sadov's variables and Serret's elements of many states: the same bits by every set of
// instructions and next to any neighbours, those of the motion through each state but for rounding,
// and the state again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "unit/free/support.hpp"
#include "worst.hpp"

namespace {

using namespace free_test;
using namespace polhode;
using free_test::pi;
using polhode::test::Worst;

std::vector<std::uint64_t> bits_of_all(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> b;
  for (const double x : numbers) b.push_back(std::bit_cast<std::uint64_t>(x));
  return b;
}
std::vector<std::uint64_t> bits_of(const SadovState& s) {
  return bits_of_all({static_cast<double>(s.region), double(s.lobe), s.phi_l, s.phi_g, s.phi_h,
                      s.I_l, s.I_g, s.I_h});
}
std::vector<std::uint64_t> bits_of(const SerretState& s) {
  return bits_of_all({s.g0, s.h, s.t0, s.G, s.H, s.T, double(s.sign_g1), double(s.sign_g3)});
}
std::vector<std::uint64_t> bits_of(const RotorState& s) {
  return bits_of_all({s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z});
}

std::vector<SadovState> converted(const Body& body, const std::vector<RotorState>& states,
                                  InstructionSet set = widest_instruction_set()) {
  std::vector<SadovState> results(states.size());
  to_sadov(body, states, results, set);
  return results;
}

RotorState any_state(Draw& draw, const Vec3& g) {
  return {normalized(Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}), g};
}
std::vector<RotorState> any_states(Draw& draw, std::size_t count) {
  std::vector<RotorState> all;
  for (std::size_t i = 0; i < count; ++i)
    all.push_back(any_state(draw, {draw.normal(), draw.normal(), draw.normal()}));
  return all;
}

// Down to the separatrix of moments 1, 1.7 and 2.1, by 10^least, and to the axes of circulation.
std::vector<RotorState> edge_states(Draw& draw, int count, double least) {
  const double slope = std::sqrt(0.7 * 2.1 / (0.4 * 1.0));  // g3/g1 on the separatrix
  std::vector<RotorState> states;
  for (int i = 0; i < count; ++i) {
    const double x = draw.sign() * draw.uniform(0.1, 1.0);
    const double off = draw.sign() * draw.power_of_ten(least, -1.0);
    states.push_back(any_state(draw, {x, draw.normal(), draw.sign() * x * slope * (1.0 + off)}));
    const double small = draw.power_of_ten(-16.0, -1.0);
    states.push_back(any_state(draw, {small * draw.normal(), small * draw.normal(), draw.sign()}));
    states.push_back(any_state(draw, {draw.sign(), small * draw.normal(), small * draw.normal()}));
  }
  return states;
}

// Axes in every order, nearly flat, nearly a needle, and one with two moments near each other.
std::vector<Body> bodies() {
  return {Body(1.0, 1.7, 2.1),  Body(2.1, 1.0, 1.7),     Body(1.7, 2.1, 1.0),
          Body(2.1, 1.7, 1.0),  Body(1.0, 2.1, 1.7),     Body(1.7, 1.0, 2.1),
          Body(1.0, 1.01, 2.0), Body(0.01, 1.0, 1.0005), Body(3.0, 3.1, 6.0)};
}

// As far as the angles mean something: sin I of the state.
double tilt(const SadovState& s) { return std::sqrt((s.I_g - s.I_h) * (s.I_g + s.I_h)) / s.I_g; }
double angle(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * pi)); }

void expect_near(const SadovState& got, const SadovState& of_motion, const std::string& what) {
  EXPECT_EQ(got.region, of_motion.region) << what;
  EXPECT_EQ(got.lobe, of_motion.lobe) << what;
  const double G = of_motion.I_g, loss = 1.0 / tilt(of_motion);
  EXPECT_LE(std::abs(got.I_l - of_motion.I_l), budget::lane_sadov * G) << what;
  EXPECT_LE(std::abs(got.I_g - of_motion.I_g), budget::lane_sadov * G) << what;
  EXPECT_LE(std::abs(got.I_h - of_motion.I_h), budget::lane_sadov * G) << what;
  EXPECT_LE(angle(got.phi_l, of_motion.phi_l), budget::lane_sadov) << what;
  EXPECT_LE(angle(got.phi_h, of_motion.phi_h), budget::lane_sadov * loss) << what;
  EXPECT_LE(angle(got.phi_g, of_motion.phi_g), budget::lane_sadov * loss) << what;
}

TEST(ManySadov, AreThoseOfTheMotionsButForRounding) {
  Draw draw(701, 0);
  const std::size_t count = std::getenv("POLHODE_TEST_FULL") != nullptr ? 3000 : 60;
  for (const Body& body : bodies()) {
    const std::vector<RotorState> states = any_states(draw, count);
    const std::vector<SadovState> got = converted(body, states);
    for (std::size_t i = 0; i < count; ++i)
      expect_near(got[i], to_sadov(FreeRotation(body, states[i]), 0.0), std::to_string(i));
  }
}

TEST(ManySadov, AreThoseOfTheMotionsNextToTheEdges) {
  Draw draw(702, 0);
  const Body body(1.0, 1.7, 2.1);
  const std::vector<RotorState> states = edge_states(draw, 120, -15.0);
  const std::vector<SadovState> got = converted(body, states);
  for (std::size_t i = 0; i < states.size(); ++i)
    expect_near(got[i], to_sadov(FreeRotation(body, states[i]), 0.0), std::to_string(i));
}

TEST(ManySadov, GoBackToTheState) {
  Draw draw(703, 0);
  Worst worst;
  for (const Body& body : bodies()) {
    const std::vector<RotorState> states = any_states(draw, 20);
    const std::vector<SadovState> got = converted(body, states);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const double m1 = FreeRotation(body, states[i]).modulus().m1();
      worst.add(difference(to_rotor(body, got[i]), states[i]) * smaller(1.0, m1) *
                smaller(1.0, tilt(got[i])));
    }
  }
  EXPECT_LE(worst.value(), budget::lane_sadov_round_trip);
}

// expect(set, cut) for every set of instructions and every run of neighbours; cut(all) are theirs.
void for_every_part(std::size_t size, const auto& expect) {
  for (const InstructionSet set : supported_instruction_sets())
    for (std::size_t count = 0, first = 0; first + count <= size; first += count++) {
      SCOPED_TRACE(testing::Message()
                   << instruction_set_name(set) << ", " << count << " from " << first);
      expect(set, [&](const auto& all) {
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
        return std::vector(begin, begin + static_cast<std::ptrdiff_t>(count));
      });
    }
}
void expect_bits(const auto& got, const auto& wanted) {
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t i = 0; i < got.size(); ++i) ASSERT_EQ(bits_of(got[i]), bits_of(wanted[i]));
}
// A steady state and one next to it among others.
void make_steady(std::vector<RotorState>& states) {
  states[7].g = {0.0, 0.0, 1.0};
  states[30].g = {1e-9, 0.0, 1.0};
}

TEST(ManySadov, HaveBitsThatDependOnTheStateAlone) {
  Draw draw(704, 0);
  for (const Body& body : bodies()) {
    std::vector<RotorState> states = any_states(draw, 200);
    make_steady(states);
    const std::vector<SadovState> all = converted(body, states, InstructionSet::baseline);
    for_every_part(states.size(), [&](InstructionSet set, const auto& cut) {
      expect_bits(converted(body, cut(states), set), cut(all));
    });
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_EQ(bits_of(to_sadov(body, states[i])), bits_of(all[i]));
  }
}

// Spheres, spins, rest, the separatrix itself: as of one motion, bit by bit.
TEST(ManySadov, WhereTheyDegenerateAreThoseOfTheMotion) {
  for (const NamedMotion& n : motions()) {
    const FreeRotation m = n.motion();
    const bool is_limit = n.regime != Regime::short_axis && n.regime != Regime::long_axis;
    const std::vector<RotorState> states(9, n.start());
    for (const SadovState& s : converted(n.body(), states)) {
      if (is_limit) {
        EXPECT_EQ(bits_of(s), bits_of(to_sadov(m, 0.0))) << n.name;
      } else {
        expect_near(s, to_sadov(m, 0.0), n.name);
      }
    }
  }
}

TEST(ManySadov, NotANumberSaysWhichStateItIs) {
  std::vector<RotorState> states(20, {{0.6, -0.3, 0.7, 0.2}, {0.3, -0.2, 1.0}});
  states[13].g.y = not_a_number;
  const std::string message = message_of([&] { converted(Body(1.0, 1.7, 2.1), states); });
  EXPECT_EQ(message, "FreeRotation: g (0.3, nan, 1) is not finite (state 13)");
}

TEST(ManySadov, RefuseAnotherNumberOfResults) {
  const std::vector<RotorState> states(9);
  std::vector<SadovState> results(8);
  EXPECT_MESSAGE(to_sadov(Body(1.0, 1.7, 2.1), states, results),
                 "to_sadov: got room for 8 results of 9 states; expected as many");
}

std::vector<RotorState> back(const Body& body, const std::vector<SadovState>& sets,
                             InstructionSet set = widest_instruction_set()) {
  std::vector<RotorState> results(sets.size());
  to_rotor(body, sets, results, set);
  return results;
}
// What the action holds of the polhode: 1 - k^2.
double complement(const Body& body, const RotorState& s) {
  return smaller(1.0, FreeRotation(body, s).modulus().m1());
}

TEST(RotorsOfSadov, AreThoseOfOneAtATimeButForRounding) {
  Draw draw(711, 0);
  const std::size_t count = std::getenv("POLHODE_TEST_FULL") != nullptr ? 3000 : 40;
  Worst worst;
  for (const Body& body : bodies()) {
    const std::vector<SadovState> sets = converted(body, any_states(draw, count));
    const std::vector<RotorState> got = back(body, sets);
    for (std::size_t i = 0; i < count; ++i) {
      const RotorState one = to_rotor(body, sets[i]);
      worst.add(difference(got[i], one) * complement(body, one));
      EXPECT_GT(
          got[i].q.w * one.q.w + got[i].q.x * one.q.x + got[i].q.y * one.q.y + got[i].q.z * one.q.z,
          0.0);
    }
  }
  EXPECT_LE(worst.value(), budget::lane_rotor_of_sadov);
}

TEST(RotorsOfSadov, AreThoseOfOneAtATimeNextToTheEdges) {
  Draw draw(712, 0);
  const Body body(1.0, 1.7, 2.1);
  const std::vector<RotorState> states = edge_states(draw, 60, -8.0);
  const std::vector<SadovState> sets = converted(body, states);
  const std::vector<RotorState> got = back(body, sets);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const RotorState one = to_rotor(body, sets[i]);
    EXPECT_LE(difference(got[i], one) * complement(body, one), budget::lane_rotor_of_sadov) << i;
  }
}

TEST(RotorsOfSadov, GoBackToTheState) {
  Draw draw(713, 0);
  Worst worst;
  for (const Body& body : bodies()) {
    const std::vector<RotorState> states = any_states(draw, 200);
    const std::vector<SadovState> sets = converted(body, states);
    const std::vector<RotorState> got = back(body, sets);
    for (std::size_t i = 0; i < states.size(); ++i)
      worst.add(difference(got[i], states[i]) * complement(body, states[i]) *
                smaller(1.0, tilt(sets[i])));
  }
  EXPECT_LE(worst.value(), budget::lane_sadov_round_trip);
}

TEST(RotorsOfSadov, HaveBitsThatDependOnTheSetAlone) {
  Draw draw(714, 0);
  for (const Body& body : bodies()) {
    std::vector<RotorState> states = any_states(draw, 200);
    make_steady(states);
    const std::vector<SadovState> sets = converted(body, states);
    const std::vector<RotorState> all = back(body, sets, InstructionSet::baseline);
    for_every_part(sets.size(), [&](InstructionSet set, const auto& cut) {
      expect_bits(back(body, cut(sets), set), cut(all));
    });
  }
}

// Spheres, spins, rest, the separatrix itself: as of one set, bit by bit.
TEST(RotorsOfSadov, WhereTheyDegenerateAreThoseOfOneSet) {
  for (const NamedMotion& n : motions()) {
    const FreeRotation m = n.motion();
    if (n.regime == Regime::short_axis || n.regime == Regime::long_axis) continue;
    const std::vector<SadovState> sets(9, to_sadov(m, 0.0));
    for (const RotorState& s : back(n.body(), sets))
      EXPECT_EQ(bits_of(s), bits_of(to_rotor(n.body(), sets[0]))) << n.name;
  }
}

TEST(RotorsOfSadov, RefuseWhatOneIsRefusedAndSayWhich) {
  const Body body(1.0, 1.7, 2.1);
  const SadovState good = to_sadov(body, {{0.6, -0.3, 0.7, 0.2}, {0.3, -0.2, 1.0}});
  const auto message = [&](const SadovState& bad) {
    std::vector<SadovState> sets(20, good);
    sets[13] = sets[17] = bad;
    return message_of([&] { back(body, sets); });
  };
  SadovState bad = good;
  const auto expected = [&] { return message_of([&] { to_rotor(body, bad); }) + " (state 13)"; };
  bad.lobe = 0;
  EXPECT_EQ(message(bad), expected());
  bad = good;
  bad.I_l = 0.1 * good.I_g;  // of the other region
  EXPECT_EQ(message(bad), expected());
  bad = good;
  bad.I_h = 1.1 * good.I_g;
  EXPECT_EQ(message(bad), expected());
  bad = good;
  bad.I_g = not_a_number;
  EXPECT_EQ(message(bad), expected());
  std::vector<RotorState> results(8);
  EXPECT_MESSAGE(to_rotor(body, std::vector<SadovState>(9, good), results),
                 "to_rotor: got room for 8 results of 9 states; expected as many");
}

std::vector<SerretState> converted(const Body& body, const std::vector<RotorState>& states,
                                   const std::vector<double>& times,
                                   InstructionSet set = widest_instruction_set()) {
  std::vector<SerretState> results(states.size());
  to_serret(body, states, times, results, set);
  return results;
}
std::vector<RotorState> back(const Body& body, const std::vector<SerretState>& sets,
                             const std::vector<double>& times,
                             InstructionSet set = widest_instruction_set()) {
  std::vector<RotorState> results(sets.size());
  to_rotor(body, sets, times, results, set);
  return results;
}

struct Sample {
  std::vector<RotorState> states;
  std::vector<double> times;
};
Sample any_sample(Draw& draw, std::size_t count) {
  Sample all;
  for (std::size_t i = 0; i < count; ++i) {
    const Quaternion q{draw.normal(), draw.normal(), draw.normal(), draw.normal()};
    all.states.push_back({normalized(q), {draw.normal(), draw.normal(), draw.normal()}});
    all.times.push_back(10.0 * draw.normal());
  }
  return all;
}

double tilt(const SerretState& s) { return std::sqrt((s.G - s.H) * (s.G + s.H)) / s.G; }

// How much of a state G, T and t0 hold: the distances from the separatrix and from equal moments.
double held(const Body& body, const RotorState& s) {
  Vec3 I = body.moments();
  std::sort(&I.x, &I.x + 3);
  const FreeRotation m(body, s);
  const double apart = smaller(I.y - I.x, I.z - I.y) / I.z;
  return smaller(1.0, m.modulus().m1()) * apart;
}

// a1/a3 of its polhode: a rounding of T moves it by eps over it.
double across(const Body& body, const RotorState& s) {
  Vec3 I = body.moments();
  std::sort(&I.x, &I.x + 3);
  const FreeRotation m(body, s);
  const double kap2 = m.circulates_long_axis() ? I.x * (I.z - I.y) / (I.z * (I.y - I.x))
                                               : I.z * (I.y - I.x) / (I.x * (I.z - I.y));
  return std::sqrt(m.modulus().m() / kap2);
}

TEST(ManySerret, AreThoseOfTheMotionsButForRounding) {
  Draw draw(721, 0);
  const std::size_t count = std::getenv("POLHODE_TEST_FULL") != nullptr ? 3000 : 60;
  Worst lanes;
  for (const Body& body : bodies()) {
    const Sample all = any_sample(draw, count);
    const std::vector<SerretState> got = converted(body, all.states, all.times);
    for (std::size_t i = 0; i < count; ++i) {
      const FreeRotation m(body, all.states[i], all.times[i]);
      const SerretState one = to_serret(m, all.times[i]);
      const RotorState again = to_rotor(body, got[i], all.times[i]);
      lanes.add(difference(again, all.states[i]) * held(body, all.states[i]) *
                smaller(1.0, tilt(one)));
      EXPECT_EQ(got[i].sign_g1, one.sign_g1);
      EXPECT_EQ(got[i].sign_g3, one.sign_g3);
      EXPECT_LE(relative(got[i].G, one.G), 2.0 * free_test::eps);
      EXPECT_LE(relative(got[i].T, one.T), 2.0 * free_test::eps);
      EXPECT_LE(std::abs(got[i].H - one.H), budget::lane_sadov * one.G);
      EXPECT_LE(std::abs(got[i].t0 - one.t0),
                budget::lane_serret_t0 * m.polhode_period() / held(body, all.states[i]));
    }
  }
  EXPECT_LE(lanes.value(), budget::lane_serret_round_trip);
}

TEST(ManySerret, StatesAreThoseOfOneSetButForRounding) {
  Draw draw(722, 0);
  Worst worst;
  for (const Body& body : bodies()) {
    const Sample all = any_sample(draw, 60);
    const std::vector<SerretState> sets = converted(body, all.states, all.times);
    const std::vector<RotorState> got = back(body, sets, all.times);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const RotorState one = to_rotor(body, sets[i], all.times[i]);
      worst.add(difference(got[i], one) * held(body, one));
      EXPECT_GT(
          got[i].q.w * one.q.w + got[i].q.x * one.q.x + got[i].q.y * one.q.y + got[i].q.z * one.q.z,
          0.0);
    }
  }
  EXPECT_LE(worst.value(), budget::lane_rotor_of_serret);
}

TEST(ManySerret, GoBackToTheState) {
  Draw draw(723, 0);
  Worst worst;
  for (const Body& body : bodies()) {
    const Sample all = any_sample(draw, 300);
    const std::vector<SerretState> sets = converted(body, all.states, all.times);
    const std::vector<RotorState> got = back(body, sets, all.times);
    for (std::size_t i = 0; i < sets.size(); ++i)
      worst.add(difference(got[i], all.states[i]) * held(body, all.states[i]) *
                smaller(1.0, tilt(sets[i])));
  }
  EXPECT_LE(worst.value(), budget::lane_serret_round_trip);
}

// Down to the separatrix and to the axes of circulation, where G and T hold less and less: no less
// of the state than by one.
TEST(ManySerret, GoBackToTheStateNextToTheEdges) {
  Draw draw(726, 0);
  const Body body(1.0, 1.7, 2.1);
  const double slope = std::sqrt(0.7 * 2.1 / (0.4 * 1.0));  // g3/g1 on the separatrix
  Sample all = any_sample(draw, 180);
  for (std::size_t i = 0; i < all.states.size(); ++i) {
    const double x = draw.sign() * draw.uniform(0.1, 1.0);
    const double off = draw.sign() * draw.power_of_ten(-7.0, -1.0);
    const double small = draw.power_of_ten(-7.0, -1.0), y = small * draw.normal();
    const Vec3 near[] = {{x, draw.normal(), draw.sign() * x * slope * (1.0 + off)},
                         {small, y, draw.sign()},
                         {draw.sign(), y, small}};
    all.states[i].g = near[i % 3];
  }
  const std::vector<SerretState> sets = converted(body, all.states, all.times);
  const std::vector<RotorState> got = back(body, sets, all.times);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const FreeRotation m(body, all.states[i], all.times[i]);
    const RotorState one = to_rotor(body, to_serret(m, all.times[i]), all.times[i]);
    const double floor =
        budget::lane_serret_round_trip / (held(body, all.states[i]) * smaller(1.0, tilt(sets[i])) *
                                          smaller(1.0, across(body, all.states[i])));
    EXPECT_LE(difference(got[i], all.states[i]),
              4.0 * larger(difference(one, all.states[i]), floor))
        << i;
  }
}

// A time that is many turns away: one by one, as ever.
TEST(ManySerret, FarFromTheEpochAreThoseOfOneSet) {
  Draw draw(724, 0);
  const Body body(1.0, 1.7, 2.1);
  const Sample all = any_sample(draw, 40);
  const std::vector<SerretState> sets = converted(body, all.states, all.times);
  const std::vector<RotorState> got = back(body, sets, {1e5});
  for (std::size_t i = 0; i < sets.size(); ++i)
    EXPECT_EQ(bits_of(got[i]), bits_of(to_rotor(body, sets[i], 1e5)));
}

TEST(ManySerret, HaveBitsThatDependOnTheStateAlone) {
  Draw draw(725, 0);
  for (const Body& body : bodies()) {
    Sample all = any_sample(draw, 150);
    make_steady(all.states);
    const auto whole = converted(body, all.states, all.times, InstructionSet::baseline);
    const auto states = back(body, whole, all.times, InstructionSet::baseline);
    for_every_part(whole.size(), [&](InstructionSet set, const auto& cut) {
      expect_bits(converted(body, cut(all.states), cut(all.times), set), cut(whole));
      expect_bits(back(body, cut(whole), cut(all.times), set), cut(states));
    });
  }
}

// Spheres, spins, rest, the separatrix itself: as of one motion, bit by bit.
TEST(ManySerret, WhereTheyDegenerateAreThoseOfTheMotion) {
  for (const NamedMotion& n : motions()) {
    if (n.regime == Regime::short_axis || n.regime == Regime::long_axis) continue;
    const FreeRotation m = n.motion();
    const std::string refused = message_of([&] { to_serret(m, 0.0); });
    const std::vector<RotorState> states(9, n.start());
    if (refused != "") {
      EXPECT_MESSAGE(converted(n.body(), states, {0.0}), refused + " (state 0)");
      continue;
    }
    for (const SerretState& s : converted(n.body(), states, {0.0}))
      EXPECT_EQ(bits_of(s), bits_of(to_serret(FreeRotation(n.body(), n.start(), 0.0), 0.0)))
          << n.name;
  }
}

TEST(ManySerret, RefuseWhatOneIsRefusedAndSayWhich) {
  const Body body(1.0, 1.7, 2.1);
  const RotorState start{{0.6, -0.3, 0.7, 0.2}, {0.3, -0.2, 1.0}};
  std::vector<RotorState> states(20, start);
  states[13].g.y = not_a_number;
  EXPECT_MESSAGE(converted(body, states, {0.0}),
                 "FreeRotation: g (0.3, nan, 1) is not finite (state 13)");
  std::vector<SerretState> sets(20, to_serret(FreeRotation(body, start), 0.0));
  sets[11].T = sets[17].T = 100.0;
  EXPECT_MESSAGE(back(body, sets, {0.0}),
                 message_of([&] { to_rotor(body, sets[11], 0.0); }) + " (state 11)");
  for (double SerretState::*element : {&SerretState::g0, &SerretState::h}) {
    std::vector<SerretState> none(3, to_serret(FreeRotation(body, start), 0.0));
    none[1].*element = not_a_number;
    EXPECT_MESSAGE(back(body, none, {0.0}),
                   message_of([&] { to_rotor(body, none[1], 0.0); }) + " (state 1)");
  }
  std::vector<SerretState> results(8);
  states.resize(9);
  EXPECT_MESSAGE(to_serret(body, states, std::vector<double>(9), results),
                 "to_serret: got room for 8 results of 9 states; expected as many");
  results.resize(9);
  EXPECT_MESSAGE(to_serret(body, states, std::vector<double>(4), results),
                 "to_serret: got 4 times of 9 states; expected as many, or one for all");
}

}  // namespace
