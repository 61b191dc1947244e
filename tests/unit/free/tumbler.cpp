// SPDX-License-Identifier: MIT
// Tumblers as observers describe them: published bodies, the convention, and what cannot be.
#include "polhode/free/tumbler.hpp"

#include <gmock/gmock.h>

#include "budgets.hpp"
#include "message_of.hpp"
#include "unit/free/support.hpp"
#include "worst.hpp"

namespace {

using namespace free_test;
using namespace polhode;
using free_test::pi;
using polhode::test::smaller;
using polhode::test::Worst;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double degree = pi / 180.0;

Vec3 pole_of(double longitude, double latitude) {
  return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude)};
}
double turned(double angle) { return std::remainder(angle, 2.0 * pi); }

const Body& apophis() {
  static const Body body(0.61, 0.965, 1.0);
  return body;
}
// Pravec et al. (2014). The long axis precesses in their P_1; their P_phi is the short axis'.
TumblerState apophis_state() {
  return {30.56, 263.0, pole_of(250 * degree, -75 * degree), Regime::short_axis, 0.0, 0.0};
}
// Hudson & Ostro (1995): about the long axis in 5.41 d, which precesses in 7.35 d
const Body& toutatis() {
  static const Body body(3.22, 3.09, 1.0);
  return body;
}
TumblerState toutatis_state() {
  return {7.35, 5.41, pole_of(180 * degree, -52 * degree), Regime::long_axis, 0.3, 1.1};
}

void expect_equal(const TumblerState& a, const TumblerState& b) {
  EXPECT_LE(relative(a.precession_period, b.precession_period), budget::tumbler_round_trip);
  EXPECT_LE(relative(a.rotation_period, b.rotation_period), budget::tumbler_round_trip);
  EXPECT_LE(norm(a.pole - b.pole), budget::tumbler_round_trip);
  EXPECT_EQ(a.mode, b.mode);
  EXPECT_LE(std::abs(turned(a.phi0 - b.phi0)), budget::tumbler_round_trip);
  EXPECT_LE(std::abs(turned(a.psi0 - b.psi0)), budget::tumbler_round_trip);
  EXPECT_EQ(a.branch, b.branch);
  EXPECT_EQ(a.sense, b.sense);
}

// Neither was put in: P_phi (27.38 h, of the short axis) and the energy over the least with this
// momentum. Were 27.38 h of the long axis, they would be 24.80 h and 1.0285.
TEST(Tumbler, ApophisHasThePeriodsAndEnergyPublished) {
  const TumblerState s = apophis_state();
  const FreeRotation motion(apophis(), to_rotor(apophis(), s));
  EXPECT_EQ(motion.regime(), Regime::short_axis);
  expect_equal(to_tumbler(motion, 0.0), s);
  EXPECT_NEAR(2.0 * pi / motion.precession_rate_short(), 27.38, budget::apophis_period_h);
  EXPECT_NEAR(2.0 * pi / motion.precession_rate_long(), 30.56, budget::apophis_period_h);
  const double G = motion.momentum();
  EXPECT_NEAR(2.0 * motion.energy() * 1.0 / (G * G), 1.024, budget::apophis_energy);
}

TEST(Tumbler, ToutatisIsInLongAxisMode) {
  const TumblerState s = toutatis_state();
  const RotorState rotor = to_rotor(toutatis(), s);
  const FreeRotation motion(toutatis(), rotor);
  EXPECT_EQ(motion.regime(), Regime::long_axis);
  expect_equal(to_tumbler(motion, 0.0), s);
  // "the long axis ... at an angle of about 50 degrees" to the momentum
  const double theta = std::acos(rotor.g.z / motion.momentum());
  EXPECT_NEAR(theta / degree, 50.0, budget::toutatis_inclination_deg);
  EXPECT_THAT(message_of([&] {
                TumblerState t = s;
                t.mode = Regime::short_axis;
                to_rotor(toutatis(), t);
              }),
              HasSubstr("is impossible in SAM for these moments; it must be at least 3.272"));
}

