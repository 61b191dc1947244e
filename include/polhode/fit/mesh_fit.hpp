// SPDX-License-Identifier: MIT
// fit_mesh(): light curves of a body of known shape to its spin state.
//
// Equations   flux = f B of a mesh in free rotation, f as in fit_light, B of
//             light/shaded_mesh.hpp: facets that shade or hide each other where it is not convex.
//             Derivatives by the attitude are those of the facets that are lit and seen, exact
//             between the directions at which a facet goes into shadow or comes out of it; what
//             comes and goes there is left out of them. Unknowns: the turn and w_F, and what
//             MeshFit names.
// Units       as fit_light.
// Domain      axes F are those of the mesh; inertia_F is any tensor along them
//             (homogeneous_inertia has that of an even filling), diagonal where moments are
//             unknown.
// Accuracy    derivatives: budget light_derivatives in tests/budgets/fit.hpp. The facets are those
//             of the body, which bend its light where they pass a terminator, so that a fit comes
//             to rest beside the least: converged is nearer than one standard error, or 1 of
//             chi-square. Shadows jump by the light of a facet: fine meshes keep that below the
//             errors of the data, and a fit that stalls in the jumps says that it did not converge.
// Errors      DomainError as fit_light; MomentSource::shape, as the shape does not change.
// Cost        that of the mesh at each point (benchmarks/brightness.cpp), some three times with
//             derivatives.
#pragma once

#include <span>
#include <vector>

#include "polhode/fit/light_fit.hpp"
#include "polhode/light/shaded_mesh.hpp"

namespace polhode {
inline namespace v0 {

struct MeshModel {
  SpinState spin;
  ShadedMesh shape;
  Scattering law;
};

// Of constant density about the centre of mass, along the axes of the mesh, in units of its Izz.
Mat3 homogeneous_inertia(const FacetShape& shape);

struct MeshFit {
  std::vector<LightCurve> curves;
  MeshModel start;
  MomentSource moments = MomentSource::start;  // or fit
  bool multiple = false;                       // the weight of Lambert's law as an unknown
  Loss loss;
  int most_iterations = 100;
};

struct MeshSolution : LightOutcome {
  MeshModel body;
};

MeshSolution fit_mesh(const MeshFit& fit);

// The problem that it solves, for another optimiser or a sampler (residual_function.hpp): turns are
// about the attitude of the start, factors of sessions the best ones. And the body at some values
// of the unknowns.
LeastSquares least_squares_of(const MeshFit& fit);
MeshModel body_at(const MeshFit& fit, std::span<const double> x);

// Fluxes of the model at all points, session by session, with the best factor of each under a loss.
std::vector<std::vector<double>> model_fluxes(const MeshModel& body,
                                              std::span<const LightCurve> curves,
                                              const Loss& loss = {});

}  // namespace v0
}  // namespace polhode
