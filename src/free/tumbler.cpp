// SPDX-License-Identifier: MIT
// Tumblers: two periods to energy and momentum, and the long-axis angles.
#include "polhode/free/tumbler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "free/detail/mean_frame.hpp"
#include "free/detail/polhode_family.hpp"
#include "free/detail/sorted_state.hpp"
#include "free/prepare.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/detail/normalized_arc.hpp"
#include "polhode/free/detail/precession.hpp"
#include "polhode/rotor/euler.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using DD = DoubleDouble;
constexpr double right_angle = 1.5707963267948966;

// Tumbler axes (intermediate, short, long) <- body axes.
detail::AxisOrder tumbler_axes(const Body& body) {
  return detail::composed(detail::ascending_order(body.moments()),
                          detail::AxisOrder{{1, 2, 0}, {1.0, 1.0, 1.0}});
}

// Inertial axes <- the frame of phi: qz(longitude) qy(pi/2 - latitude).
Quaternion pole_frame(const Vec3& pole) {
  const double across = std::hypot(pole.x, pole.y);
  const double longitude = across > 0.0 ? std::atan2(pole.y, pole.x) : 0.0;
  const double half = 0.5 * std::atan2(across, pole.z);
  return rotation_z(longitude) * Quaternion{std::cos(half), 0.0, std::sin(half), 0.0};
}

// Rates at momentum 1 and scaled moments.
struct FamilyRates {
  DD rotation;    // 2 pi / P_psi
  DD precession;  // 2 pi / P_phi
};

FamilyRates family_rates(const detail::PolhodeCurve<DD>& c) {
  return {abs(detail::phase_rate(c)), detail::precession_of_long_axis(c)};
}

std::string mode_name(bool long_axis) { return long_axis ? "LAM" : "SAM"; }

void require_mode(const Body& body, bool long_axis) {
  const detail::PrimedMoments<DD> I =
      detail::primed_moments(detail::sorted_moments(body), long_axis);
  const Vec3& m = body.moments();
  if (detail::is_sphere(body) || !detail::mode_exists(I))
    throw DomainError("TumblerState: moments (" + detail::number_text(m.x) + ", " +
                      detail::number_text(m.y) + ", " + detail::number_text(m.z) + ") have no " +
                      mode_name(long_axis) + ": it needs unequal " +
                      (long_axis ? "lesser" : "greater") + " moments");
}

bool is_long_axis(Regime mode) {
  if (mode != Regime::short_axis && mode != Regime::long_axis)
    throw DomainError("TumblerState: mode must be short_axis (SAM) or long_axis (LAM)");
  return mode == Regime::long_axis;
}

void require_periods(const TumblerState& s) {
  for (const double period : {s.precession_period, s.rotation_period})
    if (!(period > 0.0) || !std::isfinite(period))
      throw DomainError("TumblerState: period " + detail::number_text(period) +
                        " must be positive and finite");
  if (!(norm(s.pole) > 0.0) || !std::isfinite(norm(s.pole)))
    throw DomainError("TumblerState: pole (" + detail::number_text(s.pole.x) + ", " +
                      detail::number_text(s.pole.y) + ", " + detail::number_text(s.pole.z) +
                      ") must be a finite, non-zero vector");
  if (std::abs(s.branch) != 1 || std::abs(s.sense) != 1)
    throw DomainError("TumblerState: branch " + std::to_string(s.branch) + " and sense " +
                      std::to_string(s.sense) + " must be 1 or -1");
  if (s.mode == Regime::long_axis && s.sense != 1)
    throw DomainError("TumblerState: sense -1 is for SAM; in LAM branch names the lobe");
  if (!std::isfinite(s.phi0) || !std::isfinite(s.psi0))
    throw DomainError("TumblerState: angles (" + detail::number_text(s.phi0) + ", " +
                      detail::number_text(s.psi0) + ") must be finite");
}

