// SPDX-License-Identifier: MIT
// The dipole of a scenario: by its coefficients, or the Earth's of the epoch.
#include "scenario/kinds/torques/dipole_keys.hpp"

#include <cmath>

#include "polhode/ephemeris/earth.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/value_access.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// The Earth's orientation at t = 0 along the axes of the state.
PrimaryRotation earth_at_epoch(const TermContext& at, const Clock& clock, const std::string& axes) {
  const Mat3 R = j2000_from_earth(clock.epoch, clock.dut1);
  const auto column = [&](int k) {
    return in_other_axes(Vec3{R(0, k), R(1, k), R(2, k)}, "equator-J2000", axes);
  };
  const Vec3 pole = column(2), greenwich = column(0);
  const Vec3 node = cross(Vec3{0.0, 0.0, 1.0}, pole);
  const double meridian = std::atan2(dot(cross(node, greenwich), pole), dot(node, greenwich));
  return {.pole = pole,
          .rate = at.units().to_core(earth_rotation_rate, "rad/s", Dimension::rate),
          .meridian = meridian,
          .epoch = 0.0};
}

NamedDipole earth_dipole(const TermContext& at) {
  const std::string& axes = word(at.values(), "state.axes");
  if (axes == "inertial")
    at.refuse("field",
              "expected axes = \"equator-J2000\" or \"ecliptic-J2000\" in [state] as well, "
              "and epoch");
  const Clock clock = clock_of(at.values(), at.units(), at.key_path("field"), at.file());
  return at.built("field", [&]() -> NamedDipole {
    const Vec3 g = igrf_dipole(clock.epoch);
    const auto core = [&](double x) {
      return at.units().to_core(x, "nT", Dimension::magnetic_field);
    };
    const double radius = at.units().to_core(igrf_radius_km, "km", Dimension::length);
    const auto shown = [](double x) { return number_text(std::round(10.0 * x) / 10.0); };
    return {DipoleField::from_gauss({core(g.x), core(g.y), core(g.z)}, radius,
                                    earth_at_epoch(at, clock, axes)),
            ", the Earth's dipole of the epoch (IGRF-14: " + shown(g.x) + ", " + shown(g.y) + ", " +
                shown(g.z) + " nT)"};
  });
}

}  // namespace

NamedDipole dipole_of(const DipoleArguments& a, const TermContext& at) {
  if (a.field == FieldSource::earth) return earth_dipole(at);
  if (!a.gauss)
    at.refuse("gauss", "expected the Gauss coefficients g10, g11, h11, or field = \"earth\"");
  if (!a.reference_radius)
    at.refuse("reference_radius", "expected the radius that belongs to gauss");
  const bool turns_show = a.gauss->y != 0.0 || a.gauss->z != 0.0;
  if (turns_show && !a.rotation_rate)
    at.refuse("rotation_rate", "expected the rotation rate of the field; 0 for a fixed field");
  if (turns_show && !a.meridian)
    at.refuse("meridian", "expected the angle of the prime meridian at t = meridian_epoch");
  require_pole(at, "pole");
  const PrimaryRotation primary{.pole = a.pole,
                                .rate = a.rotation_rate.value_or(0.0),
                                .meridian = a.meridian.value_or(0.0),
                                .epoch = a.meridian_epoch};
  if (primary.pole == Vec3{}) at.refuse("pole", "expected a vector that is not zero");
  return at.built("gauss", [&]() -> NamedDipole {
    const Vec3& g = *a.gauss;
    return {DipoleField::from_gauss({g.x, g.y, g.z}, *a.reference_radius, primary), ""};
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
