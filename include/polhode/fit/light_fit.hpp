// SPDX-License-Identifier: MIT
// fit_light(): light curves of a tumbling body to its spin state and shape, from one start. The
// shape is that of the start: an ellipsoid, a convex body of facets, or a mesh that is known.
//
// Equations   flux = f B(shape, law; q* s q, q* o q) in free rotation (polhode/free/). f is one
//             factor for each relative session and one for all calibrated ones, the best one at
//             every trial (variable projection), whose change is part of the derivatives: f = sum(w
//             F B) / sum(w B^2), and under a robust loss the f of the least sum of losses; of
//             several minima that cauchy may have, the one that descent meets from the weighted
//             median of F / B. Motion by dual numbers as fit_spin has it. Unknowns: the attitude at
//             t0 as a rotation vector, w_F, and what LightUnknowns names.
//             Ellipsoid: B of light/lambert.hpp; its unknowns are b/a and c/b.
//             Convex body: B = sum of A_j S_h(n_j . o, n_j . s), A_j of GaussianImage, each facet a
//             patch (patch_brightness.hpp); its unknowns are c_lm with l > 0, c_00 being part of
//             the factors. Beside the data, as residuals of priors: closure, sum A_j n_j / A over
//             closure_error, A = sum A_j; the products of the area tensor, sum A_j n_j n_j^T / A,
//             over axes_error, so that axes F are nearly those of inertia; roughness, l (l + 1)
//             (c_lm - usual) over roughness_error; and the ratios of moments about the usual ones.
//             Mesh: B of light/shaded_mesh.hpp; no unknowns. Derivatives by the attitude are those
//             of the facets that are lit and seen, exact between the directions at which a facet
//             goes into shadow or comes out of it; what comes and goes there is left out of them.
// Units       t that of the light curves, w rad per unit of time; fluxes at unit distances
//             (at_unit_distances in light/aspect.hpp), in any unit; moments in units of Izz, areas
//             in units of the b of the ellipsoid that a convex body begins with.
// Domain      axes F are those of the shape, and principal but for a mesh whose moments stay.
//             Moments of an even filling of an ellipsoid: 1 >= b/a >= 0.05, 1 >= c/b >= 0.05, so
//             that a is about the axis of the least moment; other moments: both between 0.05 and
//             20. Those of a convex body follow the areas, also in derivatives and errors, linear
//             in them within a round of iterations; the fit has converged where they are those of
//             the body to 1e-5. Times are free of light time.
// Accuracy    budget light_derivatives in tests/budgets/fit.hpp, where the motion is no degenerate
//             one, convex_moments_by_areas of moments that follow areas; errors: covariance.hpp, of
//             factors that follow, and of convex bodies only under their regularisation. The
//             facets of a mesh are those of the body, which bend its light where they pass a
//             terminator, so that a fit stops next to the minimum: converged is nearer than
//             one standard error, or 1 of chi-square. Shadows jump by the light of a facet: fine
//             meshes keep that below the errors of the data, and a fit that stalls in the jumps
//             says that it did not converge.
// Errors      DomainError as require_sound and solve; a start that no body has; fewer points than
//             unknowns and factors; regularisation errors that are not above 0; MomentSource::shape
//             of a mesh, which does not change.
// Cost        benchmarks/fit_light_curves.cpp: about 2 us a point and iteration; facets
//             (degree + 1)^2 flops of a convex body, whose moments take one convex_moments for ten
//             iterations besides where they follow; that of the mesh at each point
//             (benchmarks/brightness.cpp), about three times with derivatives.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/fit/inertia_from_periods.hpp"
#include "polhode/fit/light_model.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {

// The source of moments of inertia: the shape filled evenly, the start, or the
// unknowns Ixx/Izz and Iyy/Izz.
enum class MomentSource { shape, start, fit };

struct LightUnknowns {
  bool shape = true;  // b/a and c/b of an ellipsoid, facets of a convex body; a mesh is known
  MomentSource moments = MomentSource::shape;
  bool multiple = false;  // the weight of Lambert's law, that of Lommel and Seeliger's being 1
};

// The regularisation of a convex body: priors that keep it closed, along its axes and smooth.
struct Regularisation {
  double closure_error = 1e-3;
  double axes_error = 1e-2;
  double roughness_error = 3.0;
  double moments_error = 0.1;  // infinity: nothing is known of moments
  // The ellipsoid or convex body whose coefficients and moments are the usual ones; none: those of
  // the start. So a fit can go on from what another one found.
  std::optional<LightModel> about = std::nullopt;
};

struct LightFit {
  std::vector<LightCurve> curves;
  LightModel start;
  LightUnknowns unknowns;
  Loss loss;
  int most_iterations = 200;
  double first_step = 0.0;  // as LeastSquares
  Regularisation regularisation = {};
};

// A part of the sum that was minimised.
struct CostTerm {
  std::string name;
  double value;
};

// The greatest chi-square per degree of freedom, or square of the spread under a robust loss, at
// which a model is taken to describe the data.
inline constexpr double most_chi_square = 10.0;

struct LightSolution {
  LightModel body;  // of an ellipsoid a = 1
  LeastSquaresResult result;
  UnknownsCovariance covariance;  // of errors as they are given; turns about the body found
  std::vector<double> factors;    // of each session
  double degrees_of_freedom = 0.0;
  // How the body tumbles: periods are 0 where the regime has none.
  TumblerPeriods periods{};
  Vec3 pole;  // direction of the momentum, along I
  std::vector<std::string> notes;

  Loss loss;               // that was minimised
  std::size_t points = 0;  // numbers of data, with which those of the result begin
  // Terms of result.cost: "data" under the loss, and for convex bodies those that regularise them.
  std::vector<CostTerm> terms;

  // By which all errors of fluxes, and so those of the unknowns, would be as large as residuals: by
  // chi-square, or under a robust loss by the spread, as chi-square is that of the points it
  // spared. NaN where the data leave no degrees of freedom, fewer than 0.5.
  double error_factor() const;
  // The standard deviation of the residuals, in their errors, by the median of their sizes.
  double spread() const;
  // Whether error_factor()^2 is at most most_chi_square. Otherwise errors mean nothing.
  bool describes_data() const;
  // Nothing that did not converge counts as found.
  bool is_found() const { return result.is_converged(); }
};

LightSolution fit_light(const LightFit& fit);

// The problem that it solves, for another optimiser or a sampler (residual_function.hpp): turns are
// about the attitude of the start, factors of sessions the best ones under the loss of the fit;
// regularisation is among the residuals, as priors. Moments that follow the areas of a convex body
// are those of the body at every x, one convex_moments each: no value where the areas close none,
// and DomainError where those of the start do.
LeastSquares least_squares_of(const LightFit& fit);
// The body at some values of the unknowns.
LightModel body_at(const LightFit& fit, std::span<const double> x);

// The unknowns of a body, in the order of the covariance of a fit from `about`, which has the same
// shape.
std::vector<double> light_unknowns_at(const LightUnknowns& unknowns, const LightModel& about,
                                      const LightModel& body);

// Fluxes of the model at all points, session by session, with the best factor of each under a loss.
std::vector<std::vector<double>> model_fluxes(const LightModel& body,
                                              std::span<const LightCurve> curves,
                                              const Loss& loss = {});

}  // namespace v0
}  // namespace polhode
