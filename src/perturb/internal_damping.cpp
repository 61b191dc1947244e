// SPDX-License-Identifier: MIT
#include "polhode/perturb/internal_damping.hpp"

#include <algorithm>
#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::number_text;

void require_positive(const char* what, double x) {
  if (!(x > 0.0) || !std::isfinite(x))
    throw DomainError(std::string("InternalDamping: ") + what + " " + number_text(x) +
                      " must be positive and finite");
}

// (1/2)(1/A + 1/B) - 1/C, C the largest moment: a small wobble falls as exp(-k G^2 t) to this
// power.
double wobble_factor(const Body& body) {
  const Vec3& I = body.moments();
  double m[] = {I.x, I.y, I.z};
  std::sort(m, m + 3);
  const double factor = 0.5 * ((m[2] - m[0]) / (m[0] * m[2]) + (m[2] - m[1]) / (m[1] * m[2]));
  if (!(factor > 0.0))
    throw DomainError("InternalDamping: moments " + detail::tuple_text({I.x, I.y, I.z}) +
                      " of a sphere have no wobble to damp: give a coefficient");
  return factor;
}

}  // namespace

InternalDamping::InternalDamping(const Vec3& k_B, bool grows) : law_{k_B, grows} {
  for (const double x : {k_B.x, k_B.y, k_B.z})
    if (!(x >= 0.0) || !std::isfinite(x))
      throw DomainError("InternalDamping: coefficients " +
                        detail::tuple_text({k_B.x, k_B.y, k_B.z}) + " must be >= 0 and finite");
}

InternalDamping::InternalDamping(double k) : InternalDamping(Vec3{k, k, k}) {}

InternalDamping InternalDamping::of_wobble(const Body& body, double time, double momentum) {
  require_positive("time", time);
  require_positive("momentum", momentum);
  const double k = 1.0 / (time * momentum * momentum * wobble_factor(body));
  return InternalDamping(k);
}

InternalDamping InternalDamping::of_material(const Body& body, const DampedMaterial& material) {
  const double C = std::max({body.moments().x, body.moments().y, body.moments().z});
  // at |g| = C, where w = 1: k |g|^3 is the rate of the wobble, as w^3 is
  const double k = 1.0 / (wobble_time(material, 1.0) * (C * C * C) * wobble_factor(body));
  return InternalDamping(Vec3{k, k, k}, true);
}

double wobble_time(const DampedMaterial& m, double rate) {
  require_positive("rigidity", m.rigidity);
  require_positive("quality factor", m.quality_factor);
  require_positive("density", m.density);
  require_positive("radius", m.radius);
  require_positive("shape factor", m.shape_factor);
  require_positive("rate", rate);
  return m.rigidity * m.quality_factor /
         (m.density * m.shape_factor * (m.radius * m.radius) * (rate * rate * rate));
}

}  // namespace v0
}  // namespace polhode
