// SPDX-License-Identifier: MIT
// The Earth at a date: how it is oriented, and the dipole of its magnetic field.
//
// Equations   orientation: precession and nutation of the IAU 2006/2000A and the Earth rotation
//             angle (SOFA's celestial-to-terrestrial matrix, by ERFA), without the motion of the
//             pole in the crust. Field: the coefficients of degree 1 of the IGRF-14, linear between
//             its epochs (Alken et al. 2021; IAGA 2024).
// Units       nT; the coefficients belong to the radius 6371.2 km.
// Domain      the field from 1900 to 2030, DomainError outside. UT1 is taken for UTC if dut1 = UT1
//             - UTC (s) is not given: 0.004 deg at most since 1972, 0.2 deg in 1900.
// Accuracy    0.0001 deg with dut1 (the motion of the pole). The dipole is 0.8 to 0.9 of the field
//             of a low orbit, and more farther out.
// Errors      DomainError for a date outside the domain.
// Cost        about 50 us.
#pragma once

#include <optional>

#include "polhode/ephemeris/date.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

// rad per second of UT1
inline constexpr double earth_rotation_rate = 7.292115146706979e-5;
inline constexpr double igrf_radius_km = 6371.2;

// Turns components along the axes of the Earth (axis 3 the pole, axis 1 Greenwich) into those along
// equator and equinox of J2000.
Mat3 j2000_from_earth(const Date& date, std::optional<double> dut1 = std::nullopt);

// g10, g11 and h11 of the IGRF, nT.
Vec3 igrf_dipole(const Date& date);

}  // namespace v0
}  // namespace polhode
