// SPDX-License-Identifier: MIT
// Serret's elements (g0, h, -t0; G, H, T) of free rotation: canonical constants of the motion.
//
// Equations   [SA (36)-(62)]: u = n (t - t0), the base point of u and of the integral of cos J dl
//             is l = pi/2 (long-axis mode: the sign of g1 times pi/2), and g0 is Andoyer's g at
//             time t0.
// Corrections the base point of [SA (51)] must be u = 0: docs/theory/errata.md.
// Units       g0, h in radians, (-pi, pi]; G, H angular momentum, T energy, t0 time.
// Domain      refers to the body axes sorted by moment (long, intermediate, short; a proper
//             permutation). Short-axis mode: sign_g1 = 1, sign_g3 the sense of circulation;
//             long-axis mode the reverse; on the separatrix both signs say which of the four
//             branches. The elements are multivalued: t0 + a period goes with g0 + n_g times it; t0
//             nearest to t is returned. Limits: spin about the short or long axis t0 = t; about the
//             middle axis, where t0 is infinite, that of a momentum 2^-440 G away; across the axis
//             of an axisymmetric body (n = 0) t0 = t and g0 = g, and l is lost; sphere the same,
//             which to_rotor refuses, since T no longer gives J; I = 0, pi: h = 0. Within 2^-40 G^2
//             of the separatrix both signs say the branch; T within 2 eps of G^2/2I2 is read as
//             the separatrix itself.
// Accuracy    budgets flow_round_trip, flow_round_trip_eps, flow_canonical_eps and
//             serret_separatrix in tests/budgets.hpp; measured: docs/accuracy/charts.md. T and G
//             hold the distance to the separatrix and to the axes only to eps G^2: near an axis of
//             moment I the hub loses eps I / (J dI), dI the least difference to another moment, and
//             up to sqrt(eps I / dI); near the separatrix about eps G^2 / |D2|, half a period from
//             t0 the most, and within 2^-40 G^2 of it up to 1e-6. t0 holds a place on the polhode
//             to eps |t0| times the rate. chart_jacobian has no meaning where the chart is singular
//             (J = 0 or as close as T rounds to it, I = 0, pi, steady rotations): it is
//             rank-deficient or not finite there.
// Errors      to_serret throws DomainError where T or t0 is beyond double range, and where moments
//             are equal but for rounding so that G and T do not hold the state to 1e-6.
//             to_rotor throws DomainError for a T or G / I beyond double range, moments of a ratio
//             below 2^-900, G <= 0 (rest has no elements), |H| > G, T outside
//             [G^2/2I3, G^2/2I1], a sphere, signs that are not 1 or -1.
// Cost        tens of microseconds; of many in lanes, docs/accuracy/benchmarks.md.
#pragma once

#include <span>

#include "polhode/free/free_rotation.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

template <Real Number>
struct BasicSerretState {
  Number g0;
  Number h;
  Number t0;
  Number G;
  Number H;
  Number T;
  int sign_g1 = 1;  // signs of the momentum along sorted axes 1 and 3 at time t0
  int sign_g3 = 1;

  constexpr bool operator==(const BasicSerretState&) const = default;
};
using SerretState = BasicSerretState<double>;

// [SA (54), (58), (59), (62), "dimensionless", "SerTointerm", "Haminterm"]
SerretState to_serret(const FreeRotation& motion, double t);

// Those of states of a body, each at its time (or one for all), in the lanes of the processor, far
// from the separatrix (k'^2 > 1e-6) and from what else degenerates; of the others, one by one,
// those of the motion through each. The bits of a result depend on its state and time alone, and
// differ from those of the motion by rounding. DomainError as FreeRotation and to_serret, with the
// state's index, for as many results as there are states, and for a set that this processor lacks.
void to_serret(const Body& body, std::span<const RotorState> states, std::span<const double> times,
               std::span<SerretState> results, InstructionSet set = widest_instruction_set());

// The state at time t of the motion with these elements [SA (54), (62), "hge0"].
RotorState to_rotor(const Body& body, const SerretState& s, double t);
// The same of many, in lanes as far as t is within some half period of t0.
void to_rotor(const Body& body, std::span<const SerretState> states, std::span<const double> times,
              std::span<RotorState> results, InstructionSet set = widest_instruction_set());
// The motion itself, with epoch t0.
FreeRotation free_rotation(const Body& body, const SerretState& s);

// d(dtheta_B, dg_B)(t) / d(g0, h, -t0, G, H, T): canonical with -t0 as the third angle
// [SA (36), (41)].
Matrix6 chart_jacobian(const Body& body, const SerretState& s, double t);

}  // namespace v0
}  // namespace polhode
