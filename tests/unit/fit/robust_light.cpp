// SPDX-License-Identifier: MIT
// Factors of sessions under robust losses: against bisection in 50 digits, and derivatives of the
// least sum against differences of light in double-double.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "fit/detail/light_residuals.hpp"
#include "fit/detail/weighed_curves.hpp"
#include "polhode/ensemble/draws.hpp"
#include "polhode/fit/least_squares.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "wide_light.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using fit::detail::FactorPoint;
using fit::detail::Rows;
using Digits = boost::multiprecision::cpp_bin_float_50;
using Kind = fit::Loss::Kind;

constexpr Kind robust_kinds[] = {Kind::huber, Kind::soft_l1, Kind::cauchy};

struct WidePoint {
  Digits u, v;
};

// scale^2 rho, and half its derivative by the residual.
Digits cost_of(const fit::Loss& loss, const Digits& r) {
  const Digits s = loss.scale, z = r * r / (s * s);
  if (loss.kind == Kind::huber) return s * s * (z <= 1 ? z : Digits(2 * sqrt(z) - 1));
  if (loss.kind == Kind::soft_l1) return s * s * 2 * (sqrt(1 + z) - 1);
  return s * s * log(1 + z);
}
Digits pull_of(const fit::Loss& loss, const Digits& r) {
  if (loss.kind == Kind::squared) return r;
  const Digits s = loss.scale, z = r * r / (s * s);
  if (loss.kind == Kind::huber) return z <= 1 ? r : Digits(r > 0 ? s : -s);
  if (loss.kind == Kind::soft_l1) return r / sqrt(1 + z);
  return r / (1 + z);
}

Digits fall_at(const fit::Loss& loss, const std::vector<WidePoint>& points, const Digits& f) {
  Digits sum = 0;
  for (const WidePoint& p : points) sum += p.v * pull_of(loss, p.u - f * p.v);
  return sum;
}

// The first zero of the slope downhill from the weighted median: steps of a hundredth of what
// changes a usual residual by the scale, then bisection.
Digits least_factor(const fit::Loss& loss, const std::vector<WidePoint>& points) {
  std::vector<WidePoint> seen = points;
  std::erase_if(seen, [](const WidePoint& p) { return p.v == 0; });
  std::ranges::sort(seen, [](const auto& a, const auto& b) { return a.u / a.v < b.u / b.v; });
  Digits all = 0, below = 0, squares = 0;
  for (const WidePoint& p : seen) all += p.v;
  for (const WidePoint& p : seen) squares += p.v * p.v;
  std::size_t k = 0;
  while (2 * (below + seen[k].v) < all) below += seen[k++].v;
  Digits from = seen[k].u / seen[k].v;
  const bool up = fall_at(loss, points, from) > 0;
  const Digits step =
      (up ? 1 : -1) * loss.scale / sqrt(squares / Digits(double(points.size()))) / 100;
  Digits to = from;
  while (fall_at(loss, points, to) != 0 && (fall_at(loss, points, to) > 0) == up) {
    from = to;
    to += step;
  }
  for (int i = 0; i < 150; ++i) {
    const Digits middle = (from + to) / 2;
    ((fall_at(loss, points, middle) > 0) == up ? from : to) = middle;
  }
  return to;
}

std::vector<WidePoint> wide(const std::vector<FactorPoint>& points) {
  std::vector<WidePoint> found;
  for (const FactorPoint& p : points) found.push_back({p.u, p.v});
  return found;
}

// Brightness of 0.2 to 1 and flux of 2.5 times it in errors of 1 / accuracy; a part of the points
// is three times too bright.
std::vector<FactorPoint> drawn_points(std::uint64_t number, std::size_t count, double accuracy,
                                      double bad) {
  const ensemble::CounterRandom random(5, ensemble::key_of("factors"));
  std::vector<FactorPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double B = 0.2 + 0.8 * random.uniform(number, 8 * i);
    const double flux = 2.5 * B + random.normal(number, 8 * i + 4) / accuracy;
    const double times = random.uniform(number, 8 * i + 1) < bad ? 3.0 : 1.0;
    points.push_back({accuracy * times * flux, accuracy * B});
  }
  return points;
}

TEST(RobustFactor, IsTheLeastOfTheSum) {
  Worst<> worst;
  for (const Kind kind : robust_kinds)
    for (const double scale : {0.3, 1.345, 5.0, 1e3})
      for (std::uint64_t k = 0; k < 12; ++k) {
        const fit::Loss loss{kind, scale};
        std::vector<FactorPoint> points =
            drawn_points(k, k < 3 ? 1 + k : 40, k % 2 == 0 ? 50.0 : 0.7, k % 3 == 0 ? 0.0 : 0.15);
        if (k > 6) points.push_back({0.4, 0.0});  // unlit
        const Digits least = least_factor(loss, wide(points));
        const double found = fit::detail::robust_factor(loss, points);
        EXPECT_NEAR(found, double(least), budget::robust_factor * std::abs(double(least)))
            << int(kind) << ' ' << scale << ' ' << k;
        worst.add(std::abs(double((Digits(found) - least) / least)));
      }
  RecordProperty("worst", std::to_string(worst.value()));
}

