// SPDX-License-Identifier: MIT
#include "polhode/fit/fourier_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/detail/fourier_checks.hpp"
#include "fit/detail/scan_task.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
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
      throw DomainError(std::string(who) + ": frequency " + detail::number_text(f) +
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
    throw DomainError("refined_pair: reach " + detail::number_text(reach) + " must be positive");
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

}  // namespace v0
}  // namespace polhode
