// SPDX-License-Identifier: MIT
// Tolerances of tests: programs and pages.
#pragma once

namespace polhode::budget {

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
// Chi-square of a fit from two starts, relative: each stops within 1e-3 standard errors.
inline constexpr double cli_fit_starts = 1e-6;
// images under a Sun and an observer that do not move
inline constexpr double cli_fit_images = 1e-6;
// Periods of the lowest minimum of one scan and of another grid, each refined.
inline constexpr double cli_scan_periods = 1e-6;
// The period of 2.1 h of a rotator in 40 to 80 points over 9 h with errors of 2 %; h.
inline constexpr double cli_few_points_period = 0.02;
// Chi-square of a Fourier series against numpy's least squares.
inline constexpr double cli_series = 1e-12;
// the light of the facets of a fit and of the mesh that is written of them, which closes; and
// chi-square of a fit of this mesh, of that of the facets
inline constexpr double cli_convex_mesh = 0.01, cli_convex_again = 0.1;
// chi-square of the same night with times as Julian dates, which have 0.04 ms, and of microseconds
inline constexpr double cli_julian = 1e-3;
// d, of a Julian date in double
inline constexpr double cli_julian_day = 1e-9;
// Unknowns of a fit of exact attitudes, deg, deg/h and ratios.
inline constexpr double cli_fit_exact = 1e-8;
// Numbers of a published or independent fit that are told to three decimals.
inline constexpr double cli_published = 1e-3;
// TDB - TT is 2 ms at most, in days.
inline constexpr double cli_tdb = 3e-8;
// Fluxes with noise of 1e-9, five times that.
// The mean of 34 points of noise of 2 %, three times its error.
inline constexpr double cli_mean_of_noise = 0.01;
// chi-square of a scan with its frequencies exchanged
inline constexpr double cli_landscape = 1e-12;
inline constexpr double cli_light_noise = 5e-9;
// chi-square of light without noise, of dates to 1e-7 s and errors of 2 %
inline constexpr double cli_light_of_itself = 1e-6;
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

// --- long runs (tests/cli/test_resume.py) ---
// Peak memory with twenty times the events, over that before.
inline constexpr double run_memory = 1.2;

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
inline constexpr double elements_run = 1e-9;  // rows 1e-10 of the distance between
// Positions between rows, from the orbit of the same elements: relative, the tolerance of the rows.
inline constexpr double elements_rows = 1.2e-10;
// Libration of 1e-4 rad against the linear formula: relative.
inline constexpr double small_libration = 1e-7;
// 3-2-1 angles, deg.
inline constexpr double roll_pitch_yaw_deg = 1e-12;

// --- ensembles: statistics against NumPy's of the rows, of the largest number; what one step
// leaves of Frechet means and covariances, rad and rad^2; phases of tumblers by 4000 of Sobol's
// points ---
inline constexpr double ensemble_statistics = 1e-12;
inline constexpr double ensemble_frechet = 1e-2;
inline constexpr double ensemble_spreading = 1e-3;

// --- examples of ensembles (tests/cli/test_ensemble_examples.py) ---
// A clone of Apophis against SciPy's DOP853, 360 h: quaternion, rad/h.
inline constexpr double apophis_clone = 1e-7;
// A clone of Mars after 1 Myr against it, on splines through the same elements: deg.
inline constexpr double mars_clone = 1e-5;
// Spins of a sphere under eddy currents against their mean decay, of the first.
inline constexpr double debris_spin = 1e-3;

// --- the model of a cluster (tests/tools/test_cluster_cost.py): sums that are exact but for
// rounding; the leader at its bound, and where it is not; its memory; counts beside draws; sizes
// and times as measured ---
inline constexpr double cluster_even = 1e-12, cluster_bound = 0.01, cluster_model = 0.06;
inline constexpr double cluster_waiting = 0.05, cluster_scatter = 0.05, cluster_counts = 0.02;
inline constexpr double cluster_size = 0.15, cluster_merge = 0.2;

}  // namespace polhode::budget
