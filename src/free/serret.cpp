// SPDX-License-Identifier: MIT
// Serret's elements, read from a FreeRotation and turned back into a state.
#include "polhode/free/serret.hpp"

#include <cmath>
#include <string>

#include "free/detail/assembly.hpp"
#include "free/detail/hub_tangent.hpp"
#include "free/detail/mean_phase.hpp"
#include "free/detail/precession.hpp"
#include "free/detail/sorted_state.hpp"
#include "math/detail/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/rotor/andoyer.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using DD = DoubleDouble;
constexpr double half_pi = 1.5707963267948966;

// The moment of one scaled unit.
double moment_unit(const Body& body) {
  return std::ldexp(1.0, detail::exponent_of_largest(body.moments()));
}

// Discriminants at momentum 1 and scaled moments: 1 - 2 T I / G^2, none below zero.
template <Real T>
detail::Discriminants<T> discriminants_of(const BasicVec3<T>& I, const T& twice_energy) {
  const T one(1.0), zero(0.0);
  const T D1 = one - twice_energy * I.x, D3 = twice_energy * I.z - one;
  return {D1 < zero ? zero : D1, one - twice_energy * I.y, D3 < zero ? zero : D3};
}

// Below this 1 - k^2 the derivative of K, like 1 / (1 - k^2), takes the digits of the others with
// it, and on the separatrix there is none. The elements stand still, so B is then carried by the
// flow from t0, where it needs no K.
constexpr double flow_below = 1e-14;

// 2 T / G^2 times the unit of moment; no square, so small and large units serve.
template <Real T>
T energy_ratio(const Body& body, const BasicSerretState<T>& c) {
  return T(2.0) * (c.T / c.G) * (T(moment_unit(body)) / c.G);
}

template <Real T>
detail::PolhodeCurve<T> curve_of(const Body& body, const BasicSerretState<T>& c) {
  const BasicVec3<DD> sorted = detail::sorted_moments(body);
  const BasicVec3<T> I{T(sorted.x), T(sorted.y), T(sorted.z)};
  return detail::polhode_curve(I, T(1.0), discriminants_of(I, energy_ratio(body, c)), false);
}

template <Real T>
BasicRotorState<T> rotor_from(const Body& body, const detail::PolhodeCurve<T>& curve,
                              const BasicSerretState<T>& c, double t) {
  const detail::AxisOrder order = detail::ascending_order(body.moments());
  const detail::PrimedSense sense = detail::primed_sense(curve.long_axis, c.sign_g1, c.sign_g3);
  const T elapsed = (T(t) - c.t0) * (c.G / T(moment_unit(body)));  // in units of momentum 1
  const T mean_angle =
      c.g0 + detail::node_offset<T>(sense) + detail::precession_of_axis1(curve) * elapsed;
  return detail::assembled(order, sense, curve, T(curve.n * elapsed),
                           detail::InvariableElements<T>{mean_angle, c.h, c.H, c.G});
}

BasicSerretState<DD> widened(const SerretState& s) {
  return {s.g0, s.h, s.t0, s.G, s.H, s.T, s.sign_g1, s.sign_g3};
}

// The state at t0 of a rotation that is steady: l = +-pi/2 and L from the energy.
RotorState base_state(const Body& body, const SerretState& s) {
  const BasicSerretState<DD> c = widened(s);
  const BasicVec3<DD> I = detail::sorted_moments(body);
  const detail::Discriminants<DD> d = discriminants_of(I, energy_ratio(body, c));
  const double L = s.sign_g3 * (c.G * sqrt(I.z * d.D1 / (I.z - I.x))).hi;
  const double l = s.sign_g1 < 0 ? -half_pi : half_pi;
  return detail::in_body_axes(body, to_rotor(AndoyerState{l, s.g0, s.h, L, s.G, s.H}));
}

void require_elements(const Body& body, const SerretState& s) {
  if (detail::is_sphere(body))
    throw DomainError("SerretState: moment " + detail::number_text(body.moments().x) +
                      " three times: a sphere has no Serret elements (T does not tell J)");
  const auto fail = [&](const std::string& need) {
    throw DomainError("SerretState: (g0, h, t0, G, H, T) = " +
                      detail::tuple_text({s.g0, s.h, s.t0, s.G, s.H, s.T}) + " needs " + need);
  };
  const double slack = 1.0 + 8.0 * epsilon<double>();
  for (const double x : {s.g0, s.h, s.t0, s.G, s.H, s.T})
    if (!std::isfinite(x)) fail("finite elements");
  if (!(s.G > 0.0) || std::abs(s.H) > s.G * slack) fail("G > 0 and |H| <= G");
  for (const int sign : {s.sign_g1, s.sign_g3})
    if (sign != 1 && sign != -1) fail("signs of g1 and g3 that are 1 or -1");
  const Vec3 I = detail::sorted_doubles(body);
  const double low = 0.5 * s.G * (s.G / I.z), high = 0.5 * s.G * (s.G / I.x);
  if (s.T * slack < low || s.T > high * slack)
    fail("T in [G^2/2I3, G^2/2I1] = [" + detail::number_text(low) + ", " +
         detail::number_text(high) + "]");
}

}  // namespace

