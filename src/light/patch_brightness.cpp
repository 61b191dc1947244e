// SPDX-License-Identifier: MIT
#include "polhode/light/patch_brightness.hpp"

#include <string>

#include "light/direction.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using SoftCosine = BasicSoftCosine<double>;

// Most facets that are lit are so beyond their width.
SoftCosine soft(double mu, double h) {
  return mu < h ? SoftCosine::at(mu, h) : SoftCosine{mu, mu, 1.0, 1.0};
}

}  // namespace

void require_widths(std::span<const Vec3> normals, std::size_t widths) {
  if (normals.size() == widths) return;
  throw DomainError("patch_brightness: " + std::to_string(widths) + " widths for " +
                    std::to_string(normals.size()) + " normals; expected one for each");
}

FacetGradient patch_gradient(std::span<const Vec3> normals, std::span<const double> widths,
                             std::span<const double> areas, const Scattering& law,
                             const Vec3& to_sun, const Vec3& to_observer) {
  require_areas(normals, areas.size());
  require_widths(normals, widths.size());
  const Direction sun(to_sun), observer(to_observer);
  FacetGradient out;
  out.by_areas.assign(areas.size(), 0.0);
  Vec3 by_s, by_o;
  for (std::size_t j = 0; j < normals.size(); ++j) {
    const double h = widths[j];
    const double mu = dot(normals[j], observer.unit), mu0 = dot(normals[j], sun.unit);
    if (mu <= -h || mu0 <= -h) continue;                 // with all derivatives
    const SoftCosine a = soft(mu, h), b = soft(mu0, h);  // M > 0 each
    const double inverse = 1.0 / (a.positive + b.positive);
    const double second = a.even * b.even, first = second * inverse;
    const double S = law.single * first + law.multiple * second;
    out.by_areas[j] = S;
    out.value += areas[j] * S;
    out.by_single += areas[j] * first;
    out.by_multiple += areas[j] * second;
    const double both = law.single * inverse + law.multiple;
    const double by_sum = law.single * first * inverse;
    by_o =
        by_o + (areas[j] * (both * b.even * a.even_slope - by_sum * a.positive_slope)) * normals[j];
    by_s =
        by_s + (areas[j] * (both * a.even * b.even_slope - by_sum * b.positive_slope)) * normals[j];
  }
  out.by_sun = sun.by_vector(by_s);
  out.by_observer = observer.by_vector(by_o);
  return out;
}

}  // namespace v0
}  // namespace polhode
