// SPDX-License-Identifier: MIT
// Adaptive on rotors: against the free rotation, closed forms, runs in double-double, itself
// backwards and in another frame; and what it says when it cannot go on.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "unit/dynamics/adaptive_support.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;
using polhode::test::larger;
using polhode::test::Worst;
using testing::HasSubstr;

bool full() { return std::getenv("POLHODE_TEST_FULL") != nullptr; }

const Adaptive tight{1e-15};
const Adaptive wide{1e-22, Precision::double_double};

Problem with_torque(const std::string& name, auto torque, const Method& method, double stop,
                    const RotorState& s = w1_state) {
  return {System(w1_body, Frame::inertial(), {AnyPerturbation(name, TorqueTerm(torque))}), s, 0.0,
          stop, method};
}

TEST(Adaptive, WithoutTorqueIsTheFreeRotation) {
  const double stop = 10.0 * w1_turn;
  const FreeRotation free(w1_body, w1_state);
  for (const Adaptive& method : {tight, wide}) {
    const End end = end_of({System(w1_body), w1_state, 0.0, stop, method});
    EXPECT_EQ(end.advice, "");
    EXPECT_LE(distance(end.s, free.at(stop)), budget::rotor_ode_free);
  }
}

TEST(Adaptive, OfDoubleDoubleIsOfOrderNine) {
  std::vector<double> errors;
  const RotorState exact = end_of(w1(wide, 0.0, 1.0)).s;
  for (const double h : {1.0 / 24, 1.0 / 36}) {
    const End end = end_of(w1(Adaptive{1e-2, Precision::double_double, h, h}, 0.0, 1.0));
    EXPECT_EQ(end.statistics.steps, std::lround(1.0 / h));
    errors.push_back(distance(end.s, exact));
  }
  EXPECT_NEAR(std::log(errors[0] / errors[1]) / std::log(1.5), 9.0, budget::rotor_ode_order);
}

TEST(Adaptive, ConstantTorqueAboutTheAxisOfASymmetricBody) {
  // g_z = g0 + N t, and (g_x, g_y) turns by (1/I_z - 1/I_x) times its integral.
  const Body body(1.0, 1.0, 0.6);
  const double N = 0.7, stop = 12.0;
  const auto torque = [N](const auto&, const auto& s) {
    using T = std::decay_t<decltype(s.q.w)>;
    return BasicVec3<T>{T(0.0), T(0.0), T(N)};
  };
  const RotorState s{{0.5, 0.5, 0.5, 0.5}, {1.5, -0.4, 0.8}};
  const End end =
      end_of({System(body, Frame::inertial(), {AnyPerturbation("N", TorqueTerm(torque))}), s, 0.0,
              stop, tight});
  const double angle = (1.0 / 0.6 - 1.0) * (0.8 * stop + 0.5 * N * stop * stop);
  EXPECT_NEAR(end.s.g.z, 0.8 + N * stop, budget::rotor_ode_closed_form);
  EXPECT_NEAR(end.s.g.x, 1.5 * std::cos(angle) - 0.4 * std::sin(angle),
              budget::rotor_ode_closed_form);
  EXPECT_NEAR(end.s.g.y, -0.4 * std::cos(angle) - 1.5 * std::sin(angle),
              budget::rotor_ode_closed_form);
}

TEST(Adaptive, ForwardsAndBackwards) {
  const double turns_100 = 100.0 * w1_turn;
  const End there = end_of(w1(tight, 0.0, 10.0 * w1_turn));
  EXPECT_LE(distance(end_of(w1(tight, 10.0 * w1_turn, 0.0, there.s)).s, w1_state),
            budget::rotor_ode_back_10);
  const End far = end_of(w1(tight, 0.0, turns_100));
  EXPECT_LE(distance(end_of(w1(tight, turns_100, 0.0, far.s)).s, w1_state),
            budget::rotor_ode_back_100);
}

