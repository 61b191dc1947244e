// SPDX-License-Identifier: MIT
// The axes of two-line elements: true equator, mean equinox of date (TEME), which SGP4 answers in.
//
// Equations   x_J2000 = P^T N^T Rz(-dpsi cos eps) x_TEME with the precession P of 1976, the
//             nutation N of 1980 and its dpsi, and the mean obliquity eps of date (Vallado et al.
//             2006); by ERFA.
// Units       none: a rotation.
// Domain      dates of the two theories, some centuries about 2000.
// Accuracy    budget teme_arcsec, against the axes of the ICRS: those of 1976 and 1980 are without
//             the corrections observed since. docs/guide/orbits.md has what that is in metres.
// Cost        some 4 us (benchmarks/ephemeris.cpp).
#pragma once

#include "polhode/ephemeris/date.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

// Turns components along TEME of a date into those along equator and equinox of J2000.
Mat3 j2000_from_teme(const Date& date);

}  // namespace v0
}  // namespace polhode
