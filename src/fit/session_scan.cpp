// SPDX-License-Identifier: MIT
#include "polhode/fit/session_scan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "fit/detail/landscape_minima.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/scan_advice.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Half of a window, in steps of the coarse grid: the least of the whole may be beside a cell.
constexpr double reach = 1.5;

std::size_t unknowns_of(std::size_t order) {
  return 2 * FourierOrders::pair(order).harmonics() + 1;
}

FrequencyGrid window(const FrequencyGrid& coarse, std::size_t at, double step) {
  const double half = reach * coarse.step, f = coarse.at(at);
  return FrequencyGrid::between(std::max(f - half, step), f + half, step);
}

bool is_known(std::span<const ScanMinimum> found, const ScanMinimum& m, double step) {
  return std::ranges::any_of(found, [&](const ScanMinimum& one) {
    return detail::are_one(one.refined.fit, m.refined.fit, step);
  });
}

class SessionScanner {
 public:
  SessionScanner(std::span<const LightCurve> sessions, const SessionScanOptions& options)
      : sessions_(sessions), options_(options) {
    if (options.windows < 1) throw DomainError(who + "windows = 0 must be 1 or more");
  }

  SessionScan found(double least, double most) {
    coarse(least, most);
    const ScanPoints points(sessions_, options_.quantity);
    const double step = scan_advice(sessions_, options_.scan.order).step;
    for (const auto& [row, column] : detail::minimum_cells(result_->coarse, options_.windows))
      look_into(points, row, column, step);
    std::ranges::stable_sort(result_->minima, {},
                             [](const ScanMinimum& m) { return m.refined.fit.chi_square; });
    return std::move(*result_);
  }

 private:
  inline static const std::string who = "scan_sessions: ";

  // Sums of the landscapes of sessions that have enough points, on the grid of the longest.
  void coarse(double least, double most) {
    std::vector<LightCurve> enough;
    double step = 0.0;
    const std::size_t unknowns = unknowns_of(options_.scan.order);
    for (const LightCurve& one : sessions_) {
      if (one.points.size() <= unknowns) continue;
      enough.push_back(one);
      const double own = scan_advice({&one, 1}, options_.scan.order).step;
      step = step > 0.0 ? std::min(step, own) : own;
    }
    if (enough.empty())
      throw DomainError(who + "no session has more than " + std::to_string(unknowns) +
                        " points, the unknowns of a series of order " +
                        std::to_string(options_.scan.order));
    const auto grid = FrequencyGrid::between(least, most, step);
    for (const LightCurve& one : enough) {
      const Landscape own =
          scan_pairs(ScanPoints({&one, 1}, options_.quantity), grid, grid, options_.scan);
      if (!result_) {
        result_ = SessionScan{own, enough.size(), 0, {}};
        continue;
      }
      result_->coarse.again += own.again;
      for (std::size_t i = 0; i < own.chi_square.size(); ++i)
        result_->coarse.chi_square[i] += own.chi_square[i];
    }
  }

  // The minima of the whole time base about a cell; those at the edge of its window belong to
  // another one, or to none.
  void look_into(const ScanPoints& points, std::size_t row, std::size_t column, double step) {
    const FrequencyGrid& grid = result_->coarse.first;
    const Landscape fine =
        scan_pairs(points, window(grid, row, step), window(grid, column, step), options_.scan);
    result_->pairs += fine.chi_square.size();
    const std::vector<ScanMinimum> all = scan_minima(points, fine,
                                                     {.most = options_.most,
                                                      .threads = options_.scan.threads,
                                                      .between = options_.scan.between});
    const auto at_end = [&](std::size_t i) { return i == 0 || i + 1 == grid.count; };
    for (ScanMinimum m : all) {
      if (m.at_edge || is_known(result_->minima, m, step)) continue;
      m.row = row;
      m.column = column;
      m.at_edge = at_end(row) || at_end(column);
      result_->minima.push_back(m);
    }
  }

  std::span<const LightCurve> sessions_;
  const SessionScanOptions& options_;
  std::optional<SessionScan> result_;
};

}  // namespace

SessionScan scan_sessions(std::span<const LightCurve> sessions, double least, double most,
                          const SessionScanOptions& options) {
  return SessionScanner(sessions, options).found(least, most);
}

}  // namespace v0
}  // namespace polhode
