// SPDX-License-Identifier: MIT
// From the light of tumbling ellipsoids to their periods.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "budgets.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/free/tumbler.hpp"
#include "unit/fit/tumbling_light.hpp"

namespace {
using namespace polhode;
using polhode::test::Ellipsoid;
using polhode::test::Tumbling;

struct Case {
  Ellipsoid shape;
  Vec3 momentum;
};

const std::vector<Case> tumblers{{{2.2, 1.3, 1.0}, {1.0, 0.7, 0.3}},   // long axis
                                 {{3.0, 1.2, 1.0}, {1.0, 0.2, 0.9}},   // long axis
                                 {{2.0, 1.7, 1.0}, {0.3, 0.4, 1.0}}};  // short axis

bool has_truth(const Tumbling& of, const fit::FourierFit& fit) {
  const auto labels = fit::period_labels(fit.f1, fit.f2);
  return std::any_of(labels.begin(), labels.end(), [&](const fit::PeriodLabel& label) {
    return label.mode == of.motion.regime() && label.of_ellipsoid &&
           std::abs(label.precession_period * of.f_phi() - 1.0) < budget::labelled_period &&
           std::abs(label.rotation_period * of.f_psi() - 1.0) < budget::labelled_period &&
           fit::allows(of.motion.body(), label);
  });
}

TEST(TumblerScan, FindsThePeriodsUpToTheirLabels) {
  for (const Case& c : tumblers) {
    const Tumbling tumbling = Tumbling::of(c.shape, c.momentum);
    const std::vector<light::LightCurve> curves{tumbling.light_curve(11.0, 350, 0.01, 7)};
    const fit::ScanPoints points(curves);
    const double f = tumbling.f_phi();
    const auto grid =
        fit::FrequencyGrid::between(0.45 * f, 3.1 * f, fit::scan_advice(curves, 2).step);
    const fit::Landscape landscape =
        fit::scan_pairs(points, grid, grid, {.order = 2, .threads = 2});
    const auto minima = fit::scan_minima(points, landscape, {.most = 20, .threads = 2});
    ASSERT_FALSE(minima.empty());
    EXPECT_TRUE(std::is_sorted(minima.begin(), minima.end(), [](const auto& a, const auto& b) {
      return a.refined.fit.chi_square < b.refined.fit.chi_square;
    }));
    const auto best = std::find_if(minima.begin(), minima.end(), [](const fit::ScanMinimum& m) {
      return m.resolved && m.refined.converged && !m.at_edge;
    });
    ASSERT_NE(best, minima.end());
    EXPECT_TRUE(has_truth(tumbling, best->refined.fit))
        << best->refined.fit.f1 / f << " " << best->refined.fit.f2 / f << " "
        << tumbling.f_psi() / f;
    EXPECT_LE(best->refined.fit.chi_square, best->chi_square);
  }
}

// Each main line of a tumbling ellipsoid is one that its symmetry lets it have.
TEST(TumblerScan, LinesOfEllipsoidsObeyTheirSymmetry) {
  for (const Case& c : tumblers) {
    const Tumbling tumbling = Tumbling::of(c.shape, c.momentum);
    const fit::ScanPoints points(std::vector{tumbling.light_curve(40.0, 1600, 1e-3, 3)});
    const fit::FourierFit fit =
        fit::fourier_fit(points, tumbling.f_phi(), tumbling.f_psi(), fit::FourierOrders::pair(4));
    double even = 0.0, odd = 0.0;
    for (const fit::FourierTerm& term : fit.terms) {
      const bool is_long = tumbling.motion.regime() == Regime::long_axis;
      const bool allowed = is_long ? term.k % 2 == 0 : (term.j + term.k) % 2 == 0;
      (allowed ? even : odd) += term.cosine * term.cosine + term.sine * term.sine;
    }
    EXPECT_LT(odd, budget::forbidden_lines * even);
  }
}

TEST(TumblerScan, RefinesToTheLeastOfChiSquareWithItsErrors) {
  const Tumbling tumbling = Tumbling::of(tumblers[2].shape, tumblers[2].momentum);
  const fit::ScanPoints points(std::vector{tumbling.light_curve(14.0, 350, 0.02, 5)});
  const double f1 = tumbling.f_phi() + tumbling.f_psi(), f2 = 2.0 * tumbling.f_psi();
  const fit::FourierOrders orders = fit::FourierOrders::pair(3);
  const double step = 0.02 / points.time_base();
  const fit::RefinedPair found = fit::refined_pair(points, f1 + step, f2 - step, orders, step);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.fit.f1, f1, budget::scanned_frequency * found.scale * found.sigma_f1);
  EXPECT_NEAR(found.fit.f2, f2, budget::scanned_frequency * found.scale * found.sigma_f2);
  const double least = found.fit.chi_square;
  for (const double off : {-1e-3, 1e-3}) {
    const auto at = [&](double d1, double d2) {
      return fit::fourier_fit(points, found.fit.f1 + d1, found.fit.f2 + d2, orders).chi_square;
    };
    EXPECT_GT(at(off * step, 0.0), least);
    EXPECT_GT(at(0.0, off * step), least);
    // chi-square rises by one where one frequency is an error off and the other follows
    const double d1 = found.sigma_f1 * (off > 0.0 ? 1.0 : -1.0);
    const double d2 = found.correlation * found.sigma_f2 * (off > 0.0 ? 1.0 : -1.0);
    EXPECT_NEAR(at(d1, d2) - least, 1.0, budget::unit_rise);
  }
}

