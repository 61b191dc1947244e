// SPDX-License-Identifier: MIT
// Sessions of light curves that are fitted one by one.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polhode/run/light_report.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// ScenarioError for a single one.
void require_sessions(const Scenario& scenario, std::span<const LightCurve> curves);
// The session with most points.
std::size_t longest_session(std::span<const LightCurve> curves);
// The session that a body fits best.
std::size_t nearest_session(std::span<const LightCurve> curves, const BrightEllipsoid& body,
                            const Loss& loss);

// From bodies near the first of the sessions to solutions of all.
void extend_to_sessions(const Scenario& scenario, std::size_t first,
                        std::vector<BrightEllipsoid> starts, const LightFitOptions& options,
                        LightReport& report);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
