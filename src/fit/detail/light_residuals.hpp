// SPDX-License-Identifier: MIT
// Residuals of light curves: what unknowns there are, and the numbers at them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fit/detail/weighed_curves.hpp"
#include "fit/free_motion.hpp"
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

std::vector<Unknown> light_unknowns(const LightUnknowns& unknowns, const EllipsoidModel& start);

class LightResiduals {
 public:
  LightResiduals(std::span<const LightCurve> curves, const LightUnknowns& unknowns,
                 const EllipsoidModel& start, const Loss& loss = {}, Rows rows = Rows::exact);

  std::size_t points() const { return curves_.size(); }
  std::size_t groups() const { return curves_.groups(); }
  const WeighedCurves& curves() const { return curves_; }
  const LightPlaces& places() const { return places_; }
  EllipsoidModel body_at(std::span<const double> x) const;

  // (flux - f B) / sigma at x about the start, and their derivatives row by row where `jacobian` is
  // not empty.
  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const;
  // B of the body at each point for attitudes q of `motion`, which has one at each.
  bool brightness_of(const EllipsoidModel& body, std::span<const MotionPoint> motion,
                     std::span<double> found) const;

 private:
  void row_at(const EllipsoidModel& body, const Mat3& turn, const MotionPoint& motion,
              const WeighedPoint& p, double& value, double* row) const;

  LightUnknowns unknowns_;
  EllipsoidModel start_;
  LightPlaces places_;
  WeighedCurves curves_;
  Rows rows_;
};

// A problem of least squares about a start, under the loss of the residuals.
LeastSquares light_problem(const LightResiduals& residuals, const LightUnknowns& unknowns,
                           const EllipsoidModel& start, int most_iterations);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
