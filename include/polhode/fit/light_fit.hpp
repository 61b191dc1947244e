// SPDX-License-Identifier: MIT
// fit_light(): light curves of a tumbling ellipsoid to its spin state and shape, from one start.
//
// Equations   flux = f B(shape, law; q* s q, q* o q) in free rotation (polhode/free/), B of
//             light/lambert.hpp. f is one factor for each relative session and one for all
//             calibrated ones, the best one at every trial (variable projection), whose change is
//             part of the derivatives: f = sum(w F B) / sum(w B^2), and under a robust loss the f
//             of the least sum of losses; of several minima that cauchy may have, the one that
//             descent meets from the weighted median of F / B. Motion by dual
//             numbers as fit_spin has it; brightness by brightness_gradient. Unknowns: the attitude
//             at t0 as a rotation vector, w_F, b/a and c/b, and what LightUnknowns names.
// Units       t that of the light curves, w rad per unit of time; fluxes at unit distances
//             (at_unit_distances in light/aspect.hpp), in any unit; moments in units of Izz.
// Domain      axes F are those of the ellipsoid and principal. Moments of an even filling: 1 >= b/a
//             >= 0.05, 1 >= c/b >= 0.05, so that a is about the axis of the least moment; other
//             moments: both between 0.05 and 20. Times are free of light time.
// Accuracy    budget light_derivatives in tests/budgets/fit.hpp, where the motion is no degenerate
//             one; errors: covariance.hpp, of factors that follow.
// Errors      DomainError as require_sound and solve; a start that no body has; fewer points than
//             unknowns and factors.
// Cost        benchmarks/fit_light_curves.cpp: some 2 us a point and iteration.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "polhode/fit/inertia_from_periods.hpp"
#include "polhode/fit/spin_fit.hpp"
#include "polhode/light/ellipsoid.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/light/scattering.hpp"

namespace polhode {
inline namespace v0 {

// Where moments of inertia come from: those of the ellipsoid filled evenly, those of the start, or
// unknowns Ixx/Izz and Iyy/Izz.
enum class MomentSource { shape, start, fit };

struct LightUnknowns {
  bool shape = true;  // b/a, c/b
  MomentSource moments = MomentSource::shape;
  bool multiple = false;  // the weight of Lambert's law, that of Lommel and Seeliger's being 1
};

struct EllipsoidModel {
  SpinState spin;  // inertia_F is diagonal
  Ellipsoid shape;
  Scattering law;

  // With the moments of an even filling.
  static EllipsoidModel homogeneous(double t0, const Quaternion& q, const Vec3& w_F,
                                    const Ellipsoid& shape, const Scattering& law = {});
};

struct LightFit {
  std::vector<LightCurve> curves;
  EllipsoidModel start;
  LightUnknowns unknowns;
  Loss loss;
  int most_iterations = 200;
  double first_step = 0.0;  // as LeastSquares
};

// A part of the sum that was minimised.
struct CostTerm {
  std::string name;
  double value;
};

// The greatest chi-square per degree of freedom, or square of the spread under a robust loss, at
// which a model is taken to describe the data.
inline constexpr double most_chi_square = 10.0;

// What every fit of light curves says beside its body.
struct LightOutcome {
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

struct LightSolution : LightOutcome {
  EllipsoidModel body;  // a = 1
};

LightSolution fit_light(const LightFit& fit);

// The problem that it solves, for another optimiser or a sampler (residual_function.hpp): turns are
// about the attitude of the start, factors of sessions the best ones under the loss of the fit. And
// the body at some values of the unknowns.
LeastSquares least_squares_of(const LightFit& fit);
EllipsoidModel body_at(const LightFit& fit, std::span<const double> x);

// The unknowns of a body, in the order of the covariance of a fit from `about`.
std::vector<double> light_unknowns_at(const LightUnknowns& unknowns, const EllipsoidModel& about,
                                      const EllipsoidModel& body);

// Fluxes of the model at all points, session by session, with the best factor of each under a loss.
std::vector<std::vector<double>> model_fluxes(const EllipsoidModel& body,
                                              std::span<const LightCurve> curves,
                                              const Loss& loss = {});

}  // namespace v0
}  // namespace polhode
