// SPDX-License-Identifier: MIT
// Driven bodies whose truth is known: torques, flybys and jumps found again, with errors that are
// what they say; what a fit of them refuses.
#include "polhode/fit/driven_spin_fit.hpp"

#include <gmock/gmock.h>

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "budgets.hpp"
#include "fit/detail/rotation_vector.hpp"
#include "fit/driven/driven_motion.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/perturb/user_terms.hpp"

namespace {
using namespace polhode;
using testing::HasSubstr;

Vec3 normal(oracle::Draw& draw, double sigma) {
  return {sigma * draw.normal(), sigma * draw.normal(), sigma * draw.normal()};
}

fit::SpinState spun(double Ixx, double Iyy, const Vec3& w) {
  fit::SpinState s{1.0, normalized(Quaternion{0.5, 0.1, -0.7, 0.5}), w, Mat3::identity()};
  s.inertia_F(0, 0) = Ixx;
  s.inertia_F(1, 1) = Iyy;
  return s;
}

struct Truth {
  fit::SpinState state;
  fit::SpinDrive drive;
};

fit::TorqueParameter parameter(const char* name, double start) { return {name, start}; }

Truth pushed() {
  Truth truth{spun(0.5, 0.8, {0.2, -0.1, 0.9}), {}};
  truth.drive.parameters = {parameter("x", 2e-4), parameter("z", -1e-3)};
  truth.drive.terms = [](std::span<const double> p) {
    return std::vector<AnyPerturbation>{{"body", ConstantTorque::in_body({0.0, 0.0, p[1]})},
                                        {"space", ConstantTorque::in_space({p[0], 0.0, 0.0})}};
  };
  return truth;
}

Truth braked() {
  Truth truth{spun(3.1, 3.25, {0.15, 0.3, -0.9}), {}};
  truth.drive.parameters = {parameter("M", 5e-3)};
  truth.drive.parameters[0].low = 0.0;
  truth.drive.terms = [](std::span<const double> p) {
    Mat3 M;
    for (int i = 0; i < 3; ++i) M(i, i) = p[0];
    return std::vector<AnyPerturbation>{
        {"eddy", EddyCurrents(M, ConstantField({0.3, -0.2, 0.9}), FieldRate::left_out)}};
  };
  return truth;
}

// As a planet passes a tumbler.
Truth passed() {
  Truth truth{spun(2.4, 2.7, {0.1, 0.4, 0.3}), {}};
  truth.drive.parameters = {parameter("gm", 30.0)};
  truth.drive.terms = [](std::span<const double> p) {
    const KeplerElements orbit{
        .gm = 30.0, .pericentre = 5.0, .eccentricity = 1.5, .inclination = 0.4, .epoch = 13.0};
    return std::vector<AnyPerturbation>{{"gravity", GravityGradient(p[0], KeplerOrbit(orbit))}};
  };
  return truth;
}

Truth hit() {
  Truth truth{spun(1.7, 1.9, {0.4, 0.5, 0.6}), {}};
  truth.drive.jumps = {{"hit", 12.0, fit::SpinJump::Of::rate, {0.02, -0.03, 0.05}}};
  return truth;
}

// Twenty attitudes, and a start beside the truth.
fit::SpinFit seen_of(const Truth& truth, oracle::Draw& draw, double sigma) {
  fit::SpinFit fit;
  std::vector<double> times;
  for (int i = 0; i < 20; ++i) times.push_back(1.3 * i + draw.uniform(0.0, 1.0));
  for (const fit::PredictedAttitude& at : fit::driven_attitudes(truth.state, truth.drive, times)) {
    const Quaternion q = at.q * fit::detail::turn_by(normal(draw, sigma));
    fit.seen.attitudes.push_back({at.t, q, fit::covariance_of(sigma)});
  }
  fit.start = truth.state;
  fit.start.q = truth.state.q * fit::detail::turn_by(normal(draw, 0.05));
  fit.start.w_F = truth.state.w_F + normal(draw, 0.01 * norm(truth.state.w_F));
  fit.start.inertia_F(0, 0) *= 1.0 + 0.02 * draw.normal();
  fit.start.inertia_F(1, 1) *= 1.0 + 0.02 * draw.normal();
  return fit;
}

fit::SpinDrive unknown(fit::SpinDrive drive) {
  for (fit::TorqueParameter& one : drive.parameters) one.start *= 0.5;
  for (fit::SpinJump& one : drive.jumps) one.change = {};
  return drive;
}

// The unknowns of the truth about a solution.
std::vector<double> true_numbers(const fit::SpinFit& fit, const Truth& truth,
                                 const fit::SpinSolution& s) {
  std::vector<double> x = fit::unknowns_at(fit, s.state, truth.state);
  for (const fit::TorqueParameter& one : truth.drive.parameters) x.push_back(one.start);
  for (const fit::SpinJump& one : truth.drive.jumps) {
    for (int k = 0; k < 3; ++k) x.push_back(one.change[k]);
  }
  return x;
}

TEST(FitDrivenSpin, FindsWhatIsExact) {
  for (const Truth& truth : {pushed(), braked(), passed(), hit()}) {
    oracle::Draw draw(19, 0);
    fit::SpinFit fit = seen_of(truth, draw, 1e-12);
    for (fit::ObservedAttitude& a : fit.seen.attitudes) a.covariance = fit::covariance_of(1e-3);
    const fit::SpinDrive drive = unknown(truth.drive);
    const fit::SpinSolution s = fit::fit_driven_spin(fit, drive);
    ASSERT_TRUE(s.is_found()) << s.result.sentence;
    EXPECT_LE(norm(fit::attitude_residual(truth.state.q, s.state.q)), budget::fit_exact);
    const std::vector<double> found = fit::unknowns_at(fit, drive, s.state, s);
    const std::vector<double> expected = true_numbers(fit, truth, s);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 3; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], expected[i], budget::fit_driven_exact * (1.0 + std::abs(expected[i])))
          << s.covariance.names[i];
    }
  }
}

