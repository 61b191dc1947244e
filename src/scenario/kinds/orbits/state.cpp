// SPDX-License-Identifier: MIT
// [orbit.NAME] from a position and a velocity, about an attracting body that may be oblate.
#include <optional>
#include <string>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct Arguments {
  std::optional<double> gm;
  double epoch;
  Vec3 position, velocity;
  double J2;
  std::optional<double> radius;
  std::optional<std::string> axes;
};

constexpr KindKey<Arguments> keys[] = {
    orbit_gm_key<&Arguments::gm>(),
    orbit_epoch_key<&Arguments::epoch>(),
    quantity_key<&Arguments::position>("position", Dimension::length, "Position at the epoch.")
        .required()
        .example("[7000.0, 0.0, 0.0]"),
    quantity_key<&Arguments::velocity>("velocity", Dimension::speed, "Velocity at the epoch.")
        .required()
        .example("{ value = [0.0, 5.0, 5.6], unit = \"km/s\" }"),
    quantity_key<&Arguments::J2>(
        "J2", Dimension::number,
        "Oblateness of the attracting body, whose pole is axis 3 of `axes`: node, pericentre and "
        "mean anomaly of the mean ellipse then advance at their secular rates of first order.")
        .otherwise("0")
        .example("1.0826e-3"),
    quantity_key<&Arguments::radius>("radius", Dimension::length,
                                     "Equatorial radius that J2 belongs to.")
        .example("\"6378.137 km\""),
    orbit_axes_key<&Arguments::axes>(),
};

ScenarioOrbit made(const Arguments& a, const OrbitContext& at) {
  const double gm = *positive_gm(at, a.gm);
  const std::string axes = orbit_axes(at, a.axes), of_state = at.state_axes();
  const auto from = [&](const Vec3& position, const Vec3& velocity) {
    return at.built("velocity",
                    [&] { return KeplerOrbit::from_state(position, velocity, gm, a.epoch); });
  };
  if (a.J2 == 0.0)
    return {
        {},
        from(in_other_axes(a.position, axes, of_state), in_other_axes(a.velocity, axes, of_state)),
        gm};
  if (!a.radius) at.refuse("J2", "expected a key radius as well");
  const double radius = *a.radius;
  if (!(radius > 0.0)) at.refuse("radius", "expected a positive length");
  const KeplerElements osculating = from(a.position, a.velocity).elements();
  const PrecessingKeplerOrbit moving = at.built("J2", [&] {
    const KeplerElements elements = mean_elements(osculating, a.J2, radius);
    return PrecessingKeplerOrbit(elements, j2_rates(elements, a.J2, radius));
  });
  return precessing_orbit(at, axes, moving);
}

}  // namespace

OrbitKind state_kind() {
  return orbit_kind<Arguments>(
      "state", "A position and a velocity, about an attracting body that may be oblate.", keys,
      made);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