TEST(PeriodLabels, AreAllCombinationsThatPhysicsAllows) {
  const double f_phi = 1.3, f_psi = 0.47;
  for (const fit::LineLabel a :
       {fit::LineLabel{2, 0}, fit::LineLabel{2, 2}, fit::LineLabel{1, 1}, fit::LineLabel{1, 2, 2}})
    for (const fit::LineLabel b :
         {fit::LineLabel{2, -2}, fit::LineLabel{0, 2}, fit::LineLabel{3, 2, 2}}) {
      const auto line = [&](const fit::LineLabel& l) {
        return (l.j * f_phi + l.k * f_psi) / l.over;
      };
      for (const Regime mode : {Regime::long_axis, Regime::short_axis}) {
        const auto labels = fit::period_labels(line(a), line(b));
        const auto found =
            std::find_if(labels.begin(), labels.end(), [&](const fit::PeriodLabel& l) {
              return l.mode == mode && l.first == a && l.second == b;
            });
        ASSERT_NE(found, labels.end());
        EXPECT_NEAR(found->precession_period, 1.0 / f_phi, budget::moments_of_body);
        EXPECT_NEAR(found->rotation_period, 1.0 / f_psi, budget::moments_of_body);
      }
    }
  for (const fit::PeriodLabel& label : fit::period_labels(1.0, 1.7, 3)) {
    EXPECT_GT(label.precession_period, 0.0);
    EXPECT_GT(label.rotation_period, 0.0);
    if (label.mode == Regime::short_axis) {
      EXPECT_GT(label.rotation_period, label.precession_period);
    }
  }
  const fit::PeriodLabel first = fit::period_labels(2.0, 3.0).front();
  EXPECT_TRUE(first.of_ellipsoid);
  EXPECT_TRUE(first.first == (fit::LineLabel{2, 0}) || first.second == (fit::LineLabel{2, 0}));
  EXPECT_THROW(fit::period_labels(0.0, 1.0), DomainError);
  EXPECT_THROW(fit::period_labels(1.0, 2.0, 0), DomainError);
}

// The bounds that the labels rest on, of ellipsoids from thin to flat.
TEST(PeriodLabels, BoundsAreThoseOfEllipsoids) {
  for (const double b : {0.05, 0.3, 0.6, 0.9, 0.99})
    for (const double c : {0.001, 0.3, 0.8}) {
      if (c >= b) continue;
      const Body body = Ellipsoid{1.0, b, c}.body();
      EXPECT_GT(least_period_ratio(body, Regime::short_axis), 1.0);
      EXPECT_GT(least_period_ratio(body, Regime::long_axis), 0.0);
    }
  EXPECT_LT(least_period_ratio(Ellipsoid{1.0, 0.6, 0.001}.body(), Regime::short_axis),
            budget::flat_ratio);
  EXPECT_LT(least_period_ratio(Ellipsoid{1.0, 0.05, 0.001}.body(), Regime::long_axis),
            budget::thin_ratio);
}

TEST(BodiesWithPeriods, HaveThem) {
  for (const Regime mode : {Regime::long_axis, Regime::short_axis}) {
    std::size_t bodies = 0;
    for (const double ratio : {1.2, 2.3, 5.0})
      for (const double tilt : {0.1, 0.7, 1.3}) {
        const fit::TumblerPeriods periods{mode, 3.0, 3.0 * ratio};
        for (const fit::TumblingBody& b : fit::inertia_from_periods(periods, tilt, 20)) {
          ++bodies;
          const FreeRotation motion(b.body, b.state);
          EXPECT_EQ(motion.regime(), mode);
          const double eps = budget::periods_of_body * epsilon<double>();
          EXPECT_NEAR(motion.polhode_period() / periods.rotation_period, 1.0, eps);
          EXPECT_NEAR(motion.precession_rate_long() * 3.0 / (2.0 * pi<double>()), 1.0, eps);
          const TumblingAngles angles = tumbling_angles(motion);
          EXPECT_NEAR(mode == Regime::long_axis ? angles.long_most : angles.short_most, tilt,
                      budget::moments_of_body);
          EXPECT_NEAR(inertial_momentum(b.state).x, 0.0, budget::moments_of_body);
          EXPECT_NEAR(inertial_momentum(b.state).y, 0.0, budget::moments_of_body);
        }
      }
    EXPECT_GT(bodies, 30U);
  }
}

TEST(BodiesWithPeriods, GiveABodyBack) {
  for (const Case& c : tumblers) {
    const Tumbling t = Tumbling::of(c.shape, c.momentum);
    const Regime mode = t.motion.regime();
    const TumblingAngles angles = tumbling_angles(t.motion);
    const Vec3 I = t.motion.body().moments();
    const fit::TumblingBody found = fit::body_with_periods(
        {mode, 1.0 / t.f_phi(), 1.0 / t.f_psi()},
        mode == Regime::long_axis ? angles.long_most : angles.short_most, I.y / I.z);
    EXPECT_NEAR(found.body.moments().x, I.x / I.z, budget::moments_of_body);
  }
}

TEST(BodiesWithPeriods, SayWhatThereIs) {
  EXPECT_THROW(fit::body_with_periods({Regime::short_axis, 3.0, 2.0}, 0.5, 0.7), DomainError);
  EXPECT_TRUE(fit::inertia_from_periods({Regime::short_axis, 3.0, 2.0}, 0.5, 20).empty());
  EXPECT_THROW(fit::body_with_periods({Regime::steady, 3.0, 7.0}, 0.5, 0.7), DomainError);
  EXPECT_THROW(fit::body_with_periods({Regime::long_axis, 0.0, 7.0}, 0.5, 0.7), DomainError);
  EXPECT_THROW(fit::body_with_periods({Regime::long_axis, 3.0, 7.0}, 0.0, 0.7), DomainError);
  EXPECT_THROW(fit::body_with_periods({Regime::long_axis, 3.0, 7.0}, 0.5, 0.5), DomainError);
}

}  // namespace