// q = qz(longitude) qy(pi/2 - latitude) qz(phi) qx(theta) qz(psi), and the momentum along the pole
TEST(Tumbler, AttitudeIsTheProductOfTheConvention) {
  const double longitude = 1.3, latitude = 0.4;
  const Body body(4.0, 6.0, 3.0);  // (intermediate, short, long) already
  for (const int branch : {1, -1}) {
    const TumblerState s{20.0, 45.0,  pole_of(longitude, latitude), Regime::short_axis, 0.7,
                         0.25, branch};
    const RotorState r = to_rotor(body, s);
    const Vec3 k = (1.0 / norm(r.g)) * r.g;
    const double theta = std::acos(k.z), half = 0.5 * (0.5 * pi - latitude);
    const Quaternion q = rotation_z(longitude) *
                         Quaternion{std::cos(half), 0.0, std::sin(half), 0.0} * rotation_z(0.7) *
                         rotation_x(theta) * rotation_z(0.25);
    EXPECT_LE(attitude_difference(r.q, q), budget::free_invariants);
    EXPECT_LE(norm((1.0 / norm(r.g)) * inertial_momentum(r) - s.pole), budget::free_invariants);
    EXPECT_NEAR(std::atan2(k.x, k.y), 0.25, budget::free_invariants);
    EXPECT_EQ(k.z > 0.0, branch > 0);
  }
}

// psi = 0: the momentum lies in the plane of the long and the short axis.
TEST(Tumbler, PsiZeroIsTheLongShortPlane) {
  const RotorState r = to_rotor(apophis(), apophis_state());
  EXPECT_EQ(r.g.y, 0.0);
  EXPECT_GT(r.g.z, 0.0);
  EXPECT_GT(r.g.x, 0.0);  // branch = 1: cos theta > 0
}

TEST(Tumbler, FourStatesShareAPsiInShortAxisMode) {
  TumblerState s = apophis_state();
  s.psi0 = -0.4;
  s.phi0 = 2.0;
  for (const int branch : {1, -1}) {
    for (const int sense : {1, -1}) {
      s.branch = branch;
      s.sense = sense;
      const RotorState r = to_rotor(apophis(), s);
      EXPECT_EQ(r.g.x > 0.0, branch > 0);
      EXPECT_EQ(r.g.z > 0.0, sense > 0);
      expect_equal(to_tumbler(FreeRotation(apophis(), r), 0.0), s);
    }
  }
}

TEST(Tumbler, LobesOfLongAxisMode) {
  for (const int branch : {1, -1}) {
    for (const double psi0 : {-3.0, -1.0, 0.0, 2.0}) {
      TumblerState s = toutatis_state();
      s.branch = branch;
      s.psi0 = psi0;
      const RotorState r = to_rotor(toutatis(), s);
      EXPECT_EQ(r.g.z > 0.0, branch > 0);
      expect_equal(to_tumbler(FreeRotation(toutatis(), r), 0.0), s);
    }
  }
}

TEST(Tumbler, DoesNotDependOnTheOrderOfAxes) {
  const Vec3 I{0.965, 1.0, 0.61};
  for (const Turn& t : proper_turns()) {
    if (t.sign[1] < 0.0) continue;
    const Body body(I[t.axis[0]], I[t.axis[1]], I[t.axis[2]]);
    TumblerState s = apophis_state();
    s.psi0 = 0.5;
    s.phi0 = -1.0;
    const FreeRotation motion(body, to_rotor(body, s));
    expect_equal(to_tumbler(motion, 0.0), s);
    expect_equal(to_tumbler(motion, 100.0),
                 to_tumbler(FreeRotation(apophis(), to_rotor(apophis(), s)), 100.0));
  }
}

// P_phi is the mean period of phi, P_psi the period of psi.
TEST(Tumbler, PeriodsAreThoseOfTheAngles) {
  for (const auto& [body, s] :
       {std::pair{apophis(), apophis_state()}, std::pair{toutatis(), toutatis_state()}}) {
    const FreeRotation motion(body, to_rotor(body, s));
    for (const double t : {0.0, 17.0, -40.0}) {
      const TumblerState now = to_tumbler(motion, t);
      const TumblerState later = to_tumbler(motion, t + s.rotation_period);
      EXPECT_LE(std::abs(turned(later.psi0 - now.psi0)), budget::tumbler_round_trip);
      const double phi = 2.0 * pi * s.rotation_period / s.precession_period;
      EXPECT_LE(std::abs(turned(later.phi0 - now.phi0 - phi)), budget::tumbler_round_trip);
    }
  }
}

