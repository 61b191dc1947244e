// SPDX-License-Identifier: MIT
#include "polhode/perturb/constant_torque.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

ConstantTorque::ConstantTorque(const Vec3& u, std::optional<SpaceAxes> axes) : u_(u), axes_(axes) {
  if (!std::isfinite(u.x) || !std::isfinite(u.y) || !std::isfinite(u.z))
    throw DomainError("ConstantTorque: torque " + detail::tuple_text({u.x, u.y, u.z}) +
                      " must be finite");
}

ConstantTorque ConstantTorque::in_body(const Vec3& u_B) { return {u_B, std::nullopt}; }

ConstantTorque ConstantTorque::in_space(const Vec3& u, SpaceAxes axes) { return {u, axes}; }

}  // namespace v0
}  // namespace polhode
