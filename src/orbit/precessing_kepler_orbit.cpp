// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "math/number_text.hpp"
#include "orbit/detail/kepler_elements.hpp"
#include "orbit/detail/orbit_lanes.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace {

const KeplerElements& checked(const KeplerElements& elements, const SecularRates& rates) {
  constexpr const char* name = "PrecessingKeplerOrbit";
  require_valid(elements, name);
  for (const double rate :
       {rates.node, rates.argument, rates.mean_anomaly, rates.inclination, rates.eccentricity}) {
    if (!std::isfinite(rate))
      throw DomainError(std::string(name) +
                        ": rates of node, argument, mean anomaly, inclination, eccentricity " +
                        detail::tuple_text({rates.node, rates.argument, rates.mean_anomaly,
                                            rates.inclination, rates.eccentricity}) +
                        " must be finite");
  }
  if (rates.eccentricity != 0.0 && elements.eccentricity > 1.0)
    throw DomainError(std::string(name) + ": rate of the eccentricity " +
                      detail::number_text(rates.eccentricity) +
                      " must be 0 for a hyperbola: only of an ellipse it may change");
  if (!(detail::kepler_shape(elements).mean_motion.hi + rates.mean_anomaly > 0.0))
    throw DomainError(std::string(name) + ": rate of the mean anomaly " +
                      detail::number_text(rates.mean_anomaly) +
                      " must be greater than minus the mean motion");
  return elements;
}

PlanarKepler::Shape shape(const KeplerElements& elements, const SecularRates& rates) {
  PlanarKepler::Shape s = detail::kepler_shape(elements);
  s.mean_motion += rates.mean_anomaly;
  s.pericentre_time = elements.epoch - elements.mean_anomaly / s.mean_motion;
  return s;
}

void require_oblate(const KeplerElements& k, double J2, double R, const char* function) {
  require_valid(k, function);
  const std::string name(function);
  if (!(k.eccentricity < 1.0))
    throw DomainError(name + ": eccentricity " + detail::number_text(k.eccentricity) +
                      " must be below 1: a hyperbola has no secular rates");
  if (!std::isfinite(J2) || !(R > 0.0) || !std::isfinite(R))
    throw DomainError(name + ": J2 " + detail::number_text(J2) + " and equatorial radius " +
                      detail::number_text(R) + " must be finite, the radius positive");
}

}  // namespace

SecularRates j2_rates(const KeplerElements& k, double J2, double R) {
  require_oblate(k, J2, R, "j2_rates");
  const double ratio = R / (k.pericentre * (1.0 + k.eccentricity));
  const double size = 1.5 * mean_motion(k) * J2 * ratio * ratio;
  const double c = std::cos(k.inclination), s = std::sin(k.inclination);
  const double axes = std::sqrt((1.0 - k.eccentricity) * (1.0 + k.eccentricity));
  return {-size * c, size * (2.0 - 2.5 * s * s), size * axes * (1.0 - 1.5 * s * s)};
}

KeplerElements mean_elements(const KeplerElements& k, double J2, double R) {
  require_oblate(k, J2, R, "mean_elements");
  const Vec3 x = KeplerOrbit(k).position(k.epoch);
  const double r = norm(x), sine = x.z / r, s = std::sin(k.inclination), e = k.eccentricity;
  const double own = semi_major_axis(k), square = (1.0 - e) * (1.0 + e);
  const double here = (R / r) * (R / r) * (1.0 - 3.0 * sine * sine) * (own / r);
  const double mean = (R / own) * (R / own) * (1.0 - 1.5 * s * s) / (square * std::sqrt(square));
  // ratio = a_s / a; each trip is nearer by some J2, about the Earth 6 do
  double ratio = 1.0, change = 1.0;
  for (int trip = 0; trip < 60 && std::abs(change) > 1e-15; ++trip) {
    const double next = 1.0 + J2 * (here - mean * (ratio * ratio * ratio));
    change = next - ratio;
    ratio = next;
  }
  if (!(ratio > 0.0) || !(std::abs(change) <= 1e-15))
    throw DomainError("mean_elements: J2 " + detail::number_text(J2) +
                      " is too large at this distance: there is no mean ellipse");
  KeplerElements out = k;
  out.pericentre = k.pericentre / ratio;
  return out;
}

PrecessingKeplerOrbit::PrecessingKeplerOrbit(const KeplerElements& elements,
                                             const SecularRates& rates)
    : elements_(checked(elements, rates)),
      rates_(rates),
      plane_(shape(elements, rates)),
      node_(elements.node, rates.node, elements.epoch),
      argument_(elements.argument, rates.argument, elements.epoch),
      inclination_(sincos(DoubleDouble(elements.inclination))) {
  if (rates.inclination != 0.0)
    tilt_ = UniformAngle(elements.inclination, rates.inclination, elements.epoch);
}

double PrecessingKeplerOrbit::eccentricity(double t) const {
  return rates_.eccentricity == 0.0 ? elements_.eccentricity : wide_eccentricity(t).e.hi;
}