// The polhode of the family whose P_psi/P_phi is that of the observer.
detail::PolhodeCurve<DD> curve_with_ratio(const Body& body, bool long_axis, const DD& ratio) {
  const BasicVec3<DD> sorted = detail::sorted_moments(body);
  const DD kap2 = detail::kappa_squared(detail::primed_moments(sorted, long_axis));
  const double least = least_period_ratio(body, long_axis ? Regime::long_axis : Regime::short_axis);
  if (ratio.hi < least * (1.0 - 4.0 * epsilon<double>()))
    throw DomainError("TumblerState: P_psi/P_phi = " + detail::number_text(ratio.hi) +
                      " is impossible in " + mode_name(long_axis) +
                      " for these moments; it must be at least " + detail::number_text(least));
  const auto curve = [&](const DD& v) {
    return detail::family_curve(sorted, long_axis, DD(1.0), detail::family_member(kap2, v));
  };
  const auto excess = [&](const DD& v) {
    const FamilyRates r = family_rates(curve(v));
    return r.precession / (ratio * r.rotation) - DD(1.0);
  };
  // A double ratio separates no polhode smaller than J^2 = 1e-18 from a point, but next to the
  // separatrix it holds the logarithm of the distance: k'^2 down to 1e-220. Where equal lesser
  // moments make kappa^2 large, polhodes of that size have a k^2 that the ratio resolves.
  const DD start = kap2.hi > 1e4 ? DD(-50.0) - log(kap2) : DD(-50.0);
  return curve(detail::family_root(excess, start, detail::family_end(kap2, 1e220, 600.0)));
}

// sin^2 psi = k_x^2 / (k_x^2 + k_y^2) is largest where k_z = 0, at sn = +-1: a2^2/(a2^2 + a3^2
// k'^2).
double largest_psi(const detail::PolhodeCurve<DD>& c) { return atan2(c.a2, c.a3 * sqrt(c.kp2)).hi; }

// The direction of the momentum along the tumbler axes, but for the sign along z.
struct Inclination {
  double sin, cos;
  // Within 2^-5 of the middle axis: the direction itself, which theta and psi as doubles do not
  // hold.
  bool beside_middle_axis = false;
  Vec3 k;
};

// G^2 - 2 T I2 at momentum 1.
DD separatrix_distance(const detail::PolhodeCurve<DD>& c) {
  const DD D2 = c.kp2 * abs(c.C - c.B) * c.DA / abs(c.C - c.A);
  return c.long_axis ? -D2 : D2;
}

// a1^2 and a3^2 at momentum 1 are the squares of the momentum along sorted axes 1 and 3 when that
// along 2 is zero: k_z^2 = a1^2 - (I1/I2)(1 - beta) k_x^2 in sums that do not cancel.
Inclination inclination(const BasicVec3<DD>& I, const detail::PolhodeCurve<DD>& c, double psi0,
                        bool long_axis) {
  const auto [s, cosine] = sincos(DD(psi0));
  const DD p2 = s * s;
  const DD along_long2 = long_axis ? c.a3 * c.a3 : c.a1 * c.a1;
  const DD along_short2 = long_axis ? c.a1 * c.a1 : c.a3 * c.a3;
  const DD beta = (I.y - I.x) / (I.z - I.x);
  // k_z^2 = al - m k_x^2, k_y^2 = as - (1 - m) k_x^2, k_x^2 = p2 (k_x^2 + k_y^2).
  const DD m = I.x / I.y * (DD(1.0) - beta);
  const DD across2 = along_short2 / (DD(1.0) - m * p2);  // k_x^2 + k_y^2
  const DD along2 = along_long2 - m * p2 * across2;
  const Inclination plain{sqrt(across2).hi, along2 > DD(0.0) ? sqrt(along2).hi : 0.0, false, {}};
  if (!(abs(cosine) < DD(0x1p-5) && plain.cos < 0x1p-5) || !(I.x < I.y)) return plain;
  // At psi_max psi0 stands still: the tip of the polhode, sn = 1.
  if (!long_axis && std::abs(psi0) >= largest_psi(c)) {
    const DD y = c.a3 * sqrt(c.kp2);
    return {sqrt(c.a2 * c.a2 + y * y).hi, 0.0, true, {(s < DD(0.0) ? -c.a2 : c.a2).hi, y.hi, 0.0}};
  }
  // not al - m k_x^2: there it cancels
  const DD x = sqrt(across2) * s, y = sqrt(across2) * cosine;
  const DD z2 = (y * y * ((I.z - I.y) / I.z) - separatrix_distance(c)) * I.x / (I.y - I.x);
  const double z = z2 > DD(0.0) ? sqrt(z2).hi : 0.0;
  return {plain.sin, z, true, {x.hi, y.hi, z}};
}

