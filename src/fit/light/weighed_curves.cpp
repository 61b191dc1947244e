// SPDX-License-Identifier: MIT
// Points of light curves with the best factors of their sessions, robust losses included.
#include "fit/detail/weighed_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Of the factor, or of its standard error where it is less than that: rounding.
constexpr double same = 4.0 * std::numeric_limits<double>::epsilon();
constexpr int most_steps = 200;

// Of u / v with weights v: the f that minimises sum |u - f v|.
struct Middle {
  double median, low, high;
};

Middle middle_of(std::span<const FactorPoint> points) {
  struct Ratio {
    double of, weight;
  };
  std::vector<Ratio> ratios;
  ratios.reserve(points.size());
  double all = 0.0, below = 0.0;
  for (const FactorPoint& p : points) {
    if (!(p.v > 0.0)) continue;  // says nothing of f
    ratios.push_back({p.u / p.v, p.v});
    all += p.v;
  }
  std::ranges::sort(ratios, {}, &Ratio::of);
  std::size_t k = 0;
  while (k + 1 < ratios.size() && below + ratios[k].weight < 0.5 * all) below += ratios[k++].weight;
  return {ratios[k].of, ratios.front().of, ratios.back().of};
}

// Of the sum at f, over -2 and 2: how it falls, how it bends, and how the parabola of reweighted
// least squares bends, which touches it and is nowhere below.
struct Slopes {
  double fall = 0.0, bend = 0.0, above = 0.0;
};

Slopes slopes_at(const Loss& loss, std::span<const FactorPoint> points, double f) {
  Slopes s;
  const double scale2 = loss.scale * loss.scale;
  for (const FactorPoint& p : points) {
    const double r = p.u - f * p.v;
    const LossValue at = value(loss, r * r / scale2);
    s.fall += at.weight * r * p.v;
    s.bend += at.curvature * p.v * p.v;
    s.above += at.weight * p.v * p.v;
  }
  return s;
}

}  // namespace

double robust_factor(const Loss& loss, std::span<const FactorPoint> points) {
  double squares = 0.0;
  bool is_sound = true;
  for (const FactorPoint& p : points) {
    squares += p.v * p.v;
    is_sound = is_sound && std::isfinite(p.u);
  }
  if (!is_sound || !(squares > 0.0) || !std::isfinite(squares)) return nan;
  auto [f, low, high] = middle_of(points);
  const bool is_convex = loss.kind != Loss::Kind::cauchy;
  // by which a usual residual changes by the scale
  const double reach = is_convex
                           ? std::numeric_limits<double>::infinity()
                           : loss.scale / std::sqrt(squares / static_cast<double>(points.size()));
  bool has_low = false, has_high = false;  // until then the least and the greatest u / v
  double last = std::numeric_limits<double>::infinity(), before = last;
  for (int k = 0; k < most_steps; ++k) {
    const Slopes s = slopes_at(loss, points, f);
    if (s.fall == 0.0) return f;
    (s.fall > 0.0 ? low : high) = f;
    (s.fall > 0.0 ? has_low : has_high) = true;
    double step = s.fall / (s.bend > 0.0 ? s.bend : 0.5 * s.above);
    const bool is_inside = f + step > low && f + step < high;
    if (std::abs(step) <= same * std::max(std::abs(f), 1.0 / std::sqrt(squares)))
      return is_inside ? f + step : f;
    // where Newton's method leaves what is enclosed, or does not shrink in two steps
    const bool is_enclosed = has_low && has_high;
    if (!is_inside || (is_enclosed && std::abs(step) > 0.5 * before))
      step = is_enclosed ? 0.5 * (low + high) - f : s.fall / s.above;
    step = std::clamp(step, -reach, reach);
    if (f + step == f || !std::isfinite(step)) return f + step;
    before = last;
    last = std::abs(step);
    f += step;
  }
  return f;
}

