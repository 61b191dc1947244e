// SPDX-License-Identifier: MIT
// What a fit of a driven body offers and refuses beside its solutions: torques that jump by the
// state, residuals as a function for others, and predictions of what is not determined.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "budgets/fit.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/fit/driven_spin_fit.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/user_terms.hpp"

namespace {
using namespace polhode;
using testing::HasSubstr;

fit::SpinDrive pushed() {
  fit::SpinDrive drive;
  drive.parameters = {{"x", 2e-4}, {"z", -1e-3}};
  drive.terms = [](std::span<const double> p) {
    return std::vector<AnyPerturbation>{{"body", ConstantTorque::in_body({0.0, 0.0, p[1]})},
                                        {"space", ConstantTorque::in_space({p[0], 0.0, 0.0})}};
  };
  return drive;
}

// Twelve attitudes without errors, of a tumbler.
fit::SpinFit seen_of(const fit::SpinDrive& drive) {
  fit::SpinFit fit;
  fit.start = {
      1.0, normalized(Quaternion{0.5, 0.1, -0.7, 0.5}), {0.2, -0.1, 0.9}, Mat3::identity()};
  fit.start.inertia_F(0, 0) = 0.5;
  fit.start.inertia_F(1, 1) = 0.8;
  std::vector<double> times;
  for (int i = 0; i < 12; ++i) times.push_back(1.9 * i);
  for (const fit::PredictedAttitude& at : fit::driven_attitudes(fit.start, drive, times))
    fit.seen.attitudes.push_back({at.t, at.q, fit::covariance_of(0.01)});
  return fit;
}

// A thruster that pushes against the rate beyond a dead band, and a brake that begins there from
// nothing: the one jumps where the state says so, the other has a kink.
fit::SpinDrive switched(double push, double slope) {
  fit::SpinDrive drive;
  drive.terms = [=](std::span<const double>) {
    const auto torque = [=]<Real T>(const T&, const BasicRotorState<T>& s,
                                    std::span<const double> sides) {
      const BasicVec3<T> none{T(0.0), T(0.0), T(0.0)};
      if (sides[0] < 0.0) return none;
      return BasicVec3<T>{T(-push) - T(slope) * (s.g.x - T(0.05)), none.y, none.z};
    };
    const auto band = [](double, const RotorState& s) { return std::vector<double>{s.g.x - 0.05}; };
    return std::vector<AnyPerturbation>{{"thruster", SwitchedTorqueTerm(torque, band)}};
  };
  return drive;
}

TEST(FitDrivenSpin, RefusesWhatJumpsByItsState) {
  const fit::SpinFit fit = seen_of(pushed());
  EXPECT_REJECTED(fit::fit_driven_spin(fit, switched(1e-3, 0.0)),
                  "the term \"thruster\" jumps where the attitude or the rate says so");
  EXPECT_NO_THROW(fit::least_squares_of(fit, switched(0.0, 1e-3)));
  // one that jumps at a time has derivatives
  fit::SpinDrive timed;
  timed.terms = [](std::span<const double>) {
    const auto torque = []<Real T>(const T&, const BasicRotorState<T>&,
                                   std::span<const double> sides) {
      return BasicVec3<T>{T(sides[0] < 0.0 ? 0.0 : 1e-3), T(0.0), T(0.0)};
    };
    const auto when = [](double t, const RotorState&) { return std::vector<double>{t - 11.0}; };
    return std::vector<AnyPerturbation>{{"timed", SwitchedTorqueTerm(torque, when)}};
  };
  EXPECT_NO_THROW(fit::least_squares_of(fit, timed));
}

// A push beyond a dead band, of a term that also has a rate, which is large beside it or jumps too.
struct PushAndRate {
  double push, slope, rate, rate_jump;

  std::vector<double> switches(const Setting& at) const { return {at.s.g.x - 0.05}; }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const bool is_on = at.sides.empty() ? to_double(at.s.g.x) >= 0.05 : at.sides[0] >= 0.0;
    const T none(0.0);
    const T u = is_on ? T(-push) - T(slope) * (at.s.g.x - T(0.05)) : none;
    return {{none, T(rate + (is_on ? rate_jump : 0.0)), none}, {u, none, none}};
  }
};