// How far beyond psi_max psi0 may be by rounding: its own, and that of a momentum in double
// precision, which moves D2 by eps G^2 and so k' by eps / k'.
double psi_rounding(const detail::PolhodeCurve<DD>& c) {
  return std::min(8.0 * epsilon<double>() * (1.0 + 1.0 / std::sqrt(c.kp2.hi)), 1e-9);
}

// The polhode of these periods. In SAM psi must reach psi0 on it, to rounding: then it is at its
// tip. Where it misses by no more than the rounding of the periods, which next to the spin is half
// the digits of psi_max, the polhode is the one that the rounding allows.
detail::PolhodeCurve<DD> curve_reaching(const Body& body, const TumblerState& s, bool long_axis) {
  const int unit = std::ilogb(s.precession_period);  // double-double ends before double does
  const DD ratio =
      DD(std::ldexp(s.rotation_period, -unit)) / DD(std::ldexp(s.precession_period, -unit));
  const detail::PolhodeCurve<DD> c = curve_with_ratio(body, long_axis, ratio);
  if (long_axis || std::abs(s.psi0) <= largest_psi(c) + psi_rounding(c)) return c;
  const DD rounding = DD(1.0) + DD(8.0 * epsilon<double>());
  const detail::PolhodeCurve<DD> wider = curve_with_ratio(body, long_axis, ratio * rounding);
  if (std::abs(s.psi0) <= largest_psi(wider)) return wider;
  throw DomainError("TumblerState: psi0 = " + detail::number_text(s.psi0) +
                    " rad is beyond psi_max = " + detail::number_text(largest_psi(c)) +
                    " rad of this SAM");
}

// Of unit length. Along the inertial axis but for rounding it has no longitude: 0, and phi0 holds
// all of the turn.
Vec3 unit_pole(const Vec3& momentum) {
  const double G = norm(momentum);
  const Vec3 k{momentum.x / G, momentum.y / G, momentum.z / G};
  if (std::hypot(k.x, k.y) > 8.0 * epsilon<double>()) return k;
  return {0.0, 0.0, k.z < 0.0 ? -1.0 : 1.0};
}

// Next to the separatrix the ratio of the periods grows like the logarithm of a distance that a
// momentum in double precision soon cannot hold: what the state would not give back is refused.
void require_held(const Body& body, const TumblerState& s, const RotorState& state) {
  const FreeRotation motion(body, state);
  const double wanted = s.rotation_period / s.precession_period;
  const double held = motion.polhode_period() * motion.precession_rate_long() / (4.0 * right_angle);
  if (motion.regime() == s.mode && std::abs(held - wanted) <= 1e-6 * wanted) return;
  throw DomainError("TumblerState: P_psi/P_phi = " + detail::number_text(wanted) +
                    " is closer to the separatrix than a momentum in double precision can hold");
}

}  // namespace

double least_period_ratio(const Body& body, Regime mode) {
  const bool long_axis = is_long_axis(mode);
  detail::require_held_moments("TumblerState", body);
  require_mode(body, long_axis);
  const FamilyRates r = family_rates(
      detail::family_curve(detail::sorted_moments(body), long_axis, DD(1.0), {DD(0.0), DD(1.0)}));
  return (r.precession / r.rotation).hi;
}

double psi_max(const FreeRotation& m) {
  if (m.regime() != Regime::short_axis) return std::numeric_limits<double>::quiet_NaN();
  return largest_psi(detail::normalized_arc<DD>(m.body(), m.initial_state().g).curve);
}

double long_axis_period(double short_axis_period, double rotation_period) {
  if (!(short_axis_period > 0.0) || !(short_axis_period < rotation_period))
    throw DomainError("long_axis_period: got a period " + detail::number_text(short_axis_period) +
                      " of the short axis; expected one that is positive and less than P_psi = " +
                      detail::number_text(rotation_period));
  const double rest = rotation_period - short_axis_period;
  return short_axis_period * (rotation_period / rest);
}

