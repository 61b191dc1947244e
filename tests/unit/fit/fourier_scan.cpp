// SPDX-License-Identifier: MIT
// Fourier scans against plain least squares in long double, and what they must not depend on.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using polhode::test::Worst;
using Column = std::vector<long double>;

constexpr long double two_pi = 6.283185307179586476925286766559L;

// A few harmonics of 1.7 and 2.9 with noise, over ten units of time, in so many sessions of which
// each has a factor of its own.
std::vector<light::LightCurve> light_curves(std::size_t sessions, std::size_t count,
                                            bool is_calibrated) {
  std::mt19937_64 engine(11);
  const auto uniform = [&] { return std::ldexp(static_cast<double>(engine() >> 11U), -53); };
  std::vector<light::LightCurve> curves(
      sessions, {.name = "night", .is_calibrated = is_calibrated, .points = {}});
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t s = i * sessions / count;
    const double t = 10.0 * (static_cast<double>(i) + uniform()) / static_cast<double>(count);
    const double turn = 6.283185307179586 * t;
    const double flux = 5.0 + std::cos(3.4 * turn) + 0.6 * std::sin(4.6 * turn + 1.0) +
                        0.3 * std::sin(1.2 * turn) + 0.1 * (uniform() - 0.5);
    const double factor = is_calibrated ? 1.0 : 1.0 + 0.3 * static_cast<double>(s);
    curves[s].points.push_back({t, factor * flux, factor * 0.03 * (1.0 + uniform()), {}, {}});
  }
  return curves;
}

// Chi-square over the total, by orthogonal columns, each made so twice.
long double plain(const std::vector<light::LightCurve>& curves, double f1, double f2,
                  fit::FourierOrders of) {
  std::vector<Column> columns;
  Column rest;
  const bool one = curves.front().is_calibrated;
  std::vector<long double> scale(curves.size());
  long double all = 0.0L, count = 0.0L;
  for (std::size_t s = 0; s < curves.size(); ++s) {
    for (const light::LightPoint& p : curves[s].points) scale[s] += p.flux;
    all += scale[s];
    count += curves[s].points.size();
    scale[s] /= curves[s].points.size();
  }
  if (one) std::fill(scale.begin(), scale.end(), all / count);
  const auto add = [&](const auto& function) {
    Column c;
    for (std::size_t s = 0; s < curves.size(); ++s)
      for (const light::LightPoint& p : curves[s].points)
        c.push_back(function(s, p) * scale[s] / p.sigma);
    columns.push_back(std::move(c));
  };
  for (std::size_t s = 0; s < (one ? 1 : curves.size()); ++s)
    add([&](std::size_t at, const light::LightPoint&) { return one || at == s ? 1.0L : 0.0L; });
  const int m1 = static_cast<int>(of.first), m2 = static_cast<int>(of.second);
  for (int j = 0; j <= m1; ++j)
    for (int k = j == 0 ? 1 : -m2; k <= m2; ++k) {
      const long double f = j * static_cast<long double>(f1) + k * static_cast<long double>(f2);
      add([&](std::size_t, const light::LightPoint& p) { return std::cos(two_pi * f * p.t); });
      add([&](std::size_t, const light::LightPoint& p) { return std::sin(two_pi * f * p.t); });
    }
  const std::size_t constants = one ? 1 : curves.size();
  add([&](std::size_t s, const light::LightPoint& p) { return p.flux / scale[s]; });
  rest = columns.back();
  columns.pop_back();
  const auto dot = [](const Column& a, const Column& b) {
    long double sum = 0.0L;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  std::vector<Column> basis;
  long double total = 0.0L;
  for (std::size_t c = 0; c <= columns.size(); ++c) {
    if (c == constants) total = dot(rest, rest);
    if (c == columns.size()) break;
    Column& x = columns[c];
    for (int pass = 0; pass < 2; ++pass)
      for (const Column& b : basis) {
        const long double part = dot(b, x);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] -= part * b[i];
      }
    const long double size = std::sqrt(dot(x, x)), part = dot(x, rest) / size;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] /= size;
      rest[i] -= part * x[i];
    }
    basis.push_back(x);
  }
  return dot(rest, rest) / total;
}