TEST(Adaptive, CompensatedAgreesWithDoubleDouble) {
  const double stop = 10.0 * 2.0 * 3.141592653589793;
  const End exact = end_of(w1(Adaptive{1e-19, Precision::double_double}, 0.0, stop));
  EXPECT_LE(distance(end_of(w1(tight, 0.0, stop)).s, exact.s), budget::rotor_ode_w1_tight);
  for (const double tolerance : {1e-9, 1e-11, 1e-13})
    EXPECT_LE(distance(end_of(w1(Adaptive{tolerance}, 0.0, stop)).s, exact.s),
              budget::rotor_ode_w1_per_tolerance * tolerance);
}

TEST(Adaptive, DenseOutputIsAsGoodAsItsSteps) {
  const Problem p = w1(Adaptive{1e-13}, 0.0, 1.0);
  const auto stepper = detail::make_stepper(p, std::get<Adaptive>(p.method));
  Worst worst;
  while (stepper->time() != 1.0) {
    ASSERT_EQ(stepper->advance(1.0), "");
    const auto dense = stepper->dense(true);
    EXPECT_EQ(dense->t1(), stepper->time());
    EXPECT_EQ(dense->at(dense->t1()), stepper->state());
    for (const double part : {0.0, 0.3, 0.8}) {
      const double t = dense->t0() + part * (dense->t1() - dense->t0());
      if (t > 0.0) worst.add(distance(dense->at(t), end_of(w1(wide, 0.0, t)).s));
    }
  }
  EXPECT_LE(worst.value(), budget::rotor_ode_dense);
}

// The torque is the same one: in a moving frame it finds its own way to inertial axes. How far the
// two runs end apart, or their inertial angular velocities, of which that in the frame comes from
// canonical elements by the formula of free rotation [SA (124)].
double frame_law(const Frame& frame, double stop) {
  const System moving(w1_body, frame, {AnyPerturbation("gravity gradient", W1Torque{})});
  const RotorState start = reference_state(moving, 0.0, w1_state);
  const End inertial = end_of(w1(tight, 0.0, stop));
  const End relative = end_of(w1(tight, 0.0, stop, start, frame));
  const Vec3 w = angular_velocity(w1_body, inertial.s);
  const Vec3 from_elements = angular_velocity(w1_body, to_rotor(to_andoyer(relative.s)));
  return larger(distance(inertial_state(moving, stop, relative.s), inertial.s),
                norm(from_elements - w) / norm(w));
}

TEST(Adaptive, FrameLaw) {
  const Frame precessing = Frame::precessing({0.3, -0.5, 0.8}, 0.37);
  const Frame nodding = Frame::orbit_plane([](const auto& t) { return 0.4 - 0.03 * t; },
                                           [](const auto& t) {
                                             using std::sin;
                                             return 0.5 + 0.1 * sin(0.25 * t);
                                           });
  for (const Frame& frame : {precessing, nodding}) {
    EXPECT_LE(frame_law(frame, 10.0 * w1_turn), budget::rotor_ode_frame_10);
    if (full()) {
      EXPECT_LE(frame_law(frame, 1e4 * w1_turn), budget::rotor_ode_frame_1e4);
    }
  }
}