// The eccentricity is e + rate (t - epoch), linear.
double PrecessingKeplerOrbit::first_time() const {
  const double e = elements_.eccentricity, rate = rates_.eccentricity;
  if (rate == 0.0) return -std::numeric_limits<double>::infinity();
  return elements_.epoch + ((rate > 0.0 ? 0.0 : 1.0) - e) / rate;
}

double PrecessingKeplerOrbit::last_time() const {
  const double e = elements_.eccentricity, rate = rates_.eccentricity;
  if (rate == 0.0) return std::numeric_limits<double>::infinity();
  return elements_.epoch + ((rate > 0.0 ? 1.0 : 0.0) - e) / rate;
}

PrecessingKeplerOrbit::Axes<double> PrecessingKeplerOrbit::axes(double t) const {
  const SinCos<double> fixed{inclination_.sin.hi, inclination_.cos.hi};
  const UniformAngle::Two two = UniformAngle::both(node_, argument_, t);
  return {two.first, two.second, tilt_ ? tilt_->at(t) : fixed};
}

PrecessingKeplerOrbit::Axes<DoubleDouble> PrecessingKeplerOrbit::axes(const DoubleDouble& t) const {
  return {node_.at(t), argument_.at(t), tilt_ ? tilt_->at(t) : inclination_};
}

namespace {

// On an ellipse of fixed axis a whose eccentricity has the rate `change`: dE/dt = (n + e' sin E) /
// (1 - e cos E) from Kepler's equation.
template <Real T>
BasicPlanarMotion<T> on_changing_ellipse(const BasicKeplerAnomaly<T>& at,
                                         const BasicEccentricity<T>& e, const T& a, const T& n,
                                         const T& change) {
  using std::sqrt;
  const T one(1.0), axes = sqrt(e.complement * (one + e.e));
  const T rate = (n + change * at.sine) / (e.complement + e.e * at.versine);
  return {{a * (e.complement - at.versine), a * axes * at.sine},
          {-(a * (change + at.sine * rate)),
           a * (axes * (one - at.versine) * rate - e.e * change * at.sine / axes)}};
}

}  // namespace

BasicEccentricity<DoubleDouble> PrecessingKeplerOrbit::wide_eccentricity(
    const DoubleDouble& t) const {
  const DoubleDouble e =
      elements_.eccentricity + DoubleDouble(rates_.eccentricity) * (t - elements_.epoch);
  return {e, DoubleDouble(1.0) - e};
}

BasicPlanarMotion<DoubleDouble> PrecessingKeplerOrbit::planar(const DoubleDouble& t) const {
  if (rates_.eccentricity == 0.0) return plane_.motion(t);
  const BasicEccentricity<DoubleDouble> e = wide_eccentricity(t);
  return on_changing_ellipse<DoubleDouble>(eccentric_anomaly(plane_.mean_anomaly(t), e), e,
                                           plane_.semi_axis(), plane_.shape().mean_motion,
                                           rates_.eccentricity);
}

BasicPlanarMotion<double> PrecessingKeplerOrbit::planar(double t, double rest) const {
  if (rates_.eccentricity == 0.0) return plane_.motion(t);
  const DoubleDouble whole = DoubleDouble::sum(t, rest);
  const BasicEccentricity<DoubleDouble> wide = wide_eccentricity(whole);
  const Eccentricity e{wide.e.hi, wide.complement.hi};
  return on_changing_ellipse<double>(eccentric_anomaly(plane_.mean_anomaly(whole).hi, e), e,
                                     plane_.semi_axis().hi, plane_.shape().mean_motion.hi,
                                     rates_.eccentricity);
}

template <class F>
void PrecessingKeplerOrbit::each_planar(const TimeRows& times, InstructionSet set,
                                        const F& f) const {
  const detail::OrbitLanes lanes = detail::orbit_lanes(set);
  detail::each_block(times, [&](const detail::LaneTimes& block) {
    detail::OrbitBlock M, e, complement, sine, versine;
    for (std::size_t i = 0; i < block.count; ++i) {
      const DoubleDouble t = DoubleDouble::sum(block.t[i], block.rest[i]);
      const BasicEccentricity<DoubleDouble> wide = wide_eccentricity(t);
      M.of[i] = plane_.mean_anomaly(t).hi;
      e.of[i] = wide.e.hi;
      complement.of[i] = wide.complement.hi;
    }
    for (detail::OrbitBlock* row : {&M, &e, &complement}) row->fill_up(block.count);
    lanes.anomalies(block.count, M.of, e.of, complement.of, {sine.of, versine.of});
    for (std::size_t i = 0; i < block.count; ++i) {
      const KeplerAnomaly at{0.0, sine.of[i], versine.of[i]};  // of which E is not asked
      f(block.first + i,
        on_changing_ellipse<double>(at, {e.of[i], complement.of[i]}, plane_.semi_axis().hi,
                                    plane_.shape().mean_motion.hi, rates_.eccentricity));
    }
  });
}

