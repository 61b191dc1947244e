// SPDX-License-Identifier: MIT
// Snapshots of bodies whose truth is known: recovery, coverage, every kind of observation, bad
// input.
#include "polhode/fit/spin_fit.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "drawn_seeds.hpp"
#include "fit/detail/rotation_vector.hpp"
#include "fit/detail/snapshot_residuals.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/fit/driven_spin_fit.hpp"
#include "polhode/perturb/constant_torque.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using testing::HasSubstr;

Vec3 normal(oracle::Draw& draw, double sigma) {
  return {sigma * draw.normal(), sigma * draw.normal(), sigma * draw.normal()};
}

fit::SpinState spun(double Ixx, double Iyy, const Vec3& w) {
  fit::SpinState s{1.0, {0.5, 0.1, -0.7, 0.5}, w, Mat3::identity()};
  s.inertia_F(0, 0) = Ixx;
  s.inertia_F(1, 1) = Iyy;
  return s;
}

// Twenty attitudes over some turns; a start that is `off` by some per cent.
fit::SpinFit seen_of(const fit::SpinState& truth, oracle::Draw& draw, double sigma,
                     double off = 1.0) {
  fit::SpinFit fit;
  std::vector<fit::detail::MotionPoint> points;
  std::vector<double> times;
  for (int i = 0; i < 20; ++i) times.push_back(1.3 * i + draw.uniform(0.0, 1.0));
  fit::detail::free_motion(truth, times, {}, points);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Quaternion q = points[i].q * fit::detail::turn_by(normal(draw, sigma));
    fit.seen.attitudes.push_back({times[i], q, fit::covariance_of(sigma)});
  }
  fit.start = truth;
  fit.start.q = truth.q * fit::detail::turn_by(normal(draw, off * 0.05));
  fit.start.w_F = truth.w_F + normal(draw, off * 0.01 * norm(truth.w_F));
  fit.start.inertia_F(0, 0) *= 1.0 + off * 0.02 * draw.normal();
  fit.start.inertia_F(1, 1) *= 1.0 + off * 0.02 * draw.normal();
  return fit;
}

const std::vector<fit::SpinState>& truths() {
  static const std::vector<fit::SpinState> all{
      spun(3.1, 3.25, {0.15, 0.3, -0.9}),  // LAM
      spun(0.5, 0.8, {0.2, -0.1, 0.9}),    // SAM
      spun(1.7, 1.71, {0.4, 0.5, 0.6}),    // nearly symmetric
  };
  return all;
}

TEST(FitSpin, FindsWhatIsExact) {
  for (const fit::SpinState& truth : truths()) {
    oracle::Draw draw(19, 0);
    fit::SpinFit fit = seen_of(truth, draw, 1e-12);
    for (fit::ObservedAttitude& a : fit.seen.attitudes) a.covariance = fit::covariance_of(1e-3);
    std::ranges::reverse(fit.seen.attitudes);  // times in any order
    const fit::SpinSolution s = fit::fit_spin(fit);
    ASSERT_TRUE(s.is_found()) << s.result.sentence;
    EXPECT_LE(norm(fit::attitude_residual(truth.q, s.state.q)), budget::fit_exact);
    EXPECT_LE(norm(s.state.w_F - truth.w_F), budget::fit_exact);
    EXPECT_NEAR(s.state.inertia_F(0, 0), truth.inertia_F(0, 0), budget::fit_exact);
    EXPECT_NEAR(s.state.inertia_F(1, 1), truth.inertia_F(1, 1), budget::fit_exact);
  }
}

TEST(FitSpin, ErrorsAreWhatTheySay) {
  PooledDistance distance;
  for (std::size_t k = 0; k < 30; ++k) {
    const fit::SpinState& truth = truths()[k % truths().size()];
    oracle::Draw draw(1992, k);
    const fit::SpinFit fit = seen_of(truth, draw, 0.01);
    const fit::SpinSolution s = fit::fit_spin(fit);
    ASSERT_TRUE(s.is_found()) << s.result.sentence;
    distance.add(fit::mahalanobis(s.covariance, fit::unknowns_at(fit, s.state, s.state),
                                  fit::unknowns_at(fit, s.state, truth)));
  }
  distance.expect_probable();
}