// Of a model that is far from the light: no residual is within the scale.
TEST(RobustFactor, IsTheLeastWhereNothingFits) {
  const ensemble::CounterRandom random(6, ensemble::key_of("misfits"));
  for (const Kind kind : robust_kinds)
    for (std::uint64_t k = 0; k < 12; ++k) {
      std::vector<FactorPoint> points;
      for (std::size_t i = 0; i < 60; ++i)
        points.push_back({300.0 * random.uniform(k, 2 * i), 90.0 * random.uniform(k, 2 * i + 1)});
      const fit::Loss loss{kind, 1.0};
      const double least = double(least_factor(loss, wide(points)));
      EXPECT_NEAR(fit::detail::robust_factor(loss, points), least, budget::robust_factor * least)
          << int(kind) << ' ' << k;
    }
}

TEST(RobustFactor, HasNoValueWhereNothingIsSeen) {
  const fit::Loss huber{Kind::huber, 1.0};
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(fit::detail::robust_factor(huber, {})));
  for (const FactorPoint& p :
       {FactorPoint{1.0, 0.0}, {1.0, std::nan("")}, {infinite, 1.0}, {1.0, infinite}})
    EXPECT_TRUE(std::isnan(fit::detail::robust_factor(huber, std::vector{p})));
  EXPECT_EQ(fit::detail::robust_factor(huber, std::vector{FactorPoint{0.0, 2.0}}), 0.0);
}

// With 15 points of a hundred three times too bright the factor of squares is off by many errors.
TEST(RobustFactor, IsThatOfTheGoodPoints) {
  for (std::uint64_t k = 0; k < 5; ++k) {
    std::vector<FactorPoint> points = drawn_points(k, 100, 50.0, 0.0);
    const auto of_squares = [](const std::vector<FactorPoint>& all) {
      double up = 0.0, down = 0.0;
      for (const FactorPoint& p : all) up += p.u * p.v;
      for (const FactorPoint& p : all) down += p.v * p.v;
      return std::pair(up / down, 1.0 / std::sqrt(down));
    };
    const auto [clean, error] = of_squares(points);
    for (std::size_t i = 3; i < 100; i += 7) points[i].u *= 3.0;
    EXPECT_GT(std::abs(of_squares(points).first - clean), 50.0 * error);
    EXPECT_LT(std::abs(fit::detail::robust_factor({Kind::cauchy, 3.0}, points) - clean), error);
    // huber's pull stays: that of 15 points at the scale, on the others
    const double pull = 15.0 / 85.0 * 1.345 * std::sqrt(100.0);
    EXPECT_LT(std::abs(fit::detail::robust_factor({Kind::huber, 1.345}, points) - clean),
              1.5 * pull * error);
  }
}

// A night with noise, and some points three times too bright.
light::LightCurve bad_night(const fit::LightModel& b) {
  light::LightCurve curve = night(b, 3.0, 40, 0.02, 3);
  for (const std::size_t i : {4u, 15u, 29u}) curve.points[i].flux *= 3.0;
  return curve;
}

// Residuals with the best factor under the loss, at x + h e_k.
std::vector<Digits> wide_residuals(const fit::LightModel& b, const light::LightCurve& curve,
                                   const fit::Loss& loss, std::size_t k, const DoubleDouble& h) {
  const std::vector<DoubleDouble> B = wide_brightness(b, curve, k, h);
  std::vector<WidePoint> points;
  for (std::size_t i = 0; i < B.size(); ++i) {
    const light::LightPoint& p = curve.points[i];
    points.push_back({Digits(p.flux) / p.sigma, (Digits(B[i].hi) + Digits(B[i].lo)) / p.sigma});
  }
  const Digits f = least_factor(loss, points);
  std::vector<Digits> r;
  for (const WidePoint& p : points) r.push_back(p.u - f * p.v);
  return r;
}

