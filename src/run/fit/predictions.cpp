// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/run/light_report.hpp"
#include "run/detail/attitude_errors.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/light_report.hpp"
#include "run/fit/fit_torques.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

using detail::error_about;

constexpr std::pair<int, int> pairs[] = {{0, 1}, {0, 2}, {1, 2}};
double correlation(const Mat3& c, int i, int j) {
  return c(i, j) / (error_about(c, i) * error_about(c, j));
}

Mat3 times_number(double k, Mat3 c) {
  for (Vec3& row : c.row) row = k * row;
  return c;
}

// Errors about the three axes, with as many digits as one needs.
std::string errors_text(const Units& units, const Mat3& c) {
  std::string text;
  for (int k = 0; k < 3; ++k) {
    const double error = units.from_core(error_about(c, k), Dimension::angle);
    text += (k == 0 ? "" : ", ") +
            fmt::format(fmt::runtime(error < 100.0 ? "{:.3g}" : "{:.0f}"), error);
  }
  return text;
}

// Columns as wide as they have to be; those that are empty below their head are left out.
std::string table_text(const std::vector<std::vector<std::string>>& rows) {
  const std::size_t n = rows.front().size();
  std::vector<std::size_t> width(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 1; i < rows.size(); ++i) width[k] = std::max(width[k], rows[i][k].size());
    if (width[k] > 0) width[k] = std::max(width[k], rows.front()[k].size());
  }
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < n; ++k)
      if (width[k] > 0) line += fmt::format("{:<{}}  ", row[k], width[k]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace

std::vector<AttitudePrediction> fit_predictions(const FitReport& report, std::size_t solution,
                                                std::span<const double> times) {
  const FoundSpin& found = report.solutions.at(solution);
  std::vector<AttitudePrediction> all;
  for (const fit::PredictedAttitude& one : detail::predicted_by(report, found.raw, times))
    all.push_back({one, std::nullopt});
  if (!found.scaled) return all;
  const std::vector<fit::PredictedAttitude> scaled =
      detail::predicted_by(report, *found.scaled, times);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].scaled = scaled[i];
  return all;
}

std::vector<AttitudePrediction> fit_predictions(const LightReport& report, std::size_t solution,
                                                std::span<const double> times) {
  const fit::LightSolution& found = report.solutions.at(solution).solution;
  std::vector<AttitudePrediction> all;
  const double factor = light_error_factor(found), known = report.has_errors() ? 1.0 : unknown;
  for (fit::PredictedAttitude& one : fit::predicted(found, report.unknowns, times)) {
    one.covariance = times_number(known, one.covariance);
    all.push_back({one, std::nullopt});
    if (!(factor > 0.0)) continue;
    all.back().scaled = one;
    all.back().scaled->covariance = times_number(factor * factor, one.covariance);
  }
  return all;
}

std::vector<double> prediction_times(const Scenario& scenario, std::span<const std::string> words) {
  std::vector<double> times;
  for (const std::string& word : words) times.push_back(time_of_word(scenario, word));
  return times;
}

std::vector<double> prediction_times(const Scenario& scenario) {
  const std::optional<SaveAt>& rows = row_times(scenario);
  if (!rows)
    throw DomainError(scenario.document.name +
                      ": time: got nothing; expected [time], when attitudes are predicted");
  std::vector<double> times;
  for (std::int64_t k = 0; k < rows->size(); ++k) times.push_back((*rows)[k]);
  return times;
}

