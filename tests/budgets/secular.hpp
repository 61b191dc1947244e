// SPDX-License-Identifier: MIT
// Tolerances of tests: theories.
#pragma once

namespace polhode::budget {

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
inline constexpr double secular_lanes = 1e-10;           // 2 Myr, up to 0.8 rad a kyr
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

// In Python: 28 of Laskar's 160 terms against La2004, rad; methods and tables.
inline constexpr double la2004_obliquity = 3.2e-3;
inline constexpr double la2004_climatic = 6e-3;
inline constexpr double spin_methods = 1e-10;
inline constexpr double spin_length = 1e-15;
inline constexpr double spin_taylor = 1e-13;  // of 20 kyr at most

// --- nutation (tests/unit/secular/nutation.cpp) ---
// Relative, of coefficients with a closed form.
inline constexpr double nutation_closed = 1e-12;
// Of log-log slopes of the error; what they should be is an integer.
inline constexpr double nutation_slope = 0.2;
// Axes of figure and rotation against the rotor, over the size of the Oppolzer terms.
inline constexpr double nutation_rotor = 0.05;
// Rate of Phi less the spin, relative: second order.
inline constexpr double nutation_phi = 0.02;
// Differences of axes from their ratio, over J: second order.
inline constexpr double nutation_axes = 1e-9;

// --- nutation of planets (python/tests/test_nutation.py) ---
// mas: terms against REN-2000; axes and terms against integration.
inline constexpr double nutation_published = 0.4;
inline constexpr double nutation_published_fast = 0.03;
inline constexpr double nutation_integrated = 1.0;
inline constexpr double nutation_term = 0.15;
// The rate of the node against the precession of the theory, relative; d, of the year of Mars.
inline constexpr double nutation_equinox = 0.01, nutation_year = 1e-4;
// d; mas of what is printed with three digits; mas of sums of numbers with six digits, and of all
// terms of a table.
inline constexpr double nutation_period = 0.01;
inline constexpr double nutation_digits = 2e-6;
inline constexpr double nutation_sum = 0.01;
// Relative, of what the obliquity and eccentricities change in a century.
inline constexpr double nutation_change = 0.02;
// arcsec/yr.
inline constexpr double nutation_precession = 1e-3;
// mas: parts of IAU 2000A beside the theory, among what planets do.
inline constexpr double nutation_real_earth = 0.5;
// Turns of the arguments, and over the nutation, a century from the epoch.
inline constexpr double nutation_epochs = 1e-6;
inline constexpr double nutation_epochs_size = 1e-4;
// Relative, against theories with other digits of the constants.
inline constexpr double nutation_venus = 2e-3;
// Of axes apart by 40 nrad, without terms below 5 prad.
inline constexpr double nutation_axes_ratio = 5e-3;

// --- Lie transforms (tests/unit/secular/lie_maps.cpp, python/tests/test_lie_transform.py) ---
// Of the logarithm of two errors, parameters 0.04 and 0.08, and of the motion at 0.005 and 0.01.
inline constexpr double lie_slope = 0.1;
inline constexpr double lie_map_slope = 0.2;
// Estimate of the number of terms over what is there (tests/unit/secular/transform_size.cpp): below
// 2.5, and 4.8 where the terms of the Hamiltonian are hardly coupled.
inline constexpr double transform_size_factor = 5.0;
// And of orders that are extrapolated from the first few.
inline constexpr double transform_size_extrapolated = 2.0;
// Radians and relative momentum, of first order, after ten units of time.
inline constexpr double lie_first_order = 5e-3;

// After 3000 rad of rotation, rad; the estimate of a drift, of what it is.
inline constexpr double gravity_theory_drift = 1e-9;
inline constexpr double gravity_theory_told = 100.0;

// --- normal form of the rotor (tests/unit/secular/triaxial_normal_form.cpp) ---
// At order 8 and triaxiality 0.01: relative; rad and over G.
inline constexpr double normal_form_frequencies = 1e-14;
inline constexpr double normal_form_angles = 1e-14;
// Of log-log slopes of the error; what they should be is an integer.
inline constexpr double normal_form_slope = 0.5;
inline constexpr double normal_form_estimate = 1.5;  // errors, of what is estimated
// python/tests/test_normal_form.py: the same over 40 units of time; rad and relative.
inline constexpr double normal_form_motion = 1e-13;
// Mean rotation under a gravity gradient (tests/unit/secular/gravity_gradient_theory.cpp): slopes
// of the error; relative, rad and energies of bodies of about 1; what a mean element differs by at
// least.
inline constexpr double gravity_theory_slope = 0.12, gravity_theory_closed = 1e-12;
inline constexpr double gravity_theory_series = 1e-12, gravity_theory_back = 1e-11;
inline constexpr double gravity_theory_moved = 1e-6;
// In Python (python/tests/test_mean_rotation.py); measured 5e-6 and 8e-8 rad, 1e-14, 1e-12.
inline constexpr double gravity_theory_python_first = 2e-5;
inline constexpr double gravity_theory_python_second = 3e-7;
inline constexpr double gravity_theory_python_rate = 1e-12;
inline constexpr double gravity_theory_python_back = 1e-11;

}  // namespace polhode::budget
