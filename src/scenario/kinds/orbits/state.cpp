// SPDX-License-Identifier: MIT
// [orbit.NAME] from a position and a velocity, about an attracting body that may be oblate.
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr Key keys[] = {
    orbit_gm_key,
    orbit_epoch_key,
    {.path = "position",
     .type = KeyType::numbers,
     .presence = Presence::required,
     .dimension = Dimension::length,
     .length = 3,
     .example = "[7000.0, 0.0, 0.0]",
     .help = "Position at the epoch."},
    {.path = "velocity",
     .type = KeyType::numbers,
     .presence = Presence::required,
     .dimension = Dimension::speed,
     .length = 3,
     .example = "{ value = [0.0, 5.0, 5.6], unit = \"km/s\" }",
     .help = "Velocity at the epoch."},
    {.path = "J2",
     .type = KeyType::number,
     .fallback = "0",
     .example = "1.0826e-3",
     .help = "Oblateness of the attracting body, whose pole is axis 3 of `axes`: node, pericentre "
             "and mean anomaly of the mean ellipse then advance at their secular rates of "
             "first order."},
    {.path = "radius",
     .type = KeyType::number,
     .dimension = Dimension::length,
     .example = "\"6378.137 km\"",
     .help = "Equatorial radius that J2 belongs to."},
    orbit_axes_key,
};

}  // namespace

const std::string& orbit_axes(const OrbitContext& at) {
  const std::string& of_state = at.state_axes();
  if (!has(at.values(), at.key_path("axes"))) return of_state;
  const std::string& own = word(at.values(), at.key_path("axes"));
  if ((own == "inertial") != (of_state == "inertial"))
    refuse(at.values(), at.key_path("axes"), at.file(),
           "expected axes that have a known place in those of the state, which are " + of_state);
  return own;
}

namespace {

ScenarioOrbit state_orbit(const OrbitContext& at) {
  const Values& values = at.values();
  const double gm = *at.gm(), J2 = number(values, at.key_path("J2"));
  const Vec3 x = vector(values, at.key_path("position")),
             v = vector(values, at.key_path("velocity"));
  const double epoch = number(values, at.key_path("epoch"));
  const std::string& axes = orbit_axes(at);
  const std::string& of_state = at.state_axes();
  const auto from = [&](const Vec3& position, const Vec3& velocity) {
    return built(values, at.key_path("velocity"), at.file(),
                 [&] { return KeplerOrbit::from_state(position, velocity, gm, epoch); });
  };
  if (J2 == 0.0)
    return {{}, from(in_other_axes(x, axes, of_state), in_other_axes(v, axes, of_state)), gm};
  if (!has(values, at.key_path("radius")))
    refuse(values, at.key_path("J2"), at.file(), "expected a key radius as well");
  const double radius = number(values, at.key_path("radius"));
  if (!(radius > 0.0))
    refuse(values, at.key_path("radius"), at.file(), "expected a positive length");
  const KeplerElements osculating = from(x, v).elements();
  const PrecessingKeplerOrbit moving = built(values, at.key_path("J2"), at.file(), [&] {
    const KeplerElements elements = mean_elements(osculating, J2, radius);
    return PrecessingKeplerOrbit(elements, j2_rates(elements, J2, radius));
  });
  return precessing_orbit(at, moving);
}

}  // namespace

OrbitKind state_kind() {
  return {.name = "state",
          .help = "A position and a velocity, about an attracting body that may be oblate.",
          .keys = {std::begin(keys), std::end(keys)},
          .made = state_orbit};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
