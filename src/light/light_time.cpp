// SPDX-License-Identifier: MIT
#include "polhode/light/light_time.hpp"

#include <string>

#include "light/curve_place.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void fail_light_time(const LightCurve& curve, std::size_t point, const char* what) {
  throw DomainError(in_words(curve, point) + ": " + what);
}

void require_speed_of_light(double c) {
  if (!(c > 0.0) || !std::isfinite(c))
    throw DomainError("light time: speed of light " + number_text(c) + "; expected one above 0");
}

}  // namespace detail

LightCurve at_body(LightCurve curve, double c) {
  detail::require_speed_of_light(c);
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    LightPoint& p = curve.points[k];
    const double distance = norm(p.to_observer);
    if (!(distance > 0.0))
      detail::fail_light_time(curve, k,
                              "there is no vector to the observer; expected one, or a "
                              "light time");
    p.t -= distance / c;
  }
  return curve;
}

LightCurve at_body_after(LightCurve curve, double light_time) {
  if (!(light_time >= 0.0) || !std::isfinite(light_time))
    throw DomainError("at_body_after: light time " + detail::number_text(light_time) +
                      "; expected a finite time, 0 or more");
  for (LightPoint& p : curve.points) p.t -= light_time;
  return curve;
}

}  // namespace v0
}  // namespace polhode
