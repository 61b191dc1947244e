// SPDX-License-Identifier: MIT
#include "polhode/system/osculation.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/dual.hpp"

namespace polhode {
inline namespace v0 {
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

// x of A x = b by Cramer's rule, the columns of A given.
Vec3 solved(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& right) {
  const double det = dot(a, cross(b, c));
  return {dot(right, cross(b, c)) / det, dot(a, cross(right, c)) / det,
          dot(a, cross(b, right)) / det};
}

// g + I (v - mu) - g_osc with its derivatives, and the size of what is summed.
struct Residual {
  Vec3 value;
  Vec3 by_g[3];
  double size;
};

Residual residual(const System& system, const Setting& at, const Vec3& mu_B, const Vec3& g_osc) {
  const DualVec v = terms_rate(system, at);
  const Vec3& I = system.body().moments();
  const Vec3 w = value_of(v) - mu_B;
  const Vec3 lag{I.x * w.x, I.y * w.y, I.z * w.z};
  Residual r{(at.s.g - g_osc) + lag, {}, norm(at.s.g) + norm(lag) + norm(g_osc)};
  for (int j = 0; j < 3; ++j) {
    const auto k = static_cast<std::size_t>(j) + 3;
    r.by_g[j] = {I.x * v.x.derivative[k], I.y * v.y.derivative[k], I.z * v.z.derivative[k]};
    r.by_g[j][j] += 1.0;
  }
  return r;
}

[[noreturn]] void no_canonical_momentum(const Vec3& g_osc, const Residual& r) {
  throw DomainError("canonical_state: no canonical momentum found for the osculating one " +
                    detail::tuple_text({g_osc.x, g_osc.y, g_osc.z}) + ", nearest misses by " +
                    detail::number_text(norm(r.value)) +
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
      const Vec3 g = at.s.g - solved(r.by_g[0], r.by_g[1], r.by_g[2], r.value);
      const Setting polished{at.body, at.t, {at.s.q, g}, at.q_IS};
      return norm(residual(system, polished, mu_B, g_osc).value) < norm(r.value) ? g : at.s.g;
    }
    const Vec3 change = solved(r.by_g[0], r.by_g[1], r.by_g[2], r.value);
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

}  // namespace

RotorState osculating_state(const System& system, double t, const RotorState& canonical) {
  const Vec3 v = effect(system, t, canonical).v;
  const Vec3& I = system.body().moments();
  return {canonical.q, canonical.g + Vec3{I.x * v.x, I.y * v.y, I.z * v.z}};
}

RotorState canonical_state(const System& system, double t, const RotorState& osculating) {
  require_no_damper(system);
  const FrameMotion frame = system.frame().at(t);
  const Setting at{system.body(), t, {normalized(osculating.q), osculating.g}, frame.q_IS};
  const Vec3 mu_B = body_from_reference(at, frame.mu_S);
  return {osculating.q, canonical_momentum(system, at, mu_B, osculating.g)};
}

AndoyerState osculating_andoyer(const System& system, double t, const RotorState& canonical) {
  return to_andoyer(osculating_state(system, t, canonical));
}

AndoyerState osculating_andoyer(const System& system, double t, const AndoyerState& canonical) {
  return osculating_andoyer(system, t, to_rotor(canonical));
}

AndoyerState canonical_andoyer(const System& system, double t, const AndoyerState& osculating) {
  return to_andoyer(canonical_state(system, t, to_rotor(osculating)));
}

}  // namespace v0
}  // namespace polhode