std::string prediction_text(const Scenario& scenario,
                            std::span<const AttitudePrediction> predictions) {
  const Units& units = scenario.units();
  std::vector<std::vector<std::string>> rows = {
      {"t, " + units.time(), "date", "phi, theta, psi", "error about x, y, z", "scaled"}};
  bool open = false;
  for (const AttitudePrediction& one : predictions) {
    const fit::PredictedAttitude& raw = one.raw;
    rows.push_back({fmt::format("{:.10g}", units.from_core(raw.t, Dimension::time)),
                    date_of_time(scenario, raw.t), detail::euler_text(scenario, raw.q),
                    errors_text(units, raw.covariance),
                    one.scaled ? errors_text(units, one.scaled->covariance) : std::string()});
    open = open || detail::is_open(raw.covariance);
  }
  std::string text = "\npredicted attitudes, errors in " + units.angle() + "\n" + table_text(rows);
  if (open)
    text += "note: where an error is more than a radian, the fit does not know the attitude\n";
  return text;
}

void write_predictions(const Scenario& scenario, std::span<const AttitudePrediction> predictions,
                       const std::string& path) {
  const Units& units = scenario.units();
  const std::string angle = units.label(Dimension::angle), rate = units.label(Dimension::rate);
  const std::vector<ColumnGroup> groups = {
      {"t", {{"t", units.time()}}},
      {"q", {{"qw", "1"}, {"qx", "1"}, {"qy", "1"}, {"qz", "1"}}},
      {"rate", {{"w_x", rate}, {"w_y", rate}, {"w_z", rate}}},
      {"errors", {{"error_x", angle}, {"error_y", angle}, {"error_z", angle}}},
      {"correlations", {{"r_xy", "1"}, {"r_xz", "1"}, {"r_yz", "1"}}},
      {"scaled_errors",
       {{"scaled_error_x", angle}, {"scaled_error_y", angle}, {"scaled_error_z", angle}}},
      {"scaled_correlations", {{"scaled_r_xy", "1"}, {"scaled_r_xz", "1"}, {"scaled_r_yz", "1"}}}};
  std::vector<double> rows;
  const auto add = [&](const std::optional<Mat3>& c) {
    for (int k = 0; k < 3; ++k)
      rows.push_back(c ? units.from_core(error_about(*c, k), Dimension::angle) : unknown);
    for (const auto& [i, j] : pairs) rows.push_back(c ? correlation(*c, i, j) : unknown);
  };
  for (const auto& [raw, scaled] : predictions) {
    rows.insert(rows.end(),
                {units.from_core(raw.t, Dimension::time), raw.q.w, raw.q.x, raw.q.y, raw.q.z});
    for (int k = 0; k < 3; ++k) rows.push_back(units.from_core(raw.w_F[k], Dimension::rate));
    add(raw.covariance);
    add(scaled ? std::optional(scaled->covariance) : std::nullopt);
  }
  detail::write_fit_rows(
      scenario, groups, rows,
      {"attitudes that the solution predicts: body axes to inertial axes, errors about the body "
       "axes of first order, with errors of data as given and scaled; those of more than a radian "
       "say that the attitude is not known"},
      path);
}

void detail::add_predictions(JsonWriter& json, const Scenario& scenario,
                             std::span<const AttitudePrediction> predictions) {
  const Units& units = scenario.units();
  const auto add_errors = [&](const std::string& scaled, const Mat3& c) {
    std::vector<double> errors, correlations;
    for (int k = 0; k < 3; ++k)
      errors.push_back(units.from_core(error_about(c, k), Dimension::angle));
    for (const auto& [i, j] : pairs) correlations.push_back(correlation(c, i, j));
    json.members(scaled + "errors", errors, scaled + "correlations", correlations);
  };
  json.array(predictions, [&](const AttitudePrediction& one) {
    json.begin_object().members("t", units.from_core(one.raw.t, Dimension::time));
    if (const std::string date = date_of_time(scenario, one.raw.t); !date.empty())
      json.members("date", date);
    Vec3 rate = one.raw.w_F;
    for (int k = 0; k < 3; ++k) rate[k] = units.from_core(rate[k], Dimension::rate);
    json.members("quaternion", one.raw.q, "rate", rate);
    add_errors("", one.raw.covariance);
    if (one.scaled) add_errors("scaled_", one.scaled->covariance);
    json.end_object();
  });
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
