// SPDX-License-Identifier: MIT
// fit_convex(): the last step from an ellipsoid of search_light: a convex body by the areas of its
// facets, with its spin state.
//
// Equations   flux = f sum of A_j S_h(n_j . o, n_j . s) in free rotation, A_j of GaussianImage,
//             each facet a patch (patch_brightness.hpp), f as in fit_light. Beside the data, as
//             residuals of priors: closure, sum A_j n_j / A over closure_error, A = sum A_j; the
//             products of the area tensor, sum A_j n_j n_j^T / A, over axes_error, so that axes F
//             are nearly those of inertia; roughness, l (l + 1) c_lm over roughness_error; and the
//             ratios of moments about those of the start.
//             Unknowns: the turn and w_F, ratios of moments, the weight of Lambert's law, c_lm with
//             l > 0; c_00 is part of the factors.
// Units       as fit_light; areas in units of the start's b = 1, moments in units of Izz.
// Domain      axes F are principal: inertia_F is diagonal. MomentSource::fit: moments of their own,
//             about those of the start to moments_error; start: those stay; shape: those of an even
//             filling of the body that is found, which follow the areas in derivatives and errors,
//             too, linear in them within a round of iterations; the fit has converged where they
//             are those of the body to 1e-5. A convex body that has the light of a hollow one is a
//             model of it, no more.
// Accuracy    derivatives: budget light_derivatives in tests/budgets/fit.hpp, of moments that
//             follow the shape convex_moments_by_areas; errors: covariance.hpp, under this
//             regularisation alone.
// Errors      DomainError as fit_light and GaussianImage; regularisation errors that are not above
//             0.
// Cost        facets (degree + 1)^2 flops a point and iteration: benchmarks/fit_light_curves.cpp;
//             moments that follow the shape take one convex_moments for ten iterations besides, and
//             some rounds.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/light/gaussian_image.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {

struct ConvexModel {
  SpinState spin;  // inertia_F is diagonal
  Scattering law;
  GaussianImage image;
  std::vector<double> coefficients;  // of `image`

  std::vector<double> areas() const { return image.areas(coefficients); }
  // The body itself, its centre of mass in the origin, along axes F.
  FacetShape mesh() const;
};

struct ConvexFit {
  std::vector<LightCurve> curves;
  EllipsoidModel start;
  int degree = 6;
  int rows = 8;  // 8 rows^2 facets
  MomentSource moments = MomentSource::fit;
  bool multiple = false;  // the weight of Lambert's law as an unknown
  double closure_error = 1e-3;
  double axes_error = 1e-2;
  double roughness_error = 3.0;
  double moments_error = 0.1;  // infinity: nothing is known of moments
  Loss loss;
  int most_iterations = 100;
  // Where the unknowns begin, if not at the ellipsoid of the start: its degree and rows are taken.
  // Priors stay about the start, so that a short fit can go on.
  std::optional<ConvexModel> from = std::nullopt;
};

struct ConvexSolution : LightOutcome {
  ConvexModel body;
};

ConvexSolution fit_convex(const ConvexFit& fit);

// The problem that it solves, for another optimiser or a sampler (residual_function.hpp), about the
// body that the fit begins with; regularisation is among its residuals, as priors. Moments of
// MomentSource::shape are those of the body at every x, one convex_moments each: no value where the
// areas close none, and DomainError where those of the start do. And the body at some values of the
// unknowns.
LeastSquares least_squares_of(const ConvexFit& fit);
ConvexModel body_at(const ConvexFit& fit, std::span<const double> x);

// Fluxes of the model at all points, session by session, with the best factor of each under a loss.
std::vector<std::vector<double>> model_fluxes(const ConvexModel& body,
                                              std::span<const LightCurve> curves,
                                              const Loss& loss = {});

// From the best ellipsoid of each pair of periods, be its cost what it may: the ellipsoid is
// wrong about real bodies, and an alias can suit it better; and from what the search reports
// besides, images and other poles. `how` without its start.
struct FoundConvex {
  std::size_t periods = 0;  // the place of those of the search
  ConvexSolution solution;
};
// By what was minimised (LeastSquaresResult::cost); those that did not converge last. `most` pairs
// of periods, those with the lowest costs of ellipsoids. `between` is called before each fit, in
// any of the threads; what it throws ends the fits.
std::vector<FoundConvex> fit_convex_of_periods(
    const LightSearchResult& found, const ConvexFit& how, int threads = 1,
    std::size_t most = std::numeric_limits<std::size_t>::max(),
    const std::function<void()>& between = {});

// How an even filling of the convex body would turn beside the moments that were fitted.
struct ShapeInertia {
  double Ixx, Iyy;  // over Izz, of the even filling about the axes F
  double axes_off;  // rad: the greatest angle between its principal axes and those of F
};
ShapeInertia shape_inertia(const ConvexModel& body);

}  // namespace v0
}  // namespace polhode
