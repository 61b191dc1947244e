// SPDX-License-Identifier: MIT
#include "fit/detail/weighed_curves.hpp"

#include <cmath>
#include <optional>

namespace polhode {
inline namespace v0 {
namespace detail {

WeighedCurves::WeighedCurves(std::span<const LightCurve> curves) {
  std::optional<std::size_t> calibrated;
  for (const LightCurve& curve : curves) {
    const std::size_t group = curve.is_calibrated && calibrated ? *calibrated : groups_++;
    if (curve.is_calibrated) calibrated = group;
    sessions_.push_back(curve.points.size());
    for (const LightPoint& p : curve.points) {
      times_.push_back(p.t);
      points_.push_back({p.flux, 1.0 / p.sigma, p.to_sun, p.to_observer, group});
    }
  }
}

std::vector<double> WeighedCurves::factors(std::span<const double> brightness) const {
  std::vector<double> up(groups_, 0.0), down(groups_, 0.0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const WeighedPoint& p = points_[i];
    const double m = p.weight * brightness[i];
    up[p.group] += p.weight * p.flux * m;
    down[p.group] += m * m;
  }
  for (std::size_t g = 0; g < groups_; ++g) up[g] /= down[g];
  return up;
}

double WeighedCurves::chi_square(std::span<const double> brightness) const {
  const std::vector<double> f = factors(brightness);
  double sum = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const WeighedPoint& p = points_[i];
    const double r = p.weight * (p.flux - f[p.group] * brightness[i]);
    sum += r * r;
  }
  return sum;
}

std::vector<double> WeighedCurves::session_factors(std::span<const double> brightness) const {
  const std::vector<double> f = factors(brightness);
  std::vector<double> found;
  std::size_t first = 0;
  for (const std::size_t count : sessions_) {
    found.push_back(f[points_[first].group]);
    first += count;
  }
  return found;
}

std::vector<std::vector<double>> WeighedCurves::fluxes(std::span<const double> brightness) const {
  const std::vector<double> f = factors(brightness);
  std::vector<std::vector<double>> found;
  std::size_t i = 0;
  for (const std::size_t count : sessions_) {
    found.emplace_back();
    for (std::size_t k = 0; k < count; ++k, ++i)
      found.back().push_back(f[points_[i].group] * brightness[i]);
  }
  return found;
}

bool WeighedCurves::residuals(std::span<const double> brightness, std::size_t n,
                              std::span<double> numbers, std::span<double> jacobian) const {
  const std::size_t count = points_.size();
  const std::vector<double> f = factors(brightness);
  bool is_sound = true;
  for (std::size_t i = 0; i < count; ++i) {
    const WeighedPoint& p = points_[i];
    numbers[i] = p.weight * (p.flux - f[p.group] * brightness[i]);
    is_sound = is_sound && std::isfinite(numbers[i]);
  }
  if (jacobian.empty() || !is_sound) return is_sound;
  // df = sum(w^2 (F - 2 f B) dB) / sum(w^2 B^2)
  std::vector<double> by(groups_ * n, 0.0), squares(groups_, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const WeighedPoint& p = points_[i];
    const double w2 = p.weight * p.weight;
    squares[p.group] += w2 * brightness[i] * brightness[i];
    const double k = w2 * (p.flux - 2.0 * f[p.group] * brightness[i]);
    for (std::size_t j = 0; j < n; ++j) by[p.group * n + j] += k * jacobian[i * n + j];
  }
  for (std::size_t i = 0; i < count; ++i) {
    const WeighedPoint& p = points_[i];
    const double k = brightness[i] / squares[p.group];
    for (std::size_t j = 0; j < n; ++j) {
      double& entry = jacobian[i * n + j];
      entry = -p.weight * (f[p.group] * entry + k * by[p.group * n + j]);
    }
  }
  return true;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
