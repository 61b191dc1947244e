// SPDX-License-Identifier: MIT
// Charts of many states: the same bits by every set of instructions, next to any neighbours, for
// any number of states; but for rounding the values of one state at a time.
#include "polhode/rotor/many_states.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "unit/rotor/support.hpp"

namespace {

using namespace polhode;
using rotor_test::bits;
using rotor_test::hard_states;

constexpr double eps = std::numeric_limits<double>::epsilon();

std::array<double, 6> numbers(const AndoyerState& s) { return {s.l, s.g, s.h, s.L, s.G, s.H}; }
std::array<double, 6> numbers(const EulerState& s) {
  return {s.phi, s.theta, s.psi, s.Phi, s.Theta, s.Psi};
}
std::array<double, 7> numbers(const RotorState& s) {
  return {s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z};
}
std::array<double, 8> numbers(const PoincareState& s) {
  return {s.sigma,
          s.Q1,
          s.Q2,
          s.G,
          s.P1,
          s.P2,
          double(s.pole_J == Pole::pi),
          double(s.pole_I == Pole::pi)};
}
template <class State>
std::vector<std::uint64_t> bits_of(const State& s) {
  std::vector<std::uint64_t> b;
  for (const double x : numbers(s)) b.push_back(bits(x));
  return b;
}

struct ToAndoyer {
  using To = AndoyerState;
  template <class... A>
  static auto of(A&&... a) {
    return to_andoyer(a...);
  }
};
struct ToEuler {
  using To = EulerState;
  template <class... A>
  static auto of(A&&... a) {
    return to_euler(a...);
  }
};
template <Pole J, Pole I>
struct ToPoincare {
  using To = PoincareState;
  static auto of(const RotorState& s) { return to_poincare(s, J, I); }
  static void of(std::span<const RotorState> s, std::span<To> results, InstructionSet set) {
    to_poincare(s, J, I, results, set);
  }
};
struct ToNearestPoincare {
  using To = PoincareState;
  template <class... A>
  static auto of(A&&... a) {
    return nearest_poincare(a...);
  }
};
struct ToRotor {
  using To = RotorState;
  template <class... A>
  static auto of(A&&... a) {
    return to_rotor(a...);
  }
};

template <class Chart, class From>
std::vector<typename Chart::To> converted(const std::vector<From>& states,
                                          InstructionSet set = widest_instruction_set()) {
  std::vector<typename Chart::To> results(states.size() + 1);
  const auto untouched = bits_of(results.back());
  Chart::of(std::span<const From>(states), std::span(results).first(states.size()), set);
  EXPECT_EQ(bits_of(results.back()), untouched);
  results.pop_back();
  return results;
}

template <class Chart, class From>
void expect_same_bits(const std::vector<From>& states) {
  const auto all = converted<Chart>(states, InstructionSet::baseline);
  for (const InstructionSet set : supported_instruction_sets()) {
    const auto by_set = converted<Chart>(states, set);
    for (std::size_t i = 0; i < states.size(); ++i)
      ASSERT_EQ(bits_of(by_set[i]), bits_of(all[i])) << instruction_set_name(set) << ", " << i;
    // parts of any size, from anywhere: other lanes, other neighbours
    for (std::size_t count = 0, first = 0; first + count <= states.size(); first += count++) {
      const std::vector<From> some(states.begin() + static_cast<std::ptrdiff_t>(first),
                                   states.begin() + static_cast<std::ptrdiff_t>(first + count));
      const auto part = converted<Chart>(some, set);
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(bits_of(part[i]), bits_of(all[first + i])) << count << " from " << first;
    }
  }
}

// Angles modulo a turn.
void expect_near(double got, double expected, double scale) {
  if (!std::isfinite(expected) || !std::isfinite(got)) {
    EXPECT_EQ(bits(got), bits(expected));
    return;
  }
  EXPECT_LE(std::abs(got - expected), budget::lane_charts_eps * eps * scale);
}
void expect_near_angle(double got, double expected) {
  if (std::isnan(expected))
    EXPECT_TRUE(std::isnan(got));
  else
    EXPECT_LE(std::abs(std::remainder(got - expected, 2.0 * pi<double>())),
              budget::lane_charts_eps * eps);
}

template <class Chart>
std::vector<typename Chart::To> expect_chart(const std::vector<RotorState>& states) {
  const auto got = converted<Chart>(states);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto x = numbers(got[i]), one = numbers(Chart::of(states[i]));
    for (std::size_t j = 0; j < 3; ++j) expect_near_angle(x[j], one[j]);
    // no sine, no angle: the same operations
    for (std::size_t j = 3; j < 6; ++j) EXPECT_EQ(bits(x[j]), bits(one[j])) << i;
    if (testing::Test::HasFailure()) break;
  }
  return got;
}

