// SPDX-License-Identifier: MIT
// The steps of a fit of light curves: the scan for periods, the search, and sessions that are
// fitted one by one.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/light_states.hpp"
#include "polhode/run/light_report.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// ScenarioError where it has more than most_scan_pairs, or no periods to look at.
LightScan light_scan(const Scenario& scenario, std::span<const light::LightCurve> curves,
                     const FitOptions& options);
// The pairs of periods of fit.scan.at.
std::vector<ChosenPair> chosen_pairs(const Scenario& scenario,
                                     std::span<const light::LightCurve> curves);

// ScenarioError for a single one.
void require_sessions(const Scenario& scenario, std::span<const light::LightCurve> curves);
// The session with most points.
std::size_t longest_session(std::span<const light::LightCurve> curves);
// The session that a body fits best.
std::size_t nearest_session(std::span<const light::LightCurve> curves, const fit::LightModel& body,
                            const fit::Loss& loss);

// Extends bodies near the first session to solutions of all sessions. Convex bodies begin with the
// facets of ellipsoids, which stay the usual ones.
void extend_to_sessions(const Scenario& scenario, std::size_t first,
                        std::vector<fit::LightModel> starts, const FitOptions& options,
                        LightReport& report);

// The surface of the file.
fit::SurfaceSearch surface_search(const Scenario& scenario, const fit::LightUnknowns& unknowns);

// The options of a file for a step of its fit: a LightSearch, LightExtension or ScanOptions. A
// RunInterrupted says `where` it stopped; it and `options` must outlive the step.
template <class Step>
void follow(const Scenario& scenario, const FitOptions& options, const std::string& where,
            Step& step) {
  step.threads = options.threads;
  step.journal = options.journal;
  step.between = [&] {
    if (options.stop && options.stop())
      throw RunInterrupted(scenario.document.name + ": stopped " + where);
  };
  if constexpr (requires { step.progress; })
    if (options.progress) step.progress = [&](double part) { options.progress({part, part}); };
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