TEST(Tumbler, PsiSwingsToPsiMax) {
  const FreeRotation motion(apophis(), to_rotor(apophis(), apophis_state()));
  const double limit = psi_max(motion);
  Worst largest;
  for (int i = 0; i < 4000; ++i) {
    const TumblerState now = to_tumbler(motion, 263.0 * i / 4000);
    largest.add(std::abs(now.psi0));
    EXPECT_NO_THROW(to_rotor(apophis(), now)) << i;  // where psi0 rounds beyond its limit, too
  }
  EXPECT_LE(largest.value(), limit * (1.0 + budget::free_constants_eps * eps));
  EXPECT_NEAR(largest.value(), limit, budget::psi_max_by_sampling);
  EXPECT_TRUE(
      std::isnan(psi_max(FreeRotation(toutatis(), to_rotor(toutatis(), toutatis_state())))));
}

TEST(Tumbler, PsiBeyondItsLimitIsAnErrorThatSaysSo) {
  const double limit = psi_max(FreeRotation(apophis(), to_rotor(apophis(), apophis_state())));
  TumblerState s = apophis_state();
  for (const double psi0 : {limit, -limit}) {
    s.psi0 = psi0;
    EXPECT_EQ(message_of([&] { to_rotor(apophis(), s); }), "");
  }
  for (const double psi0 : {limit * (1.0 + 1e-12), -2.0}) {
    s.psi0 = psi0;
    EXPECT_THAT(message_of([&] { to_rotor(apophis(), s); }),
                AllOf(HasSubstr("TumblerState: psi0 = "),
                      HasSubstr("rad is beyond psi_max = 0.9396202"), HasSubstr("of this SAM")));
  }
}

// What the periods of a small swing cannot hold is no error: a state close to the spin about the
// short axis has a description, and the description a state.
TEST(Tumbler, SmallSwingsComeBackWithinTheirPeriods) {
  for (const double J : {1e-3, 1e-6, 1e-8, 1e-10, 1e-12}) {
    for (double l = 0.1; l < 6.3; l += 0.5) {
      const RotorState s{{0.5, -0.5, 0.5, 0.5}, {J * std::sin(l), J * std::cos(l), 1.0}};
      const TumblerState d = to_tumbler(FreeRotation(apophis(), s), 0.0);
      EXPECT_LE(difference(to_rotor(apophis(), d), s),
                smaller(budget::tumbler_spin_eps * eps / J, budget::tumbler_spin))
          << J << " " << l;
    }
  }
}

// Near the spin about the long axis both nodes are lost, the attitude is not.
TEST(Tumbler, SmallPrecessionComesBackWithinItsPeriods) {
  for (const double J : {1e-3, 1e-6, 1e-8, 1e-10, 1e-12}) {
    for (double l = 0.1; l < 6.3; l += 0.5) {
      const RotorState s{{0.5, -0.5, 0.5, 0.5}, {-1.0, J * std::sin(l), J * std::cos(l)}};
      const TumblerState d = to_tumbler(FreeRotation(apophis(), s), 0.0);
      EXPECT_LE(difference(to_rotor(apophis(), d), s),
                smaller(budget::tumbler_spin_eps * eps / J, budget::tumbler_spin))
          << J << " " << l;
    }
  }
}

// A pole along an inertial axis has no longitude; the state does not mind.
TEST(Tumbler, PoleAlongTheThirdInertialAxis) {
  for (const double z : {1.0, -1.0}) {
    TumblerState s = toutatis_state();
    s.pole = {0.0, 0.0, z};
    const FreeRotation motion(toutatis(), to_rotor(toutatis(), s));
    expect_equal(to_tumbler(motion, 0.0), s);
    TumblerState rounded = s;  // latitude 90 deg and longitude 0.5 by sines and cosines
    rounded.pole = pole_of(0.5, z * 0.5 * pi);
    const RotorState r = to_rotor(toutatis(), rounded);
    const TumblerState d = to_tumbler(FreeRotation(toutatis(), r), 0.0);
    EXPECT_EQ(d.pole, s.pole);
    EXPECT_LE(std::abs(turned(d.phi0 - s.phi0 - z * 0.5)), budget::tumbler_round_trip);
    EXPECT_LE(difference(to_rotor(toutatis(), d), r), budget::free_invariants);
  }
}

