// SPDX-License-Identifier: MIT
// Residuals of light curves: what unknowns there are, and the numbers at them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "fit/detail/spin_motion.hpp"
#include "polhode/fit/light_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline constexpr double least_axis_ratio = 0.05;

// Places of unknowns; those that there are not have none.
struct LightPlaces {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t shape = none, moments = none, multiple = none, count = 6;

  explicit LightPlaces(const LightUnknowns& unknowns);
};

std::vector<Unknown> light_unknowns(const LightUnknowns& unknowns, const BrightEllipsoid& start);

// One point as a fit takes it; its session's factor is that of `group`.
struct WeighedPoint {
  double flux, weight;  // 1 / sigma
  Vec3 to_sun, to_observer;
  std::size_t group;
};

class LightResiduals {
 public:
  LightResiduals(std::span<const LightCurve> curves, const LightUnknowns& unknowns,
                 const BrightEllipsoid& start);

  std::size_t points() const { return points_.size(); }
  std::size_t groups() const { return groups_; }
  const LightPlaces& places() const { return places_; }
  BrightEllipsoid body_at(std::span<const double> x) const;

  // (flux - f B) / sigma at x about the start, and their derivatives row by row where `jacobian` is
  // not empty.
  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const;
  // B of the body at each point for attitudes q of `motion`, which has one at each.
  bool brightness_of(const BrightEllipsoid& body, std::span<const MotionPoint> motion,
                     std::span<double> found) const;
  // Best factors of the groups, and chi-square with them.
  std::vector<double> factors(std::span<const double> brightness) const;
  double chi_square(std::span<const double> brightness) const;

  std::span<const WeighedPoint> weighed() const { return points_; }
  const std::vector<double>& times() const { return times_; }

 private:
  void row_at(const BrightEllipsoid& body, const Mat3& turn, const MotionPoint& motion,
              const WeighedPoint& p, double& value, double* row) const;

  LightUnknowns unknowns_;
  BrightEllipsoid start_;
  LightPlaces places_;
  std::vector<double> times_;
  std::vector<WeighedPoint> points_;
  std::size_t groups_ = 0;
};

// A problem of least squares about a start.
LeastSquares light_problem(const LightResiduals& residuals, const LightUnknowns& unknowns,
                           const BrightEllipsoid& start, const Loss& loss, int most_iterations);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
