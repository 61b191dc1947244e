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
    const DoubleDouble slope = DoubleDouble::two_pi() / (e.complement + e.e * at.versine);
    (*nodes)[static_cast<std::size_t>(j)] = {at.sine.hi, (1.0 - at.versine).hi, slope.hi};
  }
  return nodes;
}

DoubleDouble PlanarKepler::mean_anomaly(double t) const { return mean_anomaly(DoubleDouble(t)); }

DoubleDouble PlanarKepler::mean_anomaly(const DoubleDouble& t) const {
  const DoubleDouble elapsed = t - shape_.pericentre_time;
  if (hyperbola_) return shape_.mean_motion * elapsed;
  return DoubleDouble::two_pi() * fraction(frequency_ * elapsed);
}

KeplerAnomaly PlanarKepler::anomaly(double t) const {
  const BasicEccentricity<DoubleDouble>& e = shape_.eccentricity;
  return eccentric_anomaly(mean_anomaly(t).hi, Eccentricity{e.e.hi, e.complement.hi});
}

BasicKeplerAnomaly<DoubleDouble> PlanarKepler::anomaly(const DoubleDouble& t) const {
  return eccentric_anomaly(mean_anomaly(t), shape_.eccentricity);
}

BasicPlanarPoint<double> PlanarKepler::position(double t) const {
  const TwoTerms<double> elapsed = two_sum(t, -shape_.pericentre_time.hi);
  const TwoTerms<double> turns = two_prod(elapsed.hi, frequency_.hi);
  if (!nodes_ || !(std::abs(turns.hi) < most_turns)) {
    const KeplerAnomaly at = anomaly(t);
    return {shape_.pericentre.hi - a_.hi * at.versine, b_.hi * at.sine};
  }
  const double whole = (turns.hi + integer_bits) - integer_bits;
  const double rest =
      (turns.hi - whole) + (turns.lo + (elapsed.hi * frequency_.lo +
                                        (elapsed.lo - shape_.pericentre_time.lo) * frequency_.hi));
  // The ellipse is symmetric: the half y >= 0.
  const double half = std::abs(rest);
  const double shifted = half * (2.0 * intervals) + integer_bits;
  const double j = shifted - integer_bits;
  const Node& node = (*nodes_)[std::bit_cast<std::uint64_t>(shifted) & (2 * intervals - 1)];
  const double e = shape_.eccentricity.e.hi;
  const double es = e * node.sine, ec = e * node.cosine;
  // M - M_j = d - e (sin(E_j + d) - sin E_j), reverted to third order: d = u - p u^2 + (2 p^2 - r)
  // u^3
  const double phase = half - j * (0.5 / intervals);
  const double u = phase * node.slope;
  const double inverse = node.slope * (1.0 / (2.0 * RealTraits<double>::pi()));
  const double p = 0.5 * es * inverse, r = ec * inverse * (1.0 / 6.0);
  const double d = u - u * u * (p - u * (2.0 * p * p - r));
  // |d| < 0.06: sines to rounding in four terms
  const double z = d * d;
  const double cubic = d * z * (1.0 / 6 - z * (1.0 / 120 - z * (1.0 / 5040 - z / 362880.0)));
  const double sine = d - cubic;
  const double versed = z * (0.5 - z * (1.0 / 24 - z * (1.0 / 720 - z / 40320.0)));
  // Chebyshev's step of third order
  const double residual =
      (d * (1.0 - ec) - phase * (2.0 * RealTraits<double>::pi())) + (ec * cubic + es * versed);
  const double slope = (1.0 - ec) + (es * sine + ec * versed);
  const double bend = es * (1.0 - versed) + ec * sine;
  const double inverse_slope = 1.0 / slope;
  const double step = residual * inverse_slope;
  const double h = -step * (1.0 + 0.5 * step * bend * inverse_slope);
  // sin and 1 - cos of d + h, |h| < 1e-5
  const double hh = 0.5 * h * h;
  const double s = sine + (h * (1.0 - versed) - hh * sine);
  const double v = versed + (h * sine + hh * (1.0 - versed));
  const double x = node.cosine - (node.sine * s + node.cosine * v);
  const double y = node.sine + (node.cosine * s - node.sine * v);
  return {a_.hi * (x - e), std::copysign(b_.hi, rest) * y};
}

BasicPlanarPoint<DoubleDouble> PlanarKepler::position(const DoubleDouble& t) const {
  const auto at = anomaly(t);
  return {shape_.pericentre - a_ * at.versine, b_ * at.sine};
}

namespace {

// dE/dt = n / (|1 - e| + e (1 - cos E)), hyperbolas alike.
template <Real T>
BasicPlanarMotion<T> planar_motion(const BasicKeplerAnomaly<T>& at, const T& q, const T& a,
                                   const T& b, const T& n, const BasicEccentricity<T>& e,
                                   bool hyperbola) {
  const T one(1.0);
  const T rate = n / (e.complement + e.e * at.versine);
  const T cosine = hyperbola ? one + at.versine : one - at.versine;
  return {{q - a * at.versine, b * at.sine}, {-(a * rate * at.sine), b * rate * cosine}};
}

}  // namespace

BasicPlanarMotion<double> PlanarKepler::motion(double t) const {
  const BasicEccentricity<DoubleDouble>& e = shape_.eccentricity;
  return planar_motion<double>(anomaly(t), shape_.pericentre.hi, a_.hi, b_.hi,
                               shape_.mean_motion.hi, {e.e.hi, e.complement.hi}, hyperbola_);
}

BasicPlanarMotion<DoubleDouble> PlanarKepler::motion(const DoubleDouble& t) const {
  return planar_motion<DoubleDouble>(anomaly(t), shape_.pericentre, a_, b_, shape_.mean_motion,
                                     shape_.eccentricity, hyperbola_);
}

}  // namespace v0
}  // namespace polhode
