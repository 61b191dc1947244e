// SPDX-License-Identifier: MIT
#include "polhode/fit/fourier_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "fit/detail/fourier_checks.hpp"
#include "fit/detail/scan_task.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/cells.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Pairs that are computed in one go: functions of f1 are shared by a row, those of f2 by a column,
// and what a block keeps of both stays in the cache of a processor.
constexpr std::size_t block_rows = 8, block_pairs = 512;

void scan_block(const detail::ScanBlock& block, [[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return detail::scan_in_lanes<InstructionSet::avx512>(block);
  if (set == InstructionSet::avx2) return detail::scan_in_lanes<InstructionSet::avx2>(block);
#endif
  return detail::scan_in_lanes<InstructionSet::baseline>(block);
}

std::vector<double> frequencies(const FrequencyGrid& grid, std::size_t first, std::size_t count) {
  std::vector<double> f(count);
  for (std::size_t i = 0; i < count; ++i) f[i] = grid.at(first + i);
  return f;
}

void check(const std::string& who, const FrequencyGrid& grid) {
  if (grid.count == 0) throw DomainError(who + ": a grid has no frequencies");
  for (const double f : {grid.first, grid.at(grid.count - 1)})
    if (!(f > 0.0) || !std::isfinite(f))
      throw DomainError(who + ": frequency " + detail::number_text(f) +
                        " must be positive and finite");
  if (!(grid.step > 0.0) && grid.count > 1)
    throw DomainError(who + ": step " + detail::number_text(grid.step) + " must be positive");
}

struct BlockResult {
  std::size_t row, column, rows, columns, again;
  std::vector<double> chi_square;
};

class Scan {
 public:
  Scan(const ScanPoints& points, const Landscape& of, InstructionSet set)
      : points_(points),
        of_(of),
        set_(set),
        rows_(std::min(block_rows, of.first.count)),
        columns_(block_pairs / rows_ / 8 * 8),
        across_((of.second.count + columns_ - 1) / columns_) {}

  std::int64_t blocks() const {
    const std::size_t down = (of_.first.count + rows_ - 1) / rows_;
    return static_cast<std::int64_t>(down * across_);
  }

  // `between` is called before each pair that is computed again: some ms each of high orders.
  BlockResult block(std::size_t index, const std::function<void()>& between) const {
    BlockResult r{.row = index / across_ * rows_,
                  .column = index % across_ * columns_,
                  .rows = 0,
                  .columns = 0,
                  .again = 0,
                  .chi_square = {}};
    r.rows = std::min(rows_, of_.first.count - r.row);
    r.columns = std::min(columns_, of_.second.count - r.column);
    r.chi_square.resize(r.rows * r.columns);
    const std::vector<double> first = frequencies(of_.first, r.row, r.rows);
    const std::vector<double> second = frequencies(of_.second, r.column, (r.columns + 7) / 8 * 8);
    std::vector<std::uint8_t> suspect(r.chi_square.size());
    scan_block({.points = &points_.table(),
                .first_order = of_.orders.first,
                .second_order = of_.orders.second,
                .first = first.data(),
                .rows = r.rows,
                .second = second.data(),
                .columns = r.columns,
                .floor = scan_floor,
                .chi_square = r.chi_square.data(),
                .suspect = suspect.data()},
               set_);
    for (std::size_t i = 0; i < suspect.size(); ++i) {
      if (suspect[i] == 0) continue;
      if (between) between();
      ++r.again;
      r.chi_square[i] =
          fourier_fit(points_, first[i / r.columns], second[i % r.columns], of_.orders).chi_square;
    }
    return r;
  }

 private:
  const ScanPoints& points_;
  const Landscape& of_;
  InstructionSet set_;
  std::size_t rows_, columns_, across_;
};

Landscape scanned(const std::string& who, const ScanPoints& points, Landscape of,
                  const ScanOptions& options) {
  check(who, of.first);
  check(who, of.second);
  if (!supports(options.set))
    throw DomainError(who + ": got " + std::string(instruction_set_name(options.set)) +
                      "; expected instructions that this processor has");
  if (options.order == 0) throw DomainError(who + ": order 0: it must be 1 to 9");
  detail::check_orders(who, points, of.orders);
  of.chi_square.resize(of.first.count * of.second.count);
  const Scan scan(points, of, options.set);
  std::size_t done = 0;
  run_cells(
      0, scan.blocks(), options.threads,
      [&](std::int64_t k) {
        if (options.between) options.between();
        return scan.block(static_cast<std::size_t>(k), options.between);
      },
      [&](std::int64_t, const BlockResult& r) {
        done += r.chi_square.size();
        for (std::size_t i = 0; i < r.rows; ++i)
          std::copy_n(r.chi_square.data() + i * r.columns, r.columns,
                      of.chi_square.data() + (r.row + i) * of.second.count + r.column);
        of.again += r.again;
        if (options.progress)
          options.progress(static_cast<double>(done) / static_cast<double>(of.chi_square.size()));
      });
  return of;
}

// Rows of a grid that are computed at a time.
constexpr std::size_t rows_at_a_time = 64;

// The first rows of each of these, so that the first few are spread over all: ranks of the
// fractional parts of multiples of the golden ratio.
std::vector<std::size_t> spread_rows(std::size_t count) {
  constexpr double golden = 0.6180339887498949;
  std::vector<std::size_t> places((count + rows_at_a_time - 1) / rows_at_a_time);
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::ranges::sort(places, {}, [](std::size_t k) {
    const double turns = golden * static_cast<double>(k + 1);
    return turns - std::floor(turns);
  });
  std::vector<std::size_t> rows(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) rows[places[i]] = i * rows_at_a_time;
  return rows;
}

}  // namespace

FrequencyGrid FrequencyGrid::between(double least, double most, double step) {
  if (!(step > 0.0) || !(least > 0.0) || !(most >= least) || !std::isfinite(most))
    throw DomainError("FrequencyGrid: from " + detail::number_text(least) + " to " +
                      detail::number_text(most) + " by " + detail::number_text(step) +
                      ": it must rise from a positive frequency by a positive step");
  const double steps = std::floor((most - least) / step * (1.0 + 1e-12));
  if (steps > 1e9)
    throw DomainError("FrequencyGrid: " + std::to_string(steps) +
                      " steps: there may be no more than 1e9");
  return {least, step, static_cast<std::size_t>(steps) + 1};
}

Landscape scan_pairs(const ScanPoints& points, const FrequencyGrid& first,
                     const FrequencyGrid& second, const ScanOptions& options) {
  return scanned("scan_pairs", points, {first, second, FourierOrders::pair(options.order), {}, 0},
                 options);
}

Landscape scan_pairs(const ScanPoints& points, const FrequencyGrid& both,
                     const ScanOptions& options) {
  const std::size_t n = both.count;
  check("scan_pairs", both);
  // before memory is taken
  detail::check_orders("scan_pairs", points, FourierOrders::pair(options.order));
  Landscape all{both, both, FourierOrders::pair(options.order), std::vector<double>(n * n), 0};
  std::size_t done = 0;
  const std::vector<std::size_t> order = spread_rows(n);
  std::size_t of = 0;
  for (const std::size_t row : order) of += std::min(rows_at_a_time, n - row) * (n - row);
  for (const std::size_t row : order) {
    const std::size_t rows = std::min(rows_at_a_time, n - row), columns = n - row;
    ScanOptions how = options;
    how.progress = [&](double part) {
      const double own = part * static_cast<double>(rows * columns);
      if (options.progress)
        options.progress((static_cast<double>(done) + own) / static_cast<double>(of));
    };
    const Landscape part = scan_pairs(points, {both.at(row), both.step, rows},
                                      {both.at(row), both.step, columns}, how);
    done += rows * columns;
    all.again += part.again;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        all.chi_square[(row + i) * n + row + j] = part.at(i, j);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = rows; j < columns; ++j)
        all.chi_square[(row + j) * n + row + i] = part.at(i, j);
  }
  return all;
}

Landscape scan_periods(const ScanPoints& points, const FrequencyGrid& grid,
                       const ScanOptions& options) {
  return scanned("scan_periods", points,
                 {{grid.first, grid.step, 1}, grid, FourierOrders::single(options.order), {}, 0},
                 options);
}

}  // namespace v0
}  // namespace polhode
