// SPDX-License-Identifier: MIT
// fit_spin(): attitude snapshots to a spin state with its uncertainty.
//
// Equations   the exact free rotation (polhode/free/) of q, w_F and I_F; residuals on the group,
//             the rotation vector of q_seen* q in body axes, whitened by its covariance; of a
//             direction the angle to it as a vector of its tangent plane; of a rate the difference.
//             Derivatives by dual numbers through prepare() and evaluate(), moments included; the
//             unknown attitude is a rotation vector about the present one. Least squares:
//             least_squares.hpp.
// Units       t as that of the observations, w rad per unit of time; inertia in any unit, since
//             only ratios act: unknowns are Ixx/Izz, Iyy/Izz, Ixy/Izz, Iyz/Izz, Ixz/Izz.
// Domain      a start with a rate that is not 0 and an inertia tensor in body axes F that a body
//             may have. Moment ratios keep the triangle inequality of the diagonal as bounds; a
//             step to a tensor that no body has is not taken. Where the form of the motion differs
//             for neighbours (equal moments, spin about an axis, separatrix), derivatives are those
//             1e-8 beside it. Products of inertia, and ratios where there are products, are no
//             unknowns of a tensor with equal moments.
// Accuracy    derivatives: budgets fit_derivatives* in tests/budgets/fit.hpp; errors:
//             covariance.hpp.
// Errors      DomainError as solve() and check(Snapshots); for no unknowns, a start that no body
//             has, names of priors that are no unknowns.
// Cost        0.1 ms an iteration and some us an observation: 2 ms for 17 attitudes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/fit/least_squares.hpp"
#include "polhode/fit/snapshots.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

struct SpinState {
  double t0 = 0.0;
  Quaternion q;  // body axes F to inertial axes
  Vec3 w_F;
  Mat3 inertia_F = Mat3::identity();
};

// What is fitted; the rest stays as at the start.
struct SpinUnknowns {
  bool attitude = true;       // turn_x, turn_y, turn_z: rad, about the start
  bool rate = true;           // w_x, w_y, w_z
  bool moment_ratios = true;  // Ixx/Izz, Iyy/Izz
  bool products = false;      // Ixy/Izz, Iyz/Izz, Ixz/Izz; of the tensor: Ixy = -int x y dm
};

struct SpinFit {
  SpinState start;
  Snapshots seen;
  SpinUnknowns unknowns;
  // Of rates, ratios and products, by their names; and of the attitude at t0 (whose t is not read).
  std::vector<NormalPrior> priors;
  std::optional<ObservedAttitude> attitude_prior;
  Loss loss;
  double error_factor = 1.0;   // errors of observations are multiplied by it, those of priors not
  bool scales_errors = false;  // and by that which makes chi-square per degree of freedom 1
  int most_iterations = 200;
};

struct SpinSolution {
  SpinState state;
  LeastSquaresResult result;
  // About `state`: turns are about its attitude.
  UnknownsCovariance covariance;
  double error_factor = 1.0;
  double degrees_of_freedom = 0.0;
  // Of the residuals of attitudes, per axis, in rad; NaN without attitudes.
  double attitude_rms = 0.0;
  // Observations that come twice, unknowns that are not determined: a sentence each.
  std::vector<std::string> notes;
  // Ratios of moments and products that stay at the start, as one rotation about a fixed axis of
  // the body describes the data as well. Their variances are infinite; errors of the rest, those of
  // predictions included, are for these moments.
  std::vector<std::string> held;

  // Nothing that did not converge counts as found.
  bool is_found() const { return result.is_converged(); }
};

SpinSolution fit_spin(const SpinFit& fit);

// The problem that it solves, for another optimiser or a sampler (residual_function.hpp): turns are
// about the attitude of the start. And the state at some values of the unknowns.
LeastSquares least_squares_of(const SpinFit& fit);
SpinState state_at(const SpinFit& fit, std::span<const double> x);

// The unknowns of a fit at a state, in the order of its covariance: turns from `about`. For
// mahalanobis(), and tables.
std::vector<double> unknowns_at(const SpinFit& fit, const SpinState& about, const SpinState& state);

// The state at a time, and the covariance of its rotation vector in body axes that the fit leaves.
struct PredictedAttitude {
  double t = 0.0;
  Quaternion q;
  Vec3 w_F;
  Mat3 covariance;
};
std::vector<PredictedAttitude> predicted(const SpinFit& fit, const SpinSolution& solution,
                                         std::span<const double> times);

// The rotation vector of the attitude that was seen to the one that is predicted, in body axes.
Vec3 attitude_residual(const Quaternion& seen, const Quaternion& predicted);

}  // namespace fit
}  // namespace v0
}  // namespace polhode
