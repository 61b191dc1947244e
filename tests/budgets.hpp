// SPDX-License-Identifier: MIT
// Every tolerance of every test, by name: one header a layer. Nothing is typed in a test.
#pragma once

#include "budgets/analysis.hpp"
#include "budgets/cli.hpp"
#include "budgets/dynamics.hpp"
#include "budgets/elliptic.hpp"
#include "budgets/ephemeris.hpp"
#include "budgets/frame.hpp"
#include "budgets/free.hpp"
#include "budgets/io.hpp"
#include "budgets/math.hpp"
#include "budgets/ode.hpp"
#include "budgets/orbit.hpp"
#include "budgets/paper.hpp"
#include "budgets/perturb.hpp"
#include "budgets/python.hpp"
#include "budgets/rotor.hpp"
#include "budgets/secular.hpp"
#include "budgets/series.hpp"
#include "budgets/shape.hpp"
#include "budgets/system.hpp"
namespace polhode::budget {

// --- numbers (tests/unit/math): relative errors in units of epsilon<T>(), 2^-52 of double and
// 2^-104 of DoubleDouble ---
inline constexpr double double_double_constant = 0.125;
inline constexpr double double_double_arithmetic = 1.0;
inline constexpr double double_double_functions = 2.0;
inline constexpr double dual_derivative = 4.0;

// --- numbers with an exponent of their own (tests/unit/math/wide_range.cpp), relative ---
inline constexpr double wide_range = 4e-16;

// --- elliptic kernels (tests/unit/elliptic): relative errors in units of epsilon<T>(), 2^-52 of
// double and 2^-104 of DoubleDouble ---
inline constexpr double elliptic_carlson = 4.0;
inline constexpr double elliptic_carlson_derivative = 10.0;
inline constexpr double elliptic_complete = 4.0;
inline constexpr double elliptic_complete_derivative = 16.0;
inline constexpr double elliptic_nome = 4.0;
inline constexpr double elliptic_heuman = 4.0;
inline constexpr double elliptic_legendre = 4.0;
inline constexpr double elliptic_legendre_derivative = 6.0;
// Any angle, m < 0, m > 1, n > 1, ends of the range.
inline constexpr double elliptic_beyond = 8.0;
inline constexpr double elliptic_beyond_derivative = 40.0;
// From Python, against mpmath, relative.
inline constexpr double elliptic_python = 4e-15;
// Of sn, cn, dn: over |f| + |u f'|, what one rounding of f and of u does. Of their derivatives:
// over
// 1 + |u|.
inline constexpr double elliptic_jacobi = 3.0;
inline constexpr double elliptic_jacobi_derivative = 20.0;

// --- facet shapes (tests/unit/shape), in eps of mass x size^degree; extrapolated ellipsoid ---
inline constexpr double shape_mass = 8.0;
inline constexpr double shape_limit = 1e-6;

// Spin axes over ages (tests/unit/secular/spin_precession.cpp).
inline constexpr double secular_rounding = 1e-14;
// Precession of Saturn, arcsec a year: its spin rate is that of the magnetic field.
inline constexpr double secular_printed = 5e-19;  // rad/s, half of the last digit of VPLanet's
inline constexpr double secular_saturn = 1e-3;
// A HistoryOrbit whose elements stay against Kepler's orbit, lengths in units of a.
inline constexpr double history_orbit = 2e-12;
// The mean over the orbit leaves out what goes as 1 / n: the ratio of two errors; the mean over
// the rotation: rad over ten years of 200 / (2 pi) turns; splitting of 0.02 years over 100.
inline constexpr double averaging_order = 0.2, averaging_rotor = 1e-5, averaging_methods = 1e-9;
// Tides over ages (tests/unit/secular/tidal_spin.cpp): m a year, s a century; relative; rad.
inline constexpr double tidal_recession = 1e-3, tidal_day = 3e-4;
inline constexpr double tidal_momentum = 1e-11;
inline constexpr double tidal_methods = 1e-9;
inline constexpr double tidal_long_steps = 1e-11;
inline constexpr double satellite_constant = 1e-12;  // of itself
inline constexpr double tidal_file = 2e-9;           // 400 Myr, against Runge and Kutta's method
inline constexpr double secular_table = 1e-12;       // rows of 1 kyr, lines down to 70 kyr
inline constexpr double secular_constant_orbit = 2e-12;  // 20 rad
inline constexpr double secular_axes = 1e-11;            // two sets of axes over 5 Myr
inline constexpr double secular_splitting = 1e-10;       // against the adaptive method, 5 Myr
inline constexpr double secular_order = 0.35;            // of a measured order
inline constexpr double secular_length = 1e-15;          // of the axis after 1e9 years
inline constexpr double secular_earth_constant = 0.02;   // arcsec/yr, published to 1e-3 of it
inline constexpr double secular_moon_constant = 0.4;  // arcsec/yr: 1 % of it, as is the mean orbit
inline constexpr double secular_geodetic = 1e-4;      // arcsec/yr
inline constexpr double secular_general = 1e-4;       // deg a century
// Orbits that the library brings along, against La2004 (tests/unit/secular/shipped_orbit.cpp):
// chaotic, and so worse with every million years.
inline constexpr double shipped_orbit_recent = 1e-4;   // of e, over 1 Myr
inline constexpr double shipped_orbit_5_myr = 1e-3;    // of e
inline constexpr double shipped_orbit_100_kyr = 3e-3;  // deg of obliquity, no tides
inline constexpr double shipped_orbit_1_myr = 0.02;    // deg of obliquity, with the tidal drift
inline constexpr double planet_obliquity = 5e-3;       // deg: published to 0.01
inline constexpr double planet_rate = 0.01;            // arcsec/yr of 7.6: the spread of sources
inline constexpr double insolation_mean = 1e-5;        // of sums over 4000 moments of a day
inline constexpr double insolation_flux = 1e-9;        // of sums over the sphere and the year
// Leading frequencies (tests/unit/analysis/spectrum.cpp): rad per sample, relative, rad.
inline constexpr double spectrum_frequency = 1.5e-14;  // 3e-12 arcsec/yr of samples of 1 kyr
inline constexpr double spectrum_amplitude = 1e-9;
inline constexpr double spectrum_phase = 1e-9;
inline constexpr double spectrum_python = 1e-12;  // rad per unit of time
inline constexpr double spectrum_cli = 1e-13;     // rad per kyr
inline constexpr double spin_axes_deg = 1e-9;     // files, where the closed form is known
inline constexpr double spectrum_noise = 5.0;     // errors found, in those told
// The same in Python: 28 of Laskar's 160 terms against La2004, rad; methods and tables.
inline constexpr double la2004_obliquity = 3.2e-3;
inline constexpr double la2004_climatic = 6e-3;
inline constexpr double spin_methods = 1e-10;
inline constexpr double spin_length = 1e-15;

// --- light and air on facets (tests/unit/perturb/surface.cpp) ---
inline constexpr double surface_eps = 40.0;
inline constexpr double surface_ball = 1e-4;
// Of a ball of 512 facets, across the stream.
inline constexpr double surface_mesh = 1e-3;
inline constexpr double surface_slope = 1e-7;
inline constexpr double shadow_counted = 1e-4;
// Discs on the sphere as circles in a plane, 400 km above the Earth.
inline constexpr double shadow_plane = 2.3e-4;
// Against 600 x 600 points; error of the library relative to area times size.
inline constexpr double yorp_brute_force = 1e-3;
inline constexpr double yorp_quadrature = 1e-12;
inline constexpr double yorp_not_zero = 1e-4;  // what a body that emits has at least
// Of the series to degree 3000, whose terms fall with the third power.
inline constexpr double yorp_series = 5e-12;

// --- the paper's equations, at 50 digits (tests/paper) ---
// Identities without a derivative or an integral.
inline constexpr double paper_exact = 1e-45;
// Identities with central differences of step 1e-16, at most of a quadrature.
inline constexpr double paper_derivative = 1e-28;
// Identities with a quadrature.
inline constexpr double paper_quadrature = 1e-33;
// A printed form counts as wrong when it misses by at least this much.
inline constexpr double paper_misprint = 1e-2;
// The library's doubles against 50 digits, at states where no chart is near a pole.
inline constexpr double paper_library = 4e-15;
// Of Serret's and Sadov's sets, at |D2| > 0.02 G^2.
inline constexpr double paper_library_adapted = 1e-14;

// --- body and charts (tests/unit/rotor, tests/property/chart_*), G = 1 ---
// Moments and reassembled tensor against the tensor given, relative to the largest moment.
inline constexpr double body_tensor = 4e-15;
// Direction of principal axes whose moments differ by a fifth.
inline constexpr double body_axes = 1e-14;
// A rotation matrix rounded to float.
inline constexpr double float_matrix = 2e-7;
// A few roundings: conversions at points where they are well conditioned.
inline constexpr double chart_rounding = 3e-15;
// Andoyer round trip of the hub where sin I, sin J > 0.09, relative.
inline constexpr double andoyer_generic = 5e-14;
// What L, G, H cannot hold: attitude and momentum within min(eps x this / J, andoyer_pole).
inline constexpr double andoyer_pole_eps = 3.0;
inline constexpr double andoyer_pole = 3e-8;
// g +- l +- h near the poles, and its limit at 1e-9 from them.
inline constexpr double andoyer_sum = 4e-15;
inline constexpr double andoyer_limit = 4e-9;
// Transverse momentum near theta = 0, pi: eps x this |Psi| / sin theta.
inline constexpr double euler_pole_eps = 2.0;
// Poincare-type sets, round trip of the hub within 90 degrees of their poles.
inline constexpr double poincare = 1e-14;
// At the poles that a set is not made for.
inline constexpr double poincare_far_pole = 1e-7;
// Chart to chart and back: floor + eps x this x what the inverse Jacobians make of the sizes.
inline constexpr double round_trip_floor = 1e-14;
inline constexpr double round_trip_eps = 20.0;
// |M J M^T - J| in units of eps (|M| |J| |M^T|), entry by entry; at a hub state, and of B at the
// chart's own numbers.
inline constexpr double symplectic_eps = 4.0;
inline constexpr double own_symplectic_eps = 4.0;
// A product of Jacobians rounded to double, in eps of its terms.
inline constexpr double given_jacobian_eps = 4.0;
// Entries of B, relative, and what a zero of the differences may be.
inline constexpr double jacobian_eps = 1.0;
inline constexpr double jacobian_zero = 1e-30;
// Within 2^-40 of a pole of the chart; the entries that grow or stay.
inline constexpr double pole_jacobian_eps = 4.0;

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
// G^2 - 2 T I2, relative, however much cancels: a few roundings of double-double.
inline constexpr double separatrix_distance = 0x1p-101;
// A kernel in double-double: rad, and relative to |g|; and derivatives of one in dual numbers,
// relative to the column that a variable moves the state by.
inline constexpr double free_double_double = 1e-28;
inline constexpr double free_dual = 1e-11;
// The same within 1e-8 of the separatrix, where slopes of the period are 1e8 times its own.
inline constexpr double free_dual_near_separatrix = 4e-10;
// The oracle past the edges (tests/unit/oracle/free_edge_cases.cpp), 1e25 turns included.
inline constexpr double oracle_edges = 1e-30;
// Of the phase, rad per rad, 4 x 2^-104 (2.0 were seen in 2,800 cases): beyond 1e15 turns it has
// fewer digits than the state.
inline constexpr double free_phase = 2e-31;
// State transition matrix over ten turns, each 3x3 block relative to its norm.
inline constexpr double free_transition = 2e-14;
// The library's doubles against the paper's formulas at 50 digits (tests/paper).
inline constexpr double free_attitude = 1e-14;

// --- angles beyond the 32-digit reduction (tests/unit/math) ---
inline constexpr double large_angle = 2e-16;

// --- light on a turning plate (python/tests/test_switches.py) ---
// What a weak torque adds to g, relative, at loose tolerances: some roundings of g.
inline constexpr double turning_plate = 1e-6;

// --- text and files (tests/unit/text, tables, output, scenario, run) ---
// A state read from text against the same state built directly; momentum of order ten.
inline constexpr double io_state = 4e-15;
// Serret elements of two states of one motion.
inline constexpr double io_elements = 4e-14;
// Columns of a row of `convert` after a round trip through another chart, numbers of order one.
inline constexpr double io_convert = 4e-15;

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

// rounding_sensitivity (tests/unit/free/rounding_sensitivity.cpp): in eps w t of a sphere; in eps a
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

// --- frames and osculation (src/system): tests/paper/section4_library.cpp,
// tests/property/osculation*.cpp, tests/unit/system ---
// Rates, energies and momenta of order one against 50-digit Hamilton's equations.
inline constexpr double paper_perturbed = 1e-14;
// Angles of the osculating momentum, of axes that may stand near a pole.
inline constexpr double paper_osculating_elements = 1e-14;
// Convective terms carried through the free transition matrix and back.
inline constexpr double paper_modified = 2e-14;
// Angular velocities of order one after 1e4 turns, against 76 digits.
inline constexpr double osculation_rate = 1e-13;
// How far canonical and osculating momentum are apart at least, for the frames of those tests.
inline constexpr double osculation_apart = 1e-3;
// Rates of Andoyer's variables on the way, where I comes near 0 too.
inline constexpr double osculation_rates = 1e-12;
// Slopes of log-log lines; rates by fourth-order differences of step 2^-6.
inline constexpr double osculation_slope = 0.005;
inline constexpr double osculation_differences = 1e-12;
// Osculating to canonical and back, and the modified set, relative.
inline constexpr double osculation_round_trip = 2e-14;
// The generating function of section 3.1 and its derivatives, actions of order one.
inline constexpr double paper_generating = 1e-14;
// Two ways to the same rate of order one; by fourth-order differences of step 1e-3; 1e-7 off a
// pole.
inline constexpr double rates_rounding = 2e-15;
inline constexpr double rates_by_differences = 5e-12;
inline constexpr double rates_next_to_pole = 1e-7;
// Lagrange brackets and what follows from them, relative; and what is not canonical.
inline constexpr double andoyer_method = 2e-15;
inline constexpr double not_canonical = 1e-2;

// A deviation through one splitting step against the derivative of the step: entries of order one.
inline constexpr double splitting_deviation = 1e-14;

// --- orbits (tests/unit/orbit), in eps of the number type ---
// The eccentric anomaly and 1 - cos E, relative; sin E over what a rounding of E does.
inline constexpr double kepler_anomaly_eps = 2.0;
inline constexpr double kepler_sine_eps = 2.0;
inline constexpr double kepler_versine_eps = 5.0;
// Position and velocity of an orbit, relative to their lengths, after any number of orbits.
inline constexpr double kepler_position_eps = 4.0;
// The same for e <= 0.5, from a table; and before it is turned into the axes of the elements.
inline constexpr double kepler_tabulated_eps = 1.5;
inline constexpr double kepler_tabulated_plane_eps = 0.6;
inline constexpr double kepler_velocity_eps = 10.0;
inline constexpr double kepler_wide_eps = 16.0;
inline constexpr double kepler_rounded = 1e-15;  // functions of a rounded anomaly, relative
// Elements of a state where they are well conditioned.
inline constexpr double kepler_elements = 1e-13;
// The node of a published sun-synchronous orbit, first order in J2.
inline constexpr double sun_synchronous_deg_per_day = 5e-4;
inline constexpr double j2_rates_eps = 4.0;
// Against orbits integrated with the force of J2 (tests/oracle/oblate_motion.hpp): the rates
// relative to their scale, in J2; the mean axis relative to itself, in J2^2; km in ten days.
inline constexpr double j2_rates_relative = 5.0;
inline constexpr double j2_mean_axis = 3.0;
inline constexpr double j2_low_orbit_km = 30.0;
inline constexpr double j2_eccentric_orbit_km = 40.0;

// --- a method from outside, Runge-Kutta of order 4 (tests/unit/dynamics/own_method.cpp) ---
// Of the order; of the end of half a turn with steps of 0.005; inside steps of 0.01; of an event.
inline constexpr double own_method_order = 0.3;
inline constexpr double own_method_fine = 1e-6;
inline constexpr double own_method_dense = 1e-5;
inline constexpr double own_method_event = 1e-5;

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

// --- perturbation terms (tests/unit/perturb), over the size of the torque ---
// Effects in double, in eps, and in double-double against differences at 76 digits.
inline constexpr double perturb_eps = 4.0;
inline constexpr double perturb_difference = 2e-31;
// The cubic of a table, in eps: numbers up to 9.
inline constexpr double cubic_table_eps = 64.0;
// An average over an orbit by equal steps of time.
inline constexpr double perturb_average = 4e-15;
// Exponential of a damping matrix, over the larger momentum, in eps.
inline constexpr double damping_flow_eps = 4.0;

// --- runs (tests/unit/dynamics/integrate_test, tests/reference/libration) ---
// Attitude and momentum after some turns at tolerance 1e-12, and between the steps.
inline constexpr double adaptive_short_run = 1e-11;
inline constexpr double adaptive_dense = 1e-10;
// Times of zeros of functions of time near t = 1, and of touches, where a rounding of the function
// moves the time by its square root.
inline constexpr double time_of_zero = 1e-14;
inline constexpr double time_of_touch = 1e-7;
// Times of events of the README's wing nut over ten flips, each of which makes an error of the
// state some thousand times larger: at 1e-12 and by exact methods; at 1e-6 over two flips.
inline constexpr double event_time = 1e-7;
inline constexpr double event_time_loose = 1e-2;
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

// --- frames (tests/unit/frame), in eps ---
// Attitude, rad, and rate over max(1, |mu|), against matrices at 76 digits and their differences.
inline constexpr double frame_attitude_eps = 4.0;
inline constexpr double frame_rate_eps = 2.0;
// The same in double-double.
inline constexpr double frame_wide = 2e-31;

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

// --- chaos (tests/unit/analysis) ---
// |mean MEGNO - 2| after some hundred turns of a regular motion, and the growth ln t of one.
inline constexpr double chaos_megno_regular = 0.05;
inline constexpr double chaos_ln_growth = 0.01;
// L against the exact transition matrix, and against the planar equation of another program.
inline constexpr double chaos_growth = 1e-10;
inline constexpr double chaos_planar = 1e-8;
inline constexpr double chaos_unstable_axis = 1e-7;
// L after eight steps of the standard map (e^15 roundings), and its exponent against ln(K/2).
inline constexpr double chaos_map = 1e-8;
inline constexpr double chaos_chirikov = 0.02;
// A second motion at 1e-8; trapezoids of 256 steps an orbit; a splitting of two terms.
inline constexpr double chaos_neighbour = 1e-6;
inline constexpr double chaos_long_neighbour = 1e-3;  // over 1e5 turns
inline constexpr double chaos_trapezoid = 1e-3;
inline constexpr double chaos_damped = 1e-6;
// Extremes of a column (deg) against the exact free rotation.
inline constexpr double map_extremes = 1e-9;
// The frequency of a precession in maps: deg/kyr, and its relative change, against the closed form.
inline constexpr double map_frequency = 1e-9;
// By what part it changes at most from 10 to 20 Myr where the obliquity of Mars is regular, and at
// least where it is chaotic.
inline constexpr double map_regular = 0.002, map_chaotic = 0.02;
// Surfaces of section: some twenty orbits of a regular motion against the planar equation, its
// symmetries and fixed points; angles and axes of a single point; L on the curve of the energy
// after 300 units of time; against SciPy at its tightest; sections in the units of a file.
inline constexpr double section_planar = 1e-10;
inline constexpr double section_rounding = 1e-13;
inline constexpr double section_curve = 1e-11;
inline constexpr double section_scipy = 1e-9;
inline constexpr double section_units = 1e-9;
inline constexpr double section_axis = 1e-6;
// Rows of an indicator against its definition by trapezoids over them.
inline constexpr double chaos_quadrature = 2e-3;

// --- the Runge-Kutta pair and its control (tests/unit/ode) ---
// Published coefficients against the conditions, and double ones settled on the first of them.
inline constexpr double ode_condition = 1e-30;
inline constexpr double ode_not_of_order = 1e-6;
inline constexpr double ode_rounded_condition = 1e-17;
inline constexpr double ode_rounded_coefficient = 1e-15;
inline constexpr double ode_order = 0.3;
inline constexpr double ode_per_tolerance = 20.0;
inline constexpr double ode_tightest = 2e-15;
inline constexpr double ode_double_double = 1e-28;
inline constexpr double ode_clock = 2e-15;
inline constexpr double ode_edge = 1e-9;
// Behind the first of jumps at every rounding of t: each step at the rounding passes some.
inline constexpr double ode_jumps = 1e-7;
// A jump by 1e9 that a step at the rounding of t passes.
inline constexpr double ode_jump = 1e-12;

// --- tabulated orbits (tests/unit/orbit/table_orbit.cpp), on numbers of order one ---
inline constexpr double table_orbit_polynomial = 6e-15;
inline constexpr double table_orbit_slope = 1e-13;
inline constexpr double table_orbit_order = 0.4;
inline constexpr double table_orbit_kepler = 1e-12;
inline constexpr double table_orbit_kepler_velocity = 1e-9;
inline constexpr double table_orbit_file = 1e-11;  // a circle by 20 rows per radian
inline constexpr double table_orbit_overhang = 1e-11;
inline constexpr double table_orbit_dates = 2e-6;  // of 1e-5 rad/s: 0.1 s, half of 2 ms, 1e-8 d
inline constexpr double table_orbit_estimate_least = 0.4;  // of the error
inline constexpr double table_orbit_estimate_most = 1e3;   // it is that of a lower order
inline constexpr double table_orbit_continuous = 6e-14;

// --- dates and positions of the planets (tests/unit/ephemeris) ---
inline constexpr double date_second = 2e-10;
inline constexpr double date_tdb = 5e-5;           // s: what two terms leave out
inline constexpr double ephemeris_stated = 1e-13;  // au, ERFA's own tests
inline constexpr double ephemeris_sun_deg = 0.012;
inline constexpr double ephemeris_sun_distance = 1e-4;
inline constexpr double ephemeris_moon_deg = 0.35;
inline constexpr double ephemeris_moon_distance = 3e-3;
inline constexpr double ephemeris_rounding_km = 1e-6;
inline constexpr double ephemeris_orbit = 1e-10;  // of the distance, of scenarios
inline constexpr double ephemeris_gm = 1e-4;
// Terms read from a text against formulas in NumPy (python/tests/test_scenario_terms.py), relative.
inline constexpr double scenario_torque = 1e-13;
inline constexpr double ephemeris_table = 5e-12;  // of the distance
inline constexpr double teme_arcsec = 0.06;       // 1990 to 2030

// --- orbits and the Earth from Python (python/tests/test_ephemeris.py, test_satellites.py) ---
inline constexpr double python_table = 1e-13;
inline constexpr double python_table_slope = 2e-10;
inline constexpr double published_precession = 1e-3;
inline constexpr double published_nutation = 2e-3;
// The averaged torque to first order leaves out evection and variation of the Moon.
inline constexpr double averaged_precession = 5e-3;
inline constexpr double sgp4_km = 2e-8;  // its verification run prints 1e-8
inline constexpr double sgp4_km_s = 2e-9;
inline constexpr double sgp4_slope = 2e-3;  // km/s
inline constexpr double teme_km = 1.2e-3;
inline constexpr double tle_epoch = 1e-3;  // s, its last digit
inline constexpr double omm_km = 1e-2;

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

// --- the command line and documents (tests/cli, tests/install, tests/docs), of order one ---
// Numbers of one row or table against each other and against formulas.
inline constexpr double cli_rounding = 1e-15;
// The same along a run of some turns, through a chart and back, or after cancellation.
inline constexpr double cli_carried = 4e-14;
// The explicit midpoint rule of docs/extending/method.md, ten minutes of two turns each, deg/s.
inline constexpr double own_midpoint = 4e-4;
// Of the energy of docs/extending/experiment.md, relative, over 70 periods.
inline constexpr double own_model = 1e-11;
// a jet whose mean over turns of the body is taken, and a spiral that is all but a circle
inline constexpr double own_jet = 1e-3;
inline constexpr double own_spiral = 1e-9;
// psi_max as a table prints it, rounded down.
inline constexpr double cli_printed_digits = 1e-9;
// Times of flips after 1e9 s: in units of their last place; and half a period, by 11 of them near
// t = 0.
inline constexpr double cli_flip_ulps = 3.0;
inline constexpr double cli_half_period_ulps = 2.0;
inline constexpr double cli_half_period = 1e-14;
// Where the numbers of a chart hold half the digits of the state.
inline constexpr double cli_half_the_digits = 1e-7;
// Every method against double-double, at the steps of that test.
inline constexpr double cli_methods = 2e-11;
// rad, and relative rates, after a thousand orbits at the tolerance of the example.
inline constexpr double cli_thousand_orbits = 1e-10;
// Numbers of documents against what their programs print.
inline constexpr double documents = 1e-9;
// Errors of another program that a page calls rounding; those it names are larger.
inline constexpr double documents_rounding = 1e-9;

// --- formulas written in NumPy (python/tests), on numbers of order one ---
// The same few operations, in another order or none.
inline constexpr double numpy_rounding = 1e-15;
inline constexpr double numpy_formula = 2e-14;
// of states drawn at random, some next to a pole of a chart
inline constexpr double numpy_random = 5e-12;
// central differences of sixth order, step 2^-10
inline constexpr double numpy_differences = 5e-12;

// --- terms fitted to a series (python/tests/test_harmonics.py), over the largest number in it ---
inline constexpr double harmonic_terms = 1e-13;
// how much more noise is in an amplitude than without the other terms; with the scatter of 2000
// draws, and the part that mean and rate take of the term alone
inline constexpr double harmonic_growth = 2.1;

// --- real bodies (python/tests/test_real_bodies.py) ---
// Published numbers, relative.
inline constexpr double published_mercury = 1e-3;
inline constexpr double published_phobos = 1e-3;
inline constexpr double published_moon = 5e-3;
inline constexpr double published_cassini = 1e-2;
inline constexpr double published_mars = 5e-3;
// Other solutions of the same model: SciPy's integrator, rad; averages of first order, relative.
inline constexpr double oracle_tolerance = 1e-13;
inline constexpr double planar_libration = 1e-9;
inline constexpr double averaged_moon = 1e-3;
inline constexpr double cassini_node = 1e-3;
inline constexpr double mars_rate = 1e-4;
inline constexpr double mars_nutation = 1e-2;
inline constexpr double averaged_envisat = 3e-2;

// --- the gallery (python/tests/gallery_values.py), on numbers of order one ---
// Laws that hold along a curve, and steps of the same formulas.
inline constexpr double gallery_law = 1e-12;
// Against SciPy at its tolerance, over the flips of a wing nut.
inline constexpr double gallery_integrated = 5e-9;
// Of an energy, relative; of one along a run at tolerance 1e-10.
inline constexpr double gallery_energy = 1e-14;
inline constexpr double gallery_run = 1e-8;

// --- figures (python/tests/test_figures_*.py) ---
// The extremes of a curve that is drawn by samples, over its size.
inline constexpr double figure_sampled = 2e-5;
// Products of lengths in pixels, small compared with where they are.
inline constexpr double numpy_pixels = 4e-13;

// --- instantaneous ellipses (python/tests/test_figures_ellipses.py), in the orbit's own units ---
// Against other equations of motion, after a revolution.
inline constexpr double figure_orbit = 1e-13;
inline constexpr double figure_differences = 1e-9;
// Slope of the distance between orbit and ellipse against the time from the contact.
inline constexpr double figure_contact = 0.01;

// --- inertia integrals of degree 3 and 4 (tests/unit/shape/mass_moments.cpp), on sums of order 100
// ---
inline constexpr double mass_moments_rotated = 2e-12;

// --- long runs (tests/cli/test_resume.py) ---
// Peak memory with twenty times the events, over that before.
inline constexpr double run_memory = 1.2;

// --- attitude files (python/tests/test_attitude_files.py) ---
// Central differences of attitudes against rates: some 0.04 rad between the outer two.
inline constexpr double aem_difference = 1e-4;

// --- Apophis in 2029 (python/tests/test_apophis_2029.py) ---
// deg: between the plane or pericentre of the example and those of either orbit next to it.
inline constexpr double apophis_plane = 2.0;
// Against SciPy's DOP853 after 96 h.
inline constexpr double apophis_scipy = 1e-9;
// Tolerance asked of it.
inline constexpr double apophis_oracle = 1e-12;
// Relative change of the periods from 48 h to 192 h after the closest approach.
inline constexpr double apophis_after = 2e-3;
// --- gravity of degree 3 and 4, and of an oblate body (tests/unit/perturb/{higher,oblate}_gravity)
// --- The torque and the energy over the sum of those of every point mass, in units of eps.
inline constexpr double higher_gravity_eps = 16.0;
// Central differences at 76 digits, relative.
inline constexpr double higher_gravity_difference = 1e-15;
// The exponent with which a remainder falls between 1000 and 2000 radii.
inline constexpr double higher_gravity_slope = 0.02;

// --- tides (tests/unit/perturb/tidal_torque.cpp), relative ---
// Over the sum of its three parts, in units of eps.
inline constexpr double tidal_eps = 16.0;
// A difference over a lag of 1e-4, of its own rounding and of the third order in the lag.
inline constexpr double tidal_lag = 1e-6;
inline constexpr double tidal_average = 1e-12;

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

// --- magnetic torques (tests/unit/perturb/magnetic.cpp) ---
// Of a field and of a torque against differences of the potential at 76 digits.
inline constexpr double magnetic_field_eps = 16.0;
// Of g after a flow; beyond |h A| = 1/2 over 1 + h.
inline constexpr double affine_change_eps = 8.0;
// A sphere that loses its spin: some ten turns.
inline constexpr double magnetic_decay = 4e-14;
inline constexpr double magnetic_secular = 1e-15;
// Of the mean: second order in a strength of 1e-7.
inline constexpr double magnetic_average = 1e-5;
inline constexpr double splitting_affine_order = 0.3;
inline constexpr double splitting_affine = 1e-10;
inline constexpr double splitting_affine_composed = 1e-8;

// --- orbit files (python/tests/test_oem.py) ---
// s: times of the package oem, whose dates are doubles.
inline constexpr double oem_times = 1e-6;
// Attitude after a revolution along a table of rows 60 s apart, against elements.
inline constexpr double oem_run = 1e-8;

// --- Poisson series (tests/unit/series/evaluation.cpp) ---
// Of the sum of |C a^n|, in eps.
inline constexpr double compiled_series_eps = 5.0;
// Relative, of 2^-168, after products of some terms.
inline constexpr double series_of_50_digits = 1e-47;
// Of coefficients of size 1.
inline constexpr double fourier_series = 1e-14;

// --- Moon and Sun in Delaunay's arguments (tests/unit/ephemeris/delaunay.cpp) ---
// Over the distance; the Sun: perturbations of the Earth by the planets, 30 arcsec.
inline constexpr double delaunay_moon = 5e-11;
inline constexpr double delaunay_sun = 1.5e-4;
// Relative, of differences over 2e-4 centuries.
inline constexpr double delaunay_rates = 1e-9;

// --- nutation (tests/unit/secular/nutation.cpp) ---
// Relative, of coefficients with a closed form.
inline constexpr double nutation_closed = 1e-12;
// Of log-log slopes of the error; what they should be is an integer.
inline constexpr double nutation_slope = 0.2;
// Axes of figure and rotation against the rotor, over the size of the Oppolzer terms.
inline constexpr double nutation_rotor = 0.05;
// Differences of axes from their ratio, over J: second order.
inline constexpr double nutation_axes = 1e-9;

// --- nutation of planets (python/tests/test_nutation.py) ---
// mas: terms against REN-2000; axes and terms against integration.
inline constexpr double nutation_published = 0.4;
inline constexpr double nutation_integrated = 1.0;
inline constexpr double nutation_term = 0.15;
// d; mas of what is printed with three digits; mas of sums of numbers with six digits, and of all
// terms of a table.
inline constexpr double nutation_period = 0.01;
inline constexpr double nutation_digits = 2e-6;
inline constexpr double nutation_sum = 0.01;
// Relative, of what the obliquity and eccentricities change in a century.
inline constexpr double nutation_change = 0.02;
// arcsec/yr.
inline constexpr double nutation_precession = 1e-3;
// Relative, against theories with other digits of the constants.
inline constexpr double nutation_venus = 2e-3;
// Of axes apart by 40 nrad, without terms below 5 prad.
inline constexpr double nutation_axes_ratio = 5e-3;
// python/tests/test_series.py: relative, of three terms.
inline constexpr double series_values = 1e-13;

// --- Lie transforms (python/tests/test_lie_transform.py) ---
// Of the logarithm of two errors, parameters 0.04 and 0.08, and of the motion at 0.005 and 0.01.
inline constexpr double lie_slope = 0.1;
inline constexpr double lie_map_slope = 0.2;
// Radians and relative momentum, of first order, after ten units of time.
inline constexpr double lie_first_order = 5e-3;

// --- normal form of the rotor (tests/unit/secular/triaxial_normal_form.cpp) ---
// At order 8 and triaxiality 0.01: relative; rad and over G.
inline constexpr double normal_form_frequencies = 1e-14;
inline constexpr double normal_form_angles = 1e-14;
// Of log-log slopes of the error; what they should be is an integer.
inline constexpr double normal_form_slope = 0.5;
// Mean rotation under a gravity gradient (tests/unit/secular/gravity_gradient_theory.cpp): slopes
// of the error; relative, rad and energies of bodies of about 1; what a mean element differs by at
// least.
inline constexpr double gravity_theory_slope = 0.12, gravity_theory_closed = 1e-12;
inline constexpr double gravity_theory_series = 1e-12, gravity_theory_back = 1e-11;
inline constexpr double gravity_theory_moved = 1e-6;

// --- columns of observers (tests/cli/test_columns.py) ---
// Angles, directions and periods against formulas by hand: relative, and of unit vectors.
inline constexpr double observer_columns = 1e-13;
// TDB - TT by its two largest annual terms; s.
inline constexpr double tdb_by_one_term = 1e-4;
// Least and largest angle of 8001 rows of a polhode; deg.
inline constexpr double sampled_extreme_deg = 1e-4;
// Of periods of Pravec et al. (2014), the last digit; h.
inline constexpr double published_hours = 0.005;
// Times of events as dates: the microsecond, and what a double keeps of hours; s.
inline constexpr double event_date = 1e-5;
// Periods and poles as summaries print them: relative, deg.
inline constexpr double printed_period = 1e-6;
inline constexpr double printed_pole = 1e-4;

// --- local vertical (tests/cli/test_observers.py) ---
// Axes against those from position and velocity by hand; deg/s too.
inline constexpr double local_vertical = 1e-12;
// The same in C++ (tests/unit/frame/local_vertical.cpp); rates relative to mu.
inline constexpr double local_vertical_axes = 5e-14;
inline constexpr double local_vertical_differences = 1e-6;
// Libration of 1e-4 rad against the linear formula: relative.
inline constexpr double small_libration = 1e-7;
// 3-2-1 angles and their matrix, rad and of unit vectors; in degrees.
inline constexpr double roll_pitch_yaw = 5e-15;
inline constexpr double roll_pitch_yaw_deg = 1e-12;
}  // namespace polhode::budget
