// SPDX-License-Identifier: MIT
#include "polhode/fit/mesh_fit.hpp"

#include <memory>
#include <string>

#include "fit/detail/light_outcome.hpp"
#include "fit/detail/surface_residuals.hpp"
#include "polhode/error.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/light/light_curve_checks.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace polhode {
inline namespace v0 {
namespace {

const std::string mesh_name = "fit_mesh: ";

// In standard errors: a facet that passes a terminator or the edge of a shadow bends the light, and
// a fit comes to rest between bends, some tenths of an error from the least.
constexpr double mesh_nearness = 1.0;

// Areas of a given mesh are no unknowns.
BrightnessGradient of_all(const FacetGradient& g) {
  return static_cast<const BrightnessGradient&>(g);
}

// A mesh as it is: nothing of it is unknown.
class MeshSurface {
 public:
  struct Shape {};

  explicit MeshSurface(ShadedMesh mesh) : mesh_(std::move(mesh)) {
    for (const Facet& f : mesh_.shape().facets()) {
      normals_.push_back(f.normal);
      areas_.push_back(f.area);
    }
  }

  std::size_t own() const { return 0; }
  std::size_t priors() const { return 0; }
  Shape shape_at(std::span<const double>) const { return {}; }
  void prior_numbers(const Shape&, std::span<const double>, std::span<double>, double*) const {}

  double brightness(const Shape&, const Scattering& law, const Vec3& s, const Vec3& o) const {
    return mesh_.brightness(law, s, o);
  }

  // That of the facets which are lit and seen. At the edge of a shadow, where a facet goes out as a
  // whole, the brightness has a jump and no derivative; what a finer mesh would lose there evenly
  // is left out. At a terminator nothing is missing: the light of a facet is 0 there.
  BrightnessGradient gradient(const Shape&, const Scattering& law, const Vec3& s, const Vec3& o,
                              std::span<double>) const {
    if (mesh_.is_shadowless()) return of_all(facet_gradient(normals_, areas_, law, s, o));
    const Vec3 sun = (1.0 / norm(s)) * s, observer = (1.0 / norm(o)) * o;
    std::vector<double> lit = areas_;
    for (std::size_t i = 0; i < lit.size(); ++i) {
      const bool faces = dot(normals_[i], sun) > 0.0 && dot(normals_[i], observer) > 0.0;
      if (!faces || mesh_.obstacles(i) == 0) continue;
      if (!mesh_.is_free(i, sun) || !mesh_.is_free(i, observer)) lit[i] = 0.0;
    }
    return of_all(facet_gradient(normals_, lit, law, s, o));
  }

 private:
  ShadedMesh mesh_;
  std::vector<Vec3> normals_;
  std::vector<double> areas_;
};

using MeshResiduals = detail::SurfaceResiduals<MeshSurface>;

void require_start(const MeshFit& fit) {
  detail::require_spin(mesh_name, fit.start.spin, fit.most_iterations);
  detail::require_law(mesh_name, fit.start.law, fit.multiple);
  if (fit.moments == MomentSource::shape)
    throw DomainError(mesh_name +
                      "moments cannot follow a shape that stays; give those of an even filling as "
                      "the start's (homogeneous_inertia), or fit them");
  if (fit.moments == MomentSource::fit)
    detail::require_diagonal(mesh_name, fit.start.spin, "the axes of the mesh");
  else
    static_cast<void>(Body::from_tensor(fit.start.spin.inertia_F));  // says what is wrong with it
}

detail::SurfaceUnknowns unknowns_of(const MeshFit& fit) {
  return {fit.moments == MomentSource::fit, fit.multiple};
}

// About the spin and the law of `body`.
std::shared_ptr<const MeshResiduals> residuals_about(const MeshFit& fit, const MeshSurface& surface,
                                                     const MeshModel& body, detail::Rows rows) {
  return std::make_shared<const MeshResiduals>(fit.curves, unknowns_of(fit), body.spin, body.law,
                                               surface, detail::FollowedMoments{}, fit.loss, rows);
}

void require_points(const MeshResiduals& r) {
  detail::require_points(mesh_name, r.curves().size(), r.unknowns(), r.curves().groups());
}

LeastSquares problem_about(const MeshFit& fit, const MeshSurface& surface, const MeshModel& body,
                           int most_iterations, detail::Rows rows) {
  const auto residuals = residuals_about(fit, surface, body, rows);
  const detail::SurfaceUnknowns unknowns = unknowns_of(fit);
  LeastSquares p;
  p.unknowns = detail::spin_unknowns(unknowns, body.spin, body.law);
  if (unknowns.moments) p.triangle = {unknowns.moments_at(), unknowns.moments_at() + 1};
  p.residuals.data = residuals->curves().size();
  p.residuals.at = [residuals](std::span<const double> x, std::span<double> numbers,
                               std::span<double> jacobian) {
    return residuals->at(x, numbers, jacobian);
  };
  p.loss = fit.loss;
  p.most_iterations = most_iterations;
  p.nearness = mesh_nearness;
  return p;
}

}  // namespace

Mat3 homogeneous_inertia(const FacetShape& shape) {
  Mat3 T = mass_properties(shape, 1.0).inertia;
  const double unit = T(2, 2);
  for (Vec3& row : T.row) row = (1.0 / unit) * row;
  return T;
}

MeshSolution fit_mesh(const MeshFit& fit) {
  require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  const MeshSurface surface(fit.start.shape);
  MeshSolution found{{}, fit.start};
  const auto first = residuals_about(fit, surface, fit.start, detail::Rows::held);
  require_points(*first);
  const detail::TurningFit turning{
      [&](int most_iterations) {
        return problem_about(fit, surface, found.body, most_iterations, detail::Rows::held);
      },
      [&](const std::vector<double>& x) {
        const auto residuals = residuals_about(fit, surface, found.body, detail::Rows::held);
        found.body.spin = residuals->spin_at(x);
        found.body.law = residuals->law_at(x);
      }};
  detail::settle(turning, fit.most_iterations, first->curves().groups(), found);
  if (found.result.end == LeastSquaresResult::End::no_value) return found;
  const auto last = residuals_about(fit, surface, found.body, detail::Rows::held);
  found.factors = first->curves().session_factors(last->brightness_at(found.result.x));
  detail::describe_motion(found.body.spin, found);
  return found;
}

LeastSquares least_squares_of(const MeshFit& fit) {
  require_sound(fit.curves, {.vectors = true});
  require_start(fit);
  const MeshSurface surface(fit.start.shape);
  require_points(*residuals_about(fit, surface, fit.start, detail::Rows::exact));
  return problem_about(fit, surface, fit.start, fit.most_iterations, detail::Rows::exact);
}

MeshModel body_at(const MeshFit& fit, std::span<const double> x) {
  const std::size_t count = unknowns_of(fit).own_at();
  if (x.size() != count)
    throw DomainError("body_at: got " + std::to_string(x.size()) + " unknowns; expected " +
                      std::to_string(count));
  const MeshResiduals residuals({}, unknowns_of(fit), fit.start.spin, fit.start.law,
                                MeshSurface(fit.start.shape));
  return {residuals.spin_at(x), fit.start.shape, residuals.law_at(x)};
}

std::vector<std::vector<double>> model_fluxes(const MeshModel& body,
                                              std::span<const LightCurve> curves,
                                              const Loss& loss) {
  require_sound(curves, {.vectors = true});
  const MeshResiduals residuals(curves, {}, body.spin, body.law, MeshSurface(body.shape), {}, loss);
  const Vec3& w = body.spin.w_F;
  const std::vector<double> B =
      residuals.brightness_at(std::vector<double>{0.0, 0.0, 0.0, w.x, w.y, w.z});
  if (B.empty()) throw DomainError("model_fluxes: the body has no motion");
  return residuals.curves().fluxes(B);
}

}  // namespace v0
}  // namespace polhode
