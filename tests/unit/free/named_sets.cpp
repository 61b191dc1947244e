// SPDX-License-Identifier: MIT
// Kinoshita's variables and Fukushima and Ishizaki's elements: round trips, canonicity, actions by
// Heuman's Lambda, refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "budgets.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/free/fukushima_ishizaki.hpp"
#include "polhode/free/generating_function.hpp"
#include "polhode/free/kinoshita.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;  // NOLINT
using polhode::AndoyerState;
using polhode::FukushimaIshizakiState;
using polhode::KinoshitaState;
using polhode::Matrix6;
using polhode::SadovRegion;
using polhode::test::Worst;
namespace budget = polhode::budget;

bool is_tame(const NamedMotion& m) {
  const FreeRotation f = m.motion();
  const std::string name = m.name;
  return f.regime() != Regime::steady && f.regime() != Regime::rest &&
         !name.starts_with("next to") && f.modulus().m1() > 1e-6;
}

// Largest entry of inverse * B - 1.
double defect(const Matrix6& B, const Vec3& g) {
  const Matrix6 one = polhode::inverse_chart_jacobian(g, B) * B;
  double worst = 0.0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) worst = larger(worst, std::abs(one(i, j) - (i == j ? 1.0 : 0.0)));
  return worst;
}

TEST(Kinoshita, RoundTripsAndIsCanonical) {
  Worst<> round, canonical;
  for (const NamedMotion& m : motions()) {
    if (!is_tame(m)) continue;
    const FreeRotation f = m.motion();
    for (const double t : {0.0, 1.3, -7.9}) {
      const KinoshitaState s = to_kinoshita(f, t);
      round.add(difference(to_rotor(m.body(), s), f.at(t)));
      canonical.add(defect(chart_jacobian(m.body(), s), f.at(t).g));
    }
  }
  EXPECT_LT(round.value(), budget::named_sets_round_trip);
  EXPECT_LT(canonical.value(), budget::named_sets_canonical);
}

// [SA section 5] the action by Heuman's Lambda0
TEST(Kinoshita, ActionByHeumansLambda) {
  Worst<> gap;
  for (const NamedMotion& m : motions()) {
    const Vec3& I = m.moments;
    if (!is_tame(m) || I.x == I.y || I.y == I.z) continue;
    const FreeRotation f = m.motion();
    const KinoshitaState s = to_kinoshita(f, 0.4);
    const auto [kappa, lambda] = free::sadov_parameters(m.body(), f.momentum(), f.energy());
    const bool is_long = s.region == SadovRegion::long_axis;
    const double k = is_long ? 1.0 / lambda : lambda;
    const double ratio = is_long ? lambda / kappa : kappa / lambda;
    const double psi = std::atan(ratio);
    const double heuman = polhode::elliptic::heuman_lambda0(
        std::sin(psi), std::cos(psi),
        polhode::elliptic::Modulus::from_pair(k * k, (1.0 - k) * (1.0 + k)));
    const double action = s.G * (is_long ? 1.0 - heuman : std::copysign(heuman, s.L));
    gap.add(std::abs(action - s.L) / s.G);
  }
  EXPECT_LT(gap.value(), budget::named_sets_round_trip);
}

// Andoyer's variables where the body has an axis of symmetry
TEST(Kinoshita, IsAndoyersOfAnAxisymmetricBody) {
  const Body body(3.0, 3.0, 5.0);
  const FreeRotation f(body, {{0.6, -0.3, 0.7, 0.2}, {0.3, 0.2, 1.0}});
  const KinoshitaState s = to_kinoshita(f, 0.8);
  const AndoyerState a = polhode::to_andoyer(f.at(0.8));
  EXPECT_NEAR(s.l, a.l, budget::named_sets_round_trip);
  EXPECT_NEAR(s.g, a.g, budget::named_sets_round_trip);
  EXPECT_NEAR(s.h, a.h, budget::named_sets_round_trip);
  EXPECT_NEAR(s.L, a.L, budget::named_sets_round_trip);
}

TEST(FukushimaIshizaki, RoundTripsAndIsCanonical) {
  Worst<> round, canonical, constant;
  for (const NamedMotion& m : motions()) {
    if (!is_tame(m)) continue;
    const FreeRotation f = m.motion(0.5);
    const FukushimaIshizakiState s = to_fukushima_ishizaki(f, -1.5);
    EXPECT_EQ(s.t0, -1.5);
    for (const double t : {0.0, 1.3, -7.9}) {
      const RotorState there = to_rotor(m.body(), s, t);
      round.add(difference(there, f.at(t)));
      canonical.add(defect(chart_jacobian(m.body(), s, t), there.g));
      const FukushimaIshizakiState again =
          to_fukushima_ishizaki(FreeRotation(m.body(), there, t), -1.5);
      constant.add(larger(std::abs(again.l0 - s.l0), std::abs(again.L0 - s.L0) / s.G));
    }
  }
  EXPECT_LT(round.value(), budget::named_sets_round_trip);
  EXPECT_LT(constant.value(), budget::named_sets_round_trip);
  EXPECT_LT(canonical.value(), budget::named_sets_canonical);
}

TEST(NamedSets, RejectWhatIsNoState) {
  const Body body(3.0, 4.0, 6.0);
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(message_of([&] {
           to_rotor(body, KinoshitaState{0, 0, 0, 2.0, 1.0, 0.0});
         }),
         "|I_l| <= I_g");
  expect(message_of([&] {
           to_rotor(body, FukushimaIshizakiState{0, 0, 0, 2.0, 1.0, 0.0}, 0.0);
         }),
         "L");
  expect(message_of([&] {
           to_fukushima_ishizaki(FreeRotation(body, {{1, 0, 0, 0}, {1, 0, 1}}), infinite);
         }),
         "t = inf");
}

}  // namespace
