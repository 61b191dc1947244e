// SPDX-License-Identifier: MIT
// [[observation]] of kind "direction".
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "polhode/error.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/kinds/observations/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

enum class DirectionForm { vector, angles };

struct DirectionKeys : SkyKeys, ErrorKeys {
  Vec3 axis{0.0, 0.0, 1.0};  // of the body
  DirectionForm form = DirectionForm::vector;
  std::vector<std::string> columns;
};

constexpr auto direction_keys = polhode::io::joined(
    sky_keys<DirectionKeys>,
    std::array{
        quantity_key<&DirectionKeys::axis>("axis", Dimension::number,
                                           "The body axis whose direction was seen, of any length.")
            .otherwise("[0, 0, 1]"),
        choice_key<&DirectionKeys::form, DirectionForm::vector, DirectionForm::angles>(
            "form", "vector|angles",
            "What the columns after the time are: a vector of any length, or longitude and "
            "latitude "
            "(right ascension and declination along the axes of an equator).")
            .otherwise("\"vector\""),
        columns_key<&DirectionKeys::columns>(
            "columns",
            "The column of times, then those of the form, by name or by number "
            "from 1. Left out: t, and x, y, z or lon, lat.")
            .example("[\"t\", \"x\", \"y\", \"z\"]"),
        sigma_key<DirectionKeys>(Dimension::angle,
                                 "Its standard error in each of two directions across it.",
                                 "\"2 deg\""),
        sigma_columns_key<DirectionKeys>("The column of the error, one name."),
    });

Vec3 direction_of(DirectionForm form, double unit, const std::vector<double>& x) {
  if (form == DirectionForm::angles) {
    const double lon = unit * x[0], lat = unit * x[1];
    return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
  }
  const Vec3 d{x[0], x[1], x[2]};
  if (!(norm(d) > 0.0)) throw DomainError("direction 0, 0, 0; expected one with a length");
  return d;
}

std::vector<double> numbers_of(DirectionForm form, double unit, const Vec3& d) {
  if (form == DirectionForm::vector) return {d.x, d.y, d.z};
  return {std::atan2(d.y, d.x) / unit, std::atan2(d.z, std::hypot(d.x, d.y)) / unit};
}

// The direction of an axis after a small rotation about two axes across it.
Vec3 noisy_direction(const Vec3& axis, const Quaternion& q, double first, double second) {
  const Vec3 other = std::fabs(axis.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 across = cross(axis, other);
  const Vec3 e = (1.0 / norm(across)) * across;
  return rotate(rotated_by(q, first * e + second * cross(axis, e)), axis);
}

ObservedRows made_direction(const DirectionKeys& keys, const TermContext& at) {
  if (!(norm(keys.axis) > 0.0)) at.refuse("axis", "expected a vector that is not 0");
  const double unit = angle_unit_of(keys, at);
  const Quaternion to_state = to_state_axes(keys.axes, at);
  const DirectionForm form = keys.form;
  const bool has_angles = form == DirectionForm::angles;
  ObservedRows rows = rows_with(has_angles ? std::vector<std::string>{"t", "lon", "lat"}
                                           : std::vector<std::string>{"t", "x", "y", "z"},
                                keys.columns, keys, unit, 1);
  if (has_angles && unit == at.units().to_core(1.0, "deg", Dimension::angle))
    rows.turning_degrees = {0};
  rows.read = [=, axis = keys.axis](const FileRow& row, fit::Snapshots& seen) {
    seen.directions.push_back(
        {row.t, axis, rotate(to_state, direction_of(form, unit, row.numbers)), row.sigmas[0]});
  };
  rows.simulate = [axis = keys.axis](const BodyMotion& motion, const RowNoise& noise,
                                     const std::vector<double>& sigmas, fit::Snapshots& seen) {
    const double sigma = sigmas[0];
    const Vec3 unit_axis = (1.0 / norm(axis)) * axis;
    seen.directions.push_back(
        {motion.t, axis, noisy_direction(unit_axis, motion.q, sigma * noise(0), sigma * noise(1)),
         sigma});
  };
  rows.written = [=](const fit::Snapshots& seen) {
    std::vector<FileRow> all;
    for (const fit::ObservedDirection& one : seen.directions)
      all.push_back({one.t, numbers_of(form, unit, rotate(conj(to_state), one.direction_I))});
    return all;
  };
  return rows;
}

}  // namespace

ObservationKind direction_kind() {
  ObservationKind kind = observation_kind<DirectionKeys>("direction", "Directions of a body axis.",
                                                         direction_keys, made_direction);
  kind.sets = "sigma|sigma_columns";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
