// SPDX-License-Identifier: MIT
// How well light curves are described: by one period, by a model, and which points are not.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "polhode/run/light_report.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// From so many points on, means of neighbouring points are recommended.
inline constexpr std::size_t many_points = 3000;
std::size_t count_points(std::span<const LightCurve> curves);

// A point whose residual is more than four times the spread of all.
struct FarPoint {
  ObservedRow place;
  double r;  // in standard errors as given
};
std::vector<FarPoint> far_points(const LightReport& report, const LightSolution& s);
// "3 of table 1, 17 of table 2, ..."; tables only if there are several.
std::string lines_of(const Scenario& scenario, const std::vector<ObservedRow>& places);

// What was minimised, where that is not chi-square, and the points that are far from the model.
void add_loss(std::string& text, const Scenario& scenario, const LightReport& report,
              const LightSolution& s);

// The sentence for a scan for which one period is enough; empty otherwise.
std::string one_period_text(const Scenario& scenario, const LightScan& scan);
// The sentence for solutions none of which describes the data, and what is wrong; empty otherwise.
std::string misfit_text(const Scenario& scenario, const LightReport& report);

// Sentences on what was read: magnitudes taken for fluxes, errors far from the scatter of
// neighbours, single points that are far from their neighbours.
std::vector<std::string> data_notes(const Scenario& scenario, const ReadObservations& observed);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
