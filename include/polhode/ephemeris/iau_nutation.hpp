// SPDX-License-Identifier: MIT
// The nutation of the real Earth, to hold theories of a rigid one against.
//
// Equations   IAU 2000A (Mathews et al. 2002), 678 terms of Moon and Sun and 687 of the planets
//             (eraNut00a).
// Units       rad; T in Julian centuries of TDB from J2000.
// Domain      on mean ecliptic and equator of date; without the free core nutation. |T| up to some
//             centuries.
// Accuracy    that of the model: 0.2 mas and the free core nutation, some 0.3 mas.
// Errors      none: NaN for NaN.
// Cost        60 us.
#pragma once

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

struct IauNutation {
  double longitude, obliquity;
};
IauNutation iau_nutation(double T);

}  // namespace v0
}  // namespace polhode
