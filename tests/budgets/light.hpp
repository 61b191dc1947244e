// SPDX-License-Identifier: MIT
// Tolerances of tests: how bright a body looks.
#pragma once

namespace polhode::budget {

// --- ellipsoids (tests/unit/light/ellipsoid.cpp), axes up to 5 : 1, at any phase angle ---
inline constexpr double light_ellipsoid = 1e-14;
inline constexpr double light_ellipsoid_gradient = 1e-12;
inline constexpr double light_lambert_16 = 4e-6;
inline constexpr double light_lambert_32 = 4e-8;
inline constexpr double light_lambert_sphere = 4e-14;
inline constexpr double light_lambert_differences = 1e-6;
inline constexpr double light_semi_axes = 4e-15;

// --- convex bodies by facets (tests/unit/light/facets.cpp): 3200 facets, relative ---
inline constexpr double light_harmonics = 1e-14;
inline constexpr double light_solid_angle = 1e-13;
inline constexpr double light_facets = 3e-3;
inline constexpr double light_closure = 1e-3;
inline constexpr double light_series_back = 1e-13;
inline constexpr double light_facet_gradient = 1e-13;
// patches: means of kernels, how they join; scatter over that of flat facets, bias times rows^2
inline constexpr double light_patch_mean = 1e-6, light_patch_joint = 1e-7;
inline constexpr double light_patch_lowest = 1e-4;
// slopes beside dual numbers; the gradient just above -h, of its largest component
inline constexpr double light_patch_slope = 1e-14, light_patch_begin = 1e-13;
inline constexpr double light_patch_scatter = 1.0, light_patch_bias = 0.35;

// --- convex bodies from areas (tests/unit/light/convex_body.cpp): of the total area; of an
// ellipsoid with 288 facets, relative ---
inline constexpr double convex_areas = 1e-9;
inline constexpr double convex_volume = 3e-2;
inline constexpr double convex_moments_by_areas = 1e-5;  // differences of steps of 1e-4

// --- meshes (tests/unit/light/shaded_mesh.cpp): some 2000 facets ---
inline constexpr double light_mesh = 2e-2;
inline constexpr double light_two_balls = 3e-2;
inline constexpr double light_wall = 1e-14;

// --- light curves (tests/unit/light/light_curve.cpp) ---
inline constexpr double light_flux = 1e-14;       // relative
inline constexpr double light_magnitude = 1e-14;  // mag, of 25
inline constexpr double light_aspect = 4e-16;     // rad, and relative of small angles
inline constexpr double light_time_s = 5e-9;      // of times of 1e7 s
inline constexpr double light_time_km = 1e-7;     // of vectors of 2e8 km

// --- light curves in files (tests/unit/tables/light_curves_*.cpp) ---
inline constexpr double light_date_s = 1e-8;    // a decimal of a day, in seconds
inline constexpr double light_julian_s = 1e-7;  // 12 decimals of a day
inline constexpr double light_tdb_s = 1e-3;     // of TT for TDB, over some hours
inline constexpr double light_mars_km = 2e4;    // as published, to four digits, and 40 arcsec

}  // namespace polhode::budget
