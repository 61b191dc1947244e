// SPDX-License-Identifier: MIT
// Tolerances of tests: fits.
#pragma once

namespace polhode::budget {

// --- losses (tests/unit/fit): their values and slopes, of the value ---
inline constexpr double loss = 1e-14;

// --- least squares: a straight line, and what is on a bound or near one ---
inline constexpr double fit_line = 1e-9, fit_bounded = 1e-7;
inline constexpr double fit_narrow_prior = 1e-4;  // what the other unknown leaves to it
inline constexpr double fit_robust = 0.15, fit_robust_gradient = 1e-4;

// --- the motion and its derivatives against 50 digits: rad and of |w|, of a column; beside a
// degenerate form by 1e-8 ---
inline constexpr double fit_motion = 4e-15, fit_derivatives = 1e-12;
inline constexpr double fit_derivatives_aside = 1e-6, fit_least_column = 0.1;
// rotation vectors and their derivatives; differences in double
inline constexpr double fit_rotation = 1e-14, fit_rotation_difference = 1e-10;
inline constexpr double fit_difference = 1e-6;  // of residuals of some hundred

// --- driven bodies and their derivatives, of a column, against 40 digits ---
inline constexpr double fit_driven_motion = 2e-13, fit_driven_derivatives = 1e-11;
inline constexpr double fit_driven_exact = 1e-8;  // from exact observations
// Costs of one least, relative: each fit stops within 1e-3 standard errors.
inline constexpr double light_cost = 1e-6;
// Mahalanobis distance of what two starts come to.
inline constexpr double fit_same = 1e-3;
inline constexpr double fit_encounter = 0.1;  // rad, what a flyby does to a tumbler

// --- spin states from exact observations; a probability over fixed seeds ---
inline constexpr double fit_exact = 1e-9, fit_improbable = 1e-2;
// Twenty attitudes of 0.02 rad in 26 rad of rotation: the error of a rate across the axis, and the
// variance of an attitude 74 later.
inline constexpr double fit_uniform_error = 0.02, fit_uniform_late = 1.0;
// the error of a torque along the axis of that rotation, and the variance of a later attitude
inline constexpr double fit_uniform_torque = 1e-3, fit_uniform_torque_late = 1e-2;

// --- Toutatis 1992: half a unit of the last digit of an independent fit and a little more; deg ---
inline constexpr double toutatis_free = 0.011, toutatis_prior = 0.0011, toutatis_rms = 0.06;
inline constexpr double fit_freedom = 1e-9;
// deg: the published state misses until 2004 and in 2008, and without products of inertia
inline constexpr double toutatis_until_2004 = 15.0, toutatis_in_2008 = 60.0;
inline constexpr double toutatis_without_products = 55.0;
inline constexpr double toutatis_reach = 200.0;  // what the fit of 1992 predicts as its error

// --- scans: chi-square over that of no harmonics, against long double; against another origin of
// time and another unit ---
inline constexpr double fourier_scan = 1e-10, fourier_shift = 1e-10;

// --- frequencies of a scan beside those of the motion: in errors, scaled; periods of labels ---
inline constexpr double scanned_frequency = 6.0, labelled_period = 1e-2;
// --- power in lines that symmetry forbids; rise of chi-square an error off ---
inline constexpr double forbidden_lines = 1e-4, unit_rise = 0.1;

// --- least P_psi/P_phi of an ellipsoid with c/a = 1e-3 in short-axis mode, b/a = 0.05 in long-axis
// mode
inline constexpr double flat_ratio = 1.001, thin_ratio = 0.01;

// --- times of sessions; peaks of the window, in turns over the time base ---
inline constexpr double scan_times = 1e-9, window_peak = 0.1;

// --- nights far apart: lines of the best pair, in turns over the whole time base ---
inline constexpr double session_turns = 0.05;
// pairs in windows, of which some end at the edge of the grid, of those that were foretold
inline constexpr double session_progress = 0.1;

// --- periods of bodies made for them, in eps; their moments, angles and periods of labels against
// those put in ---
inline constexpr double periods_of_body = 8.0, moments_of_body = 1e-12;

// --- residuals of light curves: derivatives against differences in double-double, of a column ---
inline constexpr double light_derivatives = 1e-12;
// --- factors under robust losses, against bisection in 50 digits ---
inline constexpr double robust_factor = 2e-15;
// errors against those of a problem with the factor among its unknowns, by differences
inline constexpr double projected_errors = 1e-6;
// Mahalanobis' distance squared of the truth, 8 unknowns: 1 in 1000 is beyond, over fixed seeds
inline constexpr double light_distance = 26.1;
// beyond this the nearest solution is another one; of drawn tumblers, in how many it is the truth
inline constexpr double light_missed = 60.0, light_within = 0.9;
// --- convex bodies and meshes: derivatives against differences in double, of a column, between the
// bends of meshes; moments that follow the shape; what a spin state of exact light is off, in rad
// and of |w|; chi-square over that of the start, with shadows ---
inline constexpr double surface_bend = 1e-6;
// what residual functions begin with where a fit ended: the sum, and its slopes in standard errors
inline constexpr double surface_cost = 1e-5, surface_fit_slope = 2e-3;
// moments that follow the shape at every x, against those of its mesh
inline constexpr double convex_followed = 1e-11;
inline constexpr double convex_moments = 1e-5, convex_axes = 0.3, convex_ratio = 0.3;
inline constexpr double light_image_cost = 1e-6;  // of images, from fixed directions
inline constexpr double mesh_exact = 1e-4, mesh_gain = 0.25;
// searches with a mesh: how far the truth is, in the errors of one unknown; chi-square of what has
// the same light, where facets bend it
inline constexpr double mesh_off = 5.0, mesh_image = 0.02, mesh_found = 0.1;  // rad
// of drawn tumblers, in how many the true periods are reported; are among the first 20 labels
inline constexpr double light_reported = 0.95, light_labelled = 0.75;
// with Lambert's quadrature, whose points follow directions; unknowns from exact light
inline constexpr double lambert_difference = 1e-5, light_exact = 1e-6;
// chi-square per degree of freedom of noise alone, and of a model that is not the body
inline constexpr double light_noise = 1.5, light_misfit = 3.0;

// --- errors of periods and pole against differences of steps of 1e-5 ---
inline constexpr double derived_parameters = 1e-7;

}  // namespace polhode::budget
