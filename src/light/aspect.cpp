// SPDX-License-Identifier: MIT
#include "polhode/light/aspect.hpp"

#include <string>

#include "light/curve_place.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

LightCurve at_unit_distances(LightCurve curve, double unit) {
  if (!(unit > 0.0) || !std::isfinite(unit))
    throw DomainError("at_unit_distances: unit " + detail::number_text(unit) +
                      "; expected a length above 0");
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    LightPoint& p = curve.points[k];
    const double distances = (norm(p.to_sun) / unit) * (norm(p.to_observer) / unit);
    if (!(distances > 0.0))
      throw DomainError("at_unit_distances: " + detail::in_words(curve, k) +
                        " has no distances; expected vectors to the Sun and to the observer");
    const double factor = distances * distances;
    p.flux *= factor;
    p.sigma *= factor;
  }
  return curve;
}

}  // namespace v0
}  // namespace polhode
