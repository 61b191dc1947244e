// SPDX-License-Identifier: MIT
// Kinoshita's action-angle variables (1972) of free rotation: the averages of Andoyer's.
//
// Equations   L = (1/2pi) loop integral of Andoyer's L dl, G and H those of Andoyer; l, g, h are
//             conjugate to them. By Heuman's Lambda0, short-axis mode: L = +-G Lambda0(arctan(kappa
//             / lambda), lambda); long-axis mode: L = G (1 - Lambda0(arctan(lambda/kappa),
//             1/lambda)). l = phi_l + pi/2, g = phi_g, h = phi_h of Sadov's set [SA section 5]: in
//             short-axis mode Andoyer's l and g minus their periodic parts, and Andoyer's variables
//             themselves for an axisymmetric body.
// Corrections the definition is partly uncertain. The text of Kinoshita, Publ. Astron. Soc. Japan
//             24, 423 (1972), was not available. The paper calls the set very similar to Sadov's,
//             with Heuman's function, and the actions follow from that. The origin of l is chosen
//             here so that the set becomes Andoyer's at I1 = I2. The origin and the signs of the
//             long-axis mode have not been compared with the original.
// Units       angles in radians, (-pi, pi]; actions in those of the angular momentum.
// Domain      that of sadov.hpp, region and lobe as there.
// Accuracy    that of sadov.hpp and one rounding of l; budgets named_sets_* in tests/budgets.hpp.
// Errors      those of sadov.hpp.
// Cost        that of sadov.hpp.
#pragma once

#include "polhode/free/sadov.hpp"

namespace polhode {
inline namespace v0 {

struct KinoshitaState {
  double l;
  double g;
  double h;
  double L;
  double G;
  double H;
  SadovRegion region = SadovRegion::short_axis;
  int lobe = 1;  // long-axis region: sign of the momentum along the long axis

  constexpr bool operator==(const KinoshitaState&) const = default;
};

KinoshitaState to_kinoshita(const FreeRotation& motion, double t);
RotorState to_rotor(const Body& body, const KinoshitaState& s);

// d(dtheta_B, dg_B) / d(l, g, h, L, G, H)
Matrix6 chart_jacobian(const Body& body, const KinoshitaState& s);

}  // namespace v0
}  // namespace polhode
