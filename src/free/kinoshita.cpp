// SPDX-License-Identifier: MIT
// Kinoshita's variables: Sadov's with another origin of l.
#include "polhode/free/kinoshita.hpp"

#include "free/detail/mean_frame.hpp"
#include "polhode/math/double_double.hpp"

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

}  // namespace v0
}  // namespace polhode