// Ellipsoids in both modes, drawn as those of light curves.
TEST(FitSpin, ErrorsOfDrawnTumblersAreWhatTheySay) {
  for (const std::uint64_t seed : drawn_seeds()) {
    PooledDistance distance;
    for (std::size_t k = 0; k < 100; ++k) {
      const DrawnTumbler t = drawn_tumbler(k, 0, 0.0, seed);
      fit::SpinState truth = at_time(t.body, 1.0).spin;
      truth.w_F = (1.0 / norm(truth.w_F)) * truth.w_F;  // as those of truths()
      oracle::Draw draw(seed, k);
      const fit::SpinFit fit = seen_of(truth, draw, 0.01, 0.3);  // some are thin, and turn fast
      const fit::SpinSolution s = fit::fit_spin(fit);
      ASSERT_TRUE(s.is_found()) << k << ": " << s.result.sentence;
      distance.add(fit::mahalanobis(s.covariance, fit::unknowns_at(fit, s.state, s.state),
                                    fit::unknowns_at(fit, s.state, truth)));
    }
    std::cout << "seed " << seed << ", 100 tumblers: " << distance.text() << '\n';
    distance.expect_probable();
  }
}

// Bodies that are nearly flat, seen with errors that leave most of them on the triangle's bound:
// some iterations, not hundreds.
TEST(FitSpin, ComesToRestOnTheTriangle) {
  std::size_t on_bound = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    oracle::Draw draw(52, k);
    fit::SpinFit fit;
    fit.start = spun(1.0 / 2.6, 1.601 / 2.6, {0.05, 0.07, 0.21});
    std::vector<fit::detail::MotionPoint> points;
    std::vector<double> times;
    for (int i = 0; i < 41; ++i) times.push_back(1.5 * i);
    ASSERT_TRUE(fit::detail::free_motion(fit.start, times, {}, points));
    for (std::size_t i = 0; i < times.size(); ++i) {
      const Quaternion q = points[i].q * fit::detail::turn_by(normal(draw, 0.087));
      fit.seen.attitudes.push_back({times[i], q, fit::covariance_of(0.087)});
    }
    const fit::SpinSolution s = fit::fit_spin(fit);
    EXPECT_TRUE(s.is_found()) << s.result.sentence;
    EXPECT_LE(s.result.iterations, 20);
    if (!s.result.bound.empty()) ++on_bound;
  }
  EXPECT_GE(on_bound, 3u);
}

TEST(FitSpin, TakesDirectionsAndRates) {
  const fit::SpinState& truth = truths()[1];
  std::vector<double> times;
  for (int i = 0; i < 12; ++i) times.push_back(0.9 * i);
  std::vector<fit::detail::MotionPoint> points;
  ASSERT_TRUE(fit::detail::free_motion(truth, times, {}, points));
  fit::SpinFit fit;
  fit.start = truth;
  fit.start.w_F = 1.01 * truth.w_F;
  fit.start.q = truth.q * fit::detail::turn_by({0.1, 0.02, -0.05});
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Vec3 axis = i % 2 == 0 ? Vec3{0.0, 0.0, 2.0} : Vec3{1.0, 1.0, 0.0};
    fit.seen.directions.push_back({times[i], axis, rotate(points[i].q, axis), 0.01});
    fit.seen.rates.push_back({times[i], points[i].w_F, fit::covariance_of(Vec3{0.01, 0.02, 0.03})});
  }
  const fit::SpinSolution s = fit::fit_spin(fit);
  ASSERT_TRUE(s.is_found()) << s.result.sentence;
  EXPECT_LE(norm(fit::attitude_residual(truth.q, s.state.q)), budget::fit_exact);
  EXPECT_NEAR(s.state.inertia_F(0, 0), 0.5, budget::fit_exact);
  EXPECT_TRUE(std::isnan(s.attitude_rms));
  // Derivatives of these residuals, by differences.
  const fit::detail::SnapshotResiduals residuals(fit);
  const std::size_t n = 8, m = fit.seen.numbers();
  const std::vector<double> x = [&] {
    std::vector<double> at = fit::unknowns_at(fit, fit.start, fit.start);
    at[0] = 0.3;
    return at;
  }();
  std::vector<double> r(m), J(m * n);
  ASSERT_TRUE(residuals.at(x, r, J));
  for (std::size_t k = 0; k < n; ++k) {
    const double h = 1e-3;
    const auto moved = [&](double by) {
      std::vector<double> at = x, found(m);
      at[k] += by;
      residuals.at(at, found, {});
      return found;
    };
    const auto a = moved(h), b = moved(-h), c = moved(2 * h), d = moved(-2 * h);
    for (std::size_t i = 0; i < m; ++i) {
      const double slope = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
      EXPECT_NEAR(J[i * n + k], slope, budget::fit_difference) << i << " by " << k;
    }
  }
}

