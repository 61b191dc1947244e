// SPDX-License-Identifier: MIT
// How far the last digit of the input moves a free rotation: what the numbers given determine, and
// what they do not.
//
// Equations   the largest rotation angle between the attitude at t and that of the motion whose
//             moments or momentum differ in one component by one unit in the last place (2^-52 of
//             it at most), over all of them, in both directions.
// Units       rad.
// Domain      any FreeRotation, any finite t. A change that would break I3 <= I1 + I2 is left out.
// Accuracy    an order of magnitude of what a rounding of the input does, and at least the rounding
//             of two attitudes, some 1e-16. At most pi: then nothing is determined.
// Errors      none. NaN or infinite time in, NaN out.
// Cost        twelve preparations: some 0.1 ms.
#pragma once

#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace free {

double rounding_sensitivity(const FreeRotation& motion, double t);

}  // namespace free
}  // namespace v0
}  // namespace polhode
