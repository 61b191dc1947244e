// SPDX-License-Identifier: MIT
// A rigid body that spins fast under the gravity gradient of a Kepler orbit: its mean elements and
// what was averaged away, by canonical perturbation theory of the first or second order.
//
// Equations   Sadov's variables [SA 5] in the axes of the orbit, x to the pericentre and z along
//             its normal. H = H_0(I_l, I_g) + 3 gm/(2 r^3) n.I n. The body turns exactly in phi_l
//             and phi_g, whatever its shape: its tensor of inertia in the axes of the momentum is a
//             Fourier series in both, n n^T / r^3 is one in phi_h and M, and H is their product. A
//             Lie transform (Hori) removes phi_l and phi_g, and M if the orbit is averaged too.
//             Left is K(phi_h, I_h, M) with I_l and I_g constant: dphi/dt = dK/dI, dI_h/dt =
//             -dK/dphi_h.
// Units       those of the body, gm, the orbit and the state.
// Domain      eccentricities up to 0.9; gm may be another than that of the orbit. A motion in
//             short- or long-axis mode, 1e-4 at least (of I_l / I_g and I_h / I_g) from the
//             separatrix, from spin about an axis and from momentum along the normal of the orbit,
//             where the elements lose their sense as Andoyer's do at J = 0 and I = 0. (At J = 0
//             there is NutationTheory.) No resonance between phi_l, phi_g and M. Coefficients are
//             Taylor polynomials of the actions about their means: a theory holds for the motion
//             that it was made of, and for those near it. At a relative distance d in the actions
//             rates err by d^3 of the free ones; beyond 0.3 of the way to the ends of the domain,
//             states and elements are refused.
// Accuracy    order N leaves out rates and short periods of order N + 1 in gm: budgets
//             gravity_theory_*. Close to a resonance the error grows with powers of 1 / (its rate).
//             Short periods that move angles by less than `least` are left out. The mean actions
//             are off by as much, so that mean angles drift by some of it in each radian of
//             rotation. rate_error() estimates the drift, for what is left out and for the next
//             order: 0.5 to 60 times what was found.
//             Angles are doubles: after a million turns they have 1e-9 rad.
// Errors      DomainError for an orbit out of the domain, a sphere, a motion out of it, an order
//             that is not 1 or 2, a time that is not finite, and a resonance, with its combination
//             of angles.
// Cost        to make: 15 ms (axisymmetric, circle) to 0.5 s (triaxial, e = 0.05), 4 s (e = 0.3);
//             with least = 1e-11 a tenth of that, and a drift of 5e-11 rad per rad. A mean state
//             0.01 to 0.4 ms, an osculating one 0.05 to 0.12 ms; a month of mean elements 0.1 to
//             0.2 s where M stays (benchmarks/perturbation_theory.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "polhode/free/sadov.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "polhode/series/series.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

// Sadov's variables, or their means, in the axes of an orbit.
struct MeanRotation {
  double phi_l, phi_g, phi_h;
  double I_l, I_g, I_h;

  constexpr bool operator==(const MeanRotation&) const = default;
};
template <class Visit>
void each_number(MeanRotation& m, Visit&& visit) {
  for (double* const x : {&m.phi_l, &m.phi_g, &m.phi_h, &m.I_l, &m.I_g, &m.I_h}) visit(*x);
}

struct GravityGradientOptions {
  int order = 2;
  // Else M stays in the mean Hamiltonian, and what resonates with it.
  bool averages_orbit = true;
  double least = 1e-15;  // rad
};

// Is a Model (polhode/dynamics/model.hpp): integrate moves its mean elements.
class GravityGradientTheory {
 public:
  using State = MeanRotation;
  static constexpr std::string_view name = "a mean rotation under a gravity gradient";

  // Of the motion through this state at time t.
  GravityGradientTheory(const Body& body, double gm, const KeplerOrbit& orbit,
                        const RotorState& state, double t,
                        const GravityGradientOptions& options = {});

  MeanRotation mean(double t, const RotorState& osculating) const;
  RotorState osculating(double t, const MeanRotation& mean) const;
  // Sadov's variables of a state in the axes of the orbit, and back.
  MeanRotation elements(double t, const RotorState& state) const;
  RotorState state_of(const MeanRotation& elements) const;

  // At these times, before and after t0, of the motion with these mean elements at t0, which
  // Adaptive moves. `progress` is called after each step, and after each state.
  std::vector<MeanRotation> means(double t0, const MeanRotation& mean,
                                  std::span<const double> times, double tolerance = 1e-12,
                                  const Progress& progress = {}) const;
  std::vector<RotorState> states(double t0, const MeanRotation& mean, std::span<const double> times,
                                 double tolerance = 1e-12, const Progress& progress = {}) const;

  const GravityGradientOptions& options() const { return options_; }
  // The elements about whose actions coefficients are expanded.
  MeanRotation reference() const;
  // K in phi_h, M and the displacements of I_l, I_g and I_h from the reference; k counts orders.
  const series::Series<double>& mean_hamiltonian() const;
  // Of the gravity gradient, as far as they are kept.
  std::size_t term_count() const;
  // By how much the mean angles drift from the motion, estimated: rad per time.
  double rate_error() const;

  // As a Model.
  using Values = std::array<double, 6>;
  template <class T>
    requires std::is_same_v<T, double>
  Values values(const MeanRotation& m) const {
    return {m.phi_l, m.phi_g, m.phi_h, m.I_l, m.I_g, m.I_h};
  }
  MeanRotation state(const Values& y) const { return {y[0], y[1], y[2], y[3], y[4], y[5]}; }
  Values rates(const DoubleDouble& t, const Values& y) const;
  double error_size(const Values& error, const Values& y, const Values& increment) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
  GravityGradientOptions options_;
};

}  // namespace secular
}  // namespace v0
}  // namespace polhode