SerretState to_serret(const FreeRotation& m, double t) {
  const Body& body = m.body();
  SerretState s{};
  s.t0 = t;
  s.G = m.momentum();
  s.H = to_andoyer(m.initial_state()).H;  // loses nothing near I = 0, pi
  s.T = m.energy();
  const auto standing_still = [&] {
    const AndoyerState a = to_andoyer(detail::in_sorted_axes(body, m.at(t)));
    s.g0 = a.g;
    s.h = a.h;
    return s;
  };
  if (detail::is_sphere(body) || m.regime() == Regime::rest) return standing_still();
  if (m.kernel().form == FreeKernel::Form::steady) {
    const SerretState limit = to_serret(FreeRotation(body, detail::displaced(body, m.at(t)), t), t);
    // n = 0: an axisymmetric body spinning across its axis. u stands still at any time.
    const double turns = std::abs(limit.t0 - t) * s.T / s.G;
    if (!(turns < 1e30)) return standing_still();
    s.g0 = limit.g0;
    s.h = limit.h;
    s.t0 = limit.t0;
    s.sign_g1 = limit.sign_g1;
    s.sign_g3 = limit.sign_g3;
    return s;
  }
  const detail::MeanPhase phase = detail::mean_phase(m.kernel(), t);
  const bool long_axis = m.circulates_long_axis();
  const bool periodic = m.regime() != Regime::separatrix;
  const detail::PrimedSense sense = detail::primed_sense(long_axis, m.sign_g1(), m.sign_g3());
  // u = 0 of the elements is where the node sign is positive: half a polhode away if it is not now.
  const FreeKernel& k = m.kernel();
  DD elapsed;  // t - t0, scaled
  DD x = phase.x;
  if (periodic) {
    if (sense.s1 < 0.0) x = x.hi > 0.0 ? x - DD::pi() : x + DD::pi();
    const DD x_rate =
        k.form == FreeKernel::Form::trigonometric ? k.phase_rate : k.phase_rate / phase.u_per_x;
    elapsed = x / x_rate;
  } else {
    elapsed = phase.u / k.phase_rate;
  }
  const detail::FrameAngles frame = detail::frame_angles(phase.frame);
  const DD swept = detail::wrapped(DD(2.0) * k.half_precession * elapsed);
  const detail::PrimedSense start{long_axis, periodic ? 1.0 : sense.s1, sense.s3};
  const double half_turn = periodic && sense.s1 < 0.0 ? 2.0 * half_pi : 0.0;
  s.t0 = (DD(t) - elapsed / DD(k.time_scale)).hi;
  s.h = frame.h;
  s.H = detail::third_momentum(m, frame);
  s.g0 =
      detail::wrapped(frame.mean_angle - swept.hi - detail::node_offset<double>(start) + half_turn);
  s.sign_g1 = long_axis || !periodic ? m.sign_g1() : 1;
  s.sign_g3 = !long_axis || !periodic ? m.sign_g3() : 1;
  return s;
}

RotorState to_rotor(const Body& body, const SerretState& s, double t) {
  require_elements(body, s);
  const BasicSerretState<DD> c = widened(s);
  const detail::PolhodeCurve<DD> curve = curve_of(body, c);
  if (curve.steady) return FreeRotation(body, base_state(body, s), s.t0).at(t);
  return detail::rounded_state(rotor_from(body, curve, c, t));
}

FreeRotation free_rotation(const Body& body, const SerretState& s) {
  return {body, to_rotor(body, s, s.t0), s.t0};
}

Matrix6 chart_jacobian(const Body& body, const SerretState& s, double t) {
  require_elements(body, s);
  using Dual6 = Dual<DD, 6>;
  const double e[6] = {s.g0, s.h, -s.t0, s.G, s.H, s.T};
  Dual6 d[6];
  for (int i = 0; i < 6; ++i) d[i] = Dual6::variable(DD(e[i]), i);
  const BasicSerretState<Dual6> c{d[0], d[1], -d[2], d[3], d[4], d[5], s.sign_g1, s.sign_g3};
  const detail::PolhodeCurve<Dual6> curve = curve_of(body, c);
  if (curve.steady || to_double(curve.kp2) > flow_below)
    return detail::hub_tangent(rotor_from(body, curve, c, t));
  const Matrix6 B0 = detail::hub_tangent(rotor_from(body, curve, c, s.t0));
  return free_rotation(body, s).state_transition(t) * B0;
}

}  // namespace v0
}  // namespace polhode
