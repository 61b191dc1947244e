// SPDX-License-Identifier: MIT
// Serret's elements, read from a FreeRotation and turned back into a state.
#include "polhode/free/serret.hpp"

#include <array>
#include <cmath>
#include <string>

#include "free/detail/mean_frame.hpp"
#include "free/detail/serret_elements.hpp"
#include "free/detail/sorted_state.hpp"
#include "free/hub_tangent.hpp"
#include "free/prepare.hpp"
#include "math/number_text.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/error.hpp"
#include "polhode/free/detail/precession.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/rotor/andoyer.hpp"

namespace polhode {
inline namespace v0 {

namespace {

using detail::curve_of;
using detail::discriminants_of;
using detail::energy_ratio;
using detail::in_units;
using detail::place_on;
using detail::require_elements;
using detail::ScaledSerret;
using detail::Units;
using detail::units_of;
using detail::untold_complement;
using detail::widened;

using DD = DoubleDouble;
constexpr double quarter_turn = 1.5707963267948966;

// Below this 1 - k^2 the derivative of K, like 1 / (1 - k^2), takes the digits of the others with
// it, and on the separatrix there is none. The elements stand still, so B is then carried by the
// flow from t0, where it needs no K.
constexpr double flow_below = 1e-14;

template <Real T>
BasicRotorState<T> rotor_from(const Body& body, const detail::PolhodeCurve<T>& curve,
                              const BasicSerretState<T>& c, double t) {
  const detail::AxisOrder order = detail::ascending_order(body.moments());
  const detail::PrimedSense sense = detail::primed_sense(curve.long_axis, c.sign_g1, c.sign_g3);
  const T elapsed = (T(t) - c.t0) * c.G;  // in units of momentum 1
  const T mean_angle =
      c.g0 + detail::node_offset<T>(sense) + detail::precession_of_axis1(curve) * elapsed;
  return detail::assembled(order, sense, curve, T(curve.n * elapsed),
                           detail::InvariableElements<T>{mean_angle, c.h, c.H, c.G});
}

// The state at t0 of a rotation that is steady, scaled: l = +-pi/2 and L from the energy.
RotorState base_state(const Body& body, const SerretState& s) {
  const BasicSerretState<DD> c = widened(s);
  const BasicVec3<DD> I = detail::sorted_moments(body);
  const detail::Discriminants<DD> d = discriminants_of(I, energy_ratio(c));
  const double L = s.sign_g3 * (c.G * sqrt(I.z * d.D1 / (I.z - I.x))).hi;
  const double l = s.sign_g1 < 0 ? -quarter_turn : quarter_turn;
  return detail::in_body_axes(body, to_rotor(AndoyerState{l, s.g0, s.h, L, s.G, s.H}));
}

RotorState with_momentum(const RotorState& s, int exponent) {
  return {s.q, detail::scaled(s.g, -exponent)};
}

// The elements of a state that stands still, or whose T does not tell where on the polhode it is.
SerretState standing_still(const FreeRotation& m, double t, SerretState s) {
  const AndoyerState a = to_andoyer(detail::in_sorted_axes(m.body(), m.at(t)));
  s.g0 = a.g;
  s.h = a.h;
  s.t0 = t;
  return s;
}

// |D2| / G^2 to the rounding of double: for decisions. Taken from the state given: for a needle,
// the rounding of the state at another time, though far below that of |g|, may be as large as D2.
double rough_distance(const FreeRotation& m) {
  const detail::AxisOrder order = detail::ascending_order(m.body().moments());
  const Vec3 I = detail::sorted_doubles(m.body());
  const Vec3 g = detail::reordered(order, m.initial_state().g);
  const double G = norm(g), x = g.x / G, z = g.z / G;
  return std::abs(z * z * ((I.z - I.y) / I.z) - x * x * ((I.y - I.x) / I.x));
}

// Nearer than this to the separatrix T and G hold less than 1e-4 of a place half a period away:
// both signs then tell the branch, and t0 is no further than a quarter of the period.
constexpr double branch_distance = 0x1p-40;

// A slow polhode of a body with large moments.
void require_held_time(double t0, double t) {
  if (std::isfinite(t0) || !std::isfinite(t)) return;
  throw DomainError("to_serret: t0 = " + detail::number_text(t0) +
                    " must be within double range: take a unit of time in which the period is");
}

// The momentum along the sorted axes at a time, scaled: each component to its own digits, which a
// needle needs and the state in doubles does not have.
BasicVec3<DD> sorted_momentum(const FreeRotation& m, double t) {
  const detail::NormalizedArc<DD> arc = detail::normalized_arc<DD>(m.body(), m.initial_state().g);
  const detail::PolhodeCurve<DD>& c = arc.curve;
  const detail::MeanPhase phase = detail::mean_phase(m.kernel(), t);
  const DD u = !m.kernel().series.hyperbolic ? DD(2.0) / DD::pi() * phase.x * c.K : phase.u;
  const elliptic::Jacobi<DD> f =
      elliptic::jacobi(u, elliptic::BasicModulus<DD>::from_ratio(c.k2, c.kp2));
  return detail::restored(detail::primed_axes(c.long_axis, arc.s1, arc.s3),
                          BasicVec3<DD>{c.a1 * f.cn, c.a2 * f.sn, c.a3 * f.dn});
}

// A place on the polhode and the mean frame there, read back from a state by the curve that T and G
// hold: of moments that are equal but for rounding this differs from the true one.
SerretState on_held_curve(const FreeRotation& m, double t, SerretState s) {
  const Body& body = m.body();
  const RotorState now = m.at(t);
  const Units units = units_of(body, s.G);
  const detail::PolhodeCurve<DD> c = curve_of(body, widened(in_units(units, s, t).s));
  if (c.steady || !(c.DC > DD(0.0))) return standing_still(m, t, s);
  const BasicVec3<DD> g = sorted_momentum(m, t);
  s.sign_g1 = g.x < DD(0.0) ? -1 : 1;
  s.sign_g3 = g.z < DD(0.0) ? -1 : 1;
  const detail::PrimedSense sense = detail::primed_sense(c.long_axis, s.sign_g1, s.sign_g3);
  const detail::AxisOrder to_primed = detail::primed_axes(sense.long_axis, sense.s1, sense.s3);
  const detail::AxisOrder primed =
      detail::composed(detail::ascending_order(body.moments()), to_primed);
  const BasicVec3<DD> k = detail::reordered(to_primed, g);
  const DD u = place_on(c, k);
  const BasicQuaternion<DD> p =
      normalized(detail::primed_attitude(c, detail::cayley_klein_series(c), u));
  const BasicQuaternion<DD> q{now.q.w, now.q.x, now.q.y, now.q.z};
  const BasicQuaternion<DD> f = q * conj(detail::quaternion_of<DD>(primed)) * conj(p);
  const detail::FrameAngles frame = detail::frame_angles({f.w.hi, f.x.hi, f.y.hi, f.z.hi});
  const DD G = std::ldexp(s.G, -units.momentum);
  s.t0 = (DD(t) - ldexp(u / c.n / G, units.time)).hi;
  require_held_time(s.t0, t);
  // since t0 as it is rounded: a slow polhode may lie many turns back
  const DD elapsed = ldexp(DD::sum(t, -s.t0), -units.time) * G;  // in units of momentum 1
  const DD swept = detail::wrapped(detail::precession_of_axis1(c) * elapsed);
  s.h = frame.h;
  s.g0 = detail::wrapped(frame.mean_angle - swept.hi - detail::node_offset<double>(sense));
  return s;
}

// How far the state of these elements at this time is from that of the motion.
double missed_by(const FreeRotation& m, double t, const SerretState& s) {
  const RotorState now = m.at(t), back = to_rotor(m.body(), s, t);
  const Quaternion r = conj(normalized(now.q)) * normalized(back.q);
  return std::hypot(2.0 * norm(Vec3{r.x, r.y, r.z}), norm(now.g - back.g) / s.G);
}

constexpr double held_state = 1e-6;

// Refuses elements that are those of another state.
SerretState held(const FreeRotation& m, double t, const SerretState& s) {
  if (missed_by(m, t, s) <= held_state) return s;
  throw DomainError("to_serret: (G, T) = " + detail::tuple_text({s.G, s.T}) +
                    " in double precision must hold the distance from the separatrix, |1 - 2 T I2 "
                    "/ G^2| = " +
                    detail::number_text(rough_distance(m)) +
                    "; these elements would be those of another state");
}

// Next to the separatrix: the set of the phase of the motion, if it holds the state, or that of the
// nearest place on the curve that G and T hold.
SerretState held_by_either(const FreeRotation& m, double t, const SerretState& by_phase) {
  if (missed_by(m, t, by_phase) <= held_state) return by_phase;
  return held(m, t, on_held_curve(m, t, by_phase));
}

bool is_symmetric(const Body& body) {
  const Vec3 I = detail::sorted_doubles(body);
  return I.x == I.y || I.y == I.z;
}

// Spin across the axis of an axisymmetric body: momentum and body stand still to each other.
bool is_across_axis_of_symmetry(const Body& body, const RotorState& s) {
  const Vec3 I = detail::sorted_doubles(body);
  const Vec3 g = detail::reordered(detail::ascending_order(body.moments()), s.g);
  const double small = 0x1p-400 * norm(g);
  return (I.y == I.z && std::abs(g.x) < small) || (I.x == I.y && std::abs(g.z) < small);
}

// Spin about a principal axis: the limit of a polhode next to it.
SerretState of_steady_rotation(const FreeRotation& m, double t, SerretState s) {
  const Body& body = m.body();
  const RotorState now = m.at(t);
  if (is_across_axis_of_symmetry(body, now)) return standing_still(m, t, s);
  const int e = detail::momentum_exponent(now.g);
  const RotorState unit = detail::displaced(body, {now.q, detail::scaled(now.g, e)});
  const double epoch = e == 0 ? t : 0.0;
  const SerretState limit = to_serret(FreeRotation(body, unit, epoch), epoch);
  s.g0 = limit.g0;
  s.h = limit.h;
  s.t0 = e == 0 ? limit.t0 : t + std::ldexp(limit.t0, -e);
  require_held_time(s.t0, t);
  if (e != 0) {  // what t0 loses by its rounding is a turn about the momentum
    const DD lost = DD::sum(s.t0, -t) - DD(std::ldexp(limit.t0, -e));
    s.g0 = detail::wrapped(limit.g0 + m.precession_rate_long() * lost.hi);
  }
  s.sign_g1 = limit.sign_g1;
  s.sign_g3 = limit.sign_g3;
  return s;
}

}  // namespace

SerretState to_serret(const FreeRotation& m, double t) {
  const Body& body = m.body();
  SerretState s{};
  s.t0 = t;
  s.G = m.momentum();
  s.H = to_andoyer(m.initial_state()).H;  // loses nothing near I = 0, pi
  s.T = m.energy();
  if (detail::is_sphere(body) || m.regime() == Regime::rest) return standing_still(m, t, s);
  if (!std::isnormal(s.T))
    throw DomainError("to_serret: T = " + detail::number_text(s.T) +
                      " of G = " + detail::number_text(s.G) +
                      " must be within double range: take units in which G^2/2I is");
  if (m.kernel().steady) return of_steady_rotation(m, t, s);
  const detail::MeanPhase phase = detail::mean_phase(m.kernel(), t);
  const bool long_axis = m.circulates_long_axis();
  const bool periodic = m.regime() != Regime::separatrix;
  const bool is_near = std::isfinite(t) && rough_distance(m) < branch_distance;
  if (is_near && m.modulus().m1() > untold_complement) {
    s = on_held_curve(m, t, s);
    return is_symmetric(body) ? s : held(m, t, s);
  }
  const detail::PrimedSense sense = detail::primed_sense(long_axis, m.sign_g1(), m.sign_g3());
  // u = 0 of the elements is where the node sign is positive, half a polhode away if it is not now;
  // next to the separatrix where it is that of now.
  const FreeKernel& k = m.kernel();
  DD elapsed;  // t - t0, scaled
  DD x = phase.x;
  detail::PrimedSense start{long_axis, periodic ? 1.0 : sense.s1, sense.s3};
  if (periodic && is_near) start.s1 = std::abs(x.hi) > quarter_turn ? -sense.s1 : sense.s1;
  const bool from_other_side = start.s1 != sense.s1;
  if (periodic) {
    if (from_other_side) x = x.hi > 0.0 ? x - DD::pi() : x + DD::pi();
    const DD x_rate = !k.series.hyperbolic ? k.phase_rate : k.phase_rate / phase.u_per_x;
    elapsed = x / x_rate;
  } else {
    elapsed = phase.u / k.phase_rate;
  }
  const detail::FrameAngles frame = detail::frame_angles(phase.frame);
  const DD swept = detail::wrapped(DD(2.0) * k.half_precession * elapsed);
  const double half_turn = from_other_side ? 2.0 * quarter_turn : 0.0;
  s.t0 = (DD(t) - ldexp(elapsed, -std::ilogb(k.time_scale))).hi;
  require_held_time(s.t0, t);
  s.h = frame.h;
  s.H = detail::third_momentum(m, frame);
  s.g0 =
      detail::wrapped(frame.mean_angle - swept.hi - detail::node_offset<double>(start) + half_turn);
  s.sign_g1 = static_cast<int>(long_axis ? start.s3 : start.s1);
  s.sign_g3 = static_cast<int>(long_axis ? start.s1 : start.s3);
  return is_near ? held_by_either(m, t, s) : s;
}

RotorState to_rotor(const Body& body, const SerretState& s, double t) {
  require_elements(body, s);
  const Units units = units_of(body, s.G);
  const ScaledSerret at = in_units(units, s, t);
  const BasicSerretState<DD> c = widened(at.s);
  const detail::PolhodeCurve<DD> curve = curve_of(body, c);
  if (curve.steady) {
    const RotorState base = with_momentum(base_state(body, at.s), units.momentum);
    return FreeRotation(body, base, s.t0).at(t);
  }
  return with_momentum(detail::rounded_state(rotor_from(body, curve, c, at.t)), units.momentum);
}

FreeRotation free_rotation(const Body& body, const SerretState& s) {
  return {body, to_rotor(body, s, s.t0), s.t0};
}

Matrix6 chart_jacobian(const Body& body, const SerretState& given, double t) {
  require_elements(body, given);
  const Units units = units_of(body, given.G);
  const auto [s, now] = in_units(units, given, t);
  using Dual6 = Dual<DD, 6>;
  const double e[6] = {s.g0, s.h, -s.t0, s.G, s.H, s.T};
  Dual6 d[6];
  for (int i = 0; i < 6; ++i) d[i] = Dual6::variable(DD(e[i]), i);
  const BasicSerretState<Dual6> c{d[0], d[1], -d[2], d[3], d[4], d[5], s.sign_g1, s.sign_g3};
  const std::array<int, 6> coordinate{0,           0, units.time, units.momentum, units.momentum,
                                      units.energy};
  const auto in_user_units = [&](const Matrix6& B) {
    return detail::in_units(B, units.momentum, coordinate);
  };
  const detail::PolhodeCurve<Dual6> curve = curve_of(body, c);
  if (curve.steady || to_double(curve.kp2) > flow_below)
    return in_user_units(detail::hub_tangent(rotor_from(body, curve, c, now)));
  const Matrix6 B0 = detail::hub_tangent(rotor_from(body, curve, c, s.t0));
  return free_rotation(body, given).state_transition(t) * in_user_units(B0);
}

}  // namespace v0
}  // namespace polhode