// Small polhodes: P_psi/P_phi of the spins, in closed form.
TEST(Tumbler, LeastRatioIsThatOfTheSpins) {
  const double I1 = 3.0, I2 = 4.0, I3 = 6.0;
  const Body body(I2, I3, I1);
  const double w3 = std::sqrt((1 / I1 - 1 / I3) * (1 / I2 - 1 / I3));
  EXPECT_LE(relative(least_period_ratio(body, Regime::short_axis), 1 / I3 / w3),
            budget::free_constants_eps * eps);
  const double w1 = std::sqrt((I2 - I1) * (I3 - I1) / (I2 * I3)) / I1;
  EXPECT_LE(relative(least_period_ratio(body, Regime::long_axis), (1 / I1 - w1) / w1),
            budget::free_constants_eps * eps);
}

// P_psi/P_phi grows with every step from the spin to the separatrix, in both modes: a ratio has one
// polhode.
TEST(Tumbler, RatioOfPeriodsRisesTowardsTheSeparatrix) {
  for (std::uint64_t k = 0; k < 200; ++k) {
    Draw draw(61, k);
    const auto I = oracle::detail::triaxial_moments(draw);
    const Body body(I[0], I[1], I[2]);
    for (const int axis : {0, 2}) {
      const Regime mode = axis == 2 ? Regime::short_axis : Regime::long_axis;
      // momentum in the 1-3 plane, from the axis to the separatrix
      const double edge =
          std::atan2(std::sqrt(I[2] * (I[1] - I[0])), std::sqrt(I[0] * (I[2] - I[1])));
      double before = least_period_ratio(body, mode) * (1.0 - budget::free_constants_eps * eps);
      for (int i = 1; i < 60; ++i) {
        const double from_axis = (axis == 2 ? 0.5 * pi - edge : edge) * i / 60.0;
        const double s = std::sin(from_axis), c = std::cos(from_axis);
        const FreeRotation m(body, {{}, axis == 2 ? Vec3{s, 0, c} : Vec3{c, 0, s}});
        ASSERT_EQ(m.regime(), mode) << k << " " << i;
        const double ratio = m.polhode_period() * m.precession_rate_long() / (2.0 * pi);
        EXPECT_GT(ratio, before) << k << " " << i;
        before = ratio;
      }
    }
  }
}

TEST(Tumbler, RefusesWhatCannotBe) {
  const auto message = [](const Body& body, auto change) {
    TumblerState s = apophis_state();
    change(s);
    return message_of([&] { to_rotor(body, s); });
  };
  EXPECT_EQ(message(apophis(), [](TumblerState& s) { s.rotation_period = 20.0; }),
            "TumblerState: P_psi/P_phi = 0.6544502617801048 is impossible in SAM for these "
            "moments; it must be at least 6.56692790614775");
  EXPECT_EQ(message(apophis(), [](TumblerState& s) { s.rotation_period = -20.0; }),
            "TumblerState: period -20 must be positive and finite");
  EXPECT_EQ(message(apophis(), [](TumblerState& s) { s.precession_period = infinite; }),
            "TumblerState: period inf must be positive and finite");
  EXPECT_EQ(message(apophis(), [](TumblerState& s) { s.pole = {}; }),
            "TumblerState: pole (0, 0, 0) must be a finite, non-zero vector");
  EXPECT_EQ(message(apophis(), [](TumblerState& s) { s.psi0 = not_a_number; }),
            "TumblerState: angles (0, nan) must be finite");
  EXPECT_EQ(message(apophis(), [](TumblerState& s) { s.mode = Regime::steady; }),
            "TumblerState: mode must be short_axis (SAM) or long_axis (LAM)");
  EXPECT_EQ(message(Body(2, 2, 2), [](TumblerState&) {}),
            "TumblerState: moments (2, 2, 2) have no SAM: it needs unequal greater moments");
  EXPECT_EQ(message(Body(1, 2, 2), [](TumblerState&) {}),
            "TumblerState: moments (1, 2, 2) have no SAM: it needs unequal greater moments");
  EXPECT_EQ(message(Body(3, 5, 3), [](TumblerState& s) { s.mode = Regime::long_axis; }),
            "TumblerState: moments (3, 5, 3) have no LAM: it needs unequal lesser moments");
  for (const NamedMotion& m : motions()) {
    if (m.regime == Regime::short_axis || m.regime == Regime::long_axis) continue;
    EXPECT_REJECTED(to_tumbler(m.motion(), 0.0), "has no P_psi");
  }
}

}  // namespace
