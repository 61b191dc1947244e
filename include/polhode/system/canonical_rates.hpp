// SPDX-License-Identifier: MIT
// Rates of canonical variables under any system, and the part of them that perturbations make: the
// convective term.
//
// Equations   hub rates: d(theta_B)/dt = w_SB, dg_B/dt = g x w + u, w = I^-1 g + v(terms); chart
//             rates B^-1 (w_SB, dg_B/dt) with B of chart_jacobian.hpp. For a Hamiltonian system
//             these are Hamilton's equations [SA (101)]: the six free rates [SA "dot_g", "dot_h",
//             "dot_l", "dot_G", "dot_H", "dot_L"] plus the perturbation; torques without energy are
//             allowed. Perturbation alone: B^-1 (v, g x v(terms) + u(terms)), with q-part
//             dDeltaH/dp [SA (104)-(107), (111)]; in a precessing frame [SA (118)-(122)].
// Units       of the chart's variables per time.
// Domain      any state. A rate that does not exist is NaN: of phi and psi at theta = 0, pi (theta
//             and Theta then refer to the node that to_euler chooses); of l and g at J = 0, pi; of
//             g and h at I = 0, pi; at G = 0 of all of Andoyer's set but L and H. All others are
//             right there. A Poincare-type set has all six at its poles, and none at G = 0.
// Accuracy    budget paper_perturbed in tests/budgets.hpp; angles lose 1/sin of theta, J, I near
//             the poles, as their definition does.
// Errors      what a term throws passes through; a zero quaternion: NaN.
// Cost        the terms and a few microseconds for B.
#pragma once

#include <array>

#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace rates {

// Rates of the hub state in the tangent of chart_jacobian.hpp, body components.
struct HubRates {
  Vec3 theta;  // w_SB, the rate of turn relative to the reference frame
  Vec3 g;      // dg_B/dt

  constexpr bool operator==(const HubRates&) const = default;
};
// [SA (101), (107), (124)]
HubRates hub_rates(const System& system, double t, const RotorState& s);
// What the terms and the frame add to the free rates (I^-1 g, g x I^-1 g).
HubRates perturbation_rates(const System& system, double t, const RotorState& s);

// Three coordinates, then three momenta, in the order of the chart's fields.
using CanonicalRates = std::array<double, 6>;
// Hamilton's equations, if every term has an energy [SA (101), "eqHam"].
CanonicalRates canonical_rates(const System& system, double t, const RotorState& s,
                               const CanonicalChart& chart);
// The part of these rates that the terms and the frame cause [SA (118)].
CanonicalRates perturbation_rates(const System& system, double t, const RotorState& s,
                                  const CanonicalChart& chart);

struct AndoyerRates {
  double l;
  double g;
  double h;
  double L;
  double G;
  double H;

  constexpr bool operator==(const AndoyerRates&) const = default;
};
// Without a perturbation [SA "Hamilton" in section 3.2, (97), "eqHam", "dot_g", "dot_h", "dot_l",
// "dot_G", "dot_H", "dot_L"], and rates of the angles from the invariable plane [SA (52),
// (9995)-(9997), "A.4, gdot", "A.4", "A.4, sum"].
AndoyerRates andoyer_rates(const System& system, double t, const RotorState& s);

// Of (phi, theta, psi, Phi, Theta, Psi). (EulerRates are angles and their rates.)
struct EulerPhaseRates {
  double phi;
  double theta;
  double psi;
  double Phi;
  double Theta;
  double Psi;

  constexpr bool operator==(const EulerPhaseRates&) const = default;
};
// [SA "Hamilton" in section 3.2, (97), (101), (109), (110), (119), (127)]
EulerPhaseRates euler_phase_rates(const System& system, double t, const RotorState& s);

// The convective term: what the perturbation adds to the rates of the chart's three coordinates,
// in addition to the unperturbed function of the same variables. Of the Euler angles it is Phi of
// [SA (104)-(107), (109), (111), (119)-(122)], zero unless H' depends on the momentum; as a vector
// it is effect(system, t, s).v.
std::array<double, 3> convective_term(const System& system, double t, const RotorState& s,
                                      const CanonicalChart& chart);

}  // namespace rates
}  // namespace v0
}  // namespace polhode
