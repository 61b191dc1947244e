// SPDX-License-Identifier: MIT
// Derivatives of the sets that are not canonical: Euler angles with their rates, and attitude with
// the angular velocity in body or inertial components.
//
// Equations   B = d(dtheta_B, dg_B)/d(chart) as in chart_jacobian.hpp; g = I omega [SA (24)],
//             omega_B = phid s3 + thetad node + psid b3 [SA (5)-(7)], omega_I = R^T omega_B
//             [SA (8)]. The attitude of the second and third set is varied by dtheta_B itself.
// Units       entry (i, j): unit of hub coordinate i over unit of chart coordinate j.
// Domain      the Euler rates have no inverse at theta = 0 and pi: entries are infinite there, or
//             NaN where infinities meet. The other two are regular everywhere.
// Accuracy    tests/unit/rotor/rate_jacobian.cpp.
// Errors      none: NaN in, NaN out.
// Cost        a few dozen flops; two sincos for Euler rates.
#pragma once

#include "polhode/math/matrix6.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// B at Euler angles and rates.
Matrix6 chart_jacobian(const Body& body, const EulerRates& s);
Matrix6 inverse_chart_jacobian(const Body& body, const EulerRates& s);

// B for (dtheta_B, domega_B).
Matrix6 body_rate_jacobian(const Body& body);
Matrix6 inverse_body_rate_jacobian(const Body& body);

// B for (dtheta_B, domega_I).
Matrix6 inertial_rate_jacobian(const Body& body, const RotorState& s);
Matrix6 inverse_inertial_rate_jacobian(const Body& body, const RotorState& s);

}  // namespace v0
}  // namespace polhode
