// SPDX-License-Identifier: MIT
// Equations of motion of canonical, osculating and other elements of a free rotor.
#include "polhode/system/element_rates.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "polhode/system/osculation.hpp"
#include "system/gauge.hpp"

namespace polhode {
inline namespace v0 {
namespace rates {
namespace {

using polhode::detail::by_inertia;
using polhode::detail::Convection;
using polhode::detail::convection_of;
using Numbers = polhode::detail::ElementNumbers;

Vec3 over(const Vec3& x, const Vec3& I) { return {x.x / I.x, x.y / I.y, x.z / I.z}; }

// A set of elements: its numbers, angles first, and the free motion that they describe.
Numbers numbers(const AndoyerState& C) { return {C.l, C.g, C.h, C.L, C.G, C.H}; }
Numbers numbers(const FukushimaIshizakiState& C) { return {C.l0, C.g0, C.h, C.L0, C.G, C.H}; }
Numbers numbers(const SerretState& C) { return {C.g0, C.h, -C.t0, C.G, C.H, C.T}; }
Numbers numbers(const SadovState& C) { return {C.phi_l, C.phi_g, C.phi_h, C.I_l, C.I_g, C.I_h}; }

RotorState free_state(const Body&, double, const AndoyerState& C) { return to_rotor(C); }
RotorState free_state(const Body& body, double t, const FukushimaIshizakiState& C) {
  return to_rotor(body, C, t);
}
RotorState free_state(const Body& body, double t, const SerretState& C) {
  return to_rotor(body, C, t);
}
RotorState free_state(const Body& body, double, const SadovState& C) { return to_rotor(body, C); }

AndoyerState of_free_state(const Body&, double, const RotorState& s, const AndoyerState&) {
  return to_andoyer(s);
}
FukushimaIshizakiState of_free_state(const Body& body, double t, const RotorState& s,
                                     const FukushimaIshizakiState& like) {
  return to_fukushima_ishizaki(FreeRotation(body, s, t), like.t0);
}
SerretState of_free_state(const Body& body, double t, const RotorState& s, const SerretState&) {
  return to_serret(FreeRotation(body, s, t), t);
}
SadovState of_free_state(const Body& body, double, const RotorState& s, const SadovState&) {
  return to_sadov(body, s);
}

// Whether the free motion leaves them where they are.
template <class C>
constexpr bool are_constants =
    std::same_as<C, FukushimaIshizakiState> || std::same_as<C, SerretState>;

// dC / d(theta_B, gamma).
Matrix6 inverse_jacobian(const Body&, double, const AndoyerState&, const RotorState& s) {
  return inverse_chart_jacobian(s, {CanonicalSet::andoyer});
}
Matrix6 inverse_jacobian(const Body& body, double t, const FukushimaIshizakiState& C,
                         const RotorState& s) {
  return inverse_chart_jacobian(s.g, chart_jacobian(body, C, t));
}
Matrix6 inverse_jacobian(const Body& body, double t, const SerretState& C, const RotorState& s) {
  return inverse_chart_jacobian(s.g, chart_jacobian(body, C, t));
}
Matrix6 inverse_jacobian(const Body& body, double, const SadovState& C, const RotorState& s) {
  return inverse_chart_jacobian(s.g, chart_jacobian(body, C));
}

struct SetName {
  const char* set;
  const char* alternative;
};
constexpr const char* regular =
    "take canonical_rates of a Poincare-type chart, which is regular there, or the "
    "quaternion-momentum state";
SetName name(const AndoyerState&) {
  return {"Andoyer's variables (J or I is 0 or pi, or G = 0)", regular};
}
SetName name(const FukushimaIshizakiState&) {
  return {"the modified Andoyer set (J or I is 0 or pi at the epoch, or G = 0)", regular};
}
SetName name(const SerretState&) {
  return {"Serret's elements (J or I is 0 or pi, or a steady rotation)", regular};
}
SetName name(const SadovState&) {
  return {"Sadov's variables (J or I is 0 or pi, or the separatrix)", regular};
}

template <class C>
[[noreturn]] void no_rates(const C& elements) {
  const Numbers z = numbers(elements);
  const SetName of = name(elements);
  throw DomainError("element_rates: the rates of " +
                    polhode::detail::tuple_text({z[0], z[1], z[2], z[3], z[4], z[5]}) +
                    " do not exist: a singularity of " + of.set + "; " + of.alternative);
}

// v of the terms at a state, and that of the frame, -mu: the sum over terms that `chosen` takes.
template <Real T, class Chosen>
BasicVec3<T> convection(const System& system, const T& t, const BasicRotorState<T>& s,
                        const Chosen& chosen, bool with_frame) {
  const BasicFrameMotion<T> frame = system.frame().at(t);
  const BasicSetting<T> at{system.body(), t, s, frame.q_IS};
  BasicVec3<T> v{};
  for (const AnyPerturbation& term : system.terms())
    if (chosen(term)) v = v + term.effect(at).v;
  return with_frame ? v - body_from_reference(at, frame.mu_S) : v;
}

// dv/dt along the motion by central differences: of order 4 in double-double, of 6 in double.
Vec3 convection_rate(const System& system, double t, const RotorState& s, const RotorRates& rate,
                     double fastest) {
  const auto moved = [&]<Real T>(const T& h) {
    const BasicQuaternion<T> q{T(s.q.w) + h * T(rate.q.w), T(s.q.x) + h * T(rate.q.x),
                               T(s.q.y) + h * T(rate.q.y), T(s.q.z) + h * T(rate.q.z)};
    const BasicVec3<T> g{T(s.g.x) + h * T(rate.g.x), T(s.g.y) + h * T(rate.g.y),
                         T(s.g.z) + h * T(rate.g.z)};
    return BasicRotorState<T>{normalized(q), g};
  };
  const auto wide = [](const AnyPerturbation& term) { return term.supports_any_real(); };
  const auto narrow = [](const AnyPerturbation& term) { return !term.supports_any_real(); };
  using DD = DoubleDouble;
  const auto v_wide = [&](double h) {
    return convection<DD>(system, DD(t) + DD(h), moved(DD(h)), wide, true);
  };
  const double h = std::ldexp(1.0, -30) / fastest;
  const BasicVec3<DD> near = v_wide(h) - v_wide(-h), far = v_wide(2.0 * h) - v_wide(-2.0 * h);
  const BasicVec3<DD> slope = (DD(1.0) / DD(12.0 * h)) * (DD(8.0) * near - far);
  Vec3 total{to_double(slope.x), to_double(slope.y), to_double(slope.z)};
  if (std::any_of(system.terms().begin(), system.terms().end(), narrow)) {
    const double step = std::ldexp(1.0, -7) / fastest;
    const auto difference = [&](double d) {
      return convection<double>(system, t + d, moved(d), narrow, false) -
             convection<double>(system, t - d, moved(-d), narrow, false);
    };
    total = total + (1.0 / (60.0 * step)) * (45.0 * difference(step) -
                                             9.0 * difference(2.0 * step) + difference(3.0 * step));
  }
  return total;
}

// q and gamma + I Phi = I w_SB of elements of other than the canonical gauge.
template <class C>
RotorState osculating_of(const Body& body, double t, const C& elements, const Gauge& gauge) {
  const RotorState free = free_state(body, t, elements);
  return {free.q,
          free.g + by_inertia(body.moments(), convection_of(gauge, numbers(elements), t).value)};
}

}  // namespace

template <RotorElements C>
RotorState element_state(const System& system, double t, const C& elements, const Gauge& gauge) {
  if (gauge.is_canonical()) return free_state(system.body(), t, elements);
  return charts::canonical_state(system, t, osculating_of(system.body(), t, elements, gauge));
}

template <RotorElements C>
C elements_of_state(const System& system, double t, const RotorState& canonical, const C& like,
                    const Gauge& gauge) {
  const Body& body = system.body();
  if (gauge.is_canonical()) return of_free_state(body, t, canonical, like);
  const RotorState osculating = charts::osculating_state(system, t, canonical);
  const auto free = [&](const Vec3& gamma) { return RotorState{osculating.q, gamma}; };
  const Vec3 gamma = polhode::detail::unperturbed_momentum(
      gauge, t, body.moments(), osculating.g,
      [&](const Vec3& g) { return numbers(of_free_state(body, t, free(g), like)); },
      [&](const Vec3& g) {
        return inverse_jacobian(body, t, of_free_state(body, t, free(g), like), free(g));
      });
  return of_free_state(body, t, free(gamma), like);
}

template <RotorElements C>
Vec3 element_convective_term(const System& system, double t, const C& elements,
                             const Gauge& gauge) {
  if (gauge.is_canonical()) return effect(system, t, free_state(system.body(), t, elements)).v;
  return convection_of(gauge, numbers(elements), t).value;
}

template <RotorElements C>
std::array<double, 6> element_rates(const System& system, double t, const C& elements,
                                    const Gauge& gauge) {
  require_no_damper(system);
  const Body& body = system.body();
  const Vec3& I = body.moments();
  const RotorState free = free_state(body, t, elements);
  const Matrix6 inverse = inverse_jacobian(body, t, elements, free);
  for (const auto& row : inverse.a)
    for (const double x : row)
      if (!std::isfinite(x)) no_rates(elements);

  // what constants do not feel: the free motion of gamma
  const Vec3 free_w = over(free.g, I), free_torque = cross(free.g, free_w);
  if (gauge.is_canonical()) {
    const HubRates added = perturbation_rates(system, t, free);
    if constexpr (are_constants<C>) return inverse * polhode::detail::tangent(added.theta, added.g);
    return inverse * polhode::detail::tangent(free_w + added.theta, free_torque + added.g);
  }

  const Numbers z = numbers(elements);
  const Convection phi = convection_of(gauge, z, t);
  const Vec3 w = free_w + phi.value;  // w_SB
  const RotorState state = element_state(system, t, elements, gauge);
  const RotorRates rate = rotor_rates(system, t, state);
  const double fastest = norm(w) + norm(system.frame().at(t).mu_S);
  const Vec3 dv = convection_rate(system, t, state, rate, fastest > 0.0 ? fastest : 1.0);
  const Vec3 force = rate.g + by_inertia(I, dv);
  return are_constants<C> ? polhode::detail::gauge_rates(gauge, I, z, phi, inverse, {}, phi.value,
                                                         force - free_torque)
                          : polhode::detail::gauge_rates(gauge, I, z, phi, inverse, {}, w, force);
}

#define POLHODE_ELEMENTS(C)                                                                       \
  template std::array<double, 6> element_rates<C>(const System&, double, const C&, const Gauge&); \
  template RotorState element_state<C>(const System&, double, const C&, const Gauge&);            \
  template C elements_of_state<C>(const System&, double, const RotorState&, const C&,             \
                                  const Gauge&);                                                  \
  template Vec3 element_convective_term<C>(const System&, double, const C&, const Gauge&);
POLHODE_ELEMENTS(AndoyerState)
POLHODE_ELEMENTS(FukushimaIshizakiState)
POLHODE_ELEMENTS(SerretState)
POLHODE_ELEMENTS(SadovState)
#undef POLHODE_ELEMENTS

}  // namespace rates
}  // namespace v0
}  // namespace polhode