double worst_of(const std::vector<light::LightCurve>& curves, const fit::ScanOptions& options) {
  const fit::ScanPoints points(curves);
  const fit::FrequencyGrid first{0.31, 0.57, 5}, second{0.45, 0.391, 9};
  const fit::Landscape found = fit::scan_pairs(points, first, second, options);
  Worst worst;
  int compared = 0;
  for (std::size_t r = 0; r < first.count; ++r)
    for (std::size_t c = 0; c < second.count; ++c) {
      const fit::FourierFit fit = fit::fourier_fit(points, first.at(r), second.at(c), found.orders);
      if (fit.rank < fit.unknowns) continue;  // to the digits of double, dependent
      ++compared;
      const auto want =
          plain(curves, first.at(r), second.at(c), fit::FourierOrders::pair(options.order));
      worst.add(std::abs(static_cast<double>(found.at(r, c) / points.total() - want)));
    }
  EXPECT_GT(compared, 40);
  return worst.value();
}

TEST(FourierScan, IsLeastSquaresAtEveryPair) {
  for (const std::size_t order : {1U, 2U, 3U}) {
    for (const std::size_t sessions : {1U, 3U}) {
      SCOPED_TRACE(::testing::Message() << order << " " << sessions);
      EXPECT_LE(worst_of(light_curves(sessions, 240, false), {.order = order}),
                budget::fourier_scan);
      EXPECT_LE(worst_of(light_curves(sessions, 240, true), {.order = order}),
                budget::fourier_scan);
    }
  }
}

TEST(FourierScan, OfOnePeriodIsLeastSquares) {
  const auto curves = light_curves(2, 90, false);
  const fit::ScanPoints points(curves);
  const fit::FrequencyGrid grid{0.2, 0.0937, 70};
  for (const std::size_t order : {1U, 4U}) {
    const fit::Landscape found = fit::scan_periods(points, grid, {.order = order});
    for (std::size_t c = 0; c < grid.count; ++c)
      EXPECT_NEAR(
          found.at(0, c) / points.total(),
          static_cast<double>(plain(curves, 1.0, grid.at(c), fit::FourierOrders::single(order))),
          budget::fourier_scan);
  }
}

TEST(FourierScan, HasTheBitsOfOneThreadOfAnyProcessorAndOfAnyGrid) {
  const fit::ScanPoints points(light_curves(2, 150, false));
  const fit::FrequencyGrid first{0.4, 0.111, 19}, second{0.3, 0.0517, 77};
  const fit::Landscape one = fit::scan_pairs(points, first, second, {.order = 2});
  EXPECT_GT(one.again, 0U);
  EXPECT_LT(one.again, one.chi_square.size() / 4);
  for (const InstructionSet set : supported_instruction_sets())
    for (const int threads : {1, 3})
      EXPECT_EQ(fit::scan_pairs(points, first, second, {2, threads, set}).chi_square,
                one.chi_square)
          << instruction_set_name(set) << " " << threads;
  for (const std::size_t r : {0U, 7U, 18U})
    for (const std::size_t c : {0U, 13U, 76U}) {
      const fit::FrequencyGrid row{first.at(r), 1.0, 1}, column{second.at(c), 1.0, 1};
      EXPECT_EQ(fit::scan_pairs(points, row, column, {.order = 2}).at(0, 0), one.at(r, c));
    }
}

// Half of the pairs are computed, far from the diagonal the others are those.
TEST(FourierScan, OfOneGridIsTheSameWithFrequenciesExchanged) {
  const fit::ScanPoints points(light_curves(2, 150, false));
  const fit::FrequencyGrid grid{0.3, 0.0517, 150};
  const fit::Landscape whole = fit::scan_pairs(points, grid, grid, {.order = 2});
  std::vector<double> parts;
  fit::ScanOptions options{.order = 2};
  options.progress = [&](double part) { parts.push_back(part); };
  const fit::Landscape half = fit::scan_pairs(points, grid, options);
  EXPECT_EQ(half.first.count, grid.count);
  EXPECT_EQ(half.second.count, grid.count);
  for (std::size_t i = 0; i < grid.count; ++i)
    for (std::size_t j = 0; j < grid.count; ++j)
      EXPECT_NEAR(half.at(i, j), whole.at(i, j), budget::fourier_scan * points.total());
  EXPECT_EQ(half.at(10, 140), half.at(140, 10));
  ASSERT_GT(parts.size(), 10U);
  EXPECT_TRUE(std::ranges::is_sorted(parts));
  EXPECT_GT(parts.front(), 0.0);
  EXPECT_DOUBLE_EQ(parts.back(), 1.0);
}

