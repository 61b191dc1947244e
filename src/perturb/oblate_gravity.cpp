// SPDX-License-Identifier: MIT
#include "polhode/perturb/oblate_gravity.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

double checked_strength(double gm, const Oblateness& of) {
  const auto require = [](bool good, const char* what, double x, const char* needed) {
    if (!good || !std::isfinite(x))
      throw DomainError(std::string("OblateGravity: ") + what + " " + number_text(x) + " must be " +
                        needed);
  };
  require(gm > 0.0, "gm", gm, "positive and finite");
  require(of.radius > 0.0, "radius", of.radius, "positive and finite");
  require(true, "J2", of.J2, "finite");
  const double length = norm(of.pole);
  if (!(length > 0.0) || !std::isfinite(length))
    throw DomainError("OblateGravity: pole " + tuple_text({of.pole.x, of.pole.y, of.pole.z}) +
                      " must be a direction: finite and not 0");
  return gm * of.J2 * of.radius * of.radius;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
