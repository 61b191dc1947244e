// SPDX-License-Identifier: MIT
// Tolerances of tests: runs.
#pragma once

namespace polhode::budget {

// --- a method from outside, Runge-Kutta of order 4 (tests/unit/dynamics/custom_method.cpp) ---
// Of the order; of the end of half a turn with steps of 0.005; inside steps of 0.01; of an event.
inline constexpr double custom_method_order = 0.3;
inline constexpr double custom_method_fine = 1e-6;
inline constexpr double custom_method_dense = 1e-5;
inline constexpr double custom_method_event = 1e-5;

// --- splittings (tests/unit/dynamics/splitting.cpp) ---
// Sum of the coefficients, in double-double, less 1.
inline constexpr double splitting_consistency = 1.2e-16;
// Against FreeRotation, forward and back, and against another frame, over ten turns: rad and
// |dg|/G.
inline constexpr double splitting_free = 2e-13;
// A hundred turns there and back, splittings and variation of constants.
inline constexpr double hundred_turns_back = 3e-13;
// |g|^2 and 2 T of a free body after 1e5 steps, relative: one rounding of a double is 1e-16.
inline constexpr double splitting_invariant = 4e-17;
// Slopes of the error, in orders.
inline constexpr double splitting_order_below = 0.3;
inline constexpr double splitting_order_above = 1.0;
inline constexpr double splitting_near_order = 0.5;
// Of the ratio 5 of two errors with torques in that ratio.
inline constexpr double splitting_proportion = 0.05;
// Dense output against steps of the same scheme.
inline constexpr double splitting_dense = 3e-15;
// The symplectic defect of one step of 1 rad, entry by entry over eps |M| |J| |M^T|.
inline constexpr double splitting_symplectic_eps = 50.0;
// The transition matrix of a step against central differences of step 1e-5.
inline constexpr double splitting_difference = 1e-8;

// --- runs (tests/unit/dynamics/integrate_test, tests/reference/libration) ---
// Attitude and momentum after some turns at tolerance 1e-12, and between the steps.
inline constexpr double adaptive_short_run = 1e-11;
inline constexpr double adaptive_dense = 1e-10;
// Times of zeros of functions of time near t = 1, and of touches, where a rounding of the function
// moves the time by its square root.
inline constexpr double time_of_zero = 1e-14;
inline constexpr double time_of_touch = 1e-7;
// The ends of a stretch at which a function differs from zero by roundings, next to t = 10.
inline constexpr double time_of_stretch = 1e-13;
// Of touches like another power: the value there, relative, of which its time is a root.
inline constexpr double value_of_touch = 1e-13;
// Times of events of a wing nut over ten flips, each of which makes an error of the state some
// thousand times larger: at 1e-12 and by exact methods; at 1e-6 over two flips.
inline constexpr double event_time = 1e-7;
inline constexpr double event_time_loose = 1e-2;
// Where a momentum that falls in a straight line comes to zero, t up to 10.
inline constexpr double event_time_of_line = 1e-11;
// And next to an orbit; at 1e-6; by a splitting of order 2.
inline constexpr double event_time_beside_orbit = 1e-8;
inline constexpr double event_time_beside_orbit_loose = 1e-2;
// What an event function is at its event, also inside a splitting's step of seven turns.
inline constexpr double event_residual = 1e-10;
// What leaving out one of two bodies must change.
inline constexpr double two_bodies_differ = 1e-3;
// Frequencies of libration at 1e-3 rad (linear theory) and of pitch at 0.5 rad (pendulum),
// relative.
inline constexpr double libration_frequency = 1e-6;
// Logarithm of the growth of an unstable pitch over seven e-foldings.
inline constexpr double libration_growth = 1e-3;

// --- Adaptive (tests/unit/dynamics/adaptive_*.cpp): radians plus relative momentum ---
inline constexpr double rotor_ode_free = 1e-13;
inline constexpr double rotor_ode_order = 0.8;
inline constexpr double rotor_ode_closed_form = 1e-13;
inline constexpr double rotor_ode_back_10 = 1e-12;
inline constexpr double rotor_ode_back_100 = 1e-10;
inline constexpr double rotor_ode_w1_tight = 1e-12;
inline constexpr double rotor_ode_w1_per_tolerance = 1e4;
inline constexpr double rotor_ode_dense = 1e-11;
inline constexpr double rotor_ode_frame_10 = 2e-14;
inline constexpr double rotor_ode_frame_1e4 = 1e-10;
inline constexpr double rotor_ode_edge = 1e-9;
// Behind the first of jumps at every rounding of t: some steps at the rounding pass, and grow.
inline constexpr double rotor_ode_jumps = 1e-3;
// Behind such a jump by 1e6 for a time of 1e-6: what the body turns meanwhile.
inline constexpr double valve_momentum = 1e-5;

// --- state transition matrices of runs (tests/unit/dynamics/adaptive_transition.cpp),
// relative to the largest entry ---
inline constexpr double transition_free = 1e-11;
inline constexpr double transition_difference = 1e-9;
inline constexpr double transition_symplectic = 1e-13;
// Of a splitting of order 8 with steps of 0.1 rad, and of the others, against Adaptive.
inline constexpr double transition_method = 1e-11;

// --- collocation (tests/unit/dynamics/collocation.cpp) ---
// Ten turns without torques; ten orbits at 1e-13; over the tolerance; every body at 1e-12; there
// and back; inside steps; after switches.
inline constexpr double collocation_free = 1e-13;
inline constexpr double collocation_ten_orbits = 1e-12;
inline constexpr double collocation_per_tolerance = 100.0;
inline constexpr double collocation_bodies = 1e-12;
inline constexpr double collocation_back = 1e-12;
inline constexpr double collocation_dense = 1e-12;
inline constexpr double collocation_switches = 1e-11;
// After 100 units of time with torques of 1e-6 that are fast or short, and with kinks.
inline constexpr double collocation_weak = 1e-11;
inline constexpr double collocation_kink = 1e-8;
// Times of events, and the slope of the error in orders.
inline constexpr double collocation_event = 1e-11;
// Twenty unnamed kinks or jumps at 1e-12; forty eclipses with penumbras.
inline constexpr double collocation_unnamed_edge = 2e-8;
inline constexpr double collocation_unnamed_edge_of_four = 1e-6;
inline constexpr double collocation_penumbra = 1e-9;
// Thirty orbits with penumbras and plates, 0.3 rad: per tolerance, and by rounding.
inline constexpr double collocation_penumbra_per_tolerance = 1e3;
inline constexpr double collocation_penumbra_floor = 1e-12;
inline constexpr double collocation_mesh = 5e-10;
// A damper of strong friction against 10,000 steps of Adaptive; derivatives against those of
// Adaptive, relative to the largest entry.
inline constexpr double collocation_friction = 1e-12;
inline constexpr double collocation_transition = 1e-10;
inline constexpr double collocation_order = 0.5;
// |q|^2, |g|^2 and the energy after 1e5 steps, relative.
inline constexpr double collocation_invariant = 3e-14;

// --- variation of constants (tests/unit/dynamics/variation.cpp) ---
inline constexpr double collocation_tableau = 3e-16;
inline constexpr double collocation_legendre = 2e-14;
// Against FreeRotation, forward and back, and against another frame, over ten turns.
inline constexpr double variation_free = 3e-14;
// Against double-double: ten orbits of the reference workload.
inline constexpr double variation_ten_orbits = 2e-14;
inline constexpr double splitting_ten_orbits = 2e-13;
inline constexpr double variation_bodies = 1.5e-14;
inline constexpr double variation_separatrix = 1e-14;
inline constexpr double variation_dense = 3e-15;
// Error after ten turns over the tolerance.
inline constexpr double variation_per_tolerance = 10.0;
// How near to a discontinuity the last step ends.
inline constexpr double variation_last_time = 1e-9;

// --- torque tables and internal damping along a run (tests/unit/dynamics/breakpoints.cpp) ---
// Steps backwards over those forwards: other places are cut short.
inline constexpr double steps_of_either_direction = 0.1;
// A second of torque in a day of 24 turns at the default tolerance.
inline constexpr double pulse_momentum = 1e-12;
inline constexpr double pulse_angle = 1e-8;
inline constexpr double table_momentum = 1e-12;

// --- torques that switch (tests/unit/dynamics/switches.cpp) ---
// Roundings of a light from 0 to 1, of a cosine, of a quarter turn of some 2.
inline constexpr double border_light = 1e-14;
inline constexpr double time_scale = 1e-13;
// Two plates in a turning stream, 53 edges in 200: the error over the tolerance, and below what
// double and the start of the reference leave.
inline constexpr double plates_per_tolerance = 4.0;
inline constexpr double plates_floor = 2e-13;
// Of the reference against itself with half its steps.
inline constexpr double plates_reference = 2e-14;
// Two mirrors behind a cylinder: momentum and angle relative to what the lit times give, over the
// tolerance and the number of orbits; and their floor.
inline constexpr double shadow_per_tolerance = 2.0;
inline constexpr double shadow_floor = 3e-12;
// A satellite behind the Earth for some days, against the run at tolerance 1e-15.
inline constexpr double cylinder_per_tolerance = 20.0;
// A torque that changes its sign: momentum and angle over the tolerance where it says its switches.
inline constexpr double bang_per_tolerance = 10.0;
inline constexpr double bang_floor = 2e-11;
// The same where it does not: its jumps are passed at the tolerance of a step each.
inline constexpr double bang_unnamed = 1e-8;
inline constexpr double bang_unnamed_loose = 1e-5;  // at tolerance 1e-8
// Derivatives across kinks against differences of two runs 2^-16 apart.
inline constexpr double switch_transition = 1e-6;
// What a strong damping leaves of a momentum of 1.
inline constexpr double at_rest = 1e-100;
// The difference of two times up to 1000.
inline constexpr double step_rounding = 1e-12;
// What a pulse of the width of a step leaves, at tolerance 1e-6.
inline constexpr double jet_gained = 1e-5;
// tan J, the momentum in space, the energy: at tolerance 1e-13.
inline constexpr double internal_damping_law = 1e-10;
inline constexpr double internal_damping_momentum = 1e-11;
inline constexpr double internal_damping_energy = 1e-12;
// Phase of a wobble that is not circular, over the length of its decay.
inline constexpr double internal_damping_wobble = 2e-3;
// The energy that a sphere in a cavity takes where it follows closely: of first order in J w / c.
inline constexpr double kane_limit = 2e-3;

// --- a state of the tests' own (tests/unit/dynamics/gyrostat.cpp) ---
// Momentum, energy and the wheel's angle over 200; states against long double and a closed form.
inline constexpr double gyrostat_invariants = 1e-12;
inline constexpr double gyrostat_motion = 1e-12;
// Two numbers (tests/unit/dynamics/small_models.cpp): 50 radians, and roots; what a step may be
// longer than its limit.
inline constexpr double small_model_motion = 2e-13;
inline constexpr double length_of_last_step = 1e-9;

// --- runs with a Kane damper (tests/unit/dynamics/kane_damper.cpp) ---
// Radians, relative momentum and relative rate of the sphere, at tolerance 1e-14, against two
// bodies in inertial axes in long double.
inline constexpr double kane_two_bodies = 1e-12;
// The energy lost against the quadrature of c |s|^2.
inline constexpr double kane_energy = 1e-11;
// What InternalDamping misses with J/c = 1.7e-4, and the ratio of that for twice the k, to the 4 of
// first order in J/c.
inline constexpr double kane_close = 1e-6;
inline constexpr double kane_first_order = 0.1;
inline constexpr double kane_rounding = 1e-15;
// python/tests/test_kane_damper.py: SciPy at its tolerance; a difference of the fourth order.
inline constexpr double kane_two_bodies_scipy = 1e-10;
inline constexpr double kane_slope = 1e-9;

// Terms linear in the momentum: order 6 with 500 steps beside Collocation; their effect beside the
// derivative of their energy.
inline constexpr double splitting_momentum_term = 1e-11;
inline constexpr double splitting_momentum_effect = 1e-14;

}  // namespace polhode::budget
