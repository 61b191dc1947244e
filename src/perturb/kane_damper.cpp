// SPDX-License-Identifier: MIT
#include "polhode/perturb/kane_damper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "math/number_text.hpp"
#include "perturb/damper_kernel.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::number_text;
using Kernel = detail::DamperKernel<double>;

}  // namespace

KaneDamper::KaneDamper(double moment, double friction) : moment_(moment), friction_(friction) {
  if (!(moment > 0.0) || !std::isfinite(moment))
    throw DomainError("KaneDamper: moment " + number_text(moment) + " must be positive and finite");
  if (!(friction >= 0.0) || !std::isfinite(friction))
    throw DomainError("KaneDamper: friction " + number_text(friction) + " must be >= 0 and finite");
}

void KaneDamper::require_room(const Body& body) const {
  const Vec3& I = body.moments();
  double m[] = {I.x, I.y, I.z};
  std::sort(m, m + 3);
  const double room = m[0] - (m[2] - m[1]);  // I1 + I2 - I3 of the largest
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * m[2];
  if (moment_ <= room + rounding && moment_ < m[0]) return;
  throw DomainError("KaneDamper: moment " + number_text(moment_) + " in a body of moments " +
                    detail::tuple_text({I.x, I.y, I.z}) + " must be at most " + number_text(room) +
                    ", the sum of the two smaller ones less the largest, and less than each: what "
                    "is left must be a body");
}

Vec3 KaneDamper::rate_of_body(const Body& body, const Vec3& s) const {
  return Kernel(body, *this).rate_of_body(s);
}

Vec3 KaneDamper::acceleration(const Body& body, const Vec3& g, const Vec3& dg,
                              const Vec3& s) const {
  const Kernel kernel(body, *this);
  return kernel.acceleration(kernel.rate(g) + kernel.rate_of_body(s), dg, s);
}

double KaneDamper::energy(const Body& body, const Vec3& s) const {
  return 0.5 * moment_ * dot(s, s + rate_of_body(body, s));
}

Vec3 KaneDamper::momentum(const Body& body, const Vec3& g, const Vec3& s) const {
  const Kernel kernel(body, *this);
  return moment_ * (kernel.rate(g) + kernel.rate_of_body(s) + s);
}

// h = J (I^-1 g + (1 - J/I) s)
Vec3 KaneDamper::relative_rate(const Body& body, const Vec3& g, const Vec3& momentum) const {
  const Kernel kernel(body, *this);
  return kernel.lagged((1.0 / moment_) * momentum - kernel.rate(g));
}

}  // namespace v0
}  // namespace polhode
