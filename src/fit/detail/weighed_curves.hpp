// SPDX-License-Identifier: MIT
// Points of light curves as fits take them, and the factors of their sessions, which follow from
// the model at every trial: those that minimise the sum under the loss.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polhode/fit/least_squares.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// The residual is u - f v; v is not below 0.
struct FactorPoint {
  double u, v;
};

// The factor of a session under a robust loss.
//
// Equations   f of the least sum scale^2 rho((u - f v)^2 / scale^2)
//             (polhode/fit/least_squares.hpp), u and v
//             flux and brightness over the error of the flux. The start is the weighted median of
//             u / v, which minimises sum |u - f v|; from there Newton's method, kept within what
//             signs of the slope enclose; where the sum bends downwards, twice a step of reweighted
//             least squares, whose sum falls (Hunter & Lange 2004).
// Domain      huber and soft_l1 are convex: the least is one, but for a flat bottom, of which one
//             point is taken. Under cauchy there may be several minima: the one
//             is taken that descent from the median meets, in steps that change no residual of
//             usual size by more than the scale. It is a function of the points alone, with jumps
//             where two minima change places.
// Accuracy    budget robust_factor in tests/budgets/fit.hpp.
// Errors      NaN where no v has a weight, or a number is none.
// Cost        a sort of the points, and some ten passes through them.
double robust_factor(const Loss& loss, std::span<const FactorPoint> points);

// One point; its session's factor is that of `group`.
struct WeighedPoint {
  double flux, weight;  // 1 / sigma
  Vec3 to_sun, to_observer;
  std::size_t group;
};

// How derivatives treat the factors under a robust loss. exact: as they follow. held: as in
// reweighted least squares, with the weights held. Both give the gradient of the sum, since at its
// least the sum does not change with the factor. Rows that are held leave, under the weights, the
// covariance that factors as unknowns would. For squares both are the same.
enum class Rows { exact, held };

class WeighedCurves {
 public:
  explicit WeighedCurves(std::span<const light::LightCurve> curves, const Loss& loss = {});

  std::size_t size() const { return points_.size(); }
  std::size_t groups() const { return of_group_.size(); }
  const WeighedPoint& operator[](std::size_t i) const { return points_[i]; }
  const std::vector<double>& times() const { return times_; }
  const Loss& loss() const { return loss_; }

  // Best factors of the groups for a brightness at each point (robust_factor() where the loss is
  // not squared), and the least sum, of the numbers under the loss.
  std::vector<double> factors(std::span<const double> brightness) const;
  double cost(std::span<const double> brightness) const;
  // The best factor of each session.
  std::vector<double> session_factors(std::span<const double> brightness) const;
  // Fluxes with them, session by session.
  std::vector<std::vector<double>> fluxes(std::span<const double> brightness) const;

  // (flux - f B) / sigma of each point; and where `jacobian` is not empty, n derivatives of B a row
  // become those of the numbers, factors included. False where a number has no value.
  bool residuals(std::span<const double> brightness, std::size_t n, std::span<double> numbers,
                 std::span<double> jacobian, Rows rows) const;

 private:
  LossValue loss_at(double number) const;
  std::vector<bool> groups_held(std::span<const double> numbers, std::span<const double> brightness,
                                Rows rows) const;
  std::vector<double> squares_factors(std::span<const double> brightness) const;

  Loss loss_;
  std::vector<double> times_;
  std::vector<WeighedPoint> points_;
  std::vector<std::size_t> sessions_;               // points of each
  std::vector<std::vector<std::size_t>> of_group_;  // its points
};

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