// With a number held on its bound, from near and from more than a radian away.
TEST(FitDrivenSpin, TurnsFarWithANumberOnItsBound) {
  const Truth truth = braked();
  oracle::Draw draw(23, 0);
  fit::SpinFit fit = seen_of(truth, draw, 0.05);
  fit::SpinDrive drive = truth.drive;
  drive.parameters[0].low = drive.parameters[0].start = 6e-3;  // above the truth
  const fit::SpinSolution near = fit::fit_driven_spin(fit, drive);
  ASSERT_TRUE(near.is_found()) << near.result.sentence;
  ASSERT_FALSE(near.result.bound.empty());
  fit.start.q = normalized(fit.start.q * fit::detail::turn_by({0.0, 0.0, 1.2}));
  const fit::SpinSolution far = fit::fit_driven_spin(fit, drive);
  ASSERT_TRUE(far.is_found()) << far.result.sentence;
  EXPECT_EQ(far.result.bound, near.result.bound);
  EXPECT_LE(fit::mahalanobis(near.covariance, fit::unknowns_at(fit, drive, near.state, far),
                             fit::unknowns_at(fit, drive, near.state, near)),
            budget::fit_same);
}

TEST(FitDrivenSpin, ErrorsAreWhatTheySay) {
  const Truth truths[] = {pushed(), braked(), passed(), hit()};
  double distance = 0.0, freedom = 0.0;
  for (std::size_t k = 0; k < 12; ++k) {
    const Truth& truth = truths[k % 4];
    oracle::Draw draw(2029, k);
    const fit::SpinFit fit = seen_of(truth, draw, 0.01);
    const fit::SpinDrive drive = unknown(truth.drive);
    const fit::SpinSolution s = fit::fit_driven_spin(fit, drive);
    ASSERT_TRUE(s.is_found()) << s.result.sentence;
    const std::vector<double> x = fit::unknowns_at(fit, drive, s.state, s);
    distance += fit::mahalanobis(s.covariance, x, true_numbers(fit, truth, s));
    freedom += static_cast<double>(x.size());
  }
  const double above = boost::math::gamma_q(0.5 * freedom, 0.5 * distance);
  RecordProperty("p", std::to_string(above));
  EXPECT_GT(above, budget::fit_improbable) << distance << " on " << freedom;
  EXPECT_LT(above, 1.0 - budget::fit_improbable) << distance << " on " << freedom;
}

