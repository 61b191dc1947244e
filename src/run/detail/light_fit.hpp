// SPDX-License-Identifier: MIT
// The steps of a fit of light curves: the scan for periods, sessions that are fitted one by one,
// and the convex bodies or the mesh that follow the ellipsoid.
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
namespace detail {

// ScenarioError where it has more than most_scan_pairs, or no periods to look at.
LightScan light_scan(const Scenario& scenario, std::span<const LightCurve> curves,
                     const LightFitOptions& options);
// The pairs of periods of fit.scan.at.
std::vector<ChosenPair> chosen_pairs(const Scenario& scenario, std::span<const LightCurve> curves);

// ScenarioError for a single one.
void require_sessions(const Scenario& scenario, std::span<const LightCurve> curves);
// The session with most points.
std::size_t longest_session(std::span<const LightCurve> curves);
// The session that a body fits best.
std::size_t nearest_session(std::span<const LightCurve> curves, const LightModel& body,
                            const Loss& loss);

// Extends bodies near the first session to solutions of all sessions. Convex bodies begin with the
// facets of ellipsoids, which stay the usual ones.
void extend_to_sessions(const Scenario& scenario, std::size_t first, std::vector<LightModel> starts,
                        const LightFitOptions& options, LightReport& report);

// The fits of convex bodies and of the mesh of one scenario to some of its light curves, which must
// outlive it.
class SurfaceFits {
 public:
  SurfaceFits(const Scenario& scenario, const LightUnknowns& unknowns,
              const std::vector<LightCurve>& curves);

  // The best from this ellipsoid: of a mesh of some attitudes with its periods. None where the mesh
  // has no such motion.
  std::vector<FoundLight> from(const LightModel& ellipsoid) const;
  // From what has the same light where directions do not change: images, of a mesh all attitudes.
  // Not from what is near a state that is `known`.
  std::vector<FoundLight> from_images(const LightModel& ellipsoid,
                                      const std::vector<LightModel>& known) const;
  // The fit of the mesh from the state of the file.
  FoundLight from_file() const;
  LightFit fit_from(const LightModel& start) const;
  LightModel convex_of(const LightModel& ellipsoid) const;
  // The mesh with the state and the law of the file; nullopt if there is none.
  const std::optional<LightModel>& mesh() const { return mesh_; }
  // Of two fits whose bodies are the same, or nearly so.
  bool are_same(const FoundLight& a, const FoundLight& b) const;
  // Also half turns of ellipsoids that they begin with are the same.
  bool are_same_starts(const FoundLight& a, const FoundLight& b) const;

 private:
  FoundLight fitted(const LightModel& start, const LightModel& ellipsoid, int iterations) const;
  FoundLight convex_from(const LightModel& ellipsoid) const;
  FoundLight mesh_from(const SpinState& spin, const LightModel& ellipsoid, int iterations) const;
  bool is_known(const LightModel& body, const std::vector<LightModel>& known) const;
  std::vector<SpinState> mesh_starts(const LightModel& ellipsoid) const;

  const FitPlan& plan_;
  LightUnknowns unknowns_;
  const std::vector<LightCurve>& curves_;
  LightGeometry geometry_;
  int most_iterations_;
  std::optional<LightModel> mesh_;
};

// Shape and unknowns into the report; and what the scenario asks that no fit can do.
void begin_surfaces(const Scenario& scenario, LightReport& report);
// Gives a convex body the ellipsoid of the moments that it has if filled evenly.
void set_ellipsoid(FoundLight& one);
// A fit from an ellipsoid that was fitted, or of a mesh from the state of the file.
void fit_surface_from_start(const Scenario& scenario, const std::optional<LightModel>& ellipsoid,
                            LightReport& report);
// Fits convex bodies or the mesh to the curves of a search, from the ellipsoids that it found. A
// mesh is also searched for by the periods of that search.
void fit_surfaces(const Scenario& scenario, const LightSearch& asked,
                  const LightSearchResult& found, const LightFitOptions& options,
                  LightReport& report);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