TEST(RobustLight, DerivativesAreThoseOfDifferencesInDoubleDouble) {
  const DoubleDouble h(0x1p-30);
  for (const Kind kind : robust_kinds) {
    const fit::LightModel& b = kind == Kind::soft_l1 ? in_long_axis_mode : in_short_axis_mode;
    const fit::Loss loss{kind, 1.5};
    const light::LightCurve curve = bad_night(b);
    const fit::LightFit fit{{curve}, b, {}, loss, 10};
    const fit::ResidualFunction under_loss(fit::least_squares_of(fit));
    const auto exact = ellipsoid_residuals(fit.curves, {}, b, loss),
               held = ellipsoid_residuals(fit.curves, {}, b, loss, Rows::held);
    const std::vector<double> x = fit::light_unknowns_at({}, b, b);
    const std::size_t n = x.size(), count = curve.points.size();
    std::vector<double> numbers(count), jacobian(count * n), rows(count * n), lossy(count),
        lossy_rows(count * n);
    ASSERT_TRUE(exact.at(x, numbers, jacobian));
    ASSERT_TRUE(held.at(x, numbers, rows));
    ASSERT_TRUE(under_loss.at(x, lossy, lossy_rows));
    for (std::size_t k = 0; k < n; ++k) {
      const auto above = wide_residuals(b, curve, loss, k, h);
      const auto below = wide_residuals(b, curve, loss, k, -h);
      const Digits width = 2 * Digits(h.hi);
      double largest = 0.0, size = 0.0, half_gradient = 0.0, of_held = 0.0;
      Worst<> worst;
      Digits sum = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const double slope = double((above[i] - below[i]) / width);
        largest = larger(largest, std::abs(slope));
        worst.add(std::abs(jacobian[i * n + k] - slope));
        sum += (cost_of(loss, above[i]) - cost_of(loss, below[i])) / width;
        half_gradient += lossy[i] * lossy_rows[i * n + k];
        size += std::abs(lossy[i] * lossy_rows[i * n + k]);
        const double weight = value(loss, numbers[i] * numbers[i] / (1.5 * 1.5)).weight;
        of_held += weight * numbers[i] * rows[i * n + k];
      }
      EXPECT_LE(worst.value(), budget::light_derivatives * largest) << int(kind) << ' ' << k;
      EXPECT_NEAR(2.0 * half_gradient, double(sum), budget::light_derivatives * size);
      EXPECT_NEAR(2.0 * of_held, double(sum), budget::light_derivatives * size);
      EXPECT_GT(std::abs(double(sum)), 1e3 * budget::light_derivatives * size);
    }
  }
}

// The factor of a fit is the least of what it minimises: sum psi(r) m / sigma = 0, m the model.
double slope_by_factor(const fit::LightSolution& found, const light::LightCurve& curve,
                       const fit::Loss& loss) {
  double sum = 0.0, size = 0.0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const light::LightPoint& p = curve.points[i];
    const double r = found.result.numbers[i];
    const double one = double(pull_of(loss, r)) * (p.flux - r * p.sigma) / p.sigma;
    sum += one;
    size += std::abs(one);
  }
  return std::abs(sum) / size;
}

TEST(RobustLight, FactorsOfAllFitsAreTheLeastOfWhatTheyMinimise) {
  const fit::LightModel& b = in_short_axis_mode;
  const std::vector<light::LightCurve> curves{bad_night(b)};
  for (const Kind kind : robust_kinds) {
    const fit::Loss loss{kind, 1.5};
    const fit::LightSolution light = fit::fit_light({curves, b, {}, loss, 3});
    EXPECT_LE(slope_by_factor(light, curves[0], loss), budget::light_derivatives);
    EXPECT_GT(slope_by_factor(light, curves[0], {}), 0.01);
    const double factor =
        (curves[0].points[7].flux - light.result.numbers[7] * curves[0].points[7].sigma) /
        fit::model_fluxes(light.body, curves, loss)[0][7];
    EXPECT_NEAR(factor, 1.0, budget::light_derivatives);
    fit::LightFit fit{curves, b, {.moments = fit::MomentSource::fit}, loss, 3};
    fit.start.shape = fit::ConvexShape::of(b.ellipsoid(), 2, 3);
    const fit::LightSolution facets = fit::fit_light(fit);
    EXPECT_LE(slope_by_factor(facets, curves[0], loss), budget::light_derivatives);
    fit.start.shape = light::ShadedMesh(facets.body.convex().mesh());
    fit.unknowns.moments = fit::MomentSource::start;
    EXPECT_LE(slope_by_factor(fit::fit_light(fit), curves[0], loss), budget::light_derivatives);
  }
}

