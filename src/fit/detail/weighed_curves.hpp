// SPDX-License-Identifier: MIT
// Points of light curves as fits take them, and the factors of their sessions, which follow from
// the model at every trial.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// One point; its session's factor is that of `group`.
struct WeighedPoint {
  double flux, weight;  // 1 / sigma
  Vec3 to_sun, to_observer;
  std::size_t group;
};

class WeighedCurves {
 public:
  explicit WeighedCurves(std::span<const LightCurve> curves);

  std::size_t size() const { return points_.size(); }
  std::size_t groups() const { return groups_; }
  const WeighedPoint& operator[](std::size_t i) const { return points_[i]; }
  const std::vector<double>& times() const { return times_; }

  // Best factors of the groups for a brightness at each point, and chi-square with them.
  std::vector<double> factors(std::span<const double> brightness) const;
  double chi_square(std::span<const double> brightness) const;
  // The best factor of each session.
  std::vector<double> session_factors(std::span<const double> brightness) const;
  // Fluxes with them, session by session.
  std::vector<std::vector<double>> fluxes(std::span<const double> brightness) const;

  // (flux - f B) / sigma of each point; and where `jacobian` is not empty, n derivatives of B a row
  // become those of the numbers, factors included. False where a number has no value.
  bool residuals(std::span<const double> brightness, std::size_t n, std::span<double> numbers,
                 std::span<double> jacobian) const;

 private:
  std::vector<double> times_;
  std::vector<WeighedPoint> points_;
  std::vector<std::size_t> sessions_;  // points of each
  std::size_t groups_ = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
