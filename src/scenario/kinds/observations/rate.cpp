// SPDX-License-Identifier: MIT
// [[observation]] of kind "rate".
#include <array>
#include <string>
#include <vector>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/kinds/observations/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct RateKeys : ErrorKeys {
  std::vector<std::string> columns;
  std::string rate_unit;  // empty: that of the file
};

constexpr auto rate_keys = polhode::io::joined(
    std::array{
        columns_key<&RateKeys::columns>(
            "columns",
            "The column of times, then the angular velocity along the body axes, "
            "by name or by number from 1. Left out: t, w1, w2, w3.")
            .example("[\"t\", \"w1\", \"w2\", \"w3\"]"),
        unit_key<&RateKeys::rate_unit>(
            "rate_unit", "Unit of rates and of errors in columns; left out, that of this file.")
            .example("\"deg/d\""),
    },
    errors_along_axes<RateKeys>(Dimension::rate,
                                "Its standard error along each body axis, one number for all.",
                                "\"0.1 deg/h\"", "[0.1, 0.1, 0.5]"));

ObservedRows made_rate(const RateKeys& keys, const TermContext& at) {
  const double unit = keys.rate_unit.empty() ? at.units().to_core(1.0, Dimension::rate)
                                             : at.unit("rate_unit", Dimension::rate);
  ObservedRows rows = rows_with({"t", "w1", "w2", "w3"}, keys.columns, keys, unit, 3);
  rows.read = [unit](const FileRow& row, fit::Snapshots& seen) {
    const std::vector<double>& x = row.numbers;
    seen.rates.push_back(
        {row.t, {unit * x[0], unit * x[1], unit * x[2]}, fit::covariance_of(three(row.sigmas))});
  };
  rows.simulate = [](const BodyMotion& motion, const RowNoise& noise,
                     const std::vector<double>& sigmas, fit::Snapshots& seen) {
    seen.rates.push_back(
        {motion.t, motion.w_F + noise_vector(noise, sigmas), fit::covariance_of(three(sigmas))});
  };
  rows.written = [unit](const fit::Snapshots& seen) {
    std::vector<FileRow> all;
    for (const fit::ObservedRate& one : seen.rates)
      all.push_back({one.t, {one.w_F.x / unit, one.w_F.y / unit, one.w_F.z / unit}});
    return all;
  };
  return rows;
}

}  // namespace

ObservationKind rate_kind() {
  ObservationKind kind = observation_kind<RateKeys>(
      "rate", "Angular velocities along the body axes.", rate_keys, made_rate);
  kind.sets = "sigma|sigmas|sigma_columns";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
