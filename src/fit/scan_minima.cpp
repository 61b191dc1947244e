// SPDX-License-Identifier: MIT
// Minima of a scan, refined: of one landscape, and of the sum of those of single sessions.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fit/result_bytes.hpp"
#include "fit/session_scan.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/fourier_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

namespace {

struct LandscapeCell {
  std::size_t row, column;
};

bool is_minimum(const Landscape& of, std::size_t row, std::size_t column) {
  const double here = of.at(row, column);
  const std::size_t top = row == 0 ? 0 : row - 1, left = column == 0 ? 0 : column - 1;
  const std::size_t bottom = std::min(row + 2, of.first.count);
  const std::size_t right = std::min(column + 2, of.second.count);
  for (std::size_t r = top; r < bottom; ++r)
    for (std::size_t c = left; c < right; ++c) {
      const bool before = r < row || (r == row && c < column);
      if (before ? !(here < of.at(r, c)) : here > of.at(r, c)) return false;
    }
  return true;
}

bool at_end(std::size_t i, const FrequencyGrid& grid) {
  return grid.count > 1 && (i == 0 || i + 1 == grid.count);
}

constexpr double one_pair = 0.01;  // of a step

// Pairs that refinement brought together, in either order: nearer than a hundredth of a step.
bool are_one(const FourierFit& a, const FourierFit& b, double step) {
  const auto near = [&](double x, double y) { return std::abs(x - y) < one_pair * step; };
  return (near(a.f1, b.f1) && near(a.f2, b.f2)) || (near(a.f1, b.f2) && near(a.f2, b.f1));
}

bool is_same(const Landscape& of, const FourierFit& a, const FourierFit& b) {
  if (of.orders.first == 0) return std::abs(a.f2 - b.f2) < one_pair * of.second.step;
  return are_one(a, b, std::max(of.first.step, of.second.step));
}

// The cells of a landscape that are minima, the lowest first, at most `most`.
std::vector<LandscapeCell> minimum_cells(const Landscape& of, std::size_t most) {
  std::vector<LandscapeCell> cells;
  for (std::size_t r = 0; r < of.first.count; ++r)
    for (std::size_t c = 0; c < of.second.count; ++c)
      if (is_minimum(of, r, c)) cells.push_back({r, c});
  std::ranges::stable_sort(cells, {},
                           [&](const LandscapeCell& a) { return of.at(a.row, a.column); });
  if (cells.size() > most) cells.resize(most);
  return cells;
}

}  // namespace

std::vector<ScanMinimum> scan_minima(const ScanPoints& points, const Landscape& of,
                                     const MinimaOptions& options) {
  const std::vector<LandscapeCell> cells = minimum_cells(of, options.most);

  // a cell of the grid; of one frequency alone, what the time base tells apart
  double reach = std::numeric_limits<double>::infinity();
  if (of.orders.first > 0 && of.first.count > 1) reach = of.first.step;
  if (of.second.count > 1) reach = std::min(reach, of.second.step);
  if (!std::isfinite(reach)) reach = 1.0 / points.time_base();
  std::vector<ScanMinimum> found;
  ensemble::ordered_parallel_for(
      options.journal, static_cast<std::int64_t>(cells.size()), options.threads,
      [&](std::int64_t k) {
        if (options.between) options.between();
        const auto [r, c] = cells[static_cast<std::size_t>(k)];
        return refined_pair(points, of.first.at(r), of.second.at(c), of.orders, reach);
      },
      [&](std::int64_t k, const RefinedPair& refined) {
        const auto [r, c] = cells[static_cast<std::size_t>(k)];
        const bool known = std::any_of(found.begin(), found.end(), [&](const ScanMinimum& m) {
          return is_same(of, m.refined.fit, refined.fit);
        });
        if (known) return;
        const bool edge = at_end(r, of.first) || at_end(c, of.second);
        found.push_back({r, c, of.at(r, c), edge, is_resolved(refined.fit), refined});
      },
      [](Archive& bytes, RefinedPair& refined) { detail::serialize(bytes, refined); });
  std::stable_sort(found.begin(), found.end(), [](const ScanMinimum& a, const ScanMinimum& b) {
    return a.refined.fit.chi_square < b.refined.fit.chi_square;
  });
  return found;
}

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
  return std::ranges::any_of(
      found, [&](const ScanMinimum& one) { return are_one(one.refined.fit, m.refined.fit, step); });
}

const std::string who = "scan_sessions: ";

// Sessions that have more points than a series has unknowns.
std::vector<light::LightCurve> with_enough_points(std::span<const light::LightCurve> sessions,
                                                  std::size_t order) {
  std::vector<light::LightCurve> enough;
  for (const light::LightCurve& one : sessions)
    if (one.points.size() > unknowns_of(order)) enough.push_back(one);
  if (enough.empty())
    throw DomainError(who + "no session has more than " + std::to_string(unknowns_of(order)) +
                      " points, the unknowns of a series of order " + std::to_string(order));
  return enough;
}

