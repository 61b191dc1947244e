// SPDX-License-Identifier: MIT
// The generating function of Serret's transformation, at an attitude with given constants.
#include "polhode/free/generating_function.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "free/detail/attitude_roots.hpp"
#include "free/detail/mean_frame.hpp"
#include "free/detail/serret_elements.hpp"
#include "math/number_text.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/error.hpp"
#include "polhode/free/detail/precession.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace free {
namespace {

using DD = DoubleDouble;

// The circle of momenta of an attitude and the polhode with these constants, at momentum 1.
struct AttitudeProblem {
  polhode::detail::AxisOrder order;
  BasicEulerAngles<DD> q;
  DD H;
  polhode::detail::PolhodeCurve<DD> curve;
  polhode::detail::MomentumCircle circle;
  polhode::detail::AttitudeRoots roots;
  double energy_ratio;  // 2T at momentum 1
};

// `function` is the one that was called, for messages.
void require_interior(const std::string& function, const SerretState& c, const EulerAngles& q,
                      const polhode::detail::PolhodeCurve<DD>& curve) {
  const double angles[] = {q.phi, q.theta, q.psi};
  for (const double x : angles)
    if (!std::isfinite(x))
      throw DomainError(function + ": (phi, theta, psi) = " +
                        polhode::detail::tuple_text({q.phi, q.theta, q.psi}) + " must be finite");
  if (!(q.theta > 0.0 && q.theta < pi<double>()))
    throw DomainError(function + ": theta = " + polhode::detail::number_text(q.theta) +
                      " must be in (0, pi): elsewhere the Euler angles are no coordinates");
  if (!(std::abs(c.H) < c.G))
    throw DomainError(function + ": H = " + polhode::detail::number_text(c.H) +
                      " of G = " + polhode::detail::number_text(c.G) +
                      " must have |H| < G: h is not defined at I = 0, pi");
  if (curve.steady || !(curve.DC > DD(0.0)))
    throw DomainError(function + ": T = " + polhode::detail::number_text(c.T) +
                      " of G = " + polhode::detail::number_text(c.G) +
                      " must be inside (G^2/2I3, G^2/2I1): a steady rotation has no u");
}

AttitudeProblem attitude_problem(const Body& body, const EulerAngles& given,
                                 const BasicSerretState<DD>& c,
                                 const polhode::detail::PolhodeCurve<DD>& curve) {
  const BasicEulerAngles<DD> q{given.phi, given.theta, given.psi};
  const DD H = c.H / c.G;
  const polhode::detail::MomentumCircle circle(q, H);
  const auto I = polhode::detail::converted<DD>(polhode::detail::scaled(
      body.moments(), polhode::detail::exponent_of_largest(body.moments())));
  const polhode::detail::EnergyAlongCircle along(circle, I, polhode::detail::energy_ratio(c));
  return {polhode::detail::ascending_order(body.moments()), q,         H, curve, circle,
          polhode::detail::attitude_roots(along),           along.e.hi};
}

// A motion through the attitude: its place on the polhode and its slow angles.
struct Branch {
  DD angle;  // phi - h
  DD u;
  BasicVec3<DD> k;  // momentum along the primed axes
};

// The place of a root on the lobe of these signs; nullopt if the momentum is on another lobe.
std::optional<Branch> branch_of(const AttitudeProblem& p, const polhode::detail::PrimedSense& sense,
                                const DD& angle) {
  const polhode::detail::AxisOrder to_primed =
      polhode::detail::primed_axes(sense.long_axis, sense.s1, sense.s3);
  const BasicVec3<DD> k = polhode::detail::reordered(
      to_primed, polhode::detail::reordered(p.order, p.circle.at(angle)));
  const DD zero(0.0);
  if (k.z < zero || (p.curve.separatrix && k.x < zero)) return std::nullopt;
  DD u = polhode::detail::place_on(p.curve, {k.x < zero ? -k.x : k.x, k.y, k.z});
  if (k.x < zero) u = (k.y < zero ? DD(-2.0) : DD(2.0)) * p.curve.K - u;
  return Branch{angle, u, k};
}

// g0 of a branch; `u` is its argument with whole periods added.
DD node_at_start(const AttitudeProblem& p, const polhode::detail::PrimedSense& sense,
                 const Branch& b, const DD& u) {
  const DD half(0.5), one(1.0);
  const DD h = p.q.phi - b.angle;
  const BasicQuaternion<DD> tilt{sqrt(half * (one + p.H)), sqrt(half * (one - p.H)), DD(0.0),
                                 DD(0.0)};
  const polhode::detail::AxisOrder primed = polhode::detail::composed(
      p.order, polhode::detail::primed_axes(sense.long_axis, sense.s1, sense.s3));
  const BasicQuaternion<DD> on_polhode = normalized(polhode::detail::primed_attitude(
      p.curve, polhode::detail::cayley_klein_series(p.curve), b.u));
  const BasicQuaternion<DD> mean = conj(rotation_z(h) * tilt) * attitude(p.q) *
                                   conj(polhode::detail::quaternion_of<DD>(primed)) *
                                   conj(on_polhode);
  const DD swept = polhode::detail::precession_of_axis1(p.curve) / p.curve.n * u;
  return DD(2.0) * atan2(mean.z, mean.w) - swept - polhode::detail::node_offset<DD>(sense);
}

// The root whose momentum is nearest to that of the motion c, whose argument is u.
Branch nearest_branch(const AttitudeProblem& p, const polhode::detail::PrimedSense& sense,
                      const DD& u) {
  const polhode::detail::PolhodeCurve<DD>& c = p.curve;
  const elliptic::Jacobi<DD> f =
      elliptic::jacobi(u, elliptic::BasicModulus<DD>::from_ratio(c.k2, c.kp2));
  const BasicVec3<DD> near{c.a1 * f.cn, c.a2 * f.sn, c.a3 * f.dn};
  std::optional<Branch> best;
  double least = std::numeric_limits<double>::infinity();
  for (const DD& angle : p.roots.angles) {
    const std::optional<Branch> b = branch_of(p, sense, angle);
    if (!b) continue;
    const BasicVec3<DD> d = b->k - near;
    const double distance = dot(d, d).hi;
    if (!(distance < least)) continue;
    least = distance;
    best = b;
  }
  if (!best)
    throw DomainError(std::string("generating_function: ") +
                      (sense.long_axis ? "sign_g1 = " : "sign_g3 = ") +
                      (sense.s3 < 0.0 ? "-1" : "1") +
                      ": no motion with these G, H, T and this sign has the attitude; those that "
                      "have it must be taken from serret_branches");
  return *best;
}

void require_motion(const std::string& function, const AttitudeProblem& p, const EulerAngles& q,
                    const SerretState& c) {
  if (!p.roots.angles.empty()) return;
  const auto energy = [&](double twice_ratio) {
    return polhode::detail::number_text(c.T * (twice_ratio / p.energy_ratio));
  };
  throw DomainError(function + ": T = " + polhode::detail::number_text(c.T) + " must be in [" +
                    energy(p.roots.least) + ", " + energy(p.roots.greatest) +
                    "] for a motion with G = " + polhode::detail::number_text(c.G) +
                    ", H = " + polhode::detail::number_text(c.H) + " to have (phi, theta, psi) = " +
                    polhode::detail::tuple_text({q.phi, q.theta, q.psi}));
}

}  // namespace

