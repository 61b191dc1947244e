// SPDX-License-Identifier: MIT
// polhode as functions of C on rows of numbers: what WebAssembly can be called by.
//
// Units       any consistent set; angles in rad. `moments` three principal moments; a state seven
//             numbers, q (w, x, y, z) and g along the body axes; vectors three.
// Errors      functions that return an int give 0, or 1 where the library refuses what it is asked;
//             polhode_refusal() then is its sentence. Results are untouched then.
// Memory      polhode_allocate, polhode_release; a motion is released by polhode_motion_release.
#pragma once

#include <stdint.h>

#define POLHODE_WEB(result) __attribute__((visibility("default"), used)) result

#ifdef __cplusplus
extern "C" {
#endif

POLHODE_WEB(const char*) polhode_version(void);
POLHODE_WEB(const char*) polhode_refusal(void);
POLHODE_WEB(void*) polhode_allocate(uint32_t bytes);
POLHODE_WEB(void) polhode_release(void* memory);

// ---- body and state: state.cpp

POLHODE_WEB(int) polhode_body(const double* moments);
// Of a full tensor (9), row by row: moments (3) and the turn from principal axes to its axes (4).
POLHODE_WEB(int) polhode_body_of_tensor(const double* tensor, double* result);
// Moments of the ellipsoid of constant density, and back.
POLHODE_WEB(int) polhode_ellipsoid_moments(const double* semi_axes, double mass, double* moments);
POLHODE_WEB(void) polhode_semi_axes(const double* moments, double mass, double* semi_axes);
// From an angular velocity along the body axes, or along inertial ones.
POLHODE_WEB(int)
polhode_state_of_rate(const double* moments, const double* q, const double* omega, int is_inertial,
                      double* state);
// Of numbers as they were typed: finite, q not 0, and of length 1 in the result.
POLHODE_WEB(int) polhode_checked_state(const double* numbers, double* state);
// omega_B, omega_I, momentum_I, kinetic energy: ten numbers.
POLHODE_WEB(void) polhode_derived(const double* moments, const double* state, double* derived);
// The state with its momentum along `direction` of the body, and the same momentum in space.
POLHODE_WEB(int)
polhode_momentum_along(const double* state, const double* direction, double* result);

// ---- charts: charts.cpp. Of `chart` below, as many numbers as are named.

enum {
  POLHODE_ANDOYER,         // l, g, h, L, G, H
  POLHODE_EULER,           // phi, theta, psi, Phi, Theta, Psi
  POLHODE_EULER_RATES,     // phi, theta, psi and their rates
  POLHODE_POINCARE,        // sigma, Q1, Q2, G, P1, P2, pole of J, of I: 0 zero, 1 pi
  POLHODE_ROLL_PITCH_YAW,  // of the attitude alone, as the next two
  POLHODE_EULER_ANGLES,    // phi, theta, psi
  POLHODE_MATRIX           // v_B = R v_I, row by row
};
// Of POLHODE_POINCARE the poles are read from `numbers`; -1: the nearest.
POLHODE_WEB(int)
polhode_to_chart(int chart, const double* moments, const double* state, double* numbers);
// Of those of the attitude alone g is 0.
POLHODE_WEB(int)
polhode_from_chart(int chart, const double* moments, const double* numbers, double* state);

enum {
  POLHODE_SERRET,  // g0, h, t0, G, H, T, sign_g1, sign_g3
  POLHODE_SADOV,   // phi_l, phi_g, phi_h, I_l, I_g, I_h, region (0 short axis, 1 long), lobe
  POLHODE_TUMBLER  // P_phi, P_psi, pole (3), mode (0 short axis, 1 long), phi0, psi0, branch, sense
};
POLHODE_WEB(int)
polhode_from_motion_chart(int chart, const double* moments, const double* numbers, double t,
                          double* state);
POLHODE_WEB(int) polhode_long_axis_period(double short_axis, double rotation, double* period);
POLHODE_WEB(int) polhode_least_period_ratio(const double* moments, int is_long, double* ratio);

// ---- the exact motion: motion.cpp

typedef struct polhode_motion polhode_motion;

// Null where it is refused.
POLHODE_WEB(polhode_motion*)
polhode_motion_of(const double* moments, const double* state, double t0);
POLHODE_WEB(void) polhode_motion_release(polhode_motion* motion);
// Regime (0 rest, 1 steady, 2 short axis, 3 long axis, 4 separatrix), G, T, m, 1 - m, D2, P_psi,
// rates of precession of the long and of the short axis, action, direction of the momentum (3),
// frequencies n_l and n_g, angles of long and short axis from the momentum (least, most of each):
// 19 numbers.
POLHODE_WEB(void) polhode_motion_summary(const polhode_motion* motion, double* summary);
POLHODE_WEB(void) polhode_motion_at(const polhode_motion* motion, double t, double* state);
POLHODE_WEB(int)
polhode_motion_chart(const polhode_motion* motion, int chart, double t, double* numbers);
POLHODE_WEB(double) polhode_motion_sensitivity(const polhode_motion* motion, double t);
// At most `most` times from start to stop at which the momentum along the middle axis changes its
// sign, and the interval between them; how many, or -1 where refused.
POLHODE_WEB(int)
polhode_motion_flips(const polhode_motion* motion, double start, double stop, uint32_t most,
                     double* times, double* interval);

enum {
  POLHODE_STATES,          // 7 numbers
  POLHODE_BODY_RATES,      // 3
  POLHODE_INERTIAL_RATES,  // 3
  POLHODE_HERPOLHODE,      // 3: omega along two axes of the invariable plane, and across it
  POLHODE_ANDOYER_ROWS,    // 6
  POLHODE_BRIGHTNESS       // 1
};
// A row for each time: `times`, or where it is null start + i step. `light`, of POLHODE_BRIGHTNESS
// alone: semi-axes, direction to the Sun, to the observer (inertial).
POLHODE_WEB(int)
polhode_motion_rows(const polhode_motion* motion, int kind, const double* times, double start,
                    double step, uint32_t count, const double* light, double* rows);

// ---- curves on the sphere of the momentum: curves.cpp

// The polhode through the motion's state: rows of 3, closed; how many (1 where it stands still).
POLHODE_WEB(uint32_t)
polhode_motion_curve(const polhode_motion* motion, uint32_t points, double* rows);
// The polhode about one end (side 1 or -1) of the long or short axis that crosses the plane of that
// axis and the middle one at `angle` from it; pi/2, the half of the separatrix on that side of both
// other axes is polhode_half_separatrix. Returns 2 T; NaN where the body has no such polhode.
POLHODE_WEB(double)
polhode_curve(const double* moments, double G, int is_long, int side, double angle, uint32_t points,
              double* rows);
// The half circle with these signs of the momentum along long and short axis.
POLHODE_WEB(double)
polhode_half_separatrix(const double* moments, double G, int sign_long, int sign_short,
                        uint32_t points, double* rows);
// l, without jumps, and L of momenta: rows of 2.
POLHODE_WEB(void) polhode_andoyer_plane(const double* momenta, uint32_t count, double* rows);

// ---- light: light.cpp

POLHODE_WEB(double) polhode_brightness(const double* light, const double* q);
POLHODE_WEB(double) polhode_phase_angle(const double* to_sun, const double* to_observer);

// ---- perturbed motion: perturbed.cpp

// moments (3), state (7), start, stop, tolerance; gravity gradient: gm (0: none), pericentre,
// eccentricity, inclination, node, argument, mean anomaly, epoch; internal damping k, linear
// damping d; axis of a precessing frame (3) and its rate; most steps: 28 numbers.
#define POLHODE_PROBLEM_SIZE 28
// Time, state (7), energy, kinetic energy, Andoyer's variables of the canonical (6) and of the
// osculating momentum (6).
#define POLHODE_SAMPLE_SIZE 22
// `count` evenly spaced samples; how many there are, fewer where the run ended early, which
// polhode_refusal() says, or -1 where the problem is refused.
POLHODE_WEB(int) polhode_integrate(const double* problem, uint32_t count, double* rows);
POLHODE_WEB(int)
polhode_damping_of_wobble(const double* moments, double time, double G, double* k);
// Where the orbit of eight numbers, as in a problem, is at t.
POLHODE_WEB(int) polhode_orbit_position(const double* elements, double t, double* position);

#ifdef __cplusplus
}
#endif
