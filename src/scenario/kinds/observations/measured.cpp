// SPDX-License-Identifier: MIT
// Rows of numbers that are a function of the motion.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/scenario/observation_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

ObservedRows observed_rows(MeasuredRows measured, const TermContext& at) {
  const std::size_t count = measured.columns.size();
  if (count == 0) throw DomainError("a kind of observation without columns; expected one or more");
  if (!measured.numbers)
    throw DomainError("a kind of observation without a function; expected one");
  if (measured.sigmas.size() != count ||
      !std::ranges::all_of(measured.sigmas, [](double s) { return s > 0.0 && std::isfinite(s); }))
    throw DomainError("errors of a kind of observation: expected " + std::to_string(count) +
                      " positive numbers, one for each column");
  ObservedRows rows;
  rows.columns = {"t"};
  rows.sigmas = measured.sigmas;
  rows.numbers = count;
  std::vector<bool> are_angles;
  for (const MeasuredColumn& column : measured.columns) {
    rows.columns.push_back(column.name);
    rows.error_units.push_back(at.units().to_core(1.0, column.dimension));
    are_angles.push_back(column.dimension == Dimension::angle);
  }
  const auto function = std::make_shared<const fit::MotionFunction>(std::move(measured.numbers));
  const std::vector<double> units = rows.error_units;
  rows.read = [=](const FileRow& row, fit::Snapshots& seen) {
    fit::Measurement one{row.t, row.numbers, row.sigmas, function, are_angles};
    for (std::size_t i = 0; i < count; ++i) one.seen[i] *= units[i];
    seen.measurements.push_back(std::move(one));
  };
  rows.simulate = [=](const BodyMotion& motion, const RowNoise& noise,
                      const std::vector<double>& sigmas, fit::Snapshots& seen) {
    fit::Measurement one{motion.t, std::vector<double>(count), sigmas, function, are_angles};
    (*function)(motion.t, motion.q, motion.w_F, one.seen);
    for (std::size_t i = 0; i < count; ++i) one.seen[i] += sigmas[i] * noise(i);
    seen.measurements.push_back(std::move(one));
  };
  rows.written = [units](const fit::Snapshots& seen) {
    std::vector<FileRow> all;
    for (const fit::Measurement& one : seen.measurements) {
      FileRow row{one.t, one.seen};
      for (std::size_t i = 0; i < units.size(); ++i) row.numbers[i] /= units[i];
      all.push_back(std::move(row));
    }
    return all;
  };
  return rows;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