TEST(Adaptive, StartsABodyAtRest) {
  const auto torque = [](const auto& t, const auto& s) {
    using T = std::decay_t<decltype(s.q.w)>;
    return BasicVec3<T>{T(0.0), T(1e-3) + T(0.0) * t, T(0.0)};
  };
  const RotorState rest{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  const End end = end_of(with_torque("push", torque, tight, 40.0, rest));
  // About y, of moment 1: g = 1e-3 t, angle 5e-4 t^2.
  EXPECT_EQ(end.advice, "");
  EXPECT_NEAR(end.s.g.y, 0.04, budget::rotor_ode_closed_form);
  EXPECT_NEAR(2.0 * std::atan2(end.s.q.y, end.s.q.w), 0.8, budget::rotor_ode_closed_form);
  EXPECT_LE(end.statistics.steps, 1000);
}

TEST(Adaptive, SaysWhichTorqueIsNotANumber) {
  const auto torque = [](double t, const RotorState&) {
    return Vec3{t > 2.0 ? std::nan("") : 0.1, 0.0, 0.0};
  };
  const End end = end_of(with_torque("thruster", torque, Adaptive{}, 5.0));
  EXPECT_THAT(end.advice, HasSubstr("torque of term \"thruster\" is not a finite number at t = 2"));
  EXPECT_LE(end.t, 2.0);
  EXPECT_GT(end.t, 1.9);
}

// A step at the rounding of t passes the jump: g_x grows by 1e6 times 1e-6.
TEST(Adaptive, PassesATorqueThatJumps) {
  const auto torque = [](double t, const RotorState&) {
    return Vec3{t > 1.3 ? 1e6 : 0.0, 0.0, 0.0};
  };
  const End before = end_of(with_torque("valve", torque, Adaptive{1e-13}, 1.3));
  const End end = end_of(with_torque("valve", torque, Adaptive{1e-13}, 1.3 + 1e-6));
  EXPECT_EQ(end.advice, "");
  EXPECT_EQ(end.t, 1.3 + 1e-6);
  EXPECT_LE(norm(end.s.g - before.s.g - Vec3{1.0, 0.0, 0.0}), budget::valve_momentum);
}

TEST(Adaptive, SaysThatATorqueJumpsAllTheTime) {
  const auto torque = [](double t, const RotorState&) {
    return Vec3{t > 1.3 && std::fmod(t * 0x1p50, 2.0) < 1.0 ? 1e6 : 0.0, 0.0, 0.0};
  };
  const End end = end_of(with_torque("valve", torque, Adaptive{1e-13}, 5.0));
  EXPECT_THAT(end.advice, HasSubstr("try a larger tolerance"));
  EXPECT_NEAR(end.t, 1.3, budget::rotor_ode_jumps);
}

TEST(Adaptive, EndsWhereTheMomentumGrowsBeyondNumbers) {
  // |g| = 1 / sqrt(2 c (t_end - t))
  const auto torque = [](double, const RotorState& s) { return (1e-2 * dot(s.g, s.g)) * s.g; };
  const End end = end_of(with_torque("engine", torque, Adaptive{}, 5.0));
  EXPECT_NE(end.advice, "");
  EXPECT_NEAR(end.t, 50.0 / dot(w1_state.g, w1_state.g), budget::rotor_ode_edge);
}

TEST(Adaptive, ExceptionsOfATorquePassThrough) {
  const auto torque = [](double t, const RotorState&) {
    if (t > 1.0) throw std::runtime_error("no fuel");
    return Vec3{};
  };
  EXPECT_THROW(end_of(with_torque("engine", torque, Adaptive{}, 5.0)), std::runtime_error);
}

TEST(Adaptive, RefusesValuesOutOfRange) {
  for (const Adaptive& method :
       {Adaptive{0.0}, Adaptive{1e-16}, Adaptive{0.1}, Adaptive{std::nan("")},
        Adaptive{1e-12, Precision::compensated, -1.0},
        Adaptive{1e-12, Precision::compensated, 0.0, 0.0},
        Adaptive{1e-31, Precision::double_double}})
    EXPECT_THROW(detail::make_stepper(w1(method, 0.0, 1.0), method), DomainError);
}

TEST(Adaptive, RefusesMomentsWithoutSquares) {
  const auto run = [](double least) {
    return integrate({System(Body(least, 1.0, 1.0)), {{1, 0, 0, 0}, {0.0, 0.0, 1.0}}, 0.0, 1.0});
  };
  EXPECT_NO_THROW(run(1e-149));
  EXPECT_MESSAGE(
      run(1e-151),
      "integrate: moments (1e-151, 1, 1) must be within a factor of 1e150 of each other");
}

}  // namespace
