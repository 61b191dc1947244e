// SPDX-License-Identifier: MIT
// Kepler orbits in space: by elements, in turned axes, and a position on a mean ellipse.
#include "polhode/orbit/kepler_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "math/number_text.hpp"
#include "orbit/detail/kepler_elements.hpp"
#include "orbit/detail/orbit_lanes.hpp"
#include "orbit/detail/sine_excess.hpp"
#include "orbit/detail/tabulated_ellipse.hpp"
#include "orbit/mean_ellipse.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

using WideVec3 = BasicVec3<DoubleDouble>;

namespace {

Vec3 rounded(const WideVec3& v) { return {v.x.hi, v.y.hi, v.z.hi}; }
WideVec3 widened(const Vec3& v) { return {v.x, v.y, v.z}; }

[[noreturn]] void fail(const char* function, const std::string& what) {
  throw DomainError(std::string(function) + ": " + what);
}

[[noreturn]] void fail_parabola(const char* function) {
  fail(function,
       "eccentricity 1 is a parabola, which has no mean motion; use an eccentricity next to it, "
       "0.9999999999999999 or 1.0000000000000002, with the same pericentre");
}

// log(x + sqrt(1 + x^2)), odd
DoubleDouble area_sine(const DoubleDouble& x) {
  const DoubleDouble y = abs(x);
  return copysign(log1p(y + y * y / (1.0 + sqrt(1.0 + y * y))), x);
}

}  // namespace

double mean_motion(const KeplerElements& elements) {
  return detail::kepler_shape(elements).mean_motion.hi;
}

// The rate at the pericentre is sqrt(gm (1 + e) / q^3). A passage that is shorter than a thousandth
// of the whole, e > 0.987, does not set the step of all the rest.
double quarter_turn(const KeplerElements& k) {
  const double q = k.pericentre, shortest = 1e-3 / mean_motion(k);
  const double passage = q * std::sqrt(q / (k.gm * (1.0 + k.eccentricity)));
  return 0.5 * std::numbers::pi * std::max(passage, shortest);
}

void require_valid(const KeplerElements& k, const char* function) {
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  if (!positive(k.gm)) fail(function, "gm " + detail::number_text(k.gm) + " must be positive");
  if (!positive(k.pericentre))
    fail(function, "pericentre " + detail::number_text(k.pericentre) + " must be positive");
  if (k.eccentricity == 1.0) fail_parabola(function);
  if (!(k.eccentricity >= 0.0) || !std::isfinite(k.eccentricity))
    fail(function, "eccentricity " + detail::number_text(k.eccentricity) +
                       " must be in [0, 1) (ellipse) or above 1 (hyperbola)");
  for (const double x : {k.inclination, k.node, k.argument, k.mean_anomaly, k.epoch}) {
    if (!std::isfinite(x))
      fail(function,
           "inclination, node, argument, mean anomaly, epoch " +
               detail::tuple_text({k.inclination, k.node, k.argument, k.mean_anomaly, k.epoch}) +
               " must be finite");
  }
  if (std::abs(k.inclination) > 2.0 * std::numbers::pi)  // degrees?
    fail(function, "inclination " + detail::number_text(k.inclination) +
                       " must be an angle in rad, at most a turn");
  const PlanarKepler::Shape shape = detail::kepler_shape(k);
  if (!positive(shape.mean_motion.hi) || !std::isfinite(shape.pericentre_time.hi))
    fail(function, "gm " + detail::number_text(k.gm) + " and pericentre " +
                       detail::number_text(k.pericentre) + " give a mean motion out of range");
}

namespace detail {

PlanarKepler::Shape kepler_shape(const KeplerElements& k) {
  const DoubleDouble complement = k.eccentricity < 1.0 ? DoubleDouble::sum(1.0, -k.eccentricity)
                                                       : DoubleDouble::sum(k.eccentricity, -1.0);
  const DoubleDouble a = DoubleDouble(k.pericentre) / complement;
  const DoubleDouble n = sqrt(DoubleDouble(k.gm) / a) / a;
  return {k.pericentre, {k.eccentricity, complement}, n, k.epoch - k.mean_anomaly / n};
}

}  // namespace detail

