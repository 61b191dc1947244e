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
std::size_t nearest_session(std::span<const LightCurve> curves, const EllipsoidModel& body,
                            const Loss& loss);

// From bodies near the first of the sessions to solutions of all.
void extend_to_sessions(const Scenario& scenario, std::size_t first,
                        std::vector<EllipsoidModel> starts, const LightFitOptions& options,
                        LightReport& report);

// The ellipsoid with the moments of the tensor, a = 1; DomainError where none has them.
Ellipsoid ellipsoid_of(const Mat3& tensor);

// A fit of a convex body or of the mesh. `solution.body` has its spin and law, and an ellipsoid.
struct SurfaceFound {
  LightSolution solution;
  std::optional<ConvexModel> convex;
  EllipsoidModel start;  // the ellipsoid that it was fitted from
};

// The fits of one scenario.
class SurfaceFits {
 public:
  SurfaceFits(const Scenario& scenario, const LightReport& report);

  // The best from this ellipsoid: of a mesh of some attitudes with its periods. None where the mesh
  // has no such motion.
  std::vector<SurfaceFound> from(const EllipsoidModel& ellipsoid) const;
  // From what has the same light where directions do not change: images, of a mesh all attitudes.
  // Not from what is near a state that is `known`.
  std::vector<SurfaceFound> from_images(const EllipsoidModel& ellipsoid,
                                        const std::vector<EllipsoidModel>& known) const;
  // From the state of the file.
  SurfaceFound from_file() const;
  ConvexFit convex_fit(const EllipsoidModel& ellipsoid) const;
  MeshFit mesh_fit(const SpinState& spin, int most_iterations) const;
  // Of two fits whose bodies are the same, or nearly so.
  bool are_same(const LightSolution& a, const LightSolution& b) const;

 private:
  SurfaceFound convex_from(const EllipsoidModel& ellipsoid) const;
  SurfaceFound mesh_from(const SpinState& spin, const EllipsoidModel& ellipsoid,
                         int most_iterations) const;
  bool is_known(const EllipsoidModel& body, const std::vector<EllipsoidModel>& known) const;
  std::vector<SpinState> mesh_starts(const EllipsoidModel& ellipsoid) const;

  const Scenario& scenario_;
  const FitPlan& plan_;
  const LightReport& report_;
  LightGeometry geometry_;
  int most_iterations_;
};

// The mesh that is given, into the report; and what the scenario asks that no fit can do.
void begin_surfaces(const Scenario& scenario, LightReport& report);
// From the ellipsoid of the start that was fitted, or of a mesh from the file.
void fit_surface_from_start(const Scenario& scenario, LightReport& report);
// From the ellipsoids that a search found, and a mesh from what it asked, too.
void fit_surfaces(const Scenario& scenario, const LightSearch& asked,
                  const LightSearchResult& found, const LightFitOptions& options,
                  LightReport& report);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
