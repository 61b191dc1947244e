// SPDX-License-Identifier: MIT
// What files and texts of all fits share.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "polhode/run/fit.hpp"
#include "polhode/run/light_report.hpp"
#include "polhode/run/summary.hpp"
#include "text/json.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// A table of numbers in the formats of the scenario, with notes, by PATH.part. The dimension of
// rows as in Provenance.
void write_fit_rows(const Scenario& scenario, const std::vector<ColumnGroup>& groups,
                    std::span<const double> rows, const std::vector<std::string>& notes,
                    const std::string& path, const std::string& row_dimension = {});
// In the units of the scenario; `numbers` are the unknowns of the covariance.
void write_fit_covariance(const Scenario& scenario, const fit::UnknownsCovariance& covariance,
                          const std::vector<FitNumber>& numbers, const std::string& path);
// PATH.part, then PATH.
void write_fit_text(const Scenario& scenario, const std::string& text, const std::string& path);

// The file without what was observed, and with this state at t = 0 in radians per unit of time.
std::vector<ScenarioChange> without_observations(const Scenario& scenario);
ScenarioChange state_change(const Scenario& scenario, const Quaternion& q, const Vec3& w);
// Rows from the first of these times to the last, where the file has no [time].
void add_rows_of(const Scenario& scenario, const std::vector<double>& times,
                 std::vector<ScenarioChange>& changes);
std::string row_text(double a, double b, double c);

// ScenarioError "expected none: `what` relative to inertial axes" for a frame that moves.
void require_inertial(const Scenario& scenario, const std::string& what = "a fit is one");
Dimension dimension_of_unknown(std::string_view name);
// phi, theta, psi from 0 on, with their unit.
std::string euler_text(const Scenario& scenario, const Quaternion& q);
// "label             value\n"
void add_fit_line(std::string& text, std::string_view label, const std::string& value);

// The end of a text with the first solutions: how many more there are, why there are none, notes.
template <class Report>
void add_end(std::string& text, const Report& report, std::size_t shown,
             const std::vector<std::string>& notes) {
  if (shown < report.solutions.size())
    text += "\nand " + std::to_string(report.solutions.size() - shown) +
            " more solutions, which --json has in full\n";
  if (!report.is_found()) add_fit_line(text, "solutions", "none: " + report.failure);
  for (const std::string& note : notes) text += "note: " + note + "\n";
}

// Members "unknowns" and "covariance_core"; null for what is infinite or unknown.
void add_unknowns(JsonWriter& json, const std::vector<FitNumber>& numbers,
                  const fit::UnknownsCovariance& covariance);
// What a solution predicts, as an array: predictions.cpp.
void add_predictions(JsonWriter& json, const Scenario& scenario,
                     std::span<const AttitudePrediction> predictions);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
