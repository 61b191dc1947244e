// SPDX-License-Identifier: MIT
// Fourier series of two frequencies: fits to points, and scans of chi-square over frequencies.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/detail/scan_task.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

inline void check_orders(const std::string& who, const ScanPoints& points, FourierOrders orders) {
  for (const std::size_t order : {orders.first, orders.second})
    if (order > 9 || (order == 0 && orders.second == 0))
      throw DomainError(who + ": order " + std::to_string(order) + ": it must be 1 to 9");
  const std::size_t unknowns = points.constants() + 2 * orders.harmonics();
  if (points.size() <= unknowns)
    throw DomainError(who + ": " + std::to_string(points.size()) + " points do not determine " +
                      std::to_string(unknowns) + " coefficients: take a lower order");
}

}  // namespace detail

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_pivot = 1e-9;

Index whole(std::size_t i) { return static_cast<Index>(i); }

std::vector<std::pair<int, int>> harmonics_of(FourierOrders orders) {
  const int m1 = static_cast<int>(orders.first), m2 = static_cast<int>(orders.second);
  std::vector<std::pair<int, int>> all;
  for (int j = 0; j <= m1; ++j)
    for (int k = j == 0 ? 1 : -m2; k <= m2; ++k) all.emplace_back(j, k);
  return all;
}

// The columns of the series at a pair, times the root of the weights, and what is left of the
// values beside them.
class Series {
 public:
  Series(const ScanPoints& points, double f1, double f2, FourierOrders orders)
      : table_(points.table()), f1_(f1), f2_(f2), harmonics_(harmonics_of(orders)) {
    const Index n = whole(table_.count);
    columns_ = MatrixXd::Zero(n, whole(table_.groups() + 2 * harmonics_.size()));
    VectorXd values(n);
    for (std::size_t g = 0; g < table_.groups(); ++g)
      for (std::size_t i = table_.starts[g]; i < table_.starts[g + 1]; ++i) fill(i, g, values);
    qr_.setThreshold(least_pivot);
    qr_.compute(columns_);
    turned_ = qr_.householderQ().transpose() * values;
    const Index rank = qr_.rank();
    amplitudes_ = qr_.solve(values);
    chi_square_ = turned_.tail(n - rank).squaredNorm();
  }

  double chi_square() const { return chi_square_; }
  VectorXd rest() const { return turned_.tail(turned_.size() - qr_.rank()); }

  // The part beside all columns of the change of the series with f1 or f2.
  VectorXd slope(bool with_first) const {
    VectorXd slope = VectorXd::Zero(columns_.rows());
    for (std::size_t h = 0; h < harmonics_.size(); ++h) {
      const int order = with_first ? harmonics_[h].first : harmonics_[h].second;
      const Index c = whole(table_.groups() + 2 * h);
      slope +=
          order * (amplitudes_[c + 1] * columns_.col(c) - amplitudes_[c] * columns_.col(c + 1));
    }
    for (Index i = 0; i < slope.size(); ++i)
      slope[i] *= 2.0 * pi<double>() * table_.t[static_cast<std::size_t>(i)];
    const VectorXd turned = qr_.householderQ().transpose() * slope;
    return turned.tail(turned.size() - qr_.rank());
  }

  FourierFit fit() const {
    FourierFit fit{.f1 = f1_,
                   .f2 = f2_,
                   .chi_square = chi_square_,
                   .degrees_of_freedom = 0,
                   .rank = static_cast<std::size_t>(qr_.rank()),
                   .unknowns = static_cast<std::size_t>(columns_.cols()),
                   .condition = 1.0,
                   .constants = {},
                   .terms = {}};
    fit.degrees_of_freedom = table_.count - fit.rank;
    const auto& R = qr_.matrixQR();
    fit.condition = std::abs(R(0, 0) / R(qr_.rank() - 1, qr_.rank() - 1));
    for (std::size_t g = 0; g < table_.groups(); ++g)
      fit.constants.push_back(amplitudes_[whole(g)]);
    for (std::size_t h = 0; h < harmonics_.size(); ++h) {
      const Index c = whole(table_.groups() + 2 * h);
      fit.terms.push_back(
          {harmonics_[h].first, harmonics_[h].second, amplitudes_[c], amplitudes_[c + 1]});
    }
    return fit;
  }

 private:
  void fill(std::size_t i, std::size_t group, VectorXd& values) {
    const double root = std::sqrt(table_.weight[i]);
    values[whole(i)] = table_.weighted[i] / root;
    columns_(whole(i), whole(group)) = root;
    // fractions of turns, not angles: long arcs keep their phase
    const double first = f1_ * table_.t[i], second = f2_ * table_.t[i];
    const double a = first - std::rint(first), b = second - std::rint(second);
    for (std::size_t h = 0; h < harmonics_.size(); ++h) {
      const double x = 2.0 * pi<double>() * (harmonics_[h].first * a + harmonics_[h].second * b);
      const Index c = whole(table_.groups() + 2 * h);
      columns_(whole(i), c) = root * std::cos(x);
      columns_(whole(i), c + 1) = root * std::sin(x);
    }
  }

