// SPDX-License-Identifier: MIT
// fit_light_scenario: a scenario of kind "fit" that observed light curves, to its solutions, and
// what is made of them: a table, JSON, the landscape of the scan, residuals and covariance as
// files, scenarios that go on from a solution.
//
// Equations   those of scan_pairs, labelled_periods, search_light and fit_light (polhode/fit/).
//             Sessions one by one: extend_light begins with the solutions that a search finds in
//             the session with most points, or with the start, in the session that it fits best;
//             to convex bodies with the facets of the ellipsoids of that session. chi-square of a
//             scan is the same for f1 and f2 exchanged: half of it is computed.
// Units       core units; texts and files in the units of the scenario.
// Domain      free rotation relative to inertial axes. Axes of solutions are the principal ones in
//             the order of rising moments, those of a body whose moments follow from its shape; of
//             other bodies they are those of [body] in that order. What did not converge is
//             counted, and is no solution.
// Accuracy    that of the fits. The same bits for any number of threads.
// Errors      ScenarioError at the place of what a fit does not take: more unknowns than data, a
//             scan of more than most_scan_pairs, with the keys that make it smaller; as
//             read_observations (polhode/scenario/observation_kind.hpp). Files: OutputError.
//             RunInterrupted if `stop` returns true.
// Cost        benchmarks/fit_light_curves.cpp, fit_fourier_scan.cpp; minutes for a night.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/run/fit.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

inline constexpr double most_scan_pairs = 1e8;

// Of a scan session by session (scan_sessions).
struct SeparateSessions {
  std::size_t sessions;  // with enough points
  std::size_t windows;
  std::size_t pairs;  // in the windows
};
// A constant brightness; it suffices if no period lowers chi-square by more than noise does.
struct ConstantLight {
  double chi_square;
  std::size_t degrees_of_freedom;
  bool suffices;
};
// The series of one frequency with the fewest harmonics that describes the data as well as more
// harmonics and the lowest resolved pair of frequencies do, or else the one with the most. It does
// not suffice if a constant does.
struct OnePeriod {
  std::size_t order;  // of the series
  fit::RefinedPair refined;
  bool suffices;
  std::vector<double> aliases;  // frequencies that fit as well to 3 sigma
};
struct LightScan {
  fit::ScanAdvice advice;
  fit::Landscape landscape;              // of separate sessions the sum of theirs
  std::vector<fit::ScanMinimum> minima;  // on all of the time
  std::optional<SeparateSessions> separate;
  // Both are empty if the grid of one frequency would be too long.
  std::optional<ConstantLight> constant;
  std::optional<OnePeriod> one;
};

// The series at a pair of periods of fit.scan.at, and at the minimum next to it.
struct ChosenPair {
  fit::FourierFit fit;
  fit::RefinedPair refined;
};

// A pair of periods that a search began with.
struct PairFound {
  fit::TumblerPeriods from{};
  // The best ellipsoid that its starts came to, be its cost what it may; its periods may be
  // others. None where nothing converged.
  std::optional<fit::LightSolution> ellipsoid;
  // The convex body or the mesh that was fitted from it, converged or not.
  std::optional<fit::LightSolution> surface;
};

struct LightReport {
  ReadObservations observed;
  LightPlan::Shape shape = LightPlan::Shape::ellipsoid;
  fit::LightUnknowns unknowns;
  std::optional<fit::LightModel> start;  // of a fit that has one: an ellipsoid or a mesh
  std::optional<LightScan> scan;
  std::vector<ChosenPair> chosen;
  std::vector<PairFound> pairs;
  std::vector<fit::JoinedSession> joined;  // where sessions are fitted one by one
  // By what was minimised. `ellipsoid` of a convex body is that of the same moments of inertia as
  // the body filled evenly.
  std::vector<fit::FoundLight> solutions;
  std::size_t starts = 1, finalists = 1, converged = 0;  // of ellipsoids
  std::size_t surfaces = 0, surfaces_converged = 0;      // fits of convex bodies, or of the mesh
  std::vector<std::string> notes;
  std::string failure;  // why there are no solutions
  // What a reader must know before anything else: one period is enough, or no model fits.
  std::string verdict;

  bool is_found() const { return !solutions.empty(); }
  // True if any solution describes the data; errors mean nothing otherwise.
  bool has_errors() const;
  std::size_t points() const;
};

