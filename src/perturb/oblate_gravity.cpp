// SPDX-License-Identifier: MIT
#include "polhode/perturb/oblate_gravity.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

void require(const char* whose, bool good, const char* what, double x, const char* needed) {
  if (!good || !std::isfinite(x))
    throw DomainError(std::string(whose) + ": " + what + " " + number_text(x) + " must be " +
                      needed);
}

}  // namespace

SoundOblateness::SoundOblateness(double J2, double radius, const Vec3& pole) {
  require("Oblateness", radius > 0.0, "radius", radius, "positive and finite");
  require("Oblateness", true, "J2", J2, "finite");
  const double length = norm(pole);
  if (!(length > 0.0) || !std::isfinite(length))
    throw DomainError("Oblateness: pole " + tuple_text({pole.x, pole.y, pole.z}) +
                      " must be a direction: finite and not 0");
}

double checked_strength(double gm, const Oblateness& of) {
  require("OblateGravity", gm > 0.0, "gm", gm, "positive and finite");
  static_cast<void>(SoundOblateness(of.J2, of.radius, of.pole));  // as it is now
  return gm * of.J2 * of.radius * of.radius;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
