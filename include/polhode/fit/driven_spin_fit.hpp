// SPDX-License-Identifier: MIT
// fit_driven_spin(): attitude snapshots to the spin state of a body that does not turn freely:
// torques with unknown parameters, and jumps of its spin.
//
// Equations   those of System with the terms of the drive, by integrate(); the derivatives by every
//             unknown are those of the variational equations, d/dt (dq, dg) = J (dq, dg) + what the
//             unknown does to the rates, integrated beside the motion. Of a parameter of a torque
//             that is its effect with the parameter one step on less its effect, over the step,
//             which is exact since effects are affine in each parameter; of a moment the same at
//             a fixed rate w. A jump acts just after its time: g + I dw, or g + dL. Residuals and
//             priors: spin_fit.hpp.
// Units       t as that of the observations; moments, momenta and torques in one consistent set,
//             given by the tensor of the start, of which Izz stays: torques over Izz are what data
//             tell.
// Domain      terms that work on dual numbers (a state transition matrix asks for the same), in
//             inertial axes, whose effects are affine in every parameter (components of a torque,
//             GM, a pressure, a tensor of eddy currents or of friction) and, with unknown ratios of
//             moments, in the moments at a fixed rate (all of the library's but internal damping);
//             none that jumps where the state says so (looked for by its switching functions, at
//             some hundred attitudes and rates): derivatives would lack the change of that time.
//             Products of inertia are no unknowns; the ratios are where the tensor is diagonal. The
//             rate of the start is I^-1 g.
// Accuracy    budgets fit_driven* in tests/budgets/fit.hpp; derivatives to the tolerance of the
//             drive, relative to their column.
// Errors      DomainError as fit_spin(); for a drive that it cannot take, naming the parameter, the
//             term or the jump, and for jumps outside the observations.
// Cost        a trial step one run of integrate(), 1 to 3 us a radian of rotation; an iteration 50
//             us a radian for each six unknowns, and 180 where among them are moments and GM of
//             gravity along an orbit (benchmarks/fit_driven.cpp).
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "polhode/fit/spin_fit.hpp"
#include "polhode/perturb/any_perturbation.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

struct TorqueParameter {
  std::string name;  // as reports and priors call it
  double start = 0.0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// A jump of the spin just after t: three unknowns, NAME[0] to NAME[2].
struct SpinJump {
  // In body axes F: of the rate w_F, or of the angular momentum; or of that in inertial axes.
  enum class Of { rate, body_momentum, inertial_momentum };
  std::string name;
  double t = 0.0;
  Of of = Of::rate;
  Vec3 change;  // at the start
};

// What drives a body beside its free rotation.
struct SpinDrive {
  // The terms at values of the parameters, always as many, in one order, in the principal axes of
  // the body; a DomainError for values that they cannot have.
  std::function<std::vector<AnyPerturbation>(std::span<const double> parameters)> terms;
  std::vector<TorqueParameter> parameters;
  std::vector<SpinJump> jumps;
  Quaternion q_FB;  // principal axes of the terms to F: where the tensor is diagonal, none
  double tolerance = 1e-12;
};

// Unknowns are those of `fit`, then the parameters, then the jumps; priors may name each.
SpinSolution fit_driven_spin(const SpinFit& fit, const SpinDrive& drive);

// The problem that it solves, for another optimiser or a sampler (residual_function.hpp): turns are
// about the attitude of the start. And the state at some values of the unknowns.
LeastSquares least_squares_of(const SpinFit& fit, const SpinDrive& drive);
SpinState state_at(const SpinFit& fit, const SpinDrive& drive, std::span<const double> x);

// The parameters and the jumps of the drive as a solution has them.
SpinDrive solved_drive(const SpinFit& fit, const SpinDrive& drive, const SpinSolution& solution);

// As unknowns_at() of spin_fit.hpp, of a solution: for mahalanobis(), and tables.
std::vector<double> unknowns_at(const SpinFit& fit, const SpinDrive& drive, const SpinState& about,
                                const SpinSolution& solution);

// The state at a time, and the covariance of its rotation vector in body axes that the fit leaves.
// Times may lie before the first observation and after the last.
std::vector<PredictedAttitude> predicted(const SpinFit& fit, const SpinDrive& drive,
                                         const SpinSolution& solution,
                                         std::span<const double> times);

// The motion of a start under a drive with its own numbers; covariances are 0.
std::vector<PredictedAttitude> driven_attitudes(const SpinState& start, const SpinDrive& drive,
                                                std::span<const double> times);

// The state at t0 that a body without jumps would need to move as that of the solution does after
// its last jump.
SpinState after_jumps(const SpinFit& fit, const SpinDrive& drive, const SpinSolution& solution);

}  // namespace fit
}  // namespace v0
}  // namespace polhode