// Errors are those of a fit that has the factor as one more unknown.
TEST(RobustLight, ErrorsAreThoseThatAFactorAmongTheUnknownsLeaves) {
  const std::vector<light::LightCurve> curves{bad_night(in_short_axis_mode)};
  for (const Kind kind : robust_kinds) {
    const fit::LightFit fit{curves, in_short_axis_mode, {}, {kind, 1.5}, 100};
    const fit::LightSolution found = fit::fit_light(fit);
    ASSERT_TRUE(found.is_found()) << found.result.sentence;
    const auto about = ellipsoid_residuals(curves, {}, found.body);
    const auto light = [&](const std::vector<double>& x) {
      std::vector<fit::detail::MotionPoint> motion;
      std::vector<double> B(about.curves().size());
      const fit::LightModel body = about.body_at(x);
      EXPECT_TRUE(fit::detail::free_motion(body.spin, about.curves().times(), {}, motion));
      EXPECT_TRUE(fit::detail::brightness_along(
          [&](const Vec3& s, const Vec3& o) {
            return light::brightness(body.ellipsoid(), body.law, s, o);
          },
          {}, motion, about.curves(), B));
      return B;
    };
    const std::vector<double> x = fit::light_unknowns_at({}, found.body, found.body);
    const std::size_t n = x.size(), count = about.curves().size();
    const std::vector<double> B = light(x);
    const double f = found.factors.at(0), h = 1e-5;
    std::vector<double> rows(count * (n + 1)), numbers(count);
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> above = x, below = x;
      above[k] += h;
      below[k] -= h;
      const std::vector<double> a = light(above), b = light(below);
      for (std::size_t i = 0; i < count; ++i)
        rows[i * (n + 1) + k] = -about.curves()[i].weight * f * (a[i] - b[i]) / (2.0 * h);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const fit::detail::WeighedPoint& p = about.curves()[i];
      numbers[i] = p.weight * (p.flux - f * B[i]);
      rows[i * (n + 1) + n] = -p.weight * B[i];
    }
    fit::LeastSquares problem;
    fit::LeastSquaresResult at;
    at.x = x;
    at.x.push_back(f);
    for (std::size_t k = 0; k <= n; ++k) problem.unknowns.push_back({.name = std::to_string(k)});
    problem.loss = fit.loss;
    problem.residuals.data = count;
    problem.residuals.at = [&](std::span<const double>, std::span<double> r, std::span<double> J) {
      std::ranges::copy(numbers, r.begin());
      if (!J.empty()) std::ranges::copy(rows, J.begin());
      return true;
    };
    const fit::UnknownsCovariance whole = fit::covariance(problem, at);
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_NEAR(found.covariance.error(k) / whole.error(k), 1.0, budget::projected_errors)
          << int(kind) << ' ' << k;
  }
}

// Ranked and limited by what was minimised, and so it says.
TEST(RobustLight, SearchesRankByWhatTheyMinimise) {
  const FreeRotation motion = motion_of(in_short_axis_mode);
  fit::LightSearch search;
  search.curves = {bad_night(in_short_axis_mode)};
  search.periods = {{motion.regime(), 2.0 * pi<double>() / motion.precession_rate_long(),
                     motion.polhode_period()}};
  search.starts = 24;
  search.within = 3.0;
  search.loss = {Kind::cauchy, 2.0};
  const fit::LightSearchResult found = fit::search_light(search);
  ASSERT_FALSE(found.solutions.empty());
  const fit::LightSolution& best = found.solutions[0].solution;
  EXPECT_NEAR(found.chi_square_of_periods[0] / best.result.cost, 1.0, budget::light_cost);
  EXPECT_LT(best.result.cost, 0.1 * best.result.chi_square);
  EXPECT_TRUE(found.solutions[0].sentence.ends_with(": the lowest loss"));
  for (std::size_t i = 1; i < found.solutions.size(); ++i) {
    const double cost = found.solutions[i].solution.result.cost;
    EXPECT_GE(cost, (1.0 - budget::light_cost) * found.solutions[i - 1].solution.result.cost);
    EXPECT_LE(cost, (1.0 + budget::light_cost) * search.within * best.result.cost);
  }
  // chi-square is that of the bad points: errors that it scaled would make images one
  EXPECT_GT(std::sqrt(best.result.chi_square / best.degrees_of_freedom), 20.0);
  EXPECT_LT(best.error_factor(), budget::light_noise);
  EXPECT_EQ(std::ranges::count_if(found.solutions,
                                  [](const fit::FoundLight& f) {
                                    return f.beside == fit::FoundLight::Beside::image && f.of == 0;
                                  }),
            3);
  const fit::LightModel truth = at_time(in_short_axis_mode, best.body.spin.t0);
  EXPECT_TRUE(std::ranges::any_of(found.solutions, [&](const fit::FoundLight& f) {
    const fit::LightModel& b = f.solution.body;
    return fit::mahalanobis(f.solution.covariance, fit::light_unknowns_at({}, b, b),
                            fit::light_unknowns_at({}, b, fit::nearest_of_same(b, truth))) <
           budget::light_distance;
  }));
}

}  // namespace