// Seen when a torque sets it in motion.
TEST(FitSpin, FindsTheAttitudeOfABodyAtRestFromNumbersOfIt) {
  fit::SpinState truth = truths()[0];
  truth.w_F = {};
  const auto rotated = std::make_shared<const fit::MotionFunction>(
      [](double, const Quaternion& q, const Vec3&, std::span<double> numbers) {
        const Vec3 x = rotate(q, {1.0, 0.0, 0.0}), y = rotate(q, {0.0, 1.0, 0.0});
        for (int i = 0; i < 3; ++i) {
          numbers[static_cast<std::size_t>(i)] = x[i];
          numbers[static_cast<std::size_t>(i + 3)] = y[i];
        }
      });
  fit::SpinFit fit;
  fit.unknowns.rate = fit.unknowns.moment_ratios = fit.unknowns.products = false;
  fit.seen.measurements.push_back(
      {truth.t0, std::vector<double>(6), std::vector<double>(6, 0.01), rotated});
  (*rotated)(0.0, truth.q, {}, fit.seen.measurements[0].seen);
  fit.start = truth;
  fit.start.q = truth.q * fit::detail::turn_by({0.1, 0.02, -0.05});
  fit::SpinDrive drive;
  drive.terms = [](std::span<const double>) {
    return std::vector<AnyPerturbation>{{"torque", ConstantTorque::in_body({0.1, 0.0, 0.0})}};
  };
  const fit::SpinSolution s = fit::fit_driven_spin(fit, drive);
  ASSERT_TRUE(s.is_found()) << s.result.sentence;
  EXPECT_LE(norm(fit::attitude_residual(truth.q, s.state.q)), budget::fit_exact);
}

TEST(FitSpin, PredictsWithErrors) {
  oracle::Draw draw(7, 7);
  const fit::SpinFit fit = seen_of(truths()[0], draw, 0.01);
  const fit::SpinSolution s = fit::fit_spin(fit);
  const std::vector<double> times{s.state.t0, 300.0};
  const auto p = fit::predicted(fit, s, times);
  EXPECT_LE(norm(fit::attitude_residual(p[0].q, s.state.q)), budget::fit_rotation);
  EXPECT_NEAR(p[0].covariance(0, 0), s.covariance.variance(0),
              budget::fit_rotation * s.covariance.variance(0) * 1e3);
  EXPECT_GT(p[1].covariance(2, 2), p[0].covariance(2, 2));
}

TEST(FitSpin, ReportsWhatComesTwiceAndWhatIsNotDetermined) {
  oracle::Draw draw(3, 1);
  fit::SpinFit fit = seen_of(truths()[0], draw, 0.01);
  fit.seen.attitudes.push_back(fit.seen.attitudes[2]);
  EXPECT_THAT(fit::fit_spin(fit).notes, testing::Contains(HasSubstr("attitude 21 repeats 3")));
  // One axis alone, and nothing of turns about it at one time only.
  fit.seen = {};
  fit.unknowns = {true, false, false, false};
  fit.seen.directions = {
      {1.0, {0.0, 0.0, 1.0}, rotate(normalized(fit.start.q), Vec3{0.0, 0.0, 1.0}), 0.01},
      {1.0, {0.0, 0.0, 1.0}, rotate(normalized(fit.start.q), Vec3{0.0, 0.0, 1.0}), 0.01}};
  const fit::SpinSolution s = fit::fit_spin(fit);
  EXPECT_THAT(s.notes, testing::Contains("the data do not determine turn_z"));
  EXPECT_TRUE(std::isinf(s.covariance.error(2)));
}

