// SPDX-License-Identifier: MIT
#include "fit/detail/robust_factor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace polhode {
inline namespace v0 {
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
