// SPDX-License-Identifier: MIT
// Tolerances of tests: what Python computes by itself.
#pragma once

namespace polhode::budget {

// --- light on a turning plate (python/tests/test_switches.py) ---
// What a weak torque adds to g, relative, at loose tolerances: some roundings of g.
inline constexpr double turning_plate = 1e-6;

// --- formulas written in NumPy (python/tests), on numbers of order one ---
// The same few operations, in another order or none.
inline constexpr double numpy_rounding = 1e-15;
inline constexpr double numpy_formula = 2e-14;
// An arccosine of an angle of one degree: a rounding over the square of the angle.
inline constexpr double small_arccosine = 2e-12;
// A fit of numbers with central differences against one with exact derivatives, in errors of the
// unknowns: the tolerance of the fit.
inline constexpr double measured_fit = 1e-5;
// of states drawn at random, some next to a pole of a chart
inline constexpr double numpy_random = 5e-12;
// central differences of sixth order, step 2^-10
inline constexpr double numpy_differences = 5e-12;

// --- terms fitted to a series (python/tests/test_harmonics.py), over the largest number in it ---
inline constexpr double harmonic_terms = 1e-13;
// how much more noise is in an amplitude than without the other terms; with the scatter of 2000
// draws, and the part that mean and rate take of the term alone
inline constexpr double harmonic_growth = 2.1;
// Periods of printed digits (python/tests/test_argument_fit.py), relative.
inline constexpr double argument_period = 3e-5;
// Where coefficients change with time, over the largest number in the series.
inline constexpr double argument_changes = 1e-12;

// --- starts without free wobble (python/tests/test_free_wobble.py) ---
// Euler's period and the polhode of the free motion, relative.
inline constexpr double wobble_period = 1e-9;
// A forced path found from two starts; the part of a wobble that is left.
inline constexpr double wobble_forced = 1e-9;
inline constexpr double wobble_left = 1e-4;
// The forced rates of the Earth against their series in kappa, relative; the period, which the
// pull of Moon and Sun changes a little.
inline constexpr double wobble_earth = 1e-3;
inline constexpr double wobble_chandler = 1e-3;

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
// Directions on the sky from columns and from attitudes, and tangents of their longitudes.
inline constexpr double figure_directions = 1e-12;
// Means of the bands of a long run against the mean of all its rows, over the width of the band:
// what a bin with a part of a swing at its end leaves.
inline constexpr double figure_mean = 0.01;
// Envelopes at the middle of a bin, over the range of the run: they grow within the bin.
inline constexpr double figure_bin = 0.02;
// Products of lengths in pixels, small compared with where they are.
inline constexpr double numpy_pixels = 4e-13;

// --- ensembles (python/tests/test_ensembles.py): statistics against NumPy's, relative; a mean of
// 300 points of Sobol ---
inline constexpr double ensemble_of_rows = 1e-14, ensemble_middle = 0.02;

// --- instantaneous ellipses (python/tests/test_figures_ellipses.py), in the orbit's own units ---
// Against other equations of motion, after a revolution.
inline constexpr double figure_orbit = 1e-13;
inline constexpr double dual_jacobian = 1e-13;       // of Sadov's variables
inline constexpr double orbital_differences = 1e-6;  // of step 1e-3; a run of the default tolerance
inline constexpr double figure_differences = 1e-9;
// Slope of the distance between orbit and ellipse against the time from the contact.
inline constexpr double figure_contact = 0.01;

// --- attitude files (python/tests/test_attitude_files.py) ---
// Central differences of attitudes against rates: some 0.04 rad between the outer two.
inline constexpr double aem_difference = 1e-4;
// The same over 1e-4 s, in rad/s: their rounding.
inline constexpr double aem_euler_rates = 1e-10;
// What an estimate of the error of interpolation may be above the error, and below it by its two
// digits, as factors.
inline constexpr double aem_told = 20.0;
inline constexpr double aem_rounding = 1.05;
// What the error of two rows may be above its estimate, which knows no nutation, as a factor.
inline constexpr double aem_two_rows = 1.5;
// The estimate of an error of interpolation of some degrees, relative.
inline constexpr double ck_between_rows = 0.2;

// --- Apophis in 2029 (python/tests/test_apophis_2029.py) ---
// deg: between the plane or pericentre of the example and those of either orbit next to it.
inline constexpr double apophis_plane = 2.0;
// Against SciPy's DOP853 after 96 h.
inline constexpr double apophis_scipy = 1e-9;
// Tolerance asked of it.
inline constexpr double apophis_oracle = 1e-12;
// Relative change of the periods from 48 h to 192 h after the closest approach.
inline constexpr double apophis_after = 2e-3;

// --- orbit files (python/tests/test_oem.py) ---
// s: times of the package oem, whose dates are doubles.
inline constexpr double oem_times = 1e-6;
// Attitude after a revolution along a table of rows 60 s apart, against elements.
inline constexpr double oem_run = 1e-8;

// --- import (python/tests/test_package.py) ---
// Modules beside NumPy's and polhode's own: dataclasses and what it needs.
inline constexpr double imported_modules = 12;

// --- fits (python/tests/test_fits.py, test_light_fits.py): values off the truth in errors; another
// optimiser's minimum in errors and of chi-square, its covariance; fourth-order differences of
// residuals, of a column; semi-axes from one night with noise of 1 % ---
inline constexpr double python_fit_off = 4.0;
inline constexpr double python_optimum = 1e-3, python_covariance = 1e-2;
inline constexpr double python_residual_difference = 1e-6, python_lambert = 1e-5;
// what closing a convex body takes from its areas, of the whole; its light then
inline constexpr double python_convex_closure = 3e-3, python_convex_light = 2e-2;
inline constexpr double python_axes = 0.1;
// --- samplers (python/tests/test_posterior.py): of errors of 300 to 600 draws ---
inline constexpr double sampled_mean = 0.25, sampled_spread = 0.15, sampled_rhat = 0.02;
inline constexpr double sampled_torque = 0.4;   // of errors of 100 draws
inline constexpr double sampled_surface = 0.4;  // of errors of 250 draws
inline constexpr double sampled_misfit = 2.0;   // chi-square over the number of points
inline constexpr double sampled_toutatis = 0.5, sampled_rhat_few = 1.06, sampled_rhat_full = 1.03;
inline constexpr double sampled_diverged = 0.01;  // part of the draws
inline constexpr double unbounded_difference = 1e-8;
// --- figures of fits: a curve of 800 points between them, an edge of 361 points ---
inline constexpr double drawn_between = 1e-3, drawn_edge = 1e-4;
inline constexpr double drawn_degrees = 1e-6;  // of printed digits

}  // namespace polhode::budget
