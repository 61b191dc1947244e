// SPDX-License-Identifier: MIT
// FitPlan: what the tables [[observation]], [free], [fit], [light] and [simulate] of a scenario of
// kind "fit" say: what was observed, which numbers of the rotation are unknown, and how they are
// looked for.
//
// Equations   those of fit_spin (polhode/fit/spin_fit.hpp).
// Units       core units (polhode/text/units.hpp).
// Domain      unknowns in groups: attitude, rate, ratios of moments, products of inertia, about the
//             state at t = 0 in the body axes that the file gives vectors in. Means of priors that
//             are left out are the start's.
// Accuracy    a prior of Euler angles is taken to first order about the start.
// Errors      none; what is no plan is refused when the file is read.
// Cost        plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "polhode/detail/scenario/fit_drive.hpp"
#include "polhode/detail/scenario/light_plan.hpp"
#include "polhode/fit/spin_fit.hpp"
#include "polhode/scenario/observation_kind.hpp"
#include "polhode/scenario/rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

struct FitPlan {
  std::vector<Observation> observations;
  fit::SpinUnknowns unknowns;
  std::vector<fit::NormalPrior> priors;
  std::optional<fit::ObservedAttitude> attitude_prior;
  fit::Loss loss;
  int most_iterations = 200;
  std::int64_t starts = 1;          // the file's own first
  double rate_spread = 0.0;         // of the rates of the others, about that of the file
  double within = 0.0;              // chi-square above the least up to which solutions are reported
  std::size_t most_solutions = 20;  // that are listed and written
  std::uint64_t seed = 1;           // of starts
  std::uint64_t noise = 1;          // the seed of what simulations add
  LightPlan light;
  FitDrive drive;  // what of torques is unknown
  // The values that a fit may reject when it knows the observations.
  struct Places {
    Place unknowns, frame;
    std::vector<Place> perturbations;  // their kinds
    std::optional<Place> drive;        // the first parameter or jump
  };
  Places places = {};

  // Whether light curves are observed, and then nothing else is.
  bool has_light() const { return !observations.empty() && observations.front().light.has_value(); }
};

// DomainError if the kind of the scenario is another than "fit".
const FitPlan& require_fit(const Scenario& scenario);

// The state at t = 0 in the body axes that the file gives vectors in, relative to inertial axes.
fit::SpinState spin_state(const Rotation& rotation);

}  // namespace io
}  // namespace v0
}  // namespace polhode
