// SPDX-License-Identifier: MIT
// Sadov's variables, read from a FreeRotation and turned back into a state.
#include "polhode/free/sadov.hpp"

#include <cmath>

#include "free/detail/mean_frame.hpp"
#include "free/detail/polhode_family.hpp"
#include "free/detail/sadov_actions.hpp"
#include "free/detail/sorted_state.hpp"
#include "free/hub_tangent.hpp"
#include "free/prepare.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/rotor/andoyer.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::in_units;
using detail::is_andoyer;
using detail::member_with_deficit;
using detail::require_actions;
using detail::unit_exponent;

using DD = DoubleDouble;
constexpr double half_pi = 1.5707963267948966;

// A sphere has no polhode: Andoyer's variables are action-angle already, with the origin of phi_l
// where the limit I1 = I2 puts it.
SadovState spherical_state(const Body& body, const RotorState& s) {
  const AndoyerState a = to_andoyer(detail::in_sorted_axes(body, s));
  return {detail::wrapped(a.l - half_pi), a.g, a.h, a.L, a.G, a.H, SadovRegion::short_axis, 1};
}

template <Real T>
BasicRotorState<T> rotor_from(const Body& body, const BasicSadovState<T>& c) {
  using std::abs;
  const detail::AxisOrder order = detail::ascending_order(body.moments());
  const BasicVec3<DD> sorted = detail::sorted_moments(body);
  const bool long_axis = c.region == SadovRegion::long_axis;
  const bool negative = !long_axis && c.I_l < T(0.0);
  const detail::PrimedSense sense{long_axis, 1.0, long_axis ? c.lobe : (negative ? -1.0 : 1.0)};
  const T deficit = (long_axis ? c.I_l : T(c.I_g - abs(c.I_l))) / c.I_g;
  const detail::FamilyMember<T> f = member_with_deficit(sorted, long_axis, deficit);
  const BasicVec3<T> moments{T(sorted.x), T(sorted.y), T(sorted.z)};
  const detail::PolhodeCurve<T> curve = detail::family_curve(moments, long_axis, T(1.0), f);
  const T x = long_axis || negative ? c.phi_l : T(-c.phi_l);
  const T u = x * (T(2.0) * curve.K / pi<T>());
  const T mean_angle = c.phi_g + detail::node_offset<T>(sense) - (long_axis ? T(0.0) : x);
  return detail::assembled(order, sense, curve, u,
                           detail::InvariableElements<T>{mean_angle, c.phi_h, c.I_h, c.I_g});
}

}  // namespace

SadovFrequencies sadov_frequencies(const FreeRotation& m) {
  const double rate = 4.0 * half_pi / m.polhode_period();  // 0 where the period is infinite
  const bool positive = rate == 0.0 || (!m.circulates_long_axis() && m.sign_g3() < 0);
  return {positive ? rate : -rate, m.precession_rate_short()};
}

SadovState to_sadov(const FreeRotation& m, double t) {
  const Body& body = m.body();
  if (detail::is_sphere(body) || m.regime() == Regime::rest) return spherical_state(body, m.at(t));
  if (m.kernel().steady) {
    const RotorState s = m.at(t);
    const int e = detail::momentum_exponent(s.g);
    const RotorState unit = detail::displaced(body, {s.q, detail::scaled(s.g, e)});
    return in_units(to_sadov(FreeRotation(body, unit, t), t), -e);
  }

  const detail::MeanPhase phase = detail::mean_phase(m.kernel(), t);
  const bool long_axis = m.circulates_long_axis();
  const detail::PrimedSense sense = detail::primed_sense(long_axis, m.sign_g1(), m.sign_g3());
  const detail::FrameAngles frame = detail::frame_angles(phase.frame);
  const double x = phase.x.hi;
  const double from_start = sense.s1 < 0.0 ? x + 2.0 * half_pi : x;
  SadovState s{};
  s.region = long_axis ? SadovRegion::long_axis : SadovRegion::short_axis;
  s.lobe = long_axis ? m.sign_g1() : 1;
  s.I_g = m.momentum();
  s.I_h = detail::third_momentum(m, frame);
  s.I_l = long_axis ? m.circulation_deficit() : m.sign_g3() * m.circulation_action();
  s.phi_h = frame.h;
  s.phi_l = detail::wrapped(long_axis || m.sign_g3() < 0 ? from_start : -from_start);
  s.phi_g = detail::wrapped(frame.mean_angle - detail::node_offset<double>(sense) +
                            (long_axis ? 0.0 : x));
  return s;
}

RotorState to_rotor(const Body& body, const SadovState& s) {
  require_actions(body, s);
  if (is_andoyer(body, s))
    return detail::in_body_axes(
        body, to_rotor(AndoyerState{s.phi_l + half_pi, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h}));
  const int e = unit_exponent(s);
  const SadovState u = in_units(s, e);
  const RotorState state = detail::rounded_state(rotor_from(
      body, BasicSadovState<DD>{u.phi_l, u.phi_g, u.phi_h, u.I_l, u.I_g, u.I_h, u.region, u.lobe}));
  return {state.q, detail::scaled(state.g, -e)};
}

Matrix6 chart_jacobian(const Body& body, const SadovState& given) {
  require_actions(body, given);
  // derivatives by the actions, of a needle or next to a spin, need the whole range of exponents
  const int e = detail::exponent_of_largest({given.I_g, 0.0, 0.0});
  const SadovState s = in_units(given, e);
  using Dual6 = Dual<DD, 6>;
  const double c[6] = {s.phi_l, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h};
  Dual6 d[6];
  for (int i = 0; i < 6; ++i) d[i] = Dual6::variable(DD(c[i]), i);
  const Matrix6 B = is_andoyer(body, s)
                        ? detail::hub_tangent(detail::in_body_axes(
                              body, to_rotor(BasicAndoyerState<Dual6>{Dual6(d[0] + half_pi), d[1],
                                                                      d[2], d[3], d[4], d[5]})))
                        : detail::hub_tangent(
                              rotor_from(body, BasicSadovState<Dual6>{d[0], d[1], d[2], d[3], d[4],
                                                                      d[5], s.region, s.lobe}));
  return detail::in_units(B, e, {0, 0, 0, e, e, e});
}

}  // namespace v0
}  // namespace polhode
