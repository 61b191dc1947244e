// SPDX-License-Identifier: MIT
#include "run/detail/fit_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "output/part_file.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/run/run.hpp"
#include "run/detail/output_checks.hpp"
#include "run/fit/fit_torques.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t rows_without_time = 101;

std::string value_in(double number, const std::string& unit) {
  return "{ value = " + polhode::detail::number_text(number) + ", unit = \"" + unit + "\" }";
}

}  // namespace

void write_fit_rows(const Scenario& scenario, const std::vector<ColumnGroup>& groups,
                    std::span<const double> rows, const std::vector<std::string>& notes,
                    const std::string& path, const std::string& row_dimension) {
  const std::string paths[] = {path};
  require_own_files(scenario.document, paths);
  Provenance origin = provenance(scenario);
  origin.notes.insert(origin.notes.end(), notes.begin(), notes.end());
  origin.row_dimension = row_dimension;
  const std::unique_ptr<Sink> sink =
      open_sink(path, groups, origin, std::nullopt, scenario.output.formats);
  sink->push(rows);
  sink->finish();
}

void write_fit_covariance(const Scenario& scenario, const fit::UnknownsCovariance& c,
                          const std::vector<FitNumber>& numbers, const std::string& path) {
  const std::size_t n = numbers.size();
  // what one unit of each unknown is in those of the file
  std::vector<double> factor;
  for (std::size_t i = 0; i < n; ++i) factor.push_back(unit_of(scenario, numbers[i].name).of(1.0));
  std::vector<ColumnGroup> groups = {{"unknown", {{"unknown", "1"}}}};
  std::string notes = "unknowns:";
  for (std::size_t i = 0; i < n; ++i) {
    std::string name = numbers[i].name;  // a slash in the name of an HDF5 dataset means a group
    if (const std::size_t slash = name.find('/'); slash != std::string::npos)
      name.replace(slash, 1, "_over_");
    groups.push_back({name, {{numbers[i].name, numbers[i].unit}}});
    notes += " " + std::to_string(i + 1) + " " + numbers[i].name;
  }
  groups.push_back({"errors", {{"error", "1"}, {"scaled_error", "1"}}});
  std::vector<double> rows;
  for (std::size_t i = 0; i < n; ++i) {
    rows.push_back(static_cast<double>(i + 1));
    for (std::size_t j = 0; j < n; ++j) rows.push_back(factor[i] * factor[j] * c.matrix[i * n + j]);
    rows.push_back(numbers[i].error);
    rows.push_back(numbers[i].scaled_error.value_or(missing));
  }
  write_fit_rows(scenario, groups, rows,
                 {notes,
                  "covariance with errors as given, in products of the units of the columns; "
                  "error and scaled_error in the unit of the unknown of the row"},
                 path, "unknown");
}

void write_fit_text(const Scenario& scenario, const std::string& text, const std::string& path) {
  const std::string paths[] = {path};
  require_own_files(scenario.document, paths);
  PartFile file(path);
  file.write(text);
  file.commit();
}

std::vector<ScenarioChange> without_observations(const Scenario& scenario) {
  std::vector<ScenarioChange> changes;
  for (const char* const key : {"kind", "free", "fit", "light", "simulate", "map", "ensemble"})
    changes.push_back({key, ""});
  for (std::size_t i = require_fit(scenario).observations.size(); i-- > 0;)
    changes.push_back({"observation[" + std::to_string(i) + "]", ""});
  return changes;
}

std::string row_text(double a, double b, double c) {
  return "[" + polhode::detail::number_text(a) + ", " + polhode::detail::number_text(b) + ", " +
         polhode::detail::number_text(c) + "]";
}

// In radians per unit of time of the file: these read back as they are.
ScenarioChange state_change(const Scenario& scenario, const Quaternion& q, const Vec3& w) {
  return {"state.attitude-rate",
          "{ quaternion = [" + polhode::detail::number_text(q.w) + ", " +
              polhode::detail::number_text(q.x) + ", " + polhode::detail::number_text(q.y) + ", " +
              polhode::detail::number_text(q.z) + "], omega_body = { value = " +
              row_text(w.x, w.y, w.z) + ", unit = \"rad/" + scenario.units().time() + "\" } }"};
}

void add_rows_of(const Scenario& scenario, const std::vector<double>& times,
                 std::vector<ScenarioChange>& changes) {
  if (row_times(scenario)) return;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const std::string& unit = scenario.units().time();
  if (!(*first < *last)) return changes.push_back({"time", "{ at = [0] }"});
  changes.push_back({"time", "{ start = " + value_in(*first, unit) +
                                 ", stop = " + value_in(*last, unit) +
                                 ", count = " + std::to_string(rows_without_time) + " }"});
}

void require_inertial(const Scenario& scenario, const std::string& what) {
  if (!scenario.rotation().frame.is_inertial())
    require_fit(scenario).places.frame.refuse("expected none: " + what +
                                              " relative to inertial axes");
}

Dimension dimension_of_unknown(std::string_view name) {
  if (name.starts_with("turn_")) return Dimension::angle;
  return name.starts_with("w_") ? Dimension::rate : Dimension::number;
}

void add_fit_line(std::string& text, std::string_view label, const std::string& value) {
  text += fmt::format("{:<17} {}\n", label, value);
}

std::string euler_text(const Scenario& scenario, const Quaternion& q) {
  const EulerAngles e = euler_angles(q);
  const Units& units = scenario.units();
  const auto angle = [&](double x) { return units.from_core(x, Dimension::angle); };
  const double turn = 2.0 * std::acos(-1.0);
  const auto positive = [&](double x) { return angle(x < 0.0 ? x + turn : x); };
  return fmt::format("{:.6g}, {:.6g}, {:.6g} {}", positive(e.phi), angle(e.theta), positive(e.psi),
                     units.angle());
}

void add_unknowns(JsonWriter& json, const std::vector<FitNumber>& numbers,
                  const fit::UnknownsCovariance& covariance) {
  json.key("unknowns").begin_object();
  for (const FitNumber& one : numbers) {
    json.key(one.name).begin_object().members("unit", one.unit);
    if (one.start) json.members("start", *one.start);
    json.members("value", one.value, "error", one.error);
    if (one.scaled_value) json.members("scaled_value", *one.scaled_value);
    if (one.scaled_error) json.members("scaled_error", *one.scaled_error);
    json.end_object();
  }
  json.end_object().key("covariance_core").begin_array();
  const std::size_t n = covariance.names.size();
  for (std::size_t i = 0; i < n; ++i)
    json.value(std::vector(covariance.matrix.begin() + static_cast<std::ptrdiff_t>(i * n),
                           covariance.matrix.begin() + static_cast<std::ptrdiff_t>((i + 1) * n)));
  json.end_array();
}

}  // namespace detail

void require_own_files(const Scenario& scenario, std::span<const std::string> paths) {
  detail::require_own_files(scenario.document, paths);
}
}  // namespace io
}  // namespace v0
}  // namespace polhode
