// SPDX-License-Identifier: MIT
#include "polhode/system/satellite_system.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace satellites {

OrbitalPerturbation oblateness(double gm, double J2, double radius) {
  const double size = gm * J2 * radius * radius;
  if (!(radius > 0.0) || !std::isfinite(size))
    throw DomainError("oblateness: got gm = " + polhode::detail::number_text(gm) +
                      ", J2 = " + polhode::detail::number_text(J2) +
                      ", radius = " + polhode::detail::number_text(radius) +
                      "; expected finite numbers, radius > 0");
  return OrbitalPerturbation([size]<class T>(const T&, const BasicSatelliteState<T>& s) {
    using std::sqrt;
    const T r2 = dot(s.r, s.r);
    const T z2 = s.r.z * s.r.z / r2;
    return T(T(size) * (T(1.5) * z2 - T(0.5)) / (r2 * sqrt(r2)));
  });
}

SatelliteSystem::SatelliteSystem(double gm, Frame frame, std::vector<OrbitalPerturbation> terms)
    : gm_(gm), frame_(std::move(frame)), terms_(std::move(terms)) {
  if (!(gm > 0.0) || !std::isfinite(gm))
    throw DomainError("SatelliteSystem: got gm = " + polhode::detail::number_text(gm) +
                      "; expected a positive finite number");
}

template <Real T>
BasicSatelliteState<T> perturbation_rates(const SatelliteSystem& system, const T& t,
                                          const BasicSatelliteState<T>& s) {
  const BasicVec3<T> mu = system.frame().at(t).mu_S;
  BasicSatelliteState<T> rates{-cross(mu, s.r), -cross(mu, s.p)};
  for (const OrbitalPerturbation& term : system.terms()) {
    const BasicOrbitalEffect<T> of = term.effect(t, s);
    rates.r = rates.r + of.by_p;
    rates.p = rates.p - of.by_r;
  }
  return rates;
}

template <Real T>
BasicSatelliteState<T> satellite_rates(const SatelliteSystem& system, const T& t,
                                       const BasicSatelliteState<T>& s) {
  const BasicSatelliteState<T> added = perturbation_rates(system, t, s);
  const T r = norm(s.r);
  return {s.p + added.r, (T(-system.gm()) / (r * r * r)) * s.r + added.p};
}

#define POLHODE_RATES(T)                                                               \
  template BasicSatelliteState<T> perturbation_rates(const SatelliteSystem&, const T&, \
                                                     const BasicSatelliteState<T>&);   \
  template BasicSatelliteState<T> satellite_rates(const SatelliteSystem&, const T&,    \
                                                  const BasicSatelliteState<T>&);
POLHODE_RATES(double)
POLHODE_RATES(DoubleDouble)
#undef POLHODE_RATES

double energy(const SatelliteSystem& system, double t, const SatelliteState& s) {
  double H = 0.5 * dot(s.p, s.p) - system.gm() / norm(s.r);
  for (const OrbitalPerturbation& term : system.terms()) H += term.effect(t, s).energy;
  return H - dot(system.frame().at(t).mu_S, cross(s.r, s.p));
}

}  // namespace satellites
}  // namespace v0
}  // namespace polhode
