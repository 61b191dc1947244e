// SPDX-License-Identifier: MIT
// Tolerances of tests: free rotation.
#pragma once

namespace polhode::budget {

// --- the oracle of free rotation, 76 digits (tests/oracle) ---
// Against typed digits of another program (30 of them).
inline constexpr double oracle_typed_digits = 1e-30;
// Between two of its own ways, near the separatrix and after 1e12 radians too.
inline constexpr double oracle_agreement = 1e-56;
// Of a transition matrix against central differences of step 1e-25.
inline constexpr double oracle_differences = 1e-45;

// --- free rotation (tests/property), against the oracle ---
// Rotation angle, rad, and |dg|/G, in every set: hard cases, the separatrix, 1e9 turns.
inline constexpr double free_state = 2e-15;
inline constexpr double free_state_median = 4e-16;
// The same of bodies in lanes (tests/unit/free/propagate.cpp): in double but for the rates.
inline constexpr double free_many = 4e-15;
inline constexpr double free_many_median = 5e-16;
// G^2 - 2 T I2, relative, however much cancels: a few roundings of double-double.
inline constexpr double separatrix_distance = 0x1p-101;
// A kernel in double-double: rad, and relative to |g|; and derivatives of one in dual numbers,
// relative to the column that a variable moves the state by.
inline constexpr double free_double_double = 1e-28;
inline constexpr double free_dual = 1e-11;
// The same within 1e-8 of the separatrix, where slopes of the period are 1e8 times its own.
inline constexpr double free_dual_near_separatrix = 4e-10;
// The oracle past the edges (tests/unit/oracle/free_body.cpp), 1e25 turns included.
inline constexpr double oracle_edges = 1e-30;
// Of the phase, rad per rad, 4 x 2^-104 (2.0 were seen in 2,800 cases): beyond 1e15 turns it has
// fewer digits than the state.
inline constexpr double free_phase = 2e-31;
// State transition matrix over ten turns, each 3x3 block relative to its norm.
inline constexpr double free_transition = 2e-14;
// The library's doubles against the paper's formulas at 50 digits (tests/paper).
inline constexpr double free_attitude = 1e-14;

// --- parts of free rotation and its constants (tests/unit/free), in eps ---
// Rotation by a quaternion of a permutation of axes, a few products.
inline constexpr double axis_order_eps = 4.0;
// Sine and cosine of a reduced phase, against double-double; relative where they are near zero.
inline constexpr double reduced_sincos_eps = 1.0;
inline constexpr double reduced_sincos_relative_eps = 2.0;
// Energy and inertial momentum of a state, and other sums over it.
inline constexpr double free_invariants = 4e-15;
// What a rounding of the state at one time may be at another, over the sensitivity to it.
inline constexpr double free_carried_eps = 4.0;
// The same for rates prepared in double (short_arc), up to three turns.
inline constexpr double free_short_arc_eps = 8.0;
// The two forms of the Cayley-Klein series against each other and against sn, cn, dn.
inline constexpr double cayley_klein_eps = 8.0;
// Sadov's variables in lanes against those of the motion, over G and sin I; and the state again,
// over 1 - k^2 and sin I too.
inline constexpr double lane_sadov = 8e-15;
inline constexpr double lane_sadov_round_trip = 4e-14;
// The state of Sadov's variables in lanes against that of one set, over 1 - k^2.
inline constexpr double lane_rotor_of_sadov = 8e-15;
// Serret's elements in lanes: the state again, and that of one set, over 1 - k^2, the least
// difference of moments and sin I; t0 over the period and the first two.
inline constexpr double lane_serret_round_trip = 4e-15;
inline constexpr double lane_rotor_of_serret = 1e-15;
inline constexpr double lane_serret_t0 = 4e-15;
// Identities of the family of polhodes in double-double; slopes by dual numbers.
inline constexpr double family_eps = 32.0;
inline constexpr double family_derivative_eps = 64.0;
// A polhode found from its action, relative: far below the rounding of double.
inline constexpr double family_root = 1e-25;
// Tumbler to hub and back: periods and pole relative, angles, for |psi| <= 0.9 psi_max.
inline constexpr double tumbler_round_trip = 1e-13;
// Hub to tumbler and back next to the spins, where the periods hold half the digits of J: eps times
// this over J, and at most the second.
inline constexpr double tumbler_spin_eps = 4.0;
inline constexpr double tumbler_spin = 2e-7;
// Numbers published for real bodies: the last digit of a period, "about"; of the energy, what the
// last digits of the ratios 0.61 and 0.965 leave.
inline constexpr double apophis_period_h = 0.005;
inline constexpr double apophis_energy = 0.0013;
inline constexpr double toutatis_inclination_deg = 3.0;
// The largest of 4000 samples of psi against its limit, quadratic in the step.
inline constexpr double psi_max_by_sampling = 1e-5;
// Periods, rates, modulus and actions against closed forms and each other, relative.
inline constexpr double free_constants_eps = 4.0;

// rounding_sensitivity (tests/unit/free/propagate.cpp): in eps w t of a sphere; in eps a
// unit of time; and how many times larger it is a rounding away from the separatrix.
inline constexpr double sensitivity_least = 0.25;
inline constexpr double sensitivity_most = 4.0;
inline constexpr double sensitivity_of_a_turn = 0.1;
inline constexpr double sensitivity_at_separatrix = 1e9;

// --- Sadov's and Serret's sets (tests/property/flow_adapted_charts.cpp,
// tests/unit/free/flow_adapted_limits.cpp), momenta of order 1 ---
// Hub to set and back: floor + eps x this x what the Jacobian makes of the sizes.
inline constexpr double flow_round_trip = 1e-14;
inline constexpr double flow_round_trip_eps = 20.0;
// The symplectic defect of B, entry by entry over eps |B| |J| |B^T|.
inline constexpr double flow_canonical_eps = 4.0;
// Every column of the derivatives against tests/oracle/flow_adapted.hpp, over its largest entry: by
// its roundings and by those of the numbers, over the distance from where the sets are singular.
inline constexpr double flow_jacobian = 1e-13;
inline constexpr double flow_jacobian_eps = 16.0;
// The phase of the oracle: of a period, and of the momentum.
inline constexpr double flow_phase = 1e-6;
// Serret's elements exactly on the separatrix and for spin about b2; for spin about b1 or b3, where
// T holds J to sqrt(eps) only.
inline constexpr double serret_separatrix = 2e-14;
inline constexpr double serret_spin = 2e-8;
// Any of them where its numbers round J or I to the pole.
inline constexpr double flow_pole = 5e-8;
// At the edges (tests/property/chart_edges.cpp): hub to set and back where no pole is near;
// Serret's elements where T and G cannot tell the separatrix; tumblers, half of whose digits
// psi_max holds; the numbers against a thousand digits, relative, angles in rad, t0 in those of u.
inline constexpr double serret_edge = 3e-14;
inline constexpr double serret_beside_separatrix = 2e-7;
// Over the distances: eps times these over J and over |D2|/G^2; of Serret's set at most the third,
// within 2^-40.
inline constexpr double flow_pole_eps = 10.0;
inline constexpr double serret_separatrix_eps = 20.0;
inline constexpr double serret_next_to_separatrix = 1e-6;
inline constexpr double sadov_separatrix_eps = 0.1;
// Half ulps of each number of a set (tests/oracle/chart_conditioning.hpp): what is read is within
// an ulp of the number.
inline constexpr double chart_half_ulps = 2.0;
// Periods tell no tumbler nearer to the separatrix; a bound beyond the second says nothing.
inline constexpr double tumbler_untold = 2e-10;
inline constexpr double says_nothing = 0.1;
// Derivatives against those of the state in units of powers of two, relative.
inline constexpr double scaled_jacobian_eps = 4.0;
inline constexpr double tumbler_edge = 5e-7;
inline constexpr double flow_values = 1e-13;
// I_l of spin about the long axis, over I_g.
inline constexpr double sadov_long_spin = 1e-130;

}  // namespace polhode::budget