TumblingAngles tumbling_angles(const FreeRotation& m) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), pi = 2.0 * right_angle;
  const bool long_axis = m.regime() == Regime::long_axis;
  if (!long_axis && m.regime() != Regime::short_axis) return {nan, nan, nan, nan};
  const detail::PolhodeCurve<DD> c =
      detail::normalized_arc<DD>(m.body(), m.initial_state().g).curve;
  // primed axis 3, which the momentum goes round: at sn = 0 and at sn = 1
  double least = atan2(c.a1, c.a3).hi, most = atan2(c.a2, c.a3 * sqrt(c.kp2)).hi;
  if (least > most) std::swap(least, most);
  if ((long_axis ? m.sign_g1() : m.sign_g3()) < 0) {
    const double farthest = pi - least;
    least = pi - most;
    most = farthest;
  }
  // primed axis 1, on either side of which it comes to lie
  const double other = atan2(c.a3, c.a1).hi;
  if (long_axis) return {least, most, other, pi - other};
  return {other, pi - other, least, most};
}

RotorState to_rotor(const Body& body, const TumblerState& given) {
  const bool long_axis = is_long_axis(given.mode);
  require_periods(given);
  TumblerState s = given;
  s.psi0 = detail::wrapped(given.psi0);  // catalogues count from 0 to 360 deg
  require_mode(body, long_axis);
  const BasicVec3<DD> sorted = detail::sorted_moments(body);
  const detail::PolhodeCurve<DD> c = curve_reaching(body, s, long_axis);
  const FamilyRates rates = family_rates(c);
  const double psi = !long_axis && s.sense < 0 ? s.psi0 + 2.0 * right_angle : s.psi0;
  const Inclination incl = inclination(sorted, c, s.psi0, long_axis);
  const double theta = std::atan2(incl.sin, s.branch < 0 ? -incl.cos : incl.cos);
  const Quaternion q =
      pole_frame(s.pole) * rotation_z(s.phi0) * rotation_x(theta) * rotation_z(psi);

  // G from the precession, which is never small against the rotation.
  const double unit = std::ldexp(1.0, detail::exponent_of_largest(body.moments()));
  const double G = unit / rates.precession.hi * (4.0 * right_angle / s.precession_period);
  const double side = !long_axis && s.sense < 0 ? -1.0 : 1.0;
  const double along = s.branch < 0 ? -incl.cos : incl.cos;
  const Vec3 k = incl.beside_middle_axis ? Vec3{side * incl.k.x, side * incl.k.y, along}
                 : incl.cos < 0x1p-5
                     ? Vec3{incl.sin * std::sin(psi), incl.sin * std::cos(psi), along}
                     : Vec3{incl.sin * std::sin(psi), incl.sin * std::cos(psi), std::cos(theta)};
  const detail::AxisOrder axes = tumbler_axes(body);
  const RotorState state{q * detail::quaternion_of<double>(axes), G * detail::restored(axes, k)};
  require_held(body, s, state);
  return state;
}

TumblerState to_tumbler(const FreeRotation& m, double t) {
  const bool long_axis = m.regime() == Regime::long_axis;
  if (!long_axis && m.regime() != Regime::short_axis)
    throw DomainError(
        "to_tumbler: a motion that is at rest, steady or on the separatrix has no P_psi");
  const RotorState s = m.at(t);
  const Vec3 pole = unit_pole(inertial_momentum(m.initial_state()));
  const Quaternion right = detail::quaternion_of<double>(tumbler_axes(m.body()));
  const Quaternion q = conj(pole_frame(pole)) * s.q * conj(right);
  const Vec3 k = detail::reordered(tumbler_axes(m.body()), s.g);
  const EulerState e = to_euler(RotorState{q, {}});
  TumblerState d{};
  d.precession_period = 4.0 * right_angle / m.precession_rate_long();
  d.rotation_period = m.polhode_period();
  for (const double period : {d.precession_period, d.rotation_period})
    if (!std::isnormal(period))
      throw DomainError("to_tumbler: period " + detail::number_text(period) +
                        " must be within double range");
  d.pole = pole;
  d.mode = m.regime();
  // Next to the middle axis k rounds to the other side; the sides are constants of the motion.
  d.psi0 = std::atan2(k.x, k.y);
  // Near theta = 0, pi both nodes are lost to rounding: phi +- psi stays that of the attitude.
  d.phi0 = detail::wrapped(e.phi + k.z / norm(k) * detail::wrapped(e.psi - d.psi0));
  d.branch = long_axis ? m.sign_g1() : (k.z < 0.0 ? -1 : 1);
  if (!long_axis) {
    d.sense = m.sign_g3();
    const double along = d.sense * k.y;
    d.psi0 = std::atan2(d.sense * k.x, along > 0.0 ? along : 0.0);
  }
  return d;
}

}  // namespace v0
}  // namespace polhode