// Of a grid as fine as the longest of them asks for.
double coarse_step(std::span<const light::LightCurve> sessions, std::size_t order) {
  double step = std::numeric_limits<double>::infinity();
  for (const light::LightCurve& one : sessions)
    step = std::min(step, scan_advice({&one, 1}, order).step);
  return step;
}

class SessionScanner {
 public:
  SessionScanner(std::span<const light::LightCurve> sessions, const SessionScanOptions& options)
      : sessions_(sessions), options_(options) {
    if (options.windows < 1) throw DomainError(who + "windows = 0 must be 1 or more");
  }

  SessionScan found(double least, double most) {
    const SessionScanSize size = session_scan_size(sessions_, least, most, options_.scan.order);
    // half of the coarse pairs are computed
    const double coarse_work = 0.5 * static_cast<double>(size.sessions) * size.coarse;
    work_ = coarse_work + static_cast<double>(options_.windows) * size.fine;
    coarse(FrequencyGrid::between(least, most, size.coarse_step));
    const ScanPoints points(sessions_, options_.quantity);
    const double step = scan_advice(sessions_, options_.scan.order).step;
    std::size_t windows = 0;
    // each minimum off the diagonal is there twice
    for (const auto& [row, column] : minimum_cells(result_->coarse, 2 * options_.windows)) {
      if (row > column || windows == options_.windows) continue;
      ++windows;
      look_into(points, row, column, step);
    }
    std::ranges::stable_sort(result_->minima, {},
                             [](const ScanMinimum& m) { return m.refined.fit.chi_square; });
    return std::move(*result_);
  }

 private:
  // The same with the progress of a part of all work.
  ScanOptions with_progress(double own) {
    ScanOptions how = options_.scan;
    if (options_.scan.progress)
      how.progress = [this, own](double part) {
        options_.scan.progress(std::min((done_ + part * own) / work_, 1.0));
      };
    return how;
  }

  // Sums of the landscapes of sessions that have enough points.
  void coarse(const FrequencyGrid& grid) {
    const double own = 0.5 * static_cast<double>(grid.count) * static_cast<double>(grid.count);
    for (const light::LightCurve& one : with_enough_points(sessions_, options_.scan.order)) {
      const Landscape of =
          scan_pairs(ScanPoints({&one, 1}, options_.quantity), grid, with_progress(own));
      done_ += own;
      if (!result_) {
        result_ = SessionScan{of, 1, 0, {}};
        continue;
      }
      ++result_->sessions;
      result_->coarse.again += of.again;
      for (std::size_t i = 0; i < of.chi_square.size(); ++i)
        result_->coarse.chi_square[i] += of.chi_square[i];
    }
  }

  // The minima of the whole time base about a cell; those at the edge of its window belong to
  // another one, or to none.
  void look_into(const ScanPoints& points, std::size_t row, std::size_t column, double step) {
    const FrequencyGrid& grid = result_->coarse.first;
    const FrequencyGrid first = window(grid, row, step), second = window(grid, column, step);
    const double own = static_cast<double>(first.count) * static_cast<double>(second.count);
    const Landscape fine = scan_pairs(points, first, second, with_progress(own));
    done_ += own;
    result_->pairs += fine.chi_square.size();
    const std::vector<ScanMinimum> all = scan_minima(points, fine,
                                                     {.most = options_.most,
                                                      .threads = options_.scan.threads,
                                                      .between = options_.scan.between,
                                                      .journal = options_.scan.journal});
    const auto at_end = [&](std::size_t i) { return i == 0 || i + 1 == grid.count; };
    for (ScanMinimum m : all) {
      if (m.at_edge || is_known(result_->minima, m, step)) continue;
      m.row = row;
      m.column = column;
      m.at_edge = at_end(row) || at_end(column);
      result_->minima.push_back(m);
    }
  }

  std::span<const light::LightCurve> sessions_;
  const SessionScanOptions& options_;
  std::optional<SessionScan> result_;
  double work_ = 1.0, done_ = 0.0;  // in pairs that are computed
};

}  // namespace

SessionScanSize session_scan_size(std::span<const light::LightCurve> sessions, double least,
                                  double most, std::size_t order) {
  const std::vector<light::LightCurve> enough = with_enough_points(sessions, order);
  const double step = coarse_step(enough, order);
  const auto count = static_cast<double>(FrequencyGrid::between(least, most, step).count);
  const double width = 2.0 * reach * step / scan_advice(sessions, order).step + 1.0;
  return {enough.size(), step, count * count, width * width};
}

SessionScan scan_sessions(std::span<const light::LightCurve> sessions, double least, double most,
                          const SessionScanOptions& options) {
  return SessionScanner(sessions, options).found(least, most);
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