WeighedCurves::WeighedCurves(std::span<const light::LightCurve> curves, const Loss& loss)
    : loss_(loss) {
  check(loss);
  std::optional<std::size_t> calibrated;
  for (const light::LightCurve& curve : curves) {
    const std::size_t group = curve.is_calibrated && calibrated ? *calibrated : of_group_.size();
    if (group == of_group_.size()) of_group_.emplace_back();
    if (curve.is_calibrated) calibrated = group;
    sessions_.push_back(curve.points.size());
    for (const light::LightPoint& p : curve.points) {
      of_group_[group].push_back(points_.size());
      times_.push_back(p.t);
      points_.push_back({p.flux, 1.0 / p.sigma, p.to_sun, p.to_observer, group});
    }
  }
}

std::vector<double> WeighedCurves::squares_factors(std::span<const double> brightness) const {
  std::vector<double> up(groups(), 0.0), down(groups(), 0.0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const WeighedPoint& p = points_[i];
    const double m = p.weight * brightness[i];
    up[p.group] += p.weight * p.flux * m;
    down[p.group] += m * m;
  }
  for (std::size_t g = 0; g < groups(); ++g) up[g] /= down[g];
  return up;
}

std::vector<double> WeighedCurves::factors(std::span<const double> brightness) const {
  if (loss_.kind == Loss::Kind::squared) return squares_factors(brightness);
  std::vector<double> found;
  std::vector<FactorPoint> scaled;
  for (const std::vector<std::size_t>& group : of_group_) {
    scaled.clear();
    for (const std::size_t i : group) {
      const WeighedPoint& p = points_[i];
      scaled.push_back({p.weight * p.flux, p.weight * brightness[i]});
    }
    found.push_back(robust_factor(loss_, scaled));
  }
  return found;
}

LossValue WeighedCurves::loss_at(double number) const {
  return value(loss_, number * number / (loss_.scale * loss_.scale));
}

double WeighedCurves::cost(std::span<const double> brightness) const {
  const std::vector<double> f = factors(brightness);
  double sum = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const WeighedPoint& p = points_[i];
    const double r = p.weight * (p.flux - f[p.group] * brightness[i]);
    sum += r * r * loss_at(r).ratio;
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

std::vector<bool> WeighedCurves::groups_held(std::span<const double> numbers,
                                             std::span<const double> brightness, Rows rows) const {
  if (rows == Rows::held || loss_.kind == Loss::Kind::squared)
    return std::vector<bool>(groups(), true);
  std::vector<double> bends(groups(), 0.0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double m = points_[i].weight * brightness[i];
    bends[points_[i].group] += loss_at(numbers[i]).curvature * m * m;
  }
  std::vector<bool> held;
  for (const double bend : bends) held.push_back(!(bend > 0.0));
  return held;
}

bool WeighedCurves::residuals(std::span<const double> brightness, std::size_t n,
                              std::span<double> numbers, std::span<double> jacobian,
                              Rows rows) const {
  const std::size_t count = points_.size();
  const std::vector<double> f = factors(brightness);
  bool is_sound = true;
  for (std::size_t i = 0; i < count; ++i) {
    const WeighedPoint& p = points_[i];
    numbers[i] = p.weight * (p.flux - f[p.group] * brightness[i]);
    is_sound = is_sound && std::isfinite(numbers[i]);
  }
  if (jacobian.empty() || !is_sound) return is_sound;
  // df = sum(w^2 (W F - (W + c) f B) dB) / sum(c w^2 B^2), W the weight that the loss leaves, c W
  // where it is held and the curvature of the loss where it follows, whose sum must be positive, as
  // it is at a least unless the bottom is flat; for squares both are 1
  std::vector<double> by(groups() * n, 0.0), squares(groups(), 0.0);
  const std::vector<bool> is_held = groups_held(numbers, brightness, rows);
  for (std::size_t i = 0; i < count; ++i) {
    const WeighedPoint& p = points_[i];
    const LossValue loss = loss_at(numbers[i]);
    const double c = is_held[p.group] ? loss.weight : loss.curvature;
    const double w2 = p.weight * p.weight;
    squares[p.group] += c * w2 * brightness[i] * brightness[i];
    double k = loss.weight * w2 * (p.flux - 2.0 * f[p.group] * brightness[i]);
    if (c != loss.weight) k += (loss.weight - c) * w2 * f[p.group] * brightness[i];
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
}  // namespace fit
}  // namespace v0
}  // namespace polhode