  const detail::ScanTable& table_;
  double f1_, f2_;
  std::vector<std::pair<int, int>> harmonics_;
  MatrixXd columns_;
  Eigen::ColPivHouseholderQR<MatrixXd> qr_;
  VectorXd turned_, amplitudes_;
  double chi_square_ = 0.0;
};

void check(const char* who, const ScanPoints& points, double f1, double f2, FourierOrders orders) {
  for (const double f : {f1, f2})
    if (!std::isfinite(f))
      throw DomainError(std::string(who) + ": frequency " + polhode::detail::number_text(f) +
                        " is no finite number");
  detail::check_orders(who, points, orders);
}

// J^T J and J^T r of the residuals by the frequencies; one frequency has a first row of its own.
struct Normal {
  double a11, a12, a22, b1, b2;

  Normal(const Series& s, bool both) {
    const VectorXd rest = s.rest(), second = s.slope(false);
    a22 = second.squaredNorm();
    b2 = second.dot(rest);
    const VectorXd first = both ? s.slope(true) : VectorXd::Zero(second.size());
    a11 = both ? first.squaredNorm() : 1.0;
    a12 = first.dot(second);
    b1 = first.dot(rest);
  }
  double determinant(double more) const { return a11 * a22 * more * more - a12 * a12; }
};

double scale_of(const FourierFit& fit) {
  return std::sqrt(fit.chi_square / static_cast<double>(fit.degrees_of_freedom));
}

RefinedPair undetermined(const FourierFit& fit, bool both, int iterations) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  return {.fit = fit,
          .converged = false,
          .sigma_f1 = both ? unknown : 0.0,
          .sigma_f2 = unknown,
          .correlation = both ? std::numeric_limits<double>::quiet_NaN() : 0.0,
          .scale = scale_of(fit),
          .iterations = iterations};
}

}  // namespace

FourierFit fourier_fit(const ScanPoints& points, double f1, double f2, FourierOrders orders) {
  check("fourier_fit", points, f1, f2, orders);
  return Series(points, f1, f2, orders).fit();
}

RefinedPair refined_pair(const ScanPoints& points, double f1, double f2, FourierOrders orders,
                         double reach) {
  check("refined_pair", points, f1, f2, orders);
  if (!(reach > 0.0))
    throw DomainError("refined_pair: reach " + polhode::detail::number_text(reach) +
                      " must be positive");
  constexpr int most_iterations = 60;
  const bool both = orders.first > 0;
  // a step that turns no phase by more
  const double settled =
      1e-9 / (points.time_base() * static_cast<double>(std::max(orders.first, orders.second)));
  std::optional<Series> now(std::in_place, points, f1, f2, orders);
  double damping = 1e-3;
  bool converged = false;
  int iterations = 0;
  while (iterations < most_iterations && !converged) {
    const Normal n(*now, both);
    double step = 0.0;
    for (bool better = false; !better && !converged && iterations < most_iterations; ++iterations) {
      const double more = 1.0 + damping, determinant = n.determinant(more);
      if (!(determinant > 0.0)) return undetermined(now->fit(), both, iterations);
      const double d1 =
          both ? std::clamp((n.a22 * more * n.b1 - n.a12 * n.b2) / determinant, -reach, reach)
               : 0.0;
      const double d2 =
          std::clamp((n.a11 * more * n.b2 - n.a12 * n.b1) / determinant, -reach, reach);
      step = std::max(std::abs(d1), std::abs(d2));
      converged = step <= settled;
      Series next(points, f1 + d1, f2 + d2, orders);
      better = next.chi_square() < now->chi_square();
      damping *= better ? 0.1 : 10.0;
      if (!better) continue;
      f1 += d1;
      f2 += d2;
      now.emplace(std::move(next));
    }
  }
  const Normal n(*now, both);
  const double determinant = n.determinant(1.0);
  if (!(determinant > 0.0)) return undetermined(now->fit(), both, iterations);
  RefinedPair found{now->fit(), converged, 0.0, 0.0, 0.0, 0.0, iterations};
  found.sigma_f1 = both ? std::sqrt(n.a22 / determinant) : 0.0;
  found.sigma_f2 = std::sqrt(n.a11 / determinant);
  found.correlation = both ? -n.a12 / std::sqrt(n.a11 * n.a22) : 0.0;
  found.scale = scale_of(found.fit);
  return found;
}

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
      throw DomainError(who + ": frequency " + polhode::detail::number_text(f) +
                        " must be positive and finite");
  if (!(grid.step > 0.0) && grid.count > 1)
    throw DomainError(who + ": step " + polhode::detail::number_text(grid.step) +
                      " must be positive");
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
  ensemble::ordered_parallel_for(
      options.journal, scan.blocks(), options.threads,
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
      },
      [](Archive& bytes, BlockResult& r) {
        bytes.all(r.row, r.column, r.rows, r.columns, r.again, r.chi_square);
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
    throw DomainError("FrequencyGrid: from " + polhode::detail::number_text(least) + " to " +
                      polhode::detail::number_text(most) + " by " +
                      polhode::detail::number_text(step) +
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

}  // namespace fit
}  // namespace v0
}  // namespace polhode
