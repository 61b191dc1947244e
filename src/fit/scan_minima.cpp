// SPDX-License-Identifier: MIT
#include "polhode/fit/scan_minima.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "fit/detail/landscape_minima.hpp"
#include "polhode/ensemble/cells.hpp"

namespace polhode {
inline namespace v0 {
namespace {

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

bool is_same(const Landscape& of, const FourierFit& a, const FourierFit& b) {
  if (of.orders.first == 0) return std::abs(a.f2 - b.f2) < one_pair * of.second.step;
  return detail::are_one(a, b, std::max(of.first.step, of.second.step));
}

}  // namespace

bool detail::are_one(const FourierFit& a, const FourierFit& b, double step) {
  const auto near = [&](double x, double y) { return std::abs(x - y) < one_pair * step; };
  return (near(a.f1, b.f1) && near(a.f2, b.f2)) || (near(a.f1, b.f2) && near(a.f2, b.f1));
}

std::vector<detail::LandscapeCell> detail::minimum_cells(const Landscape& of, std::size_t most) {
  std::vector<LandscapeCell> cells;
  for (std::size_t r = 0; r < of.first.count; ++r)
    for (std::size_t c = 0; c < of.second.count; ++c)
      if (is_minimum(of, r, c)) cells.push_back({r, c});
  std::ranges::stable_sort(cells, {},
                           [&](const LandscapeCell& a) { return of.at(a.row, a.column); });
  if (cells.size() > most) cells.resize(most);
  return cells;
}

std::vector<ScanMinimum> scan_minima(const ScanPoints& points, const Landscape& of,
                                     const MinimaOptions& options) {
  const std::vector<detail::LandscapeCell> cells = detail::minimum_cells(of, options.most);

  // a cell of the grid; of one frequency alone, what the time base tells apart
  double reach = std::numeric_limits<double>::infinity();
  if (of.orders.first > 0 && of.first.count > 1) reach = of.first.step;
  if (of.second.count > 1) reach = std::min(reach, of.second.step);
  if (!std::isfinite(reach)) reach = 1.0 / points.time_base();
  std::vector<ScanMinimum> found;
  run_cells(
      0, static_cast<std::int64_t>(cells.size()), options.threads,
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
      });
  std::stable_sort(found.begin(), found.end(), [](const ScanMinimum& a, const ScanMinimum& b) {
    return a.refined.fit.chi_square < b.refined.fit.chi_square;
  });
  return found;
}

}  // namespace v0
}  // namespace polhode