// Whether light curves are what the scenario observed.
bool observes_light(const Scenario& scenario);

LightReport fit_light_scenario(const Scenario& scenario, const FitOptions& options = {});

// The same for a LightReport (fit.hpp). Errors are scaled by error_factor; coefficients start at
// those of their ellipsoid.
std::vector<FitNumber> fit_numbers(const Scenario& scenario, const LightReport& report,
                                   std::size_t solution);

// By which errors of a solution are scaled, its error_factor(); NaN where that is none or 0.
double light_error_factor(const fit::LightSolution& found);

// The fit that a solution is of, from that solution on.
fit::LightFit light_fit_at(const Scenario& scenario, const LightReport& report,
                           std::size_t solution);

std::string fit_text(const Scenario& scenario, const LightReport& report,
                     std::span<const double> times = {});
std::string fit_json(const Scenario& scenario, const LightReport& report,
                     std::span<const double> times = {});

// f1, f2 and chi-square, a row for each pair of the scan; DomainError without a scan.
void write_landscape(const Scenario& scenario, const LightReport& report, const std::string& path);
// A row for each point: table, line and session from 1, flux, its error, that of the solution, the
// difference, and this in errors.
void write_residuals(const Scenario& scenario, const LightReport& report, std::size_t solution,
                     const std::string& path);
void write_covariance(const Scenario& scenario, const LightReport& report, std::size_t solution,
                      const std::string& path);
// A scenario of kind "fit" that begins at the solution, with the ellipsoid or the
// mesh, so that it can be simulated and fitted again as well as run; `mesh` is the file of a convex
// body, as the scenario names it, and `folder` where its paths start; left out, where those of this
// one do.
std::string solution_text(const Scenario& scenario, const LightReport& report, std::size_t solution,
                          const std::string& mesh = "seen.obj",
                          const std::optional<std::string>& folder = std::nullopt);
// The file, and beside PATH.toml the mesh of a convex body, PATH-seen.obj; DomainError for areas
// that are those of no body. Nothing is written then.
void write_solution(const Scenario& scenario, const LightReport& report, std::size_t solution,
                    const std::string& path);

// What the solution of a fit says of the attitude at other times, with the error that is left: for
// observations to come, and to hold observations against that were not fitted.
//
// Equations   predicted() of polhode/fit/spin_fit.hpp, with torques or jumps that of
//             polhode/fit/driven_spin_fit.hpp: the covariance of the unknowns, carried by the
//             derivatives of the motion to the rotation vector of the attitude in body axes.
// Units       core units; texts and files in the units of the scenario.
// Domain      any times, before and after what was observed, in any order. Covariances are of first
//             order in the errors: beyond a radian they say that the attitude is not known.
// Accuracy    that of the derivatives.
// Errors      DomainError for what is no time, and where a driven motion does not reach it. Files:
//             OutputError.
// Cost        free rotation 0.1 ms and a microsecond a time; driven as an iteration of the fit.

struct AttitudePrediction {
  fit::PredictedAttitude raw;  // with errors as they were given
  // Of the solution with scaled errors; none where there is none.
  std::optional<fit::PredictedAttitude> scaled;
};
std::vector<AttitudePrediction> fit_predictions(const FitReport& report, std::size_t solution,
                                                std::span<const double> times);
// Of light curves: along the body axes of the solution (light_report.hpp).
std::vector<AttitudePrediction> fit_predictions(const LightReport& report, std::size_t solution,
                                                std::span<const double> times);

// From words: numbers in the unit of time of the file ("1500"), dates with a time scale or in that
// of the epoch ("2004-10-07T13:56:00 UTC").
std::vector<double> prediction_times(const Scenario& scenario, std::span<const std::string> words);
// The rows of [time]; DomainError where the file has none.
std::vector<double> prediction_times(const Scenario& scenario);

// For people, of a solution: Euler angles, and errors about the three body axes.
std::string prediction_text(const Scenario& scenario,
                            std::span<const AttitudePrediction> predictions);

// A row for each time: the quaternion of the body axes of the file and the rate along them; errors
// about them and their correlations, with errors as they were given and scaled.
void write_predictions(const Scenario& scenario, std::span<const AttitudePrediction> predictions,
                       const std::string& path);

}  // namespace io
}  // namespace v0
}  // namespace polhode
