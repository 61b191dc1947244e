// SPDX-License-Identifier: MIT
// The scan of light curves for pairs of periods, as a scenario asks for it.
#pragma once

#include <span>
#include <vector>

#include "polhode/run/light_report.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// ScenarioError where it has more than most_scan_pairs, or no periods to look at.
LightScan light_scan(const Scenario& scenario, std::span<const LightCurve> curves,
                     const LightFitOptions& options);
// The pairs of periods of fit.scan.at.
std::vector<ChosenPair> chosen_pairs(const Scenario& scenario, std::span<const LightCurve> curves);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
