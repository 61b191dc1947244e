// SPDX-License-Identifier: MIT
// One convex body or one mesh, from an ellipsoid.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fit/free_motion.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/snapshots.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/shape/mass_properties.hpp"
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

Ellipsoid ellipsoid_of(const Mat3& tensor) {
  const Vec3 I = Body::from_tensor(tensor).moments();
  double all[3] = {I.x, I.y, I.z};
  std::ranges::sort(all);
  const Ellipsoid e = homogeneous_ellipsoid(Vec3{all[0], all[1], all[2]}, 1.0);
  return {1.0, e.b / e.a, e.c / e.a};
}

SurfaceFits::SurfaceFits(const Scenario& scenario, const LightReport& report)
    : scenario_(scenario),
      plan_(require_fit(scenario)),
      report_(report),
      geometry_(geometry_of(report.observed.curves)),
      most_iterations_(plan_.light.most_iterations.value_or(usual_iterations)) {}

ConvexFit SurfaceFits::convex_fit(const EllipsoidModel& ellipsoid) const {
  const ConvexPlan& plan = plan_.light.convex;
  ConvexFit fit;
  fit.curves = report_.observed.curves;
  fit.start = ellipsoid;
  fit.degree = plan.degree;
  fit.rows = plan.rows;
  fit.moments = plan.moments;
  fit.multiple = report_.unknowns.multiple;
  fit.roughness_error = plan.roughness_error;
  fit.moments_error = plan.moments_error;
  fit.loss = plan_.loss;
  fit.most_iterations = most_iterations_;
  return fit;
}

SurfaceFound SurfaceFits::convex_from(const EllipsoidModel& ellipsoid) const {
  ConvexSolution found = fit_convex(convex_fit(ellipsoid));
  SurfaceFound one{{}, std::move(found.body), ellipsoid};
  static_cast<LightOutcome&>(one.solution) = std::move(found);
  one.solution.body = {one.convex->spin, ellipsoid.shape, one.convex->law};
  return one;
}

MeshFit SurfaceFits::mesh_fit(const SpinState& spin, int most_iterations) const {
  return {.curves = report_.observed.curves,
          .start = {spin, *report_.mesh, plan_.light.law},
          .moments = report_.unknowns.moments,
          .multiple = report_.unknowns.multiple,
          .loss = plan_.loss,
          .most_iterations = most_iterations};
}

SurfaceFound SurfaceFits::mesh_from(const SpinState& spin, const EllipsoidModel& ellipsoid,
                                    int most_iterations) const {
  MeshSolution found = fit_mesh(mesh_fit(spin, most_iterations));
  SurfaceFound one{{}, std::nullopt, ellipsoid};
  one.solution.body = {found.body.spin, ellipsoid.shape, found.body.law};
  static_cast<LightOutcome&>(one.solution) = std::move(found);
  try {
    one.solution.body.shape = ellipsoid_of(one.solution.body.spin.inertia_F);
  } catch (const DomainError& error) {
    one.solution.notes.push_back(std::string("no ellipsoid has these moments: ") + error.what());
  }
  return one;
}

