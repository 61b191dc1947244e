// SPDX-License-Identifier: MIT
#include "polhode/system/osculation.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "system/gauge.hpp"

namespace polhode {
inline namespace v0 {
namespace charts {
namespace {

using D = Tangent;
using DualVec = BasicVec3<D>;

Vec3 value_of(const DualVec& v) { return {v.x.value, v.y.value, v.z.value}; }
DualVec constant(const Vec3& v) { return {D(v.x), D(v.y), D(v.z)}; }

// v of the terms with its derivatives by g in the places 3, 4, 5.
DualVec terms_rate(const System& system, const Setting& at) {
  const BasicSetting<D> dual_at = with_variables(at);
  DualVec v;
  for (const AnyPerturbation& term : system.terms())
    v = v + (term.supports_any_real() ? term.effect(dual_at).v : constant(term.effect(at).v));
  return v;
}

// g + I (v - mu) - g_osc with its derivatives, and the size of what is summed.
struct Residual {
  Vec3 value;
  std::array<Vec3, 3> by_g;
  double size;

  Vec3 step() const { return polhode::detail::solve_columns(by_g, value); }
};

Residual residual(const System& system, const Setting& at, const Vec3& mu_B, const Vec3& g_osc) {
  const DualVec v = terms_rate(system, at);
  const Vec3& I = system.body().moments();
  const Vec3 w = value_of(v) - mu_B;
  const Vec3 lag = polhode::detail::by_inertia(I, w);
  Residual r{(at.s.g - g_osc) + lag, {}, norm(at.s.g) + norm(lag) + norm(g_osc)};
  for (int j = 0; j < 3; ++j) {
    const auto k = static_cast<std::size_t>(j) + 3;
    Vec3& column = r.by_g[static_cast<std::size_t>(j)];
    column = {I.x * v.x.derivative[k], I.y * v.y.derivative[k], I.z * v.z.derivative[k]};
    column[j] += 1.0;
  }
  return r;
}

[[noreturn]] void no_canonical_momentum(const Vec3& g_osc, const Residual& r) {
  throw DomainError("canonical_state: no canonical momentum found for the osculating one " +
                    polhode::detail::tuple_text({g_osc.x, g_osc.y, g_osc.z}) +
                    ", nearest misses by " + polhode::detail::number_text(norm(r.value)) +
                    ": the perturbation's v changes too fast with the momentum");
}

// Newton's method with halved steps where the full one does not come nearer.
Vec3 canonical_momentum(const System& system, Setting at, const Vec3& mu_B, const Vec3& g_osc) {
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  constexpr double stalled = 16.0 * rounding;  // as near as roundings of v let it come
  Residual r = residual(system, at, mu_B, g_osc);
  if (std::isnan(norm(r.value))) return r.value;
  for (int step = 0; step < 50; ++step) {
    if (norm(r.value) <= rounding * r.size) {
      // one more step brings the last bits, if it comes nearer
      const Vec3 g = at.s.g - r.step();
      const Setting polished{at.body, at.t, {at.s.q, g}, at.q_IS};
      return norm(residual(system, polished, mu_B, g_osc).value) < norm(r.value) ? g : at.s.g;
    }
    const Vec3 change = r.step();
    const Vec3 g = at.s.g;
    double part = 1.0;
    std::optional<Residual> nearer;
    for (int halving = 0; halving < 12 && !nearer; ++halving, part *= 0.5) {
      at.s.g = g - part * change;
      const Residual tried = residual(system, at, mu_B, g_osc);
      if (norm(tried.value) < norm(r.value)) nearer = tried;
    }
    if (!nearer && norm(r.value) <= stalled * r.size) return g;
    if (!nearer) no_canonical_momentum(g_osc, r);
    r = *nearer;
  }
  no_canonical_momentum(g_osc, r);
}

template <Real T>
RotorState in_double(const BasicRotorState<T>& s) {
  return {{to_double(s.q.w), to_double(s.q.x), to_double(s.q.y), to_double(s.q.z)},
          {to_double(s.g.x), to_double(s.g.y), to_double(s.g.z)}};
}

// I v, v of the terms and the frame.
template <Real T>
BasicVec3<T> lag(const System& system, double t, const BasicRotorState<T>& s) {
  const Vec3& I = system.body().moments();
  if constexpr (std::same_as<T, double>) {
    const Vec3 v = effect(system, t, s).v;
    return {I.x * v.x, I.y * v.y, I.z * v.z};
  } else {
    require_no_damper(system);
    const FrameMotion frame = system.frame().at(t);
    const BasicFrameMotion<T> motion = system.frame().at(T(t));
    const BasicSetting<T> at{system.body(), T(t), {normalized(s.q), s.g}, motion.q_IS};
    const Setting narrow{system.body(), t, in_double(at.s), frame.q_IS};
    BasicVec3<T> v = -body_from_reference(at, motion.mu_S);
    for (const AnyPerturbation& term : system.terms()) {
      if (term.supports_any_real()) {
        v = v + term.effect(at).v;
      } else {
        const Vec3 of = term.effect(narrow).v;
        v = v + BasicVec3<T>{T(of.x), T(of.y), T(of.z)};
      }
    }
    return {T(I.x) * v.x, T(I.y) * v.y, T(I.z) * v.z};
  }
}

}  // namespace

template <Real T>
BasicRotorState<T> osculating_state(const System& system, double t,
                                    const BasicRotorState<T>& canonical) {
  return {canonical.q, canonical.g + lag(system, t, canonical)};
}

template <Real T>
BasicRotorState<T> canonical_state(const System& system, double t,
                                   const BasicRotorState<T>& osculating) {
  require_no_damper(system);
  const RotorState start = in_double(osculating);
  const FrameMotion frame = system.frame().at(t);
  const Setting at{system.body(), t, {normalized(start.q), start.g}, frame.q_IS};
  const Vec3 mu_B = body_from_reference(at, frame.mu_S);
  const Vec3 g = canonical_momentum(system, at, mu_B, start.g);
  if constexpr (std::same_as<T, double>) {
    return {osculating.q, g};
  } else {
    // a step with the Jacobian of double adds an order of derivatives, or the digits of a double
    const auto by_g = residual(system, {at.body, t, {at.s.q, g}, at.q_IS}, mu_B, start.g).by_g;
    BasicRotorState<T> canonical{osculating.q, {T(g.x), T(g.y), T(g.z)}};
    const std::size_t steps = derivative_order<T> + (epsilon<T>() < epsilon<double>() ? 2 : 0);
    for (std::size_t k = 0; k < steps; ++k)
      canonical.g =
          canonical.g - polhode::detail::solve_columns(
                            by_g, (canonical.g - osculating.g) + lag(system, t, canonical));
    return canonical;
  }
}

RotorState osculating_state(const System& system, double t, const RotorState& canonical) {
  return osculating_state<double>(system, t, canonical);
}
RotorState canonical_state(const System& system, double t, const RotorState& osculating) {
  return canonical_state<double>(system, t, osculating);
}

template BasicRotorState<DoubleDouble> osculating_state(const System&, double,
                                                        const BasicRotorState<DoubleDouble>&);
template BasicRotorState<DoubleDouble> canonical_state(const System&, double,
                                                       const BasicRotorState<DoubleDouble>&);
template BasicRotorState<Tangent> osculating_state(const System&, double,
                                                   const BasicRotorState<Tangent>&);
template BasicRotorState<Tangent> canonical_state(const System&, double,
                                                  const BasicRotorState<Tangent>&);

AndoyerState osculating_andoyer(const System& system, double t, const RotorState& canonical) {
  return to_andoyer(osculating_state(system, t, canonical));
}

AndoyerState osculating_andoyer(const System& system, double t, const AndoyerState& canonical) {
  return osculating_andoyer(system, t, to_rotor(canonical));
}

AndoyerState canonical_andoyer(const System& system, double t, const AndoyerState& osculating) {
  return to_andoyer(canonical_state(system, t, to_rotor(osculating)));
}

AndoyerState modified_andoyer(const Body& body, double t, const RotorState& s, double t0) {
  return to_andoyer(FreeRotation(body, s, t).at(t0));
}

RotorState from_modified_andoyer(const Body& body, double t, const AndoyerState& C, double t0) {
  return FreeRotation(body, to_rotor(C), t0).at(t);
}

rates::AndoyerRates modified_andoyer_rates(const System& system, double t, const RotorState& s,
                                           double t0) {
  const FreeRotation motion(system.body(), s, t);
  const rates::HubRates added = rates::perturbation_rates(system, t, s);
  const std::array<double, 6> at_epoch =
      motion.state_transition(t0) * polhode::detail::tangent(added.theta, added.g);
  rates::CanonicalRates z =
      inverse_chart_jacobian(motion.at(t0), {CanonicalSet::andoyer}) * at_epoch;
  for (double& rate : z)
    if (!std::isfinite(rate)) rate = std::numeric_limits<double>::quiet_NaN();
  return {z[0], z[1], z[2], z[3], z[4], z[5]};
}

}  // namespace charts
}  // namespace v0
}  // namespace polhode