KeplerOrbit::KeplerOrbit(const KeplerElements& elements, const PlanarKepler::Shape& shape,
                         const Axes& axes)
    : elements_(elements),
      plane_(shape),
      axes_(axes),
      to_pericentre_(rounded(axes.to_pericentre)),
      along_motion_(rounded(axes.along_motion)) {}

KeplerOrbit::KeplerOrbit(const KeplerElements& elements)
    : KeplerOrbit((require_valid(elements, "KeplerOrbit"), elements),
                  detail::kepler_shape(elements), axes_of(elements)) {}

KeplerOrbit::Axes KeplerOrbit::axes_of(const KeplerElements& k) {
  const auto node = sincos(DoubleDouble(k.node)), argument = sincos(DoubleDouble(k.argument));
  const auto inclination = sincos(DoubleDouble(k.inclination));
  const auto turned = [&](const WideVec3& v) {
    using namespace detail;
    return turned_about_z(node, turned_about_x(inclination, turned_about_z(argument, v)));
  };
  return {turned({1.0, 0.0, 0.0}), turned({0.0, 1.0, 0.0})};
}

namespace {

// Of a state: the motion in its plane, and the anomaly at the epoch.
struct Passage {
  PlanarKepler::Shape shape;
  DoubleDouble a;
  BasicKeplerAnomaly<DoubleDouble> at;
  DoubleDouble mean_anomaly;
};

// h2 = |x x v|^2, radial = x.v; inverse_a, negative for a hyperbola, is the one difference on which
// a near-parabola hangs.
Passage passage(const DoubleDouble& r, const DoubleDouble& h2, const DoubleDouble& radial,
                const DoubleDouble& inverse_a, double gm, double epoch) {
  const DoubleDouble a = 1.0 / abs(inverse_a), p = h2 / gm, n = sqrt(gm / a) / a;
  const DoubleDouble sine_part = radial / sqrt(gm * a);  // e sin E or e sinh H
  BasicEccentricity<DoubleDouble> e;
  BasicKeplerAnomaly<DoubleDouble> at;
  DoubleDouble M;
  if (inverse_a.hi < 0.0) {
    e.e = sqrt(1.0 + p / a);
    at.sine = sine_part / e.e;
    at.anomaly = area_sine(at.sine);
    at.versine = at.sine * at.sine / (1.0 + sqrt(1.0 + at.sine * at.sine));
    M = e.e * detail::sinh_excess(at.anomaly, at.sine);
  } else {
    // One pair gives e and E, so that noise of a nearly circular orbit cannot separate them.
    const DoubleDouble cosine_part = 1.0 - r / a;
    e.e = hypot(sine_part, cosine_part);
    if (e.e.hi > 0.0) at.anomaly = atan2(sine_part, cosine_part);
    if (e.e.hi > 0.0) at.sine = sine_part / e.e;
    const DoubleDouble half = sin(0.5 * at.anomaly);
    at.versine = 2.0 * half * half;
    M = e.e * detail::sine_excess(at.anomaly, at.sine);
  }
  e.complement = p / a / (1.0 + e.e);
  M = e.complement * at.anomaly + M;
  return {{p / (1.0 + e.e), e, n, epoch - M / n}, a, at, M};
}

}  // namespace

