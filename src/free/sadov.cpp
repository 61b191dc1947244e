// SPDX-License-Identifier: MIT
// Sadov's variables, read from a FreeRotation and turned back into a state.
#include "polhode/free/sadov.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <string>
#include <type_traits>

#include "free/detail/mean_frame.hpp"
#include "free/detail/polhode_family.hpp"
#include "free/detail/sorted_state.hpp"
#include "free/hub_tangent.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/prepare.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/rotor/andoyer.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using DD = DoubleDouble;
constexpr double half_pi = 1.5707963267948966;

// A sphere has no polhode: Andoyer's variables are action-angle already, with the origin of phi_l
// where the limit I1 = I2 puts it.
SadovState spherical_state(const Body& body, const RotorState& s) {
  const AndoyerState a = to_andoyer(detail::in_sorted_axes(body, s));
  return {detail::wrapped(a.l - half_pi), a.g, a.h, a.L, a.G, a.H, SadovRegion::short_axis, 1};
}

template <class T>
T in(const DD& x) {
  if constexpr (std::same_as<T, double>)
    return x.hi;
  else
    return x;
}

// v of the member with this action deficit, by Newton's steps in DoubleDouble from a root in
// double: a tenth of the evaluations that bisection takes. Next to the ends, where the action
// hardly depends on v, and where the steps do not settle, by bisection.
DD family_root_of_deficit(const DD& kap2, const DD& target) {
  const DD highest = detail::family_end(kap2);
  const auto excess = [&](const auto& v) {
    using T = std::remove_cvref_t<decltype(v)>;
    const T k = in<T>(kap2);
    using std::log;
    return T(log(T(detail::action_deficit(k, detail::family_member(k, v)) / in<T>(target))));
  };
  const double seed = detail::family_root(excess, detail::family_start<double>(), highest.hi);
  if (std::abs(seed) < 50.0) {
    DD v = seed;
    for (int i = 0; i < 6; ++i) {  // 2 in practice
      const detail::FamilyMember<DD> f = detail::family_member(kap2, v);
      if (!(f.kp2 > DD(1e-10))) break;
      const DD deficit = detail::action_deficit(kap2, f);
      const DD slope = detail::action_deficit_slope(kap2, f) * f.r2 * f.kp2 / deficit;
      const DD step = log(deficit / target) / slope;
      v -= step;
      if (std::abs(step.hi) < 1e-17) return v;  // the next would be its square
    }
  }
  return detail::family_root(excess, detail::family_start<DD>(), highest);
}

// The polhode with this action: a root in DoubleDouble, then one Newton step in T, which carries
// the derivatives when T is dual.
template <Real T>
detail::FamilyMember<T> member_with_deficit(const BasicVec3<DD>& sorted, bool long_axis,
                                            const T& deficit) {
  const DD kap2 = detail::kappa_squared(detail::primed_moments(sorted, long_axis));
  const DD target = detail::value_of(deficit);
  if (!(target > DD(0.0))) return {deficit, T(1.0)};
  const DD v = family_root_of_deficit(kap2, target);
  const detail::FamilyMember<DD> f = detail::family_member(kap2, v);
  const DD slope = detail::action_deficit_slope(kap2, f);
  const T step = (deficit - T(target)) / T(slope);
  return {T(f.r2) + step, T(f.kp2) - T(kap2) * step};
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

// The variables of a motion in units in which all momenta are 2^exponent times smaller.
SadovState in_units(SadovState s, int exponent) {
  for (double* action : {&s.I_l, &s.I_g, &s.I_h}) *action = std::ldexp(*action, -exponent);
  return s;
}
int unit_exponent(const SadovState& s) { return detail::momentum_exponent({s.I_g, 0.0, 0.0}); }

// At rest, as for a sphere, there is no polhode and the variables are Andoyer's.
bool is_andoyer(const Body& body, const SadovState& s) {
  return detail::is_sphere(body) || s.I_g == 0.0;
}

void require_actions(const Body& body, const SadovState& s) {
  const double slack = 1.0 + 8.0 * epsilon<double>();
  const double I[3] = {s.I_l, s.I_g, s.I_h};
  if (s.lobe != 1 && s.lobe != -1)
    throw DomainError("SadovState: lobe " + std::to_string(s.lobe) + " must be 1 or -1");
  if (!std::all_of(I, I + 3, [](double x) { return std::isfinite(x); }) || !(s.I_g >= 0.0) ||
      std::abs(s.I_h) > s.I_g * slack || std::abs(s.I_l) > s.I_g * slack)
    throw DomainError("SadovState: actions (" + detail::number_text(s.I_l) + ", " +
                      detail::number_text(s.I_g) + ", " + detail::number_text(s.I_h) +
                      ") need I_g >= 0, |I_l| <= I_g, |I_h| <= I_g");
  if (is_andoyer(body, s)) return;
  detail::require_held_moments("SadovState", body);
  const BasicVec3<DD> sorted = detail::sorted_moments(body);
  const bool long_axis = s.region == SadovRegion::long_axis;
  const detail::PrimedMoments<DD> primed = detail::primed_moments(sorted, long_axis);
  if (!detail::mode_exists(primed))
    throw DomainError(std::string("SadovState: a body with equal ") +
                      (long_axis ? "lesser" : "greater") + " moments has no " +
                      (long_axis ? "long" : "short") + "-axis mode");
  const double kappa = std::sqrt(detail::kappa_squared(primed).hi);
  const double border = std::atan2(1.0, kappa) / half_pi;  // 1 - (2/pi) arctan(kappa)
  const double deficit = long_axis ? s.I_l / s.I_g : (s.I_g - std::abs(s.I_l)) / s.I_g;
  if (!(deficit >= -8.0 * epsilon<double>() && deficit <= border + 8.0 * epsilon<double>()))
    throw DomainError(
        "SadovState: I_l / I_g = " + detail::number_text(s.I_l / s.I_g) + " is not in the " +
        (long_axis ? "long-axis region [0, " + detail::number_text(border)
                   : "short-axis region [" + detail::number_text(1.0 - border) + ", 1") +
        "] of this body");
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
