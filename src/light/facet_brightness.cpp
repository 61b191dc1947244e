// SPDX-License-Identifier: MIT
#include "polhode/light/facet_brightness.hpp"

#include <string>

#include "light/direction.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

void require_areas(std::span<const Vec3> normals, std::size_t areas) {
  if (normals.size() == areas) return;
  throw DomainError("facet_brightness: " + std::to_string(areas) + " areas for " +
                    std::to_string(normals.size()) + " normals; expected one for each");
}

FacetGradient facet_gradient(std::span<const Vec3> normals, std::span<const double> areas,
                             const Scattering& law, const Vec3& to_sun, const Vec3& to_observer) {
  require_areas(normals, areas.size());
  const Direction sun(to_sun), observer(to_observer);
  FacetGradient out;
  out.by_areas.assign(areas.size(), 0.0);
  Vec3 by_s, by_o;
  for (std::size_t j = 0; j < normals.size(); ++j) {
    const double mu = dot(normals[j], observer.unit), mu0 = dot(normals[j], sun.unit);
    if (mu <= 0.0 || mu0 <= 0.0) continue;
    const double part = mu / (mu + mu0), part0 = mu0 / (mu + mu0);
    const double first = mu * part0, second = mu * mu0;
    const double S = law.single * first + law.multiple * second;
    out.by_areas[j] = S;
    out.value += areas[j] * S;
    out.by_single += areas[j] * first;
    out.by_multiple += areas[j] * second;
    // d(mu mu0 / (mu + mu0)) = part0^2 dmu + part^2 dmu0
    by_o = by_o + (areas[j] * (law.single * part0 * part0 + law.multiple * mu0)) * normals[j];
    by_s = by_s + (areas[j] * (law.single * part * part + law.multiple * mu)) * normals[j];
  }
  out.by_sun = sun.by_vector(by_s);
  out.by_observer = observer.by_vector(by_o);
  return out;
}

}  // namespace v0
}  // namespace polhode
