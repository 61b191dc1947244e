// SPDX-License-Identifier: MIT
// What kinds of [[observation]] share: keys of axes, units and errors, and rotations by noise.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/math/quaternion.hpp"
#include "polhode/scenario/observation_kind.hpp"
#include "scenario/tables/state.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// The axes that it refers to, and the unit of angles.
struct SkyKeys {
  std::optional<ObservedAxes> axes;
  std::string angle_unit;  // empty: that of the file
};
template <class A>
constexpr std::array sky_keys = {
    choice_key<&SkyKeys::axes, A, ObservedAxes::inertial, ObservedAxes::ecliptic,
               ObservedAxes::equator>(
        "axes", "inertial|ecliptic-J2000|equator-J2000",
        "The axes that it refers to; left out, those of `state.axes`.")
        .example("\"ecliptic-J2000\""),
    unit_key<&SkyKeys::angle_unit, A>(
        "angle_unit", "Unit of angles and of errors in columns; left out, `units.angle`.")
        .example("\"deg\""),
};

// One of these is needed.
struct ErrorKeys {
  std::optional<double> sigma;
  std::optional<Vec3> sigmas;  // along the body axes
  std::vector<std::string> sigma_columns;
};
template <class A>
consteval KindKey<A> sigma_key(Dimension dimension, std::string_view help,
                               std::string_view example) {
  return quantity_key<&ErrorKeys::sigma, A>("sigma", dimension, help)
      .alternative()
      .positive()
      .example(example);
}
template <class A>
consteval KindKey<A> sigma_columns_key(std::string_view help) {
  return columns_key<&ErrorKeys::sigma_columns, A>("sigma_columns", help)
      .alternative()
      .example("[\"sigma\"]");
}
template <class A>
consteval auto errors_along_axes(Dimension dimension, std::string_view help, std::string_view sigma,
                                 std::string_view sigmas) {
  return std::array{
      sigma_key<A>(dimension, help, sigma),
      quantity_key<&ErrorKeys::sigmas, A>("sigmas", dimension, "The same for the three body axes.")
          .alternative()
          .positive()
          .example(sigmas),
      sigma_columns_key<A>("The column of the error, or one for each body axis."),
  };
}

// Refuses axes that do not go with those of the state, and a unit of another dimension.
double angle_unit_of(const SkyKeys& keys, const KeyValues& at);
// From the axes that are observed along to those of the state.
Quaternion to_state_axes(const std::optional<ObservedAxes>& axes, const KeyValues& at);
void require_state_axes(const std::optional<ObservedAxes>& axes, const KeyValues& at);

// Rows with these columns, if the file does not name others, and these errors.
ObservedRows rows_with(std::vector<std::string> columns, const std::vector<std::string>& own,
                       const ErrorKeys& errors, double unit, std::size_t count);

// q exp(turn / 2)
Quaternion rotated_by(const Quaternion& q, const Vec3& turn);
// Three noise numbers with these errors.
Vec3 noise_vector(const RowNoise& noise, const std::vector<double>& sigmas);
// A covariance of three errors, in the order of the body axes.
Vec3 three(const std::vector<double>& sigmas);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
