// SPDX-License-Identifier: MIT
// chaos_indicator: how fast a neighbouring motion leaves a given one. Lyapunov indicator and MEGNO
// of any system, along any run.
//
// Equations   d = (dtheta_B, dg_B / scale), the deviation of the hub, q -> q exp(dtheta_B / 2),
//             obeys dtheta' = dw + dtheta x w, dg' = dg x w + g x dw + du with dw = I^-1 dg + dv.
//             growth L(t) = ln |d(t)| / |d(0)|; Lyapunov indicator L / t (Benettin et al. 1976);
//             MEGNO Y(t) = (2/t) int_0^t s L'(s) ds = 2 L(t) - (2/t) int_0^t L ds and its mean
//             (1/t) int_0^t Y ds (Cincotta and Simo 2000): 2 for a regular motion, half the
//             exponent times t for a chaotic one. t counts from the start of the run.
// Units       rates per unit of time of the system; L and MEGNO are pure numbers.
// Domain      any problem; its events are not looked for. Adaptive and VariationOfConstants: the
//             variational equations. Collocation and Splitting: the derivative of their own steps.
//             Where a term works on double alone, or a splitting has terms that are not kicks, a
//             second motion at a small distance is carried along, and brought back when it has come
//             16 times nearer or farther; the result says which.
// Accuracy    that of the method, a step of the quadrature of L included; Collocation sums L at
//             the stages of its steps, which the motion alone decides, a splitting by trapezoids of
//             its steps. A finite run gives the exponent to about 1 / (number of
//             Lyapunov times).
// Errors      DomainError for what is no problem, for a tolerance below 1e-15, for a deviation that
//             is zero. A run that cannot go on: an outcome that says why, with the rows so far.
//             What a term or `progress` throws passes through.
// Cost        two to five times the run alone.
#pragma once

#include <string>
#include <vector>

#include "polhode/dynamics/integrate.hpp"

namespace polhode {
inline namespace v0 {
namespace analysis {

// A small turn about the body axes (rad) and a change of the momentum over the scale of momentum.
struct Deviation {
  Vec3 turn;
  Vec3 momentum;

  constexpr bool operator==(const Deviation&) const = default;
};

enum class DeviationBy { variational, neighbour };

struct ChaosOptions {
  // At the start; its length does not matter. In no direction that a body would be symmetric about.
  Deviation deviation = {{0.51, 0.33, 0.42}, {0.37, 0.29, 0.48}};
  // What a change of momentum is compared with: 0 is |g| at the start, or, at rest, sqrt(|u| I).
  double momentum_scale = 0.0;
  // Of a second motion, in the measure of the deviation.
  double distance = 1e-8;
  // Take a second motion even where derivatives are there.
  bool neighbour = false;
};

struct ChaosSample {
  double t;
  double growth;      // L
  double lyapunov;    // L / t; 0 at the start, as are the others
  double megno;       // Y
  double mean_megno;  // of Y over the run so far
};

struct ChaosIndicator {
  std::vector<ChaosSample> samples;
  DeviationBy by = DeviationBy::variational;
  Outcome outcome;
  Statistics statistics;
  std::string method;  // in words: provenance
  double momentum_scale = 0.0;

  // Those of the last sample; NaN where there is none.
  double lyapunov() const;
  double mean_megno() const;
  // 1 / lyapunov(): of a regular motion it grows with the run, as t / ln t.
  double lyapunov_time() const;
};

// Samples as for state_transitions: times from start towards stop; those outside are left out.
ChaosIndicator chaos_indicator(const Problem& problem, const SaveAt& samples,
                               const ChaosOptions& options = {}, const Progress& progress = {});

}  // namespace analysis
}  // namespace v0
}  // namespace polhode
