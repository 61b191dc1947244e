// SPDX-License-Identifier: MIT
#include "fit/detail/light_search_fits.hpp"

#include <algorithm>
#include <cmath>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Points that tell a start from another, and the fewest of a session.
constexpr std::size_t enough_points = 110, enough_of_session = 12;
// Fits of few points may take more iterations, and those of all go on where they creep.
constexpr int coarse_rounds = 3, fine_rounds = 3;

// One point of every few, the place among them by the golden section, so that points at equal
// distances are not left at equal distances.
LightCurve thinned(const LightCurve& curve, std::size_t stride) {
  const std::size_t step =
      std::max<std::size_t>(1, std::min(stride, curve.points.size() / enough_of_session));
  LightCurve left{curve.name, curve.is_calibrated, {}};
  for (std::size_t first = 0, k = 0; first < curve.points.size(); first += step, ++k) {
    const double part = 0.6180339887498949 * static_cast<double>(k);
    const auto place =
        static_cast<std::size_t>((part - std::floor(part)) * static_cast<double>(step));
    left.points.push_back(curve.points[std::min(first + place, curve.points.size() - 1)]);
  }
  return left;
}

std::vector<LightCurve> thinned(const std::vector<LightCurve>& curves) {
  std::size_t points = 0;
  for (const LightCurve& curve : curves) points += curve.points.size();
  std::vector<LightCurve> left;
  for (const LightCurve& curve : curves) left.push_back(thinned(curve, points / enough_points));
  return left;
}

std::vector<LightUnknowns> models_to(const LightUnknowns& unknowns) {
  std::vector<LightUnknowns> models;
  LightUnknowns strict = unknowns;
  if (unknowns.moments == MomentSource::fit) strict.moments = MomentSource::shape;
  if (unknowns.multiple) {
    strict.multiple = false;
    models.push_back(strict);
    strict.multiple = true;
  }
  if (unknowns.moments == MomentSource::fit) models.push_back(strict);
  models.push_back(unknowns);
  return models;
}

}  // namespace

LightSearchFits::LightSearchFits(const LightSearch& search)
    : search_(search), coarse_(search), models_(models_to(search.unknowns)) {
  coarse_.curves = thinned(search.curves);
  coarse_.unknowns = models_.front();
}

std::optional<LightTrial> LightSearchFits::trial(std::size_t number) const {
  return light_trial(coarse_, epoch_of(search_.curves), number);
}

LightSolution LightSearchFits::to_end(const LightFinalist& finalist) const {
  BrightEllipsoid body = finalist.start;
  const auto fitted = [&](const std::vector<LightCurve>& curves, const LightUnknowns& model,
                          int rounds) {
    LightSolution s;
    for (int k = 0; k < rounds; ++k) {
      s = fit_light({curves, body, model, search_.loss, search_.most_iterations});
      if (s.result.end == LeastSquaresResult::End::no_value) break;
      body = s.body;
      if (s.is_found()) break;
    }
    return s;
  };
  // A start with moments of its own is not one of the stricter model.
  const bool is_strict = models_.size() == 1 || finalist.is_strict;
  const std::size_t first = is_strict ? 0 : models_.size() - 1;
  if (is_strict) fitted(coarse_.curves, models_.front(), coarse_rounds);
  LightSolution found;
  for (std::size_t m = first; m < models_.size(); ++m)
    found = fitted(search_.curves, models_[m], fine_rounds);
  return found;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