TEST(FourierScan, DoesNotKnowWhenTimeBeginsNorTheUnits) {
  auto curves = light_curves(1, 150, false);
  const fit::FrequencyGrid grid{0.4, 0.5, 6};
  const fit::Landscape before = fit::scan_pairs(fit::ScanPoints(curves), grid, grid, {.order = 2});
  for (light::LightPoint& p : curves.front().points) {
    p.t += 1024.0;
    p.flux *= 7.0;
    p.sigma *= 7.0;
  }
  const fit::ScanPoints points(curves);
  const fit::Landscape after = fit::scan_pairs(points, grid, grid, {.order = 2});
  for (std::size_t i = 0; i < before.chi_square.size(); ++i)
    EXPECT_NEAR(after.chi_square[i], before.chi_square[i], budget::fourier_shift * points.total());
}

TEST(FourierScan, OfDependentColumnsHasTheChiSquareOfTheirSpan) {
  const fit::ScanPoints points(light_curves(1, 150, false));
  for (const double f : {0.7, 1.3, 2.1}) {
    const auto pair = [&](double f2) {
      return fit::scan_pairs(points, {f, 1.0, 1}, {f2, 1.0, 1}, {.order = 2});
    };
    const auto single = [&](std::size_t order) {
      return fit::scan_periods(points, {f, 1.0, 1}, {.order = order}).at(0, 0);
    };
    EXPECT_EQ(pair(f).again, 1U);
    EXPECT_NEAR(pair(f).at(0, 0), single(4), budget::fourier_scan * points.total());
    EXPECT_NEAR(pair(2.0 * f).at(0, 0), single(6), budget::fourier_scan * points.total());
    const fit::FourierFit fit = fit::fourier_fit(points, f, f, fit::FourierOrders::pair(2));
    EXPECT_EQ(fit.rank, 9U);
    EXPECT_EQ(fit.unknowns, 25U);
    EXPECT_EQ(fit.degrees_of_freedom, 141U);
  }
}

TEST(FourierScan, OfLogarithmsTakesFactorsOutExactly) {
  auto curves = light_curves(3, 150, false);
  const fit::FrequencyGrid grid{0.4, 0.5, 6};
  const fit::ScanPoints first(curves, fit::ScanQuantity::log_flux);
  const fit::Landscape before = fit::scan_pairs(first, grid, grid, {.order = 2});
  for (std::size_t s = 0; s < 3; ++s)
    for (light::LightPoint& p : curves[s].points) {
      p.flux *= 2.0 + static_cast<double>(s);
      p.sigma *= 2.0 + static_cast<double>(s);
    }
  const fit::Landscape after = fit::scan_pairs(fit::ScanPoints(curves, fit::ScanQuantity::log_flux),
                                               grid, grid, {.order = 2});
  for (std::size_t i = 0; i < before.chi_square.size(); ++i)
    EXPECT_NEAR(after.chi_square[i], before.chi_square[i], budget::fourier_shift * first.total());
}

// Pairs that are computed again are the slow ones: what ends a scan is asked before each of them,
// not before a block alone, of which there is one here.
TEST(FourierScan, AsksBeforeEachPairThatIsComputedAgain) {
  const fit::ScanPoints points(light_curves(1, 60, false));
  const fit::FrequencyGrid grid{0.4, 0.2, 8};
  std::size_t calls = 0;
  const fit::Landscape of =
      fit::scan_pairs(points, grid, grid, {.order = 2, .between = [&] { ++calls; }});
  EXPECT_GE(of.again, grid.count);  // those of one frequency twice
  EXPECT_EQ(calls, of.again + 1);
}

TEST(FourierScan, RefusesWhatHasNoAnswer) {
  const fit::ScanPoints points(light_curves(1, 40, false));
  const fit::FrequencyGrid grid{0.4, 0.5, 6};
  EXPECT_REJECTED(fit::scan_pairs(points, grid, grid),
                  "40 points do not determine 49 coefficients");
  EXPECT_THROW(fit::scan_pairs(points, grid, grid, {.order = 0}), DomainError);
  EXPECT_THROW(fit::scan_pairs(points, grid, grid, {.order = 10}), DomainError);
  EXPECT_THROW(fit::scan_pairs(points, {0.0, 0.5, 6}, grid, {.order = 1}), DomainError);
  EXPECT_THROW(fit::scan_pairs(points, {0.4, 0.0, 6}, grid, {.order = 1}), DomainError);
  EXPECT_THROW(fit::scan_pairs(points, {0.4, 0.5, 0}, grid, {.order = 1}), DomainError);
  EXPECT_THROW(fit::scan_pairs(points, grid, grid, {.order = 1, .threads = 0}), DomainError);
  EXPECT_THROW(fit::FrequencyGrid::between(2.0, 1.0, 0.1), DomainError);
  EXPECT_EQ(fit::FrequencyGrid::between(1.0, 2.0, 0.1).count, 11U);
}

}  // namespace
