// SPDX-License-Identifier: MIT
// [[observation]] of kind "attitude".
#include "polhode/rotor/attitude.hpp"

#include <array>
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

enum class AttitudeForm { quaternion, euler, matrix };

struct AttitudeKeys : SkyKeys, ErrorKeys {
  AttitudeForm form = AttitudeForm::quaternion;
  std::vector<std::string> columns;
};

constexpr auto attitude_keys = polhode::io::joined(
    polhode::io::joined(
        sky_keys<AttitudeKeys>,
        std::array{
            choice_key<&AttitudeKeys::form, AttitudeForm::quaternion, AttitudeForm::euler,
                       AttitudeForm::matrix>(
                "form", "quaternion|euler|matrix",
                "What the columns after the time are: a quaternion w, x, y, z, body axes to "
                "inertial ones; "
                "Euler's angles phi, theta, psi (3-1-3); or the nine numbers of the matrix from "
                "inertial "
                "to body components, row by row. States in other charts become such by `polhode "
                "convert`.")
                .otherwise("\"quaternion\""),
            columns_key<&AttitudeKeys::columns>(
                "columns",
                "The column of times, then those of the form, by name or by number "
                "from 1. Left out: t, and qw, qx, qy, qz or phi, theta, psi or R11, "
                "R12, ... R33.")
                .example("[\"t\", \"qw\", \"qx\", \"qy\", \"qz\"]"),
        }),
    errors_along_axes<AttitudeKeys>(Dimension::angle,
                                    "Its standard error about each body axis, one number for all.",
                                    "\"2 deg\"", "[2, 2, 5]"));

std::vector<std::string> columns_of(AttitudeForm form) {
  switch (form) {
    case AttitudeForm::quaternion:
      return {"t", "qw", "qx", "qy", "qz"};
    case AttitudeForm::euler:
      return {"t", "phi", "theta", "psi"};
    case AttitudeForm::matrix:
      break;
  }
  return {"t", "R11", "R12", "R13", "R21", "R22", "R23", "R31", "R32", "R33"};
}

Quaternion attitude_of(AttitudeForm form, double unit, const std::vector<double>& x) {
  if (form == AttitudeForm::euler)
    return attitude(EulerAngles{unit * x[0], unit * x[1], unit * x[2]});
  if (form == AttitudeForm::quaternion) return unit_quaternion(x[0], x[1], x[2], x[3]);
  Mat3 R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int place = 3 * i + j;
      R(i, j) = x[static_cast<std::size_t>(place)];
    }
  return attitude(R);
}

std::vector<double> numbers_of(AttitudeForm form, double unit, const Quaternion& q) {
  if (form == AttitudeForm::quaternion) return {q.w, q.x, q.y, q.z};
  if (form == AttitudeForm::euler) {
    const EulerAngles e = euler_angles(q);
    return {e.phi / unit, e.theta / unit, e.psi / unit};
  }
  const Mat3 R = attitude_matrix(q);
  std::vector<double> numbers;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) numbers.push_back(R(i, j));
  return numbers;
}

ObservedRows made_attitude(const AttitudeKeys& keys, const TermContext& at) {
  const double unit = angle_unit_of(keys, at);
  const Quaternion to_state = to_state_axes(keys.axes, at);
  const AttitudeForm form = keys.form;
  ObservedRows rows = rows_with(columns_of(form), keys.columns, keys, unit, 3);
  if (form == AttitudeForm::euler && unit == at.units().to_core(1.0, "deg", Dimension::angle))
    rows.turning_degrees = {0, 2};
  rows.read = [=](const FileRow& row, fit::Snapshots& seen) {
    const Quaternion q = normalized(to_state * attitude_of(form, unit, row.numbers));
    seen.attitudes.push_back({row.t, q, fit::covariance_of(three(row.sigmas))});
  };
  rows.simulate = [](const BodyMotion& motion, const RowNoise& noise,
                     const std::vector<double>& sigmas, fit::Snapshots& seen) {
    seen.attitudes.push_back({motion.t, rotated_by(motion.q, noise_vector(noise, sigmas)),
                              fit::covariance_of(three(sigmas))});
  };
  rows.written = [=](const fit::Snapshots& seen) {
    std::vector<FileRow> all;
    for (const fit::ObservedAttitude& one : seen.attitudes)
      all.push_back({one.t, numbers_of(form, unit, conj(to_state) * one.q)});
    return all;
  };
  return rows;
}

}  // namespace

ObservationKind attitude_kind() {
  ObservationKind kind =
      observation_kind<AttitudeKeys>("attitude", "Attitudes.", attitude_keys, made_attitude);
  kind.sets = "sigma|sigmas|sigma_columns";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
