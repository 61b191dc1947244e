// SPDX-License-Identifier: MIT
// [orbit.NAME] from a position and a velocity, about an attracting body that may be oblate.
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/orbit_kinds.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

const std::string& orbit_axes(const OrbitContext& at) {
  const std::string& of_state = word(at.values(), "state.axes");
  if (!has(at.values(), at.key("axes"))) return of_state;
  const std::string& own = word(at.values(), at.key("axes"));
  if ((own == "inertial") != (of_state == "inertial"))
    refuse(at.values(), at.key("axes"), at.name(),
           "expected axes that have a known place in those of the state, which are " + of_state);
  return own;
}

ScenarioOrbit state_orbit(const OrbitContext& at) {
  const Values& values = at.values();
  const double gm = *own_gm(at), J2 = number(values, at.key("J2"));
  const Vec3 x = vector(values, at.key("position")), v = vector(values, at.key("velocity"));
  const double epoch = number(values, at.key("epoch"));
  const std::string& axes = orbit_axes(at);
  const std::string& of_state = word(values, "state.axes");
  const auto from = [&](const Vec3& position, const Vec3& velocity) {
    return built(values, at.key("velocity"), at.name(),
                 [&] { return KeplerOrbit::from_state(position, velocity, gm, epoch); });
  };
  if (J2 == 0.0)
    return {std::string(key_name(at.path)),
            from(in_other_axes(x, axes, of_state), in_other_axes(v, axes, of_state)), gm};
  if (!has(values, at.key("radius")))
    refuse(values, at.key("J2"), at.name(), "expected a key radius as well");
  const double radius = number(values, at.key("radius"));
  if (!(radius > 0.0)) refuse(values, at.key("radius"), at.name(), "expected a positive length");
  const KeplerElements osculating = from(x, v).elements();
  const PrecessingKeplerOrbit moving = built(values, at.key("J2"), at.name(), [&] {
    const KeplerElements elements = mean_elements(osculating, J2, radius);
    return PrecessingKeplerOrbit(elements, j2_rates(elements, J2, radius));
  });
  return precessing_orbit(at, moving);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
