// SPDX-License-Identifier: MIT
// Derivatives of the canonical charts: B = d(dtheta_B, dg_B)/d(chart), its inverse, and the
// derivative of one chart by another.
//
// Equations   hub tangent (dtheta_B, dg_B): q -> q exp(dtheta_B/2), g_B -> g_B + dg_B, with the
//             Poisson tensor Pi(g) = [[0, 1], [-1, hat(g)]]. Three angles, then three momenta, in
//             the order of the fields. A canonical chart satisfies B Jc B^T = Pi,
//             Jc = [[0, 1], [-1, 0]], so B^-1 = Jc B^T Pi^-1, Pi^-1 = [[hat(g), -1], [1, 0]]: no
//             angle is ever differentiated. dtheta_B = b3 dl + j dJ + k dg + i dI + s3 dh
//             [SA (dr1), (dr2)] in body components.
// Units       entry (i, j): unit of hub coordinate i over unit of chart coordinate j.
// Domain      any state. The functions of a hub state keep all digits of a small theta, J or I that
//             the chart itself has rounded away. The Poincare-type sets are regular at their
//             poles. The plain sets have entries +-infinity exactly at theta, J, I = 0, pi, where
//             they have no inverse; G = 0 is singular for all but Euler's. Exactly at the pole that
//             a Poincare-type set is not made for, entries are infinite or NaN.
// Accuracy    docs/guide/singularities.md. Computed in double-double, rounded once: only the last
//             bit of an entry is in doubt, except in the two functions that take B as an argument.
//             Entries below 1e-28 of others in their row or column may be rounding, and where q and
//             g cancel so far that sin I is below 1e-13, its last digits are lost.
// Errors      none: NaN in, NaN out.
// Cost        a few microseconds; the functions that take B: a few hundred flops.
#pragma once

#include "polhode/math/vector.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// One of the canonical charts; the poles matter to the Poincare-type sets alone.
enum class CanonicalSet { euler, andoyer, poincare };
struct CanonicalChart {
  CanonicalSet set;
  Pole pole_J = Pole::zero;
  Pole pole_I = Pole::zero;

  constexpr bool operator==(const CanonicalChart&) const = default;
};

// B at a chart state: rotations by the angles [SA "dr1", "dr2"], whose product with the momentum is
// J_alpha [SA (73), (74), "J_alpha", "J_l"]. Rows of g have the brackets
// [SA "symplecticRB"], those of R^T g [SA "brackets of G"].
Matrix6 chart_jacobian(const EulerState& s);
Matrix6 chart_jacobian(const AndoyerState& s);
Matrix6 chart_jacobian(const PoincareState& s);

// B, and its inverse, at a hub state.
Matrix6 chart_jacobian(const RotorState& s, const CanonicalChart& chart);
Matrix6 inverse_chart_jacobian(const RotorState& s, const CanonicalChart& chart);

// d(to)/d(from) at a hub state. It keeps the one-form of the momenta [SA "cantran2", (75), "defJ",
// "J_alpha, first form", "conditionJ", "J of the other variables", "L, G, H"] and holds the
// differentials of the triangle between the nodes [SA (49), (50), (A2), (A3), (A52), (A53)].
Matrix6 canonical_transformation(const RotorState& s, const CanonicalChart& from,
                                 const CanonicalChart& to);

// The same for any canonical charts given by their B at one hub state with body momentum g_B.
Matrix6 inverse_chart_jacobian(const Vec3& g_B, const Matrix6& B);
Matrix6 canonical_transformation(const Vec3& g_B, const Matrix6& B_from, const Matrix6& B_to);

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
