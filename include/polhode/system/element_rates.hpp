// SPDX-License-Identifier: MIT
// Gauge freedom: equations of motion of the elements of a free rotor under perturbation, be they
// canonical, osculating or of any other gauge.
//
// Equations   Elements C are those of a free motion that has the attitude of the body and a
//             momentum gamma of its own. The angular velocity of the body is that of the free
//             motion plus the convective term: w_SB = I^-1 gamma + Phi [SA (104) to (106), (109)],
//             Phi as a vector in body components. With y = I w_SB = g + I v, v = dH'/dg of the
//             terms and the frame: gamma = y - I Phi. Canonical elements have Phi = v
//             [SA (107), (111)]; osculating elements have Phi = 0, the Lagrange constraint;
//             Phi(C, t) of the user makes any other. With B = d(theta_B, gamma)/dC:
//             dC/dt = B^-1 (w_SB, dgamma/dt), dgamma/dt = dy/dt - I (dPhi/dt + dPhi/dC dC/dt), a
//             linear system for dC/dt. Of constants of the free motion (Serret's elements, the
//             modified Andoyer set) the free rates (I^-1 gamma, gamma x I^-1 gamma) are taken off.
// Units       of the elements per time; Phi in rad per time.
// Domain      elements: Andoyer's, Andoyer's as initial values, Serret's, Sadov's, always with the
//             angles first, then the momenta, in the order of the fields; -t0 is the third of
//             Serret's angles. Any system without a damper. Rates of other than canonical elements
//             need dv/dt along the motion: by differences in double-double, or in double of terms
//             that work on double alone.
// Accuracy    budget element_rates in tests/budgets.hpp, away from the singularities of the set;
//             1e-12 of dv/dt of terms that work on double alone.
// Errors      DomainError at a singularity of the set, and for a Phi whose linear system is
//             singular; those of canonical_state and of the set.
// Cost        the terms, with derivatives where elements are not canonical, and the Jacobian of the
//             set: microseconds for Andoyer's, a hundred for Sadov's.
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <utility>

#include "polhode/free/fukushima_ishizaki.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace rates {

// Which elements are meant.
class Gauge {
 public:
  using Elements = std::array<Tangent, 6>;
  using Function = std::function<BasicVec3<Tangent>(const Elements& C, const Tangent& t)>;

  static Gauge canonical() {
    Gauge gauge{Function{}};
    gauge.is_canonical_ = true;
    return gauge;
  }
  static Gauge osculating() { return Gauge{Function{}}; }
  // Phi(C, t), the convective term in body components.
  explicit Gauge(Function phi) : phi_(std::move(phi)) {}

  bool is_canonical() const { return is_canonical_; }
  const Function& phi() const { return phi_; }  // empty: canonical or osculating

 private:
  Function phi_;
  bool is_canonical_ = false;
};

template <class C>
concept RotorElements = std::same_as<C, AndoyerState> || std::same_as<C, FukushimaIshizakiState> ||
                        std::same_as<C, SerretState> || std::same_as<C, SadovState>;

// The equations of motion: dC/dt at time t. Angles first, then momenta. [SA (102), (104)]
template <RotorElements C>
std::array<double, 6> element_rates(const System& system, double t, const C& elements,
                                    const Gauge& gauge = Gauge::canonical());

// The canonical state (q, g) of a body with these elements: angular_velocity(system, t, state) is
// its inertial and its relative angular velocity.
template <RotorElements C>
RotorState element_state(const System& system, double t, const C& elements,
                         const Gauge& gauge = Gauge::canonical());

// The elements of a canonical state. `like` says which set; of Andoyer's variables at an epoch, the
// epoch.
template <RotorElements C>
C elements_of_state(const System& system, double t, const RotorState& canonical, const C& like,
                    const Gauge& gauge = Gauge::canonical());

// w_SB less the angular velocity of the free motion, in body components [SA (106), (109), (111)].
template <RotorElements C>
Vec3 element_convective_term(const System& system, double t, const C& elements,
                             const Gauge& gauge = Gauge::canonical());

}  // namespace rates
}  // namespace v0
}  // namespace polhode