// Torque and rate are in units of their own: neither hides a jump of the other.
TEST(FitDrivenSpin, FindsJumpsOfATorqueBesideALargeRate) {
  const fit::SpinFit fit = seen_of(pushed());
  const auto drive = [](const PushAndRate& term) {
    fit::SpinDrive one;
    one.terms = [=](std::span<const double>) {
      return std::vector<AnyPerturbation>{{"both", term}};
    };
    return one;
  };
  const auto jumps = HasSubstr("the term \"both\" jumps where the attitude or the rate says so");
  EXPECT_THAT(test::message_of([&] {
                fit::least_squares_of(fit, drive({1e-9, 0.0, 0.01, 0.0}));
              }),
              jumps);
  EXPECT_THAT(test::message_of([&] {
                fit::least_squares_of(fit, drive({0.0, 0.01, 1e-10, 1e-10}));
              }),
              jumps);
  EXPECT_NO_THROW(fit::least_squares_of(fit, drive({0.0, 1e-9, 0.01, 0.0})));
}

TEST(FitDrivenSpin, IsAResidualFunctionForOthers) {
  const fit::SpinDrive drive = pushed();
  const fit::SpinFit fit = seen_of(drive);
  const fit::LeastSquares problem = fit::least_squares_of(fit, drive);
  ASSERT_EQ(problem.unknowns.size(), 10u);
  EXPECT_EQ(problem.unknowns[9].name, "z");
  std::vector<double> x;
  for (const fit::Unknown& one : problem.unknowns) x.push_back(one.start);
  const fit::SpinState start = fit::state_at(fit, drive, x);
  EXPECT_EQ(start.w_F, fit.start.w_F);
  EXPECT_REJECTED(fit::state_at(fit, drive, std::vector<double>(8)), "got 8 unknowns; expected 10");
}

// An unknown that is not determined leaves the attitude open about the axes about which it moves
// it.
TEST(FitDrivenSpin, PredictsWhatIsOpenAsOpen) {
  fit::SpinDrive drive = pushed();
  const fit::SpinFit fit = seen_of(drive);
  drive.parameters.push_back({"nothing", 1.0});
  const fit::SpinSolution found = fit::fit_driven_spin(fit, drive);
  ASSERT_TRUE(found.is_found()) << found.result.sentence;
  EXPECT_TRUE(std::isinf(found.covariance.error(10)));
  const double times[] = {40.0};
  const Mat3 c = fit::predicted(fit, drive, found, times)[0].covariance;
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(c(k, k) > 0.0 && std::isfinite(c(k, k)));
  fit::SpinSolution open = found;
  open.covariance.matrix[9 * 11 + 9] = std::numeric_limits<double>::infinity();
  const Mat3 o = fit::predicted(fit, drive, open, times)[0].covariance;
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isinf(o(k, k)));
}

// A torque along the axis of rotation and an unknown rate leave the moments open.
TEST(FitDrivenSpin, MomentsStayAtTheStartWithoutAWobble) {
  fit::SpinDrive drive;
  drive.parameters = {{"z", 1e-3}};
  drive.terms = [](std::span<const double> p) {
    return std::vector<AnyPerturbation>{{"body", ConstantTorque::in_body({0.0, 0.0, p[0]})}};
  };
  const auto held = [&](const Vec3& w_F) {
    fit::SpinFit fit = seen_of(drive);
    fit.start.w_F = w_F;
    std::vector<double> times;
    for (const fit::ObservedAttitude& one : fit.seen.attitudes) times.push_back(one.t);
    const auto seen = fit::driven_attitudes(fit.start, drive, times);
    oracle::Draw draw(7, 1);
    for (std::size_t i = 0; i < seen.size(); ++i)
      fit.seen.attitudes[i].q = normalized(
          seen[i].q * Quaternion{1.0, 0.005 * draw.normal(), 0.005 * draw.normal(), 0.0});
    fit.start.inertia_F(0, 0) = 0.6;
    fit::SpinDrive start = drive;
    start.parameters[0].start = 0.0;
    const fit::SpinSolution found = fit::fit_driven_spin(fit, start);
    EXPECT_TRUE(found.is_found()) << found.result.sentence;
    EXPECT_NEAR(found.result.x[8], 1e-3, 4.0 * found.covariance.error(8));
    EXPECT_LT(found.covariance.error(8), budget::fit_uniform_torque);
    if (!found.held.empty()) {
      EXPECT_EQ(found.result.x[6], 0.6);
      EXPECT_TRUE(std::isinf(found.covariance.error(6)));
      const double late[] = {30.0};
      EXPECT_LT(fit::predicted(fit, start, found, late)[0].covariance(2, 2),
                budget::fit_uniform_torque_late);
    }
    return found.held;
  };
  EXPECT_EQ(held({0.0, 0.0, 0.9}), (std::vector<std::string>{"Ixx/Izz", "Iyy/Izz"}));
  EXPECT_TRUE(held({0.2, -0.1, 0.9}).empty());
}

}  // namespace
