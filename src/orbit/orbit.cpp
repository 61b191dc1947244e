// SPDX-License-Identifier: MIT
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void orbit_without_velocity(const std::string& name) {
  throw DomainError("AnyOrbit: orbit \"" + name +
                    "\" has no velocity: write position(t) as a template on the number type");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
