// SPDX-License-Identifier: MIT
// Sadov's variables of many states: the same bits by every set of instructions and next to any
// neighbours, those of the motion through each state but for rounding, and the state again.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/free/sadov.hpp"
#include "unit/free/support.hpp"
#include "worst.hpp"

namespace {

using namespace free_test;
using namespace polhode;
using polhode::test::Worst;

std::vector<std::uint64_t> bits_of(const SadovState& s) {
  std::vector<std::uint64_t> b{static_cast<std::uint64_t>(s.region),
                               static_cast<std::uint64_t>(s.lobe + 1)};
  for (const double x : {s.phi_l, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h})
    b.push_back(std::bit_cast<std::uint64_t>(x));
  return b;
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

// Down to the separatrix and to the axes of circulation.
TEST(ManySadov, AreThoseOfTheMotionsNextToTheEdges) {
  Draw draw(702, 0);
  const Body body(1.0, 1.7, 2.1);
  const double slope = std::sqrt(0.7 * 2.1 / (0.4 * 1.0));  // g3/g1 on the separatrix
  std::vector<RotorState> states;
  for (int i = 0; i < 120; ++i) {
    const double x = draw.sign() * draw.uniform(0.1, 1.0);
    const double off = draw.sign() * draw.power_of_ten(-15.0, -1.0);
    states.push_back(any_state(draw, {x, draw.normal(), draw.sign() * x * slope * (1.0 + off)}));
    const double small = draw.power_of_ten(-16.0, -1.0);
    states.push_back(any_state(draw, {small * draw.normal(), small * draw.normal(), draw.sign()}));
    states.push_back(any_state(draw, {draw.sign(), small * draw.normal(), small * draw.normal()}));
  }
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

TEST(ManySadov, HaveBitsThatDependOnTheStateAlone) {
  Draw draw(704, 0);
  for (const Body& body : bodies()) {
    std::vector<RotorState> states = any_states(draw, 200);
    states[7].g = {0.0, 0.0, 1.0};  // steady
    states[30].g = {1e-9, 0.0, 1.0};
    const std::vector<SadovState> all = converted(body, states, InstructionSet::baseline);
    for (const InstructionSet set : supported_instruction_sets())
      for (std::size_t count = 0, first = 0; first + count <= states.size(); first += count++) {
        const auto begin = states.begin() + static_cast<std::ptrdiff_t>(first);
        const auto part = converted(body, {begin, begin + static_cast<std::ptrdiff_t>(count)}, set);
        for (std::size_t i = 0; i < count; ++i)
          ASSERT_EQ(bits_of(part[i]), bits_of(all[first + i]))
              << instruction_set_name(set) << ", " << count << " from " << first;
      }
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
std::vector<std::uint64_t> bits_of(const RotorState& s) {
  std::vector<std::uint64_t> b;
  for (const double x : {s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z})
    b.push_back(std::bit_cast<std::uint64_t>(x));
  return b;
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

// Down to the separatrix and to the axes of circulation.
TEST(RotorsOfSadov, AreThoseOfOneAtATimeNextToTheEdges) {
  Draw draw(712, 0);
  const Body body(1.0, 1.7, 2.1);
  const double slope = std::sqrt(0.7 * 2.1 / (0.4 * 1.0));  // g3/g1 on the separatrix
  std::vector<RotorState> states;
  for (int i = 0; i < 60; ++i) {
    const double x = draw.sign() * draw.uniform(0.1, 1.0);
    const double off = draw.sign() * draw.power_of_ten(-8.0, -1.0);
    states.push_back(any_state(draw, {x, draw.normal(), draw.sign() * x * slope * (1.0 + off)}));
    const double small = draw.power_of_ten(-16.0, -1.0);
    states.push_back(any_state(draw, {small * draw.normal(), small * draw.normal(), draw.sign()}));
    states.push_back(any_state(draw, {draw.sign(), small * draw.normal(), small * draw.normal()}));
  }
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
    states[7].g = {0.0, 0.0, 1.0};  // steady
    states[30].g = {1e-9, 0.0, 1.0};
    const std::vector<SadovState> sets = converted(body, states);
    const std::vector<RotorState> all = back(body, sets, InstructionSet::baseline);
    for (const InstructionSet set : supported_instruction_sets())
      for (std::size_t count = 0, first = 0; first + count <= sets.size(); first += count++) {
        const auto begin = sets.begin() + static_cast<std::ptrdiff_t>(first);
        const auto part = back(body, {begin, begin + static_cast<std::ptrdiff_t>(count)}, set);
        for (std::size_t i = 0; i < count; ++i)
          ASSERT_EQ(bits_of(part[i]), bits_of(all[first + i]))
              << instruction_set_name(set) << ", " << count << " from " << first;
      }
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

}  // namespace
