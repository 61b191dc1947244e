// SPDX-License-Identifier: MIT
// Sadov's action-angle variables (phi_l, phi_g, phi_h, I_l, I_g, I_h) of free rotation.
//
// Equations   [SA "actions"], [SA "IellSadov"], [SA "phiSadov"]; action by complete integrals of
//             the third kind, equal to Kinoshita's Heuman-Lambda form (tests/paper). In short-axis
//             mode I_l has the sign of the momentum along the short axis; in long-axis mode I_l >=
//             0 and `lobe` is the sign of the momentum along the long axis. phi_h = h, I_h = H, I_g
//             = G.
// Corrections [SA "transf. eqs"], [SA "quad L dl"]: docs/theory/errata.md.
// Units       angles in radians, (-pi, pi]; actions in those of the angular momentum.
// Domain      refers to the body axes sorted by moment (long, intermediate, short; a proper
//             permutation). Limits: spin about the short axis phi_l = 0, |I_l| = I_g, and about the
//             long axis phi_l = 0, I_l = 0 (to 1e-130 I_g); exact separatrix phi_l = 0 or pi by the
//             sign of g1 (the variables do not exist there); about the middle axis phi_l = +-pi/2;
//             sphere and rest: Andoyer's, I_l = L, phi_l = l - pi/2, phi_g = g; I = 0, pi:
//             phi_h = 0.
// Accuracy    budgets flow_round_trip, flow_round_trip_eps and flow_canonical_eps in
//             tests/budgets.hpp; measured: docs/accuracy/charts.md. Next to the separatrix the pair
//             (I_l, phi_l) itself cannot hold the state: digits are lost like log10(G^2 / |D2|),
//             and where |D2| < 1e-17 G^2 the place on the polhode. A needle loses it too where the
//             momentum along its axis, g1, is lost next to I_g: I_l = I_g - |g1| then holds g1 to
//             eps I_g / |g1| only. Any unit of momentum serves.
//             chart_jacobian has no meaning where the chart is singular (J = 0 or as close as I_g -
//             |I_l| rounds to it, I = 0, pi or as close as I_g - |I_h| rounds to it, the
//             separatrix): it is rank-deficient or not finite there.
// Errors      to_rotor throws DomainError for actions outside the region named, a lobe that is no
//             sign, moments of a ratio below 2^-900.
// Cost        to_sadov under a microsecond (tens for a steady rotation); to_rotor about a hundred
//             microseconds.
#pragma once

#include <span>

#include "polhode/free/free_rotation.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

enum class SadovRegion { short_axis, long_axis };

template <Real T>
struct BasicSadovState {
  T phi_l;
  T phi_g;
  T phi_h;
  T I_l;
  T I_g;
  T I_h;
  SadovRegion region = SadovRegion::short_axis;
  int lobe = 1;  // long-axis region: sign of the momentum along the long axis

  constexpr bool operator==(const BasicSadovState&) const = default;
};
using SadovState = BasicSadovState<double>;

// Constant rates of the angles: phi_l = n_l t + ..., phi_g = n_g t + ...; n_h = 0. n = dT/dI.
struct SadovFrequencies {
  double n_l;
  double n_g;
};

// [SA "actions", "IellSadov", "IellSadov, lambda > 1", "transf. eqs", "phiSadov", "quad L dl"]
SadovState to_sadov(const FreeRotation& motion, double t);
// Those of states of a body in the lanes of the processor, far from the separatrix (k'^2 > 1e-6)
// and from what else degenerates; of the others, one by one, those of the motion through each. The
// bits of a result depend on its state alone, and differ from those of the motion by rounding.
// DomainError as FreeRotation, with the state's index, for as many results as there are states, and
// for a set that this processor lacks.
void to_sadov(const Body& body, std::span<const RotorState> states, std::span<SadovState> results,
              InstructionSet set = widest_instruction_set());
// The same of one state.
SadovState to_sadov(const Body& body, const RotorState& state);

// [SA "Hamilton" in section 5]
SadovFrequencies sadov_frequencies(const FreeRotation& motion);

// [SA "inversion"]
RotorState to_rotor(const Body& body, const SadovState& s);
// The same of many in the lanes of the processor, far from the separatrix (k'^2 > 1e-6) and from
// what else degenerates; the others as one by one. The bits of a result depend on its set alone,
// and differ from those of one at a time by rounding. DomainError as to_rotor, with the state's
// index, for as many results as there are states, and for a set that this processor lacks.
void to_rotor(const Body& body, std::span<const SadovState> states, std::span<RotorState> results,
              InstructionSet set = widest_instruction_set());

// d(dtheta_B, dg_B) / d(phi_l, phi_g, phi_h, I_l, I_g, I_h), by dual numbers through to_rotor
// [SA "ActioTransf", "partialPhiU"].
Matrix6 chart_jacobian(const Body& body, const SadovState& s);

}  // namespace v0
}  // namespace polhode
