// SPDX-License-Identifier: MIT
// LightPlan: what the tables [light], [free] and [fit] of a scenario of kind "fit" say of light
// curves: how bright the body is, what of it is unknown, and which periods are looked for.
//
// Equations   those of fit_light and search_light (polhode/fit/).
// Units       core units (polhode/text/units.hpp).
// Domain      what is left out follows from the data: the limits of the scan, how many starts.
// Accuracy    none.
// Errors      none; what is no plan is refused when the file is read.
// Cost        plain values.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {

struct ScanPlan {
  std::size_t order = 3;
  std::optional<double> shortest = std::nullopt, longest = std::nullopt;  // periods
  std::size_t minima = 20;
  LabelChoice labels;
};

struct LightPlan {
  enum class Shape { ellipsoid, mesh };
  Shape shape = Shape::ellipsoid;
  std::optional<Vec3> semiaxes = std::nullopt;  // along the principal axes
  Scattering law;
  LightUnknowns unknowns;  // with where moments come from
  bool searches = false;
  std::vector<TumblerPeriods> periods;  // empty: those of a scan
  ScanPlan scan;
  std::optional<std::size_t> starts = std::nullopt;  // in all
  std::optional<int> most_iterations = std::nullopt;
  double within_factor = 2.0;
  std::vector<double> sessions;  // of a simulation: begin and end of each
};

}  // namespace v0
}  // namespace polhode
