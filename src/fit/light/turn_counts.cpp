// SPDX-License-Identifier: MIT
#include "fit/light/turn_counts.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/detail/light_residuals.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/spin_figures.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double errors = 3.0;  // up to which counts of turns are looked for
// Of a step, what their standard errors are widened by: neighbours of a point are always among
// them.
constexpr double widened = 0.35;
// Steps of the lattice, in turns until the session: a fit comes to the count that is nearest.
constexpr double precession_turns = 0.5, rotation_turns = 0.25;
// Of a step, how near the frequencies of a start come; and in how many steps of Newton's.
constexpr double near = 0.02;
constexpr int most_newton_steps = 12;

struct Frequencies {
  Regime mode;
  Eigen::Vector2d F;
  Eigen::MatrixXd J;  // by the unknowns
};

// None of a motion that has not two periods.
std::optional<Frequencies> frequencies_of(const LightSolution& s, const LightUnknowns& unknowns) {
  const SpinFigures f = spin_figures(s, unknowns);
  if (!(f.periods.precession_period > 0.0) || !(f.periods.rotation_period > 0.0))
    return std::nullopt;
  Frequencies found{f.periods.mode, {}, Eigen::MatrixXd(2, std::ssize(f.precession_slope))};
  const auto add = [&](Eigen::Index row, double period, const std::vector<double>& slope) {
    found.F[row] = 1.0 / period;
    for (std::size_t i = 0; i < slope.size(); ++i)
      found.J(row, static_cast<Eigen::Index>(i)) = -slope[i] / (period * period);
  };
  add(0, f.periods.precession_period, f.precession_slope);
  add(1, f.periods.rotation_period, f.rotation_slope);
  if (!found.F.allFinite() || !found.J.allFinite()) return std::nullopt;
  return found;
}

void hold(Eigen::MatrixXd& C, Eigen::Index i) {
  C.row(i).setZero();
  C.col(i).setZero();
}

class Counts {
 public:
  Counts(const LightSolution& solution, const LightUnknowns& unknowns, double distance)
      : solution_(solution),
        unknowns_(unknowns),
        here_(frequencies_of(solution, unknowns)),
        step_{precession_turns / distance, rotation_turns / distance} {
    const auto n = std::ssize(solution.covariance.names);
    const double scale = solution.error_factor(), factor = scale > 1.0 ? scale : 1.0;
    C_ = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
             solution.covariance.matrix.data(), n, n) *
         (factor * factor);
    if (!here_) return;
    // an unknown that may be anything, and changes no period
    for (Eigen::Index i = 0; i < n; ++i)
      if (!std::isfinite(C_(i, i)) && here_->J.col(i).isZero(0.0)) hold(C_, i);
    V_ = here_->J * C_ * here_->J.transpose();
    if (!V_.allFinite()) here_.reset();
    V_.diagonal() += (widened * step_).cwiseAbs2();
  }

  TurnCounts found(std::size_t most) const {
    if (!here_) return {1, 0, false, {solution_.body}};
    const std::vector<Eigen::Vector2d> all = lattice(most);
    TurnCounts counts{all.size(), 0, true, {}};
    if (all.size() > most) return counts;
    for (const Eigen::Vector2d& d : all)
      if (const auto body = body_with(here_->F + d)) counts.bodies.push_back(*body);
    counts.without_body = all.size() - counts.bodies.size();
    return counts;
  }

 private:
  // Those inside of the ellipse; where they are more than `most`, some of them.
  std::vector<Eigen::Vector2d> lattice(std::size_t most) const {
    const Eigen::Matrix2d A = V_.inverse();
    const double width = std::floor(errors * std::sqrt(V_(0, 0)) / step_[0]);
    // a row has a point or more
    if (!(width <= static_cast<double>(most)))
      return std::vector<Eigen::Vector2d>(most + 1, Eigen::Vector2d::Zero());
    std::vector<Eigen::Vector2d> all;
    for (double i = -width; i <= width; i += 1.0) {
      // what A leaves of the second frequency, given the first
      const double d = i * step_[0], middle = -A(0, 1) * d / A(1, 1);
      const double square = middle * middle - (A(0, 0) * d * d - errors * errors) / A(1, 1);
      if (!(square >= 0.0)) continue;
      const double half = std::sqrt(square), last = std::floor((middle + half) / step_[1]);
      for (double j = std::ceil((middle - half) / step_[1]); j <= last; j += 1.0) {
        all.push_back({d, j * step_[1]});
        if (all.size() > most) return all;
      }
    }
    return all;
  }

  // The likeliest body of these frequencies; none where there is none in this mode.
  std::optional<BrightEllipsoid> body_with(const Eigen::Vector2d& wanted) const {
    const LightFit about{{}, solution_.body, unknowns_, {}};
    LightSolution there = solution_;
    std::vector<double> x = light_unknowns_at(unknowns_, solution_.body, solution_.body);
    Eigen::MatrixXd C = C_;  // less what comes to a bound
    for (int k = 0; k < most_newton_steps; ++k) {
      try {
        there.body = body_at(about, x);
        const std::optional<Frequencies> f = frequencies_of(there, unknowns_);
        if (!f || f->mode != here_->mode) return std::nullopt;
        const Eigen::Vector2d miss = wanted - f->F;
        if ((miss.array().abs() <= near * step_.array()).all()) return there.body;
        const Eigen::MatrixXd CJ = C * f->J.transpose();
        const Eigen::Matrix2d V = f->J * CJ;
        const Eigen::VectorXd step = CJ * V.ldlt().solve(miss);
        if (!step.allFinite()) return std::nullopt;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += step[static_cast<Eigen::Index>(i)];
      } catch (const DomainError&) {  // no body has these unknowns
        return std::nullopt;
      }
      const std::vector<double> free = x;
      keep_sound(x);
      for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] != free[i]) hold(C, static_cast<Eigen::Index>(i));
    }
    return std::nullopt;
  }

  // Inside of the bounds of a fit.
  void keep_sound(std::vector<double>& x) const {
    const LightPlaces places(unknowns_);
    const double most = unknowns_.moments == MomentSource::shape ? 1.0 : 1.0 / least_axis_ratio;
    if (unknowns_.shape)
      for (const std::size_t i : {places.shape, places.shape + 1})
        x[i] = std::clamp(x[i], least_axis_ratio, most);
    if (unknowns_.multiple) x[places.multiple] = std::max(x[places.multiple], 0.0);
  }

  const LightSolution& solution_;
  const LightUnknowns& unknowns_;
  std::optional<Frequencies> here_;
  Eigen::Vector2d step_;
  Eigen::MatrixXd C_;
  Eigen::Matrix2d V_;
};

}  // namespace

TurnCounts turn_counts(const LightSolution& solution, const LightUnknowns& unknowns,
                       double distance, std::size_t most) {
  return Counts(solution, unknowns, distance).found(most);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
