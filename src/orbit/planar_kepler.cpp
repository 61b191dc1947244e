// SPDX-License-Identifier: MIT
#include "polhode/orbit/planar_kepler.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace polhode {
inline namespace v0 {
namespace {

// Above, 64 intervals are too few for the one corrected step from a node.
constexpr double nodes_end = 0.5;
// Adding 1.5 2^52 rounds to an integer and leaves it in the low bits.
constexpr double integer_bits = 0x1.8p52;
constexpr double two_pi = 2.0 * RealTraits<double>::pi();
// Turns below which that works with room for the fraction.
constexpr double most_turns = 0x1p50;

// The fraction of a phase in turns, in [-1/2, 1/2].
DoubleDouble fraction(const DoubleDouble& turns) {
  DoubleDouble rest = turns - std::rint(turns.hi);
  rest = rest - std::rint(rest.hi);  // turns.hi beyond 2^53 leaves all to turns.lo
  return rest;
}

}  // namespace

PlanarKepler::PlanarKepler(const Shape& shape)
    : shape_(shape),
      rounded_{shape.eccentricity.e.hi, shape.eccentricity.complement.hi},
      hyperbola_(shape.eccentricity.e > DoubleDouble(1.0)),
      a_(shape.pericentre / shape.eccentricity.complement),
      b_(a_ * sqrt(shape.eccentricity.complement * (shape.eccentricity.e + 1.0))),
      frequency_(shape.mean_motion / DoubleDouble::two_pi()) {
  if (shape.eccentricity.e.hi <= nodes_end) nodes_ = prepared_nodes(shape.eccentricity);
}

std::shared_ptr<const PlanarKepler::Nodes> PlanarKepler::prepared_nodes(
    const BasicEccentricity<DoubleDouble>& e) {
  auto nodes = std::make_shared<Nodes>();
  for (int j = 0; j <= intervals; ++j) {
    const auto at = eccentric_anomaly(DoubleDouble::pi() * (double(j) / intervals), e);
    const DoubleDouble slope = e.complement + e.e * at.versine, cosine = 1.0 - at.versine;
    const DoubleDouble es = e.e * at.sine, ec = e.e * cosine;
    const DoubleDouble p = 0.5 * es / slope, r = ec / slope / 6.0;
    (*nodes)[static_cast<std::size_t>(j)] = {.sine = at.sine.hi,
                                             .versine = at.versine.hi,
                                             .rate = (DoubleDouble::two_pi() / slope).hi,
                                             .second = p.hi,
                                             .third = (2.0 * p * p - r).hi,
                                             .e_sine = es.hi,
                                             .e_cosine = ec.hi,
                                             .slope = slope.hi};
  }
  return nodes;
}

DoubleDouble PlanarKepler::mean_anomaly(const DoubleDouble& t) const {
  const DoubleDouble elapsed = t - shape_.pericentre_time;
  if (hyperbola_) return shape_.mean_motion * elapsed;
  return DoubleDouble::two_pi() * fraction(frequency_ * elapsed);
}

PlanarKepler::Direction PlanarKepler::far_direction(const DoubleDouble& t) const {
  const KeplerAnomaly at = eccentric_anomaly(mean_anomaly(t).hi, rounded_);
  return {at.sine, at.versine};
}

BasicKeplerAnomaly<DoubleDouble> PlanarKepler::anomaly(const DoubleDouble& t) const {
  return eccentric_anomaly(mean_anomaly(t), shape_.eccentricity);
}

inline PlanarKepler::Direction PlanarKepler::direction(double t, double rest_of_t) const {
  const TwoTerms<double> elapsed = two_sum(t, -shape_.pericentre_time.hi);
  const TwoTerms<double> turns = two_prod(elapsed.hi, frequency_.hi);
  if (hyperbola_ || !(std::abs(turns.hi) < most_turns))
    return far_direction(DoubleDouble::sum(t, rest_of_t));
  const double whole = (turns.hi + integer_bits) - integer_bits;
  const double rest = turns.hi - whole;
  const double tail =
      turns.lo + (elapsed.hi * frequency_.lo +
                  ((elapsed.lo - shape_.pericentre_time.lo) + rest_of_t) * frequency_.hi);
  if (!nodes_) {
    const KeplerAnomaly at = eccentric_anomaly(two_pi * (rest + tail), rounded_);
    return {at.sine, at.versine};
  }
  // The ellipse is symmetric: the half y >= 0. The point is chosen without waiting for the tail.
  const double half = std::abs(rest);
  const double shifted = half * (2.0 * intervals) + integer_bits;
  const double j = shifted - integer_bits;
  const Node& node = (*nodes_)[std::bit_cast<std::uint64_t>(shifted) & (2 * intervals - 1)];
  const double phase = (half - j * (0.5 / intervals)) + std::copysign(1.0, rest) * tail;
  // M - M_j = d - e (sin(E_j + d) - sin E_j), reverted to third order.
  const double u = phase * node.rate;
  const double d = u - u * u * (node.second - u * node.third);
  // |d| < 0.06: sines to rounding in four terms
  const double z = d * d;
  const double cubic = d * z * (1.0 / 6 - z * (1.0 / 120 - z * (1.0 / 5040 - z * (1.0 / 362880))));
  const double sine = d - cubic;
  const double versed = z * (0.5 - z * (1.0 / 24 - z * (1.0 / 720 - z * (1.0 / 40320))));
  // Chebyshev's step of third order
  const double residual =
      (d * node.slope - phase * two_pi) + (node.e_cosine * cubic + node.e_sine * versed);
  const double slope = node.slope + (node.e_sine * sine + node.e_cosine * versed);
  const double bend = node.e_sine * (1.0 - versed) + node.e_cosine * sine;
  const double inverse_slope = 1.0 / slope;
  const double step = residual * inverse_slope;
  const double h = -step * (1.0 + 0.5 * step * bend * inverse_slope);
  // sin and 1 - cos of d + h, |h| < 1e-5
  const double hh = 0.5 * h * h;
  const double s = sine + (h * (1.0 - versed) - hh * sine);
  const double v = versed + (h * sine + hh * (1.0 - versed));
  const double cosine = 1.0 - node.versine;
  return {std::copysign(1.0, rest) * (node.sine + (cosine * s - node.sine * v)),
          node.versine + (node.sine * s + cosine * v)};
}

BasicPlanarPoint<double> PlanarKepler::position(double t, double rest) const {
  const Direction at = direction(t, rest);
  return {shape_.pericentre.hi - a_.hi * at.versine, b_.hi * at.sine};
}

BasicPlanarPoint<DoubleDouble> PlanarKepler::position(const DoubleDouble& t) const {
  const auto at = anomaly(t);
  return {shape_.pericentre - a_ * at.versine, b_ * at.sine};
}

namespace {

// dE/dt = n / (|1 - e| + e (1 - cos E)), hyperbolas alike.
template <Real T>
BasicPlanarMotion<T> planar_motion(const T& sine, const T& versine, const T& q, const T& a,
                                   const T& b, const T& n, const BasicEccentricity<T>& e,
                                   bool hyperbola) {
  const T one(1.0);
  const T rate = n / (e.complement + e.e * versine);
  const T cosine = hyperbola ? one + versine : one - versine;
  return {{q - a * versine, b * sine}, {-(a * rate * sine), b * rate * cosine}};
}

}  // namespace

BasicPlanarMotion<double> PlanarKepler::motion(double t) const {
  const Direction at = direction(t, 0.0);
  return planar_motion<double>(at.sine, at.versine, shape_.pericentre.hi, a_.hi, b_.hi,
                               shape_.mean_motion.hi, rounded_, hyperbola_);
}

BasicPlanarMotion<DoubleDouble> PlanarKepler::motion(const DoubleDouble& t) const {
  const BasicKeplerAnomaly<DoubleDouble> at = anomaly(t);
  return planar_motion<DoubleDouble>(at.sine, at.versine, shape_.pericentre, a_, b_,
                                     shape_.mean_motion, shape_.eccentricity, hyperbola_);
}

}  // namespace v0
}  // namespace polhode