template <class F>
void PrecessingKeplerOrbit::each_axes(const TimeRows& times, InstructionSet set, const F& f) const {
  detail::each_block(times, [&](const detail::LaneTimes& block) {
    const TimeRows here{block.count, times.t + block.first};
    detail::OrbitBlock node[2], argument[2], tilt[2];  // sines and cosines
    node_.at(here, node[0].of, node[1].of, set);
    argument_.at(here, argument[0].of, argument[1].of, set);
    if (tilt_) {
      tilt_->at(here, tilt[0].of, tilt[1].of, set);
    } else {
      tilt[0].fill(inclination_.sin.hi);
      tilt[1].fill(inclination_.cos.hi);
    }
    const auto angle = [](const detail::OrbitBlock(&of)[2], std::size_t i) {
      return SinCos<double>{of[0].of[i], of[1].of[i]};
    };
    for (std::size_t i = 0; i < block.count; ++i)
      f(block.first + i, Axes<double>{angle(node, i), angle(argument, i), angle(tilt, i)});
  });
}

template <Real T>
BasicVec3<T> PrecessingKeplerOrbit::placed(const Axes<T>& a, const BasicPlanarPoint<T>& at) {
  using namespace detail;
  const BasicVec3<T> in_plane{at.x, at.y, T(0.0)};
  return turned_about_z(a.node,
                        turned_about_x(a.inclination, turned_about_z(a.argument, in_plane)));
}

template <Real T>
PrecessingKeplerOrbit::BasicMotion<T> PrecessingKeplerOrbit::moved(
    const Axes<T>& a, const BasicPlanarMotion<T>& m) const {
  // The argument turns the plane in itself, the inclination turns it about the node, the node turns
  // it about the third axis.
  const T turn(rates_.argument);
  const BasicVec3<T> x = placed(a, m.position);
  BasicVec3<T> v =
      placed<T>(a, {m.velocity.x - turn * m.position.y, m.velocity.y + turn * m.position.x});
  if (tilt_) {
    const BasicVec3<T> node{a.node.cos, a.node.sin, T(0.0)};
    v = v + T(rates_.inclination) * cross(node, x);
  }
  return {x, {v.x - T(rates_.node) * x.y, v.y + T(rates_.node) * x.x, v.z}};
}

Vec3 PrecessingKeplerOrbit::position(double t, double rest) const {
  const bool still = rates_.eccentricity == 0.0;
  return placed(axes(t), still ? plane_.position(t, rest) : planar(t, rest).position);
}
BasicVec3<DoubleDouble> PrecessingKeplerOrbit::position(const DoubleDouble& t) const {
  const bool still = rates_.eccentricity == 0.0;
  return placed(axes(t), still ? plane_.position(t) : planar(t).position);
}
PrecessingKeplerOrbit::BasicMotion<double> PrecessingKeplerOrbit::motion(double t) const {
  return moved(axes(t), planar(t, 0.0));
}
PrecessingKeplerOrbit::BasicMotion<DoubleDouble> PrecessingKeplerOrbit::motion(
    const DoubleDouble& t) const {
  return moved(axes(t), planar(t));
}
Vec3 PrecessingKeplerOrbit::velocity(double t) const { return motion(t).velocity; }
BasicVec3<DoubleDouble> PrecessingKeplerOrbit::velocity(const DoubleDouble& t) const {
  return motion(t).velocity;
}

// Axes are those at t, without its rest, as in position().
void PrecessingKeplerOrbit::positions(const TimeRows& times, const VectorRows& to,
                                      InstructionSet set) const {
  if (rates_.eccentricity == 0.0) {
    plane_.positions(times, {to.x, to.y}, set);
  } else {
    each_planar(times, set, [&](std::size_t i, const BasicPlanarMotion<double>& m) {
      to.x[i] = m.position.x;
      to.y[i] = m.position.y;
    });
  }
  each_axes({times.count, times.t}, set, [&](std::size_t i, const Axes<double>& a) {
    to.set(i, placed<double>(a, {to.x[i], to.y[i]}));
  });
}

void PrecessingKeplerOrbit::motions(const TimeRows& times, const VectorRows& position,
                                    const VectorRows& velocity, InstructionSet set) const {
  const TimeRows at{times.count, times.t};
  if (rates_.eccentricity == 0.0) {
    plane_.motions(at, {position.x, position.y}, {velocity.x, velocity.y}, set);
  } else {
    each_planar(at, set, [&](std::size_t i, const BasicPlanarMotion<double>& m) {
      position.x[i] = m.position.x;
      position.y[i] = m.position.y;
      velocity.x[i] = m.velocity.x;
      velocity.y[i] = m.velocity.y;
    });
  }
  each_axes(at, set, [&](std::size_t i, const Axes<double>& a) {
    const BasicMotion<double> m =
        moved<double>(a, {{position.x[i], position.y[i]}, {velocity.x[i], velocity.y[i]}});
    position.set(i, m.position);
    velocity.set(i, m.velocity);
  });
}

}  // namespace v0
}  // namespace polhode