KeplerOrbit KeplerOrbit::from_state(const Vec3& position, const Vec3& velocity, double gm,
                                    double epoch) {
  constexpr const char* name = "KeplerOrbit::from_state";
  const WideVec3 x = widened(position), v = widened(velocity), h = cross(x, v);
  const DoubleDouble r = sqrt(dot(x, x)), h2 = dot(h, h);
  if (!(gm > 0.0) || !std::isfinite(gm) || !std::isfinite(epoch) || !(h2.hi > 0.0) ||
      !std::isfinite((h2 + r + dot(v, v)).hi))
    fail(name, "position " + detail::tuple_text({position.x, position.y, position.z}) +
                   ", velocity " + detail::tuple_text({velocity.x, velocity.y, velocity.z}) +
                   ", gm " + detail::number_text(gm) + ", epoch " + detail::number_text(epoch) +
                   " must be finite, gm positive, and the motion not along one line");
  const DoubleDouble inverse_a = 2.0 / r - dot(v, v) / gm;
  if (inverse_a.hi == 0.0) fail_parabola(name);
  const Passage now = passage(r, h2, dot(x, v), inverse_a, gm, epoch);
  const PlanarKepler::Shape& shape = now.shape;
  if (!(shape.mean_motion.hi > 0.0) || !std::isfinite(shape.mean_motion.hi) ||
      !std::isfinite(shape.pericentre_time.hi))
    fail(name, "a mean motion out of range");
  // The pericentre is where the position, turned back by its own anomaly, points.
  const BasicEccentricity<DoubleDouble>& e = shape.eccentricity;
  const DoubleDouble px = (shape.pericentre - now.a * now.at.versine) / r;
  const DoubleDouble py = now.a * sqrt(e.complement * (1.0 + e.e)) * now.at.sine / r;
  const DoubleDouble c = px / hypot(px, py), s = py / hypot(px, py), hn = sqrt(h2);
  const WideVec3 normal{h.x / hn, h.y / hn, h.z / hn}, outward{x.x / r, x.y / r, x.z / r};
  const WideVec3 ahead = cross(normal, outward);
  const Axes axes{c * outward - s * ahead, s * outward + c * ahead};
  KeplerElements k{gm, shape.pericentre.hi, e.e.hi};
  const DoubleDouble tilt = hypot(normal.x, normal.y);
  const WideVec3 node =
      tilt.hi > 0.0 ? WideVec3{-normal.y / tilt, normal.x / tilt, 0.0} : WideVec3{1.0, 0.0, 0.0};
  const WideVec3& P = axes.to_pericentre;
  k.inclination = atan2(tilt, normal.z).hi;
  k.node = atan2(node.y, node.x).hi;
  k.argument = atan2(dot(P, cross(normal, node)), dot(P, node)).hi;
  k.mean_anomaly = now.mean_anomaly.hi;
  k.epoch = epoch;
  KeplerOrbit orbit(k, shape, axes);
  orbit.state_ = {position, velocity};
  return orbit;
}

Vec3 KeplerOrbit::position(double t, double rest) const { return placed(plane_.point(t, rest)); }

WideVec3 KeplerOrbit::position(const DoubleDouble& t) const {
  const BasicPlanarPoint<DoubleDouble> at = plane_.position(t);
  return at.x * axes_.to_pericentre + at.y * axes_.along_motion;
}

Vec3 KeplerOrbit::velocity(double t) const { return placed(plane_.motion(t).velocity); }

WideVec3 KeplerOrbit::velocity(const DoubleDouble& t) const {
  const BasicPlanarPoint<DoubleDouble> at = plane_.motion(t).velocity;
  return at.x * axes_.to_pericentre + at.y * axes_.along_motion;
}

void KeplerOrbit::positions(const TimeRows& times, const VectorRows& to, InstructionSet set) const {
  plane_.positions(times, {to.x, to.y}, set);
  const std::size_t whole = times.count - times.count % detail::orbit_lanes_width;
  detail::orbit_lanes(set).places(whole, {to_pericentre_, along_motion_}, to);
  for (std::size_t i = whole; i < times.count; ++i) to.set(i, placed({to.x[i], to.y[i]}));
}

void KeplerOrbit::motions(const TimeRows& times, const VectorRows& position,
                          const VectorRows& velocity, InstructionSet set) const {
  plane_.motions(times, {position.x, position.y}, {velocity.x, velocity.y}, set);
  for (std::size_t i = 0; i < times.count; ++i) {
    position.set(i, placed({position.x[i], position.y[i]}));
    velocity.set(i, placed({velocity.x[i], velocity.y[i]}));
  }
}

TurnedKeplerOrbit::TurnedKeplerOrbit(const PrecessingKeplerOrbit& orbit, double angle)
    : orbit_(orbit), angle_(angle), sine_(std::sin(angle)), cosine_(std::cos(angle)) {
  if (!std::isfinite(angle))
    throw DomainError("TurnedKeplerOrbit: angle " + detail::number_text(angle) + " must be finite");
}

Vec3 on_ellipse(double a, double e, double mean_anomaly, double pericentre) {
  const KeplerAnomaly at = eccentric_anomaly(mean_anomaly, Eccentricity::of(e));
  // not cos E - e: cancels
  const double x = a * ((1.0 - e) - at.versine), y = a * std::sqrt((1.0 - e) * (1.0 + e)) * at.sine;
  const double c = std::cos(pericentre), s = std::sin(pericentre);
  return {c * x - s * y, s * x + c * y, 0.0};
}

}  // namespace v0
}  // namespace polhode
