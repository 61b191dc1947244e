// SPDX-License-Identifier: MIT
#include "polhode/light/magnitudes.hpp"

#include <string>

#include "light/curve_place.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

double required_mean(const LightCurve& curve, const char* function) {
  const double mean = mean_flux(curve);
  if (!(mean > 0.0) || !std::isfinite(mean))
    throw DomainError(std::string(function) + ": " + detail::in_words(curve) +
                      ": its mean flux is " + detail::number_text(mean) + "; expected one above 0");
  return mean;
}

}  // namespace

double mean_flux(const LightCurve& curve) {
  double sum = 0.0;
  for (const LightPoint& p : curve.points) sum += p.flux;
  return sum / static_cast<double>(curve.points.size());  // 0 / 0 of none
}

LightCurve normalised(LightCurve curve) {
  const double mean = required_mean(curve, "normalised");
  for (LightPoint& p : curve.points) {
    p.flux /= mean;
    p.sigma /= mean;
  }
  return curve;
}

LightCurve with_relative_sigma(LightCurve curve, double fraction) {
  if (!(fraction > 0.0) || !std::isfinite(fraction))
    throw DomainError("with_relative_sigma: fraction " + detail::number_text(fraction) +
                      "; expected one above 0");
  const double sigma = fraction * required_mean(curve, "with_relative_sigma");
  for (LightPoint& p : curve.points) p.sigma = sigma;
  return curve;
}

}  // namespace v0
}  // namespace polhode
