// SPDX-License-Identifier: MIT
// Sets of the literature: Kinoshita's variables, Sadov's with another origin of l; Fukushima and
// Ishizaki's elements, Andoyer's variables at an epoch.
#include <cmath>

#include "free/detail/mean_frame.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/fukushima_ishizaki.hpp"
#include "polhode/free/kinoshita.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/chart_jacobian.hpp"

namespace polhode {
inline namespace v0 {
namespace {

DoubleDouble quarter() { return DoubleDouble(0.5) * DoubleDouble::pi(); }

SadovState sadov_of(const KinoshitaState& s) {
  return {
      detail::wrapped(DoubleDouble(s.l) - quarter()).hi, s.g, s.h, s.L, s.G, s.H, s.region, s.lobe};
}

}  // namespace

KinoshitaState to_kinoshita(const FreeRotation& motion, double t) {
  const SadovState s = to_sadov(motion, t);
  return {detail::wrapped(DoubleDouble(s.phi_l) + quarter()).hi,
          s.phi_g,
          s.phi_h,
          s.I_l,
          s.I_g,
          s.I_h,
          s.region,
          s.lobe};
}

RotorState to_rotor(const Body& body, const KinoshitaState& s) {
  return to_rotor(body, sadov_of(s));
}

Matrix6 chart_jacobian(const Body& body, const KinoshitaState& s) {
  return chart_jacobian(body, sadov_of(s));
}

FukushimaIshizakiState to_fukushima_ishizaki(const FreeRotation& motion, double t) {
  if (!std::isfinite(t))
    throw DomainError("to_fukushima_ishizaki: t = " + detail::number_text(t) +
                      ", the epoch, must be finite");
  const AndoyerState a = to_andoyer(motion.at(t));
  return {a.l, a.g, a.h, a.L, a.G, a.H, t};
}

FreeRotation free_rotation(const Body& body, const FukushimaIshizakiState& s) {
  return {body, to_rotor(andoyer_state(s.l0, s.g0, s.h, s.L0, s.G, s.H)), s.t0};
}

RotorState to_rotor(const Body& body, const FukushimaIshizakiState& s, double t) {
  return free_rotation(body, s).at(t);
}

Matrix6 chart_jacobian(const Body& body, const FukushimaIshizakiState& s, double t) {
  const FreeRotation motion = free_rotation(body, s);
  return motion.state_transition(t) *
         chart_jacobian(motion.initial_state(), {CanonicalSet::andoyer});
}

}  // namespace v0
}  // namespace polhode
