// SPDX-License-Identifier: MIT
// One convex body or one mesh, from an ellipsoid.
#include <algorithm>
#include <array>
#include <cmath>

#include "fit/free_motion.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/snapshots.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/rotor/attitude.hpp"
#include "run/detail/light_fit.hpp"
#include "run/detail/light_report.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr int usual_iterations = 100;
// Of the attitudes of a mesh with the periods of an ellipsoid: iterations of each, and how many are
// fitted to the end.
constexpr int short_iterations = 4;
constexpr std::size_t mesh_finalists = 3;
// Of the most that psi has in short-axis mode, what a mesh takes of an ellipsoid that has more.
constexpr double most_psi = 0.95;
// States from which one start is enough: in rad, and of the rate.
constexpr double near_turn = 0.05, near_rate = 0.01;
constexpr std::array<Quaternion, 4> half_turns{Quaternion{1.0, 0.0, 0.0, 0.0},
                                               {0.0, 1.0, 0.0, 0.0},
                                               {0.0, 0.0, 1.0, 0.0},
                                               {0.0, 0.0, 0.0, 1.0}};
constexpr std::array<LightImage, 3> images{LightImage::normal, LightImage::bisector,
                                           LightImage::difference};

}  // namespace

SurfaceFits::SurfaceFits(const Scenario& scenario, const LightUnknowns& unknowns,
                         const std::vector<LightCurve>& curves)
    : plan_(require_fit(scenario)),
      unknowns_(unknowns),
      curves_(curves),
      geometry_(geometry_of(curves)),
      most_iterations_(plan_.light.most_iterations.value_or(usual_iterations)) {
  if (plan_.light.shape == LightPlan::Shape::mesh)
    mesh_ = LightModel{spin_state(scenario.rotation()), ShadedMesh(light_mesh(scenario)),
                       plan_.light.law};
}

LightFit SurfaceFits::fit_from(const LightModel& start) const {
  const ConvexPlan& plan = plan_.light.convex;
  LightFit fit{curves_, start, unknowns_, plan_.loss, most_iterations_};
  fit.regularisation.roughness_error = plan.roughness_error;
  fit.regularisation.moments_error = plan.moments_error;
  return fit;
}

FoundLight SurfaceFits::fitted(const LightModel& start, const LightModel& ellipsoid,
                               int iterations) const {
  LightFit fit = fit_from(start);
  fit.most_iterations = iterations;
  FoundLight found = found_light(fit_light(fit));
  found.begun = ellipsoid;
  return found;
}

LightModel SurfaceFits::convex_of(const LightModel& ellipsoid) const {
  const ConvexPlan& plan = plan_.light.convex;
  return {ellipsoid.spin, ConvexShape::of(ellipsoid.ellipsoid(), plan.degree, plan.rows),
          ellipsoid.law};
}

FoundLight SurfaceFits::convex_from(const LightModel& ellipsoid) const {
  FoundLight found = fitted(convex_of(ellipsoid), ellipsoid, most_iterations_);
  found.ellipsoid = ellipsoid.ellipsoid();
  return found;
}

FoundLight SurfaceFits::mesh_from(const SpinState& spin, const LightModel& ellipsoid,
                                  int iterations) const {
  return fitted({spin, mesh_->shape, mesh_->law}, ellipsoid, iterations);
}

