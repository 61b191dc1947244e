// SPDX-License-Identifier: MIT
// Tolerances of tests: chaos and spectra.
#pragma once

namespace polhode::budget {

// Leading frequencies (tests/unit/analysis/spectrum.cpp): rad per sample, relative, rad.
inline constexpr double spectrum_frequency = 1.5e-14;  // 3e-12 arcsec/yr of samples of 1 kyr
inline constexpr double spectrum_amplitude = 1e-9;
inline constexpr double spectrum_phase = 1e-9;
inline constexpr double spectrum_python = 1e-12;  // rad per unit of time
inline constexpr double spectrum_cli = 1e-13;     // rad per kyr
inline constexpr double spin_axes_deg = 1e-9;     // files, where the closed form is known
inline constexpr double spectrum_noise = 5.0;     // errors found, in those told

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

}  // namespace polhode::budget