// Rotation about each principal axis, where noise alone would tell moments; and a wobble of 0.2
// rad, which tells them.
TEST(FitSpin, MomentsStayAtTheStartWhereNoWobbleIsSeen) {
  oracle::Draw draw(20, 1);
  for (int k = 0; k < 12; ++k) {
    fit::SpinState truth = spun(0.5, 0.8, {});
    truth.w_F[k % 3] = 1.0;
    const fit::SpinFit fit = seen_of(truth, draw, 0.02, 0.2);
    const fit::SpinSolution found = fit::fit_spin(fit);
    ASSERT_TRUE(found.is_found());
    EXPECT_EQ(found.held, (std::vector<std::string>{"Ixx/Izz", "Iyy/Izz"})) << k;
    EXPECT_EQ(found.state.inertia_F(0, 0), fit.start.inertia_F(0, 0));
    EXPECT_EQ(found.result.x[7], fit.start.inertia_F(1, 1));
    EXPECT_EQ(found.covariance.error(6), std::numeric_limits<double>::infinity());
    EXPECT_LT(found.covariance.error(3), budget::fit_uniform_error);
    ASSERT_FALSE(found.notes.empty());
    EXPECT_THAT(found.notes.back(), HasSubstr("not determined: Ixx/Izz and Iyy/Izz; one rotation"));
    const double late[] = {100.0};
    if (k % 3 == 1) continue;  // about the middle axis errors grow
    EXPECT_LT(fit::predicted(fit, found, late)[0].covariance(0, 0), budget::fit_uniform_late);
  }
  fit::SpinState wobbling = spun(0.5, 0.8, {0.14, 0.14, 1.0});
  EXPECT_TRUE(fit::fit_spin(seen_of(wobbling, draw, 0.02)).held.empty());
}

TEST(FitSpin, RefusesWhatMakesNoSense) {
  oracle::Draw draw(5, 5);
  const fit::SpinFit good = seen_of(truths()[0], draw, 0.01);
  const auto refusal = [&good](const auto& change) {
    fit::SpinFit changed = good;
    change(changed);
    return test::message_of([&] { fit::fit_spin(changed); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
      refusal([](fit::SpinFit& f) { f.seen.attitudes[3].covariance = fit::covariance_of(0.0); }),
      HasSubstr("attitude 4: variances (0, 0, 0)"));
  EXPECT_THAT(refusal([nan](fit::SpinFit& f) { f.seen.attitudes[1].t = nan; }),
              HasSubstr("attitude 2: t = nan must be finite"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) {
                f.seen.attitudes[1].q = {0.0, 0.0, 0.0, 0.0};
              }),
              HasSubstr("must be finite and not 0"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) {
                f.seen.directions = {{0.0, {}, {1.0, 0.0, 0.0}, 0.1}};
              }),
              HasSubstr("direction 1: axis_F = (0, 0, 0)"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) {
                f.seen.directions = {{0.0, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0}};
              }),
              HasSubstr("sigma = 0 must be positive"));
  EXPECT_THAT(refusal([nan](fit::SpinFit& f) {
                f.seen.rates = {{0.0, {nan, 0.0, 0.0}}};
              }),
              HasSubstr("rate 1"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) { f.seen.attitudes.resize(2); }),
              HasSubstr("8 unknowns"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) {
                f.unknowns = {false, false, false, false};
              }),
              HasSubstr("nothing is unknown"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) { f.start.w_F = {}; }),
              HasSubstr("the rate at the start"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) { f.start.inertia_F(0, 0) = 9.0; }), HasSubstr("break"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) {
                f.start.inertia_F = Mat3::identity();
                f.unknowns.products = true;
              }),
              HasSubstr("the principal moments 1 and 1, too near"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) {
                f.priors = {{{"turn_x"}, {0.0}, {1.0}}};
              }),
              HasSubstr("attitude_prior"));
  EXPECT_THAT(refusal([](fit::SpinFit& f) {
                f.unknowns.attitude = false;
                f.attitude_prior = fit::ObservedAttitude{};
              }),
              HasSubstr("not an unknown"));
}

}  // namespace