// The mesh with the mode, periods, pole and phases of an ellipsoid and of its images, in each of
// four half turns; without those whose periods the body of the mesh cannot have.
std::vector<SpinState> SurfaceFits::mesh_starts(const LightModel& ellipsoid) const {
  const SpinState& own = mesh_->spin;
  const Body body = Body::from_tensor(own.inertia_F);
  std::vector<SpinState> all;
  std::vector<LightModel> seen{ellipsoid};
  for (const LightImage i : images)
    seen.push_back(image_of(ellipsoid, i, geometry_.to_sun, geometry_.to_observer));
  for (const LightModel& one : seen) {
    try {
      TumblerState t = to_tumbler(free_rotation_of(one.spin), one.spin.t0);
      RotorState s;
      try {
        s = to_rotor(body, t);
      } catch (const DomainError&) {  // psi beyond what the body has, or no such periods
        const double most = t.psi0;
        t.psi0 = 0.0;
        const double limit = most_psi * psi_max(FreeRotation(body, to_rotor(body, t)));
        t.psi0 = std::isfinite(limit) ? std::clamp(most, -limit, limit) : most;
        s = to_rotor(body, t);
      }
      for (const Quaternion& r : half_turns) {
        const Vec3 g = rotate(conj(r), s.g), I = body.moments();
        const Quaternion& f = body.q_FB();
        all.push_back({one.spin.t0, normalized(s.q) * r * conj(f),
                       rotate(f, Vec3{g.x / I.x, g.y / I.y, g.z / I.z}), own.inertia_F});
      }
    } catch (const DomainError&) {  // no motion of the body has them
      continue;
    }
  }
  return all;
}

std::vector<FoundLight> SurfaceFits::from(const LightModel& ellipsoid) const {
  if (!mesh_) return {convex_from(ellipsoid)};
  std::vector<FoundLight> tried, found;
  for (const SpinState& spin : mesh_starts(ellipsoid))
    tried.push_back(mesh_from(spin, ellipsoid, short_iterations));
  std::erase_if(tried, [](const FoundLight& one) {
    return one.solution.result.end == LeastSquaresResult::End::no_value;
  });
  std::ranges::stable_sort(tried, {},
                           [](const FoundLight& one) { return one.solution.result.cost; });
  for (std::size_t k = 0; k < std::min(tried.size(), mesh_finalists); ++k)
    found.push_back(mesh_from(tried[k].solution.body.spin, ellipsoid, most_iterations_));
  return found;
}

bool SurfaceFits::is_known(const LightModel& body, const std::vector<LightModel>& known) const {
  return std::ranges::any_of(known, [&](const LightModel& one) {
    const SpinState s = mesh_ ? body.spin : nearest_of_same(one, body).spin;
    return norm(attitude_residual(one.spin.q, s.q)) < near_turn &&
           norm(s.w_F - one.spin.w_F) < near_rate * norm(one.spin.w_F);
  });
}

std::vector<FoundLight> SurfaceFits::from_images(const LightModel& ellipsoid,
                                                 const std::vector<LightModel>& known) const {
  std::vector<FoundLight> found;
  if (mesh_) {
    for (const SpinState& spin : mesh_starts(ellipsoid))
      if (!is_known({spin, ellipsoid.shape, ellipsoid.law}, known))
        found.push_back(mesh_from(spin, ellipsoid, most_iterations_));
    return found;
  }
  for (const LightImage i : images) {
    const LightModel image = image_of(ellipsoid, i, geometry_.to_sun, geometry_.to_observer);
    if (!is_known(image, known)) found.push_back(convex_from(image));
  }
  return found;
}

FoundLight SurfaceFits::from_file() const {
  return mesh_from(mesh_->spin, {mesh_->spin, Ellipsoid{1.0, 1.0, 1.0}, mesh_->law},
                   most_iterations_);
}

// Convex bodies turn with their facets; a mesh is another one after a half turn.
bool SurfaceFits::are_same(const FoundLight& a, const FoundLight& b) const {
  return are_same_spins(a, b, !mesh_, geometry_.time_base);
}

bool SurfaceFits::are_same_starts(const FoundLight& a, const FoundLight& b) const {
  return are_same_spins(a, b, true, geometry_.time_base);
}

}  // namespace detail

LightFit light_fit_at(const Scenario& scenario, const LightReport& report, std::size_t solution) {
  const FoundLight& found = report.solutions.at(solution);
  LightFit fit = detail::SurfaceFits(scenario, report.unknowns, report.observed.curves)
                     .fit_from(found.solution.body);
  if (found.solution.body.is_convex()) fit.regularisation.about = found.begun;
  return fit;
}

}  // namespace v0
}  // namespace polhode
