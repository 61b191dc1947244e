// SPDX-License-Identifier: MIT
// SatelliteSystem: a point mass about a planet under any perturbation, in a moving frame;
// Hamilton's equations of its position and momentum.
//
// Equations   H = p^2/2 - gm/r + H'(t, r, p) - mu . (r x p), with mu the rate of the frame S. Then
//             dr/dt = p + dH'/dp - mu x r and dp/dt = -gm r/r^3 - dH'/dr - mu x p
//             [SA (101) and the footnote on (108)]. If H' does not depend on p, the momentum p is
//             the velocity relative to inertial axes, in components along S.
// Units       any consistent set: gm in length^3 / time^2; mu in rad per time. Momentum and energy
//             are per unit mass, so that p is a velocity.
// Domain      r not 0. H' is a generic callable on any number type:
//             auto H(const auto& t, const BasicSatelliteState<T>& s).
// Accuracy    a few roundings; derivatives of H' are by dual numbers.
// Errors      DomainError for a gm that is not positive and finite. What H' throws passes through;
//             NaN in, NaN out.
// Cost        H' with six derivatives.
#pragma once

#include <array>
#include <concepts>
#include <memory>
#include <utility>
#include <vector>

#include "polhode/frame/frame.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/system/element_rates.hpp"

namespace polhode {
inline namespace v0 {
namespace satellites {

// Position and momentum per unit mass, both along the axes of S.
template <Number T>
struct BasicSatelliteState {
  BasicVec3<T> r;
  BasicVec3<T> p;

  constexpr bool operator==(const BasicSatelliteState&) const = default;
};
using SatelliteState = BasicSatelliteState<double>;

template <class Visit>
void each_number(SatelliteState& s, Visit&& visit) {
  for (Vec3* v : {&s.r, &s.p})
    for (int k = 0; k < 3; ++k) visit((*v)[k]);
}

// H' with its derivatives by r and p.
template <Number T>
struct BasicOrbitalEffect {
  T energy;
  BasicVec3<T> by_r;
  BasicVec3<T> by_p;
};

// An energy H'(t, r, p) of any type.
class OrbitalPerturbation {
 public:
  template <class F>
    requires(!std::same_as<F, OrbitalPerturbation>)
  explicit OrbitalPerturbation(F H) : held_(std::make_shared<const Held<F>>(std::move(H))) {}

  BasicOrbitalEffect<double> effect(double t, const SatelliteState& s) const {
    return held_->effect(t, s);
  }
  BasicOrbitalEffect<DoubleDouble> effect(const DoubleDouble& t,
                                          const BasicSatelliteState<DoubleDouble>& s) const {
    return held_->effect(t, s);
  }

 private:
  struct Erased {
    virtual ~Erased() = default;
    virtual BasicOrbitalEffect<double> effect(double t, const SatelliteState& s) const = 0;
    virtual BasicOrbitalEffect<DoubleDouble> effect(
        const DoubleDouble& t, const BasicSatelliteState<DoubleDouble>& s) const = 0;
  };
  template <class F>
  struct Held final : Erased {
    explicit Held(F H) : energy(std::move(H)) {}
    BasicOrbitalEffect<double> effect(double t, const SatelliteState& s) const override {
      return effect_of(t, s);
    }
    BasicOrbitalEffect<DoubleDouble> effect(
        const DoubleDouble& t, const BasicSatelliteState<DoubleDouble>& s) const override {
      return effect_of(t, s);
    }
    template <Real T>
    BasicOrbitalEffect<T> effect_of(const T& t, const BasicSatelliteState<T>& s) const {
      using D = Dual<T, 6>;
      const auto variable = [](const T& x, int k) { return D::variable(x, k); };
      const D H = energy(D(t), BasicSatelliteState<D>{
                                   {variable(s.r.x, 0), variable(s.r.y, 1), variable(s.r.z, 2)},
                                   {variable(s.p.x, 3), variable(s.p.y, 4), variable(s.p.z, 5)}});
      const auto& d = H.derivative;
      return {H.value, {d[0], d[1], d[2]}, {d[3], d[4], d[5]}};
    }
    F energy;
  };
  std::shared_ptr<const Erased> held_;
};

// The oblateness of the planet about the third axis of S: H' = gm J2 R^2 / r^3 P_2(z/r).
// DomainError unless the numbers are finite and the radius is positive.
OrbitalPerturbation oblateness(double gm, double J2, double radius);

class SatelliteSystem {
 public:
  explicit SatelliteSystem(double gm, Frame frame = Frame::inertial(),
                           std::vector<OrbitalPerturbation> terms = {});

  double gm() const { return gm_; }
  const Frame& frame() const { return frame_; }
  const std::vector<OrbitalPerturbation>& terms() const { return terms_; }

 private:
  double gm_;
  Frame frame_;
  std::vector<OrbitalPerturbation> terms_;
};

// (dr/dt, dp/dt), and the part of it that the perturbations and the frame add to the
// Kepler motion (p, -gm r/r^3). T = double or DoubleDouble.
template <Real T>
BasicSatelliteState<T> satellite_rates(const SatelliteSystem& system, const T& t,
                                       const BasicSatelliteState<T>& s);
template <Real T>
BasicSatelliteState<T> perturbation_rates(const SatelliteSystem& system, const T& t,
                                          const BasicSatelliteState<T>& s);

// The Hamiltonian per unit mass, constant if nothing depends on time.
double energy(const SatelliteSystem& system, double t, const SatelliteState& s);

// Gauge freedom of orbits: equations of motion of Delaunay's and Keplerian elements of a satellite
// in the canonical gauge, the osculating gauge or any other.
//
// Equations   as element_rates.hpp, for orbits. Elements C are those of a Kepler orbit with the
//             position r of the satellite and a velocity u of its own: dr/dt = u + Phi
//             [SA (104) to (106)]. Canonical elements have Phi = dH'/dp - mu x r, so that u = p;
//             osculating elements have Phi = 0; a function Phi(C, t) gives any other. With
//             B = d(r, u)/dC: dC/dt = B^-1 (dr/dt, du/dt), du/dt = d(u + Phi)/dt - dPhi/dt -
//             dPhi/dC dC/dt.
//             All vectors are along the frame S, and inclination and node refer to its plane.
// Units       as satellite_system.hpp; angles in radians; Phi a velocity; rates per time.
// Domain      bound orbits. Delaunay: l, g, h, L, G, H, with L = sqrt(gm a) > 0, G = L sqrt(1 -
//             e^2), H = G cos i. Keplerian: a, e, i, Omega, omega, M.
// Accuracy    budgets orbital_* in tests/budgets.hpp, away from e = 0 and i = 0, pi.
// Errors      DomainError for an orbit that is not bound, for rates at e = 0 and i = 0, pi, where
//             they do not exist, for a Phi whose linear system is singular, and if Newton's method
//             does not converge.
// Cost        the perturbation with its derivatives and 6 x 6 derivatives of a Kepler orbit.

enum class OrbitalSet { delaunay, keplerian };
using OrbitalElements = std::array<double, 6>;  // in the order above

// dC/dt at time t [SA (104), "(96), footnote"].
OrbitalElements element_rates(const SatelliteSystem& system, double t,
                              const OrbitalElements& elements, OrbitalSet set,
                              const rates::Gauge& gauge = rates::Gauge::canonical());

// The canonical state (r, p) of a satellite with these elements [SA (96)].
SatelliteState element_state(const SatelliteSystem& system, double t,
                             const OrbitalElements& elements, OrbitalSet set,
                             const rates::Gauge& gauge = rates::Gauge::canonical());

// The elements of a canonical state [SA (96)].
OrbitalElements elements_of_state(const SatelliteSystem& system, double t,
                                  const SatelliteState& canonical, OrbitalSet set,
                                  const rates::Gauge& gauge = rates::Gauge::canonical());

// dr/dt less the velocity of the Kepler orbit.
Vec3 element_convective_term(const SatelliteSystem& system, double t,
                             const OrbitalElements& elements, OrbitalSet set,
                             const rates::Gauge& gauge = rates::Gauge::canonical());

}  // namespace satellites
}  // namespace v0
}  // namespace polhode
