// SPDX-License-Identifier: MIT
#include "scenario/kinds/observations/shared_keys.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "scenario/detail/history_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

void require_state_axes(const std::optional<ObservedAxes>& axes, const KeyValues& at) {
  if (!axes) return;
  const bool is_inertial = state_table(at.file_values())->axes == "inertial";
  if ((*axes == ObservedAxes::inertial) != is_inertial)
    at.refuse("axes", is_inertial
                          ? "expected \"inertial\", as state.axes is; or axes of the sky there"
                          : "expected axes of the sky, as those of state.axes");
}

double angle_unit_of(const SkyKeys& keys, const KeyValues& at) {
  const double unit = keys.angle_unit.empty() ? at.units().to_core(1.0, Dimension::angle)
                                              : at.unit("angle_unit", Dimension::angle);
  require_state_axes(keys.axes, at);
  return unit;
}

Quaternion to_state_axes(const std::optional<ObservedAxes>& axes, const KeyValues& at) {
  if (!axes || *axes == ObservedAxes::inertial) return {};
  const std::string state_axes = state_table(at.file_values())->axes;
  const char* const own = *axes == ObservedAxes::ecliptic ? "ecliptic-J2000" : "equator-J2000";
  if (own == state_axes) return {};
  return conj(ecliptic_from(state_axes)) * ecliptic_from(own);
}

ObservedRows rows_with(std::vector<std::string> columns, const std::vector<std::string>& own,
                       const ErrorKeys& errors, double unit, std::size_t count) {
  const std::size_t numbers = columns.size() - 1;
  ObservedRows rows;
  rows.columns = own.empty() ? std::move(columns) : own;
  rows.sigma_columns = errors.sigma_columns;
  rows.numbers = numbers;
  rows.error_units.assign(count, unit);
  if (errors.sigma) rows.sigmas.assign(count, *errors.sigma);
  if (errors.sigmas) rows.sigmas = {errors.sigmas->x, errors.sigmas->y, errors.sigmas->z};
  return rows;
}

Quaternion rotated_by(const Quaternion& q, const Vec3& turn) {
  const double angle = norm(turn), half = 0.5 * angle;
  const double k = angle > 0.0 ? std::sin(half) / angle : 0.5;
  return normalized(q * Quaternion{std::cos(half), k * turn.x, k * turn.y, k * turn.z});
}

Vec3 noise_vector(const RowNoise& noise, const std::vector<double>& sigmas) {
  return {sigmas[0] * noise(0), sigmas[1] * noise(1), sigmas[2] * noise(2)};
}

Vec3 three(const std::vector<double>& sigmas) { return {sigmas[0], sigmas[1], sigmas[2]}; }

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
