// SPDX-License-Identifier: MIT
#include "polhode/shape/surface.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

void require_fraction(const std::string& facet, const char* what, double x) {
  if (!(x >= 0.0 && x <= 1.0))
    throw DomainError(facet + ": " + what + " " + detail::number_text(x) + " must be from 0 to 1");
}

SurfaceFacet checked(const SurfaceFacet& f, std::size_t number) {
  const std::string name = "Surface: facet " + std::to_string(number);
  const double length = norm(f.normal);
  if (!detail::is_finite(f.centre))
    throw DomainError(name + ": centre " +
                      detail::tuple_text({f.centre.x, f.centre.y, f.centre.z}) + " must be finite");
  if (!(length > 0.0) || !std::isfinite(length))
    throw DomainError(name + ": normal " +
                      detail::tuple_text({f.normal.x, f.normal.y, f.normal.z}) +
                      " must have a direction");
  if (!(f.area > 0.0) || !std::isfinite(f.area))
    throw DomainError(name + ": area " + detail::number_text(f.area) +
                      " must be positive and finite");
  const Finish& finish = f.finish;
  require_fraction(name, "specular", finish.specular);
  require_fraction(name, "diffuse", finish.diffuse);
  require_fraction(name, "specular + diffuse", finish.specular + finish.diffuse);
  require_fraction(name, "emitted", finish.emitted);
  require_fraction(name, "normal_accommodation", finish.normal_accommodation);
  require_fraction(name, "tangential_accommodation", finish.tangential_accommodation);
  SurfaceFacet out = f;
  // one that is of length 1 to rounding stays: a surface made of a surface's own rows is the same
  if (std::fabs(length - 1.0) > 4.0 * 0x1p-52) out.normal = (1.0 / length) * f.normal;
  return out;
}

}  // namespace

Surface::Surface(std::vector<SurfaceFacet> facets) : facets_(std::move(facets)) {
  if (facets_.empty()) throw DomainError("Surface: got no facets; expected at least one");
  for (std::size_t i = 0; i < facets_.size(); ++i) facets_[i] = checked(facets_[i], i + 1);
}

Surface Surface::of_shape(const shape::FacetShape& shape, const Vec3& centre,
                          const Finish& finish) {
  std::vector<SurfaceFacet> facets;
  facets.reserve(shape.facets().size());
  for (const shape::Facet& f : shape.facets())
    facets.push_back({f.centre - centre, f.normal, f.area, finish});
  return Surface(std::move(facets));
}

Surface Surface::of_plate(const Vec3& centre, const Vec3& normal, double area, const Finish& finish,
                          bool both_sides) {
  std::vector<SurfaceFacet> facets{{centre, normal, area, finish}};
  if (both_sides) facets.push_back({centre, -normal, area, finish});
  return Surface(std::move(facets));
}

Surface Surface::along(const Quaternion& q_FB) const {
  std::vector<SurfaceFacet> facets = facets_;
  const Quaternion q_BF = conj(q_FB);
  for (SurfaceFacet& f : facets) {
    f.centre = rotate(q_BF, f.centre);
    f.normal = rotate(q_BF, f.normal);
  }
  return Surface(std::move(facets));
}

Surface joined(std::span<const Surface> parts) {
  std::vector<SurfaceFacet> facets;
  for (const Surface& part : parts)
    facets.insert(facets.end(), part.facets().begin(), part.facets().end());
  return Surface(std::move(facets));
}

}  // namespace v0
}  // namespace polhode