// sigma is an angle; the other numbers have the bits of one state at a time.
template <class Chart>
std::vector<PoincareState> expect_poincare(const std::vector<RotorState>& states) {
  const auto got = converted<Chart>(states);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto x = numbers(got[i]), one = numbers(Chart::of(states[i]));
    expect_near_angle(x[0], one[0]);
    for (std::size_t j = 1; j < x.size(); ++j)
      EXPECT_EQ(bits(x[j]), bits(one[j])) << i << ", " << j;
    if (testing::Test::HasFailure()) break;
  }
  return got;
}

template <class From>
void expect_hub(const std::vector<From>& states) {
  const std::vector<RotorState> got = converted<ToRotor>(states);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto x = numbers(got[i]), one = numbers(to_rotor(states[i]));
    double g = 0.0;
    for (std::size_t j = 4; j < 7; ++j)
      if (!std::isnan(one[j])) g += std::abs(one[j]);
    for (std::size_t j = 0; j < 4; ++j) expect_near(x[j], one[j], 1.0);
    for (std::size_t j = 4; j < 7; ++j) expect_near(x[j], one[j], g);
    if (testing::Test::HasFailure()) break;
  }
}

TEST(ManyStates, AreThoseOfOneAtATimeButForRounding) {
  const std::vector<RotorState> all = hard_states();
  expect_hub(expect_chart<ToAndoyer>(all));
  expect_hub(expect_chart<ToEuler>(all));
}

TEST(ManyStates, PoincareTypeSetsAreThoseOfOneAtATimeButForRounding) {
  const std::vector<RotorState> all = hard_states();
  expect_hub(expect_poincare<ToPoincare<Pole::zero, Pole::zero>>(all));
  expect_hub(expect_poincare<ToPoincare<Pole::zero, Pole::pi>>(all));
  expect_hub(expect_poincare<ToPoincare<Pole::pi, Pole::zero>>(all));
  expect_hub(expect_poincare<ToPoincare<Pole::pi, Pole::pi>>(all));
  expect_hub(expect_poincare<ToNearestPoincare>(all));
}

TEST(ManyStates, HaveBitsThatDependOnTheStateAlone) {
  const std::vector<RotorState> all = hard_states(1500);
  expect_same_bits<ToAndoyer>(all);
  expect_same_bits<ToEuler>(all);
  expect_same_bits<ToRotor>(converted<ToAndoyer>(all));
  expect_same_bits<ToRotor>(converted<ToEuler>(all));
  expect_same_bits<ToPoincare<Pole::pi, Pole::zero>>(all);
  expect_same_bits<ToNearestPoincare>(all);
  expect_same_bits<ToRotor>(converted<ToNearestPoincare>(all));
}

TEST(ManyStates, AnglesOfManyTurnsAndMomentaBeyondTheirRange) {
  oracle::Draw draw(83, 0);
  std::vector<AndoyerState> all;
  for (int i = 0; i < 2000; ++i) {
    const double G = draw.chance(0.2) ? 0.0 : draw.power_of_ten(-320.0, 307.0);
    const auto angle = [&] { return draw.sign() * draw.power_of_ten(-3.0, 9.0); };
    all.push_back(
        {angle(), angle(), angle(), G * draw.uniform(-1.2, 1.2), G, G * draw.uniform(-1.2, 1.2)});
  }
  expect_hub(all);
  expect_same_bits<ToRotor>(all);
}

TEST(ManyStates, NotANumberStaysInItsLane) {
  std::vector<RotorState> all(33, RotorState{{0.6, -0.3, 0.7, 0.2}, {0.3, -0.2, 1.0}});
  all[5].q.x = std::numeric_limits<double>::quiet_NaN();
  const auto found = converted<ToAndoyer>(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(std::isnan(found[i].g), i == 5);
    if (i != 5) {
      EXPECT_EQ(bits_of(found[i]), bits_of(found[0]));
    }
  }
}

TEST(ManyStates, RefuseAnotherNumberOfResults) {
  const std::vector<RotorState> states(9);
  std::vector<AndoyerState> results(8);
  EXPECT_MESSAGE(to_andoyer(states, results),
                 "to_andoyer: got room for 8 results of 9 states; expected as many");
}

TEST(ManyStates, RefuseInstructionsThatTheProcessorLacks) {
  const std::vector<RotorState> states(9);
  std::vector<EulerState> results(9);
  for (const InstructionSet set :
       {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (supports(set))
      EXPECT_NO_THROW(to_euler(states, results, set));
    else
      EXPECT_THROW(to_euler(states, results, set), DomainError);
  }
}

}  // namespace
