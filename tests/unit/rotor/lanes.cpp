// SPDX-License-Identifier: MIT
// Charts of a pack of states: every lane has the bits that its state has alone, next to poles, at
// rest and beyond the range of squares too.
#include "lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "oracle/random_draw.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "unit/rotor/support.hpp"

namespace {

using namespace polhode;
using rotor_test::bits;
constexpr std::size_t lanes = 6;
using Pack = test::Lanes<double, lanes>;
using PackState = BasicRotorState<Pack>;

const Body body(2.0, 3.0, 4.5);

template <class Numbers>
Pack pack_of(const Numbers& number) {
  Pack p;
  for (std::size_t i = 0; i < lanes; ++i) p.lane[i] = number(i);
  return p;
}

PackState pack_of(const RotorState* s) {
  const auto of = [s](double Quaternion::*part) {
    return pack_of([&](std::size_t i) { return s[i].q.*part; });
  };
  const auto momentum = [s](double Vec3::*part) {
    return pack_of([&](std::size_t i) { return s[i].g.*part; });
  };
  return {{of(&Quaternion::w), of(&Quaternion::x), of(&Quaternion::y), of(&Quaternion::z)},
          {momentum(&Vec3::x), momentum(&Vec3::y), momentum(&Vec3::z)}};
}

template <class T>
std::vector<T> numbers(const BasicRotorState<T>& s) {
  return {s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z};
}
template <class T>
std::vector<T> numbers(const BasicAndoyerState<T>& s) {
  return {s.l, s.g, s.h, s.L, s.G, s.H};
}
template <class T>
std::vector<T> numbers(const BasicEulerState<T>& s) {
  return {s.phi, s.theta, s.psi, s.Phi, s.Theta, s.Psi};
}
template <class T>
std::vector<T> numbers(const BasicEulerRates<T>& s) {
  return {s.phi, s.theta, s.psi, s.phi_dot, s.theta_dot, s.psi_dot};
}
template <class T>
std::vector<T> numbers(const BasicPoincareState<T>& s) {
  return {s.sigma, s.Q1, s.Q2, s.G, s.P1, s.P2};
}
template <class T>
std::vector<T> numbers(const BasicEulerAngles<T>& s) {
  return {s.phi, s.theta, s.psi};
}

template <class Lane, class Scalar>
void expect_bits(const Lane& pack, const Scalar& scalar, std::size_t lane, const char* chart) {
  const auto got = numbers(pack);
  const auto expected = numbers(scalar);
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t k = 0; k < got.size(); ++k)
    EXPECT_EQ(bits(got[k].lane[lane]), bits(expected[k]))
        << chart << ", number " << k << ": " << got[k].lane[lane] << " and " << expected[k];
}

// From the state to the chart and back, each number compared.
template <class ToChart, class ToRotor>
void expect_chart(const ToChart& to_chart, const ToRotor& to_state, const char* chart) {
  const std::vector<RotorState> all = rotor_test::hard_states();
  for (std::size_t i = 0; i + lanes <= all.size(); i += lanes) {
    const auto there = to_chart(pack_of(&all[i]));
    const auto back = to_state(there);
    for (std::size_t j = 0; j < lanes; ++j) {
      const auto alone = to_chart(all[i + j]);
      expect_bits(there, alone, j, chart);
      expect_bits(back, to_state(alone), j, chart);
    }
    if (testing::Test::HasFailure()) return;
  }
}

TEST(ChartLanes, Andoyer) {
  expect_chart([](const auto& s) { return to_andoyer(s); },
               [](const auto& c) { return to_rotor(c); }, "Andoyer");
}

TEST(ChartLanes, Euler) {
  expect_chart([](const auto& s) { return to_euler(s); }, [](const auto& c) { return to_rotor(c); },
               "Euler");
}

TEST(ChartLanes, EulerRates) {
  expect_chart([](const auto& s) { return to_euler_rates(body, s); },
               [](const auto& c) { return to_rotor(body, c); }, "Euler rates");
}

TEST(ChartLanes, Poincare) {
  for (const Pole J : {Pole::zero, Pole::pi})
    for (const Pole I : {Pole::zero, Pole::pi})
      expect_chart([&](const auto& s) { return to_poincare(s, J, I); },
                   [](const auto& c) { return to_rotor(c); }, "Poincare");
}

TEST(ChartLanes, AnglesOfAnAttitude) {
  const std::vector<RotorState> all = rotor_test::hard_states();
  for (std::size_t i = 0; i + lanes <= all.size(); i += lanes) {
    const auto angles = euler_angles(pack_of(&all[i]).q);
    for (std::size_t j = 0; j < lanes; ++j)
      expect_bits(angles, euler_angles(all[i + j].q), j, "angles");
  }
}

// Andoyer's variables as a user gives them: L, H beyond +-G, and G = 0.
TEST(ChartLanes, AndoyerBeyondItsDomain) {
  oracle::Draw draw(82, 0);
  for (int i = 0; i < 300; ++i) {
    BasicAndoyerState<Pack> c;
    std::array<AndoyerState, lanes> alone{};
    for (std::size_t j = 0; j < lanes; ++j) {
      const double G = draw.chance(0.2) ? 0.0 : draw.power_of_ten(-3.0, 3.0);
      alone[j] = {draw.uniform(-4.0, 4.0),
                  draw.uniform(-4.0, 4.0),
                  draw.uniform(-4.0, 4.0),
                  G * draw.uniform(-1.2, 1.2),
                  G,
                  G * draw.uniform(-1.2, 1.2)};
      c.l.lane[j] = alone[j].l;
      c.g.lane[j] = alone[j].g;
      c.h.lane[j] = alone[j].h;
      c.L.lane[j] = alone[j].L;
      c.G.lane[j] = alone[j].G;
      c.H.lane[j] = alone[j].H;
    }
    const PackState s = to_rotor(c);
    for (std::size_t j = 0; j < lanes; ++j) expect_bits(s, to_rotor(alone[j]), j, "Andoyer");
  }
}

}  // namespace