// The mesh with the mode, periods, pole and phases of an ellipsoid and of its images, in each of
// four half turns; without those whose periods the body of the mesh cannot have.
std::vector<SpinState> SurfaceFits::mesh_starts(const EllipsoidModel& ellipsoid) const {
  const SpinState own = spin_state(scenario_.rotation());
  const Body body = Body::from_tensor(own.inertia_F);
  std::vector<SpinState> all;
  std::vector<EllipsoidModel> seen{ellipsoid};
  for (const LightImage i : images)
    seen.push_back(image_of(ellipsoid, i, geometry_.to_sun, geometry_.to_observer));
  for (const EllipsoidModel& one : seen) {
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

std::vector<SurfaceFound> SurfaceFits::from(const EllipsoidModel& ellipsoid) const {
  if (!report_.mesh) return {convex_from(ellipsoid)};
  std::vector<SurfaceFound> tried, found;
  for (const SpinState& spin : mesh_starts(ellipsoid))
    tried.push_back(mesh_from(spin, ellipsoid, short_iterations));
  std::erase_if(tried, [](const SurfaceFound& one) {
    return one.solution.result.end == LeastSquaresResult::End::no_value;
  });
  std::ranges::stable_sort(tried, {},
                           [](const SurfaceFound& one) { return one.solution.result.cost; });
  for (std::size_t k = 0; k < std::min(tried.size(), mesh_finalists); ++k)
    found.push_back(mesh_from(tried[k].solution.body.spin, ellipsoid, most_iterations_));
  return found;
}

bool SurfaceFits::is_known(const EllipsoidModel& body,
                           const std::vector<EllipsoidModel>& known) const {
  return std::ranges::any_of(known, [&](const EllipsoidModel& one) {
    const SpinState& s = report_.mesh ? body.spin : nearest_of_same(one, body).spin;
    return norm(attitude_residual(one.spin.q, s.q)) < near_turn &&
           norm(s.w_F - one.spin.w_F) < near_rate * norm(one.spin.w_F);
  });
}

std::vector<SurfaceFound> SurfaceFits::from_images(const EllipsoidModel& ellipsoid,
                                                   const std::vector<EllipsoidModel>& known) const {
  std::vector<SurfaceFound> found;
  if (report_.mesh) {
    for (const SpinState& spin : mesh_starts(ellipsoid))
      if (!is_known({spin, ellipsoid.shape, ellipsoid.law}, known))
        found.push_back(mesh_from(spin, ellipsoid, most_iterations_));
    return found;
  }
  for (const LightImage i : images) {
    const EllipsoidModel image = image_of(ellipsoid, i, geometry_.to_sun, geometry_.to_observer);
    if (!is_known(image, known)) found.push_back(convex_from(image));
  }
  return found;
}

SurfaceFound SurfaceFits::from_file() const {
  const SpinState spin = spin_state(scenario_.rotation());
  return mesh_from(spin, {spin, {1.0, 1.0, 1.0}, plan_.light.law}, most_iterations_);
}

bool SurfaceFits::are_same(const LightSolution& a, const LightSolution& b) const {
  if (report_.mesh) return are_same_spins(a, b, geometry_.time_base);
  // convex bodies turn with their facets; a mesh is another one after a half turn
  LightSolution near = b;
  near.body = nearest_of_same(a.body, b.body);
  return are_same_spins(a, near, geometry_.time_base);
}

}  // namespace detail

namespace {

void require_shape(const LightReport& report, LightPlan::Shape wanted) {
  if (report.shape == wanted) return;
  throw DomainError(std::string("the fit of a solution: got the shape ") +
                    detail::shape_word(report.shape) + "; expected " + detail::shape_word(wanted));
}

}  // namespace

LightFit ellipsoid_fit_at(const Scenario& scenario, const LightReport& report,
                          std::size_t solution) {
  require_shape(report, LightPlan::Shape::ellipsoid);
  return {report.observed.curves, report.solutions.at(solution).solution.body, report.unknowns,
          require_fit(scenario).loss};
}

ConvexFit convex_fit_at(const Scenario& scenario, const LightReport& report, std::size_t solution) {
  require_shape(report, LightPlan::Shape::convex);
  ConvexFit fit = detail::SurfaceFits(scenario, report).convex_fit(report.begun.at(solution));
  fit.from = report.convex.at(solution);
  return fit;
}

MeshFit mesh_fit_at(const Scenario& scenario, const LightReport& report, std::size_t solution) {
  require_shape(report, LightPlan::Shape::mesh);
  const EllipsoidModel& found = report.solutions.at(solution).solution.body;
  MeshFit fit =
      detail::SurfaceFits(scenario, report).mesh_fit(found.spin, detail::usual_iterations);
  fit.start.law = found.law;
  return fit;
}

}  // namespace v0
}  // namespace polhode
