// SPDX-License-Identifier: MIT
// LightPlan: what the tables [light], [free] and [fit] of a scenario of kind "fit" say of light
// curves: how bright the body is, what of it is unknown, and which periods are looked for.
//
// Equations   those of fit_light and search_light (polhode/fit/).
// Units       core units (polhode/text/units.hpp).
// Domain      what is left out follows from the data: the limits of the scan, how many starts.
// Errors      none; what is no plan is refused when the file is read. light_mesh: ScenarioError for
//             a file that is no mesh.
// Cost        plain values.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "polhode/fit/light_search.hpp"
#include "polhode/shape/facet_shape.hpp"
#include "polhode/text/key_values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
struct Scenario;

struct ScanPlan {
  std::size_t order = 3;
  std::optional<double> shortest = std::nullopt, longest = std::nullopt;  // periods
  // One grid over all of their time, or session by session first (scan_sessions).
  enum class Sessions { joined, separate };
  Sessions sessions = Sessions::joined;
  std::size_t windows = 20;  // of separate sessions
  std::size_t minima = 20;
  fit::LabelChoice labels;
  struct Pair {
    double first, second;  // periods
  };
  std::vector<Pair> at;  // chosen by hand
  std::size_t at_order = 3;
  // The values that may contradict the data.
  struct Places {
    Place shortest, longest, order, windows, at;
  };
  Places places = {};
};

// The facets of a convex body and its regularisation (polhode/fit/light_fit.hpp).
struct ConvexPlan {
  int degree = 6;
  int rows = 8;
  fit::MomentSource moments = fit::MomentSource::fit;
  double roughness_error = 3.0;
  double moments_error = 0.1;
  // Pairs of periods of a search that go on to a convex body, the best ones of the ellipsoid.
  std::size_t pairs = std::numeric_limits<std::size_t>::max();
};

struct LightPlan {
  enum class Shape { ellipsoid, convex, mesh };
  Shape shape = Shape::ellipsoid;
  std::string mesh;  // its file; empty: that of the body
  ConvexPlan convex;
  std::optional<Vec3> semiaxes = std::nullopt;  // along the principal axes
  light::Scattering law;
  fit::LightUnknowns unknowns;  // with where moments come from
  bool searches = false;
  bool is_tumbler = false;                   // also where one period would be enough
  bool one_by_one = false;                   // sessions, each joining those before it
  std::vector<fit::TumblerPeriods> periods;  // empty: those of a scan
  ScanPlan scan;
  std::optional<std::size_t> starts = std::nullopt;  // in all
  std::optional<int> most_iterations = std::nullopt;
  double within_factor = 2.0;
  std::vector<double> sessions;  // of a simulation: begin and end of each
  struct Places {
    Place moments, degree, one_by_one;
    Place sessions;  // [time] if there are none
  };
  Places places = {};
};

// The mesh that is seen, along the body axes of the file: that of [light], read here, or that of
// [body]. Of a scenario of kind "fit" whose shape is a mesh.
shape::FacetShape light_mesh(const Scenario& scenario);

}  // namespace io
}  // namespace v0
}  // namespace polhode