// Before a flyby alone, then what follows: the truth after it lies within what is predicted.
TEST(FitDrivenSpin, PredictsThroughAnEncounter) {
  const Truth truth = passed();
  fit::SpinDrive drive = truth.drive;  // the planet is known
  drive.parameters.clear();
  drive.terms = [&truth](std::span<const double>) {
    return truth.drive.terms(std::vector<double>{30.0});
  };
  const std::vector<double> after{25.0};
  const Quaternion there = fit::driven_attitudes(truth.state, truth.drive, after)[0].q;
  double distance = 0.0;
  constexpr std::size_t draws = 8;
  for (std::size_t k = 0; k < draws; ++k) {
    oracle::Draw draw(2029, 100 + k);
    fit::SpinFit fit = seen_of(truth, draw, 0.003);
    std::erase_if(fit.seen.attitudes, [](const fit::ObservedAttitude& a) { return a.t > 9.0; });
    const fit::SpinSolution s = fit::fit_driven_spin(fit, drive);
    ASSERT_TRUE(s.is_found()) << s.result.sentence;
    const fit::PredictedAttitude p = fit::predicted(fit, drive, s, after)[0];
    fit::UnknownsCovariance c;
    c.names = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) c.matrix.push_back(p.covariance(i, j));
    }
    const Vec3 miss = fit::attitude_residual(there, p.q);
    const std::vector<double> found{miss.x, miss.y, miss.z}, none(3, 0.0);
    distance += fit::mahalanobis(c, found, none);
    // Without the planet the same state leads elsewhere.
    const fit::PredictedAttitude blind = fit::predicted(fit, fit::SpinDrive{}, s, after)[0];
    EXPECT_GT(norm(fit::attitude_residual(p.q, blind.q)), budget::fit_encounter);
  }
  const double above = boost::math::gamma_q(1.5 * draws, 0.5 * distance);
  EXPECT_GT(above, budget::fit_improbable) << distance;
  EXPECT_LT(above, 1.0 - budget::fit_improbable) << distance;
}

TEST(FitDrivenSpin, GoesOnAfterItsJumps) {
  Truth truth = hit();
  truth.drive.jumps.push_back(
      {"push", 15.0, fit::SpinJump::Of::inertial_momentum, {0.1, 0.0, -0.05}});
  oracle::Draw draw(5, 5);
  const fit::SpinFit fit = seen_of(truth, draw, 0.001);
  const fit::SpinSolution s = fit::fit_driven_spin(fit, truth.drive);
  ASSERT_TRUE(s.is_found()) << s.result.sentence;
  const fit::SpinDrive solved = fit::solved_drive(fit, truth.drive, s);
  const std::vector<double> later{20.0};
  const fit::SpinState last = fit::after_jumps(fit, truth.drive, s);
  const Quaternion a = fit::driven_attitudes(s.state, solved, later)[0].q;
  const Quaternion b = fit::driven_attitudes(last, fit::SpinDrive{}, later)[0].q;
  EXPECT_LE(norm(fit::attitude_residual(a, b)), budget::fit_driven_exact);
}

TEST(FitDrivenSpin, RefusesWhatIsNoDrive) {
  const Truth truth = pushed();
  oracle::Draw draw(1, 1);
  const fit::SpinFit fit = seen_of(truth, draw, 0.01);
  const auto message = [&](const fit::SpinFit& f, const fit::SpinDrive& d) {
    return test::message_of([&] { static_cast<void>(fit::fit_driven_spin(f, d)); });
  };
  fit::SpinDrive drive = truth.drive;
  drive.jumps = {{"late", 100.0, fit::SpinJump::Of::rate, {}}};
  EXPECT_THAT(message(fit, drive), HasSubstr("late at t = 100; expected a time from the first "
                                             "observation on"));
  drive = truth.drive;
  drive.terms = [](std::span<const double> p) {
    return std::vector<AnyPerturbation>{{"odd", ConstantTorque::in_body({p[0] * p[0], 0.0, p[1]})}};
  };
  EXPECT_THAT(message(fit, drive), HasSubstr("does not change in proportion to x"));
  drive.terms = [](std::span<const double>) {
    return std::vector<AnyPerturbation>{
        {"mine", TorqueTerm([](double, const RotorState&) { return Vec3{}; })}};
  };
  EXPECT_THAT(message(fit, drive), HasSubstr("\"mine\" works on double alone"));
  fit::SpinFit other = fit;
  other.unknowns.products = true;
  EXPECT_THAT(message(other, truth.drive), HasSubstr("products of inertia are no unknowns"));
  other = fit;
  other.seen.attitudes.resize(3);
  EXPECT_THAT(message(other, truth.drive), HasSubstr("10 unknowns"));
  other = fit;
  other.unknowns = {false, false, false, false};
  drive = truth.drive;
  drive.parameters.clear();
  drive.terms = {};
  EXPECT_THAT(message(other, drive), HasSubstr("nothing is unknown"));
}

}  // namespace