GeneratingFunction generating_function(const Body& body, const EulerAngles& q, const SerretState& c,
                                       double t) {
  polhode::detail::require_elements(body, c);
  const polhode::detail::Units units = polhode::detail::units_of(body, c.G);
  const auto [scaled, now] = polhode::detail::in_units(units, c, t);
  const BasicSerretState<DD> s = polhode::detail::widened(scaled);
  const polhode::detail::PolhodeCurve<DD> curve = polhode::detail::curve_of(body, s);
  require_interior("generating_function", c, q, curve);
  if (!std::isfinite(t)) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none, none, none, none, none, none};
  }
  const AttitudeProblem p = attitude_problem(body, q, s, curve);
  require_motion("generating_function", p, q, c);
  const polhode::detail::PrimedSense sense =
      polhode::detail::primed_sense(curve.long_axis, c.sign_g1, c.sign_g3);
  const DD rate = curve.n * s.G, near = rate * (DD(now) - s.t0);
  const Branch b = nearest_branch(p, sense, near);
  DD u = b.u;
  if (!curve.separatrix) {
    const DD period = DD(4.0) * curve.K;
    u += period * std::rint(((near - u) / period).hi);
  }
  const DD elapsed = u / rate, t0 = DD(now) - elapsed;
  const DD h = polhode::detail::turned_to(c.h, p.q.phi - b.angle);
  const DD g0 = polhode::detail::turned_to(c.g0, node_at_start(p, sense, b, u));
  const DD S = (DD(2.0) * elapsed - DD(now)) * s.T + s.H * h + s.G * g0;  // [SA (55)]
  // momenta along the node of the Euler angles and along b3  [SA (33)-(35)]
  const DD across = s.G * sqrt(DD(1.0) - p.H * p.H);
  const auto [sine, cosine] = sincos(b.angle);
  const auto [st, ct] = sincos(p.q.theta);
  const DD Theta = -(across * sine), Psi = s.H * ct + across * st * cosine;
  const auto momentum = [&](const DD& x) { return std::ldexp(x.hi, units.momentum); };
  return {
      momentum(S), c.H, momentum(Theta), momentum(Psi), g0.hi, h.hi, -std::ldexp(t0.hi, units.time),
      -c.T};
}

std::vector<SerretState> serret_branches(const Body& body, const EulerAngles& q, double G, double H,
                                         double T, double t) {
  const SerretState c{0.0, 0.0, t, G, H, T, 1, 1};
  polhode::detail::require_elements(body, c);
  const polhode::detail::Units units = polhode::detail::units_of(body, G);
  const auto [scaled, now] = polhode::detail::in_units(units, c, t);
  const BasicSerretState<DD> s = polhode::detail::widened(scaled);
  const polhode::detail::PolhodeCurve<DD> curve = polhode::detail::curve_of(body, s);
  require_interior("serret_branches", c, q, curve);
  const AttitudeProblem p = attitude_problem(body, q, s, curve);
  require_motion("serret_branches", p, q, c);
  std::vector<SerretState> all;
  for (const DD& angle : p.roots.angles)
    for (const double s3 : {1.0, -1.0})
      for (const double s1 : {1.0, -1.0}) {
        if (s1 < 0.0 && !curve.separatrix) continue;  // u = 0 on the other side
        const polhode::detail::PrimedSense sense{curve.long_axis, s1, s3};
        const std::optional<Branch> b = branch_of(p, sense, angle);
        if (!b) continue;
        const DD elapsed = b->u / (curve.n * s.G);
        const int first = static_cast<int>(s1), third = static_cast<int>(s3);
        all.push_back({polhode::detail::wrapped(node_at_start(p, sense, *b, b->u)).hi,
                       polhode::detail::wrapped(p.q.phi - angle).hi,
                       std::ldexp((DD(now) - elapsed).hi, units.time), G, H, T,
                       curve.long_axis ? third : first, curve.long_axis ? first : third});
      }
  return all;
}

}  // namespace free
}  // namespace v0
}  // namespace polhode
