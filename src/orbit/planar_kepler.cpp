// SPDX-License-Identifier: MIT
#include "polhode/orbit/planar_kepler.hpp"

#include <cmath>

#include "orbit/detail/planar_position.hpp"
#include "orbit/detail/tabulated_ellipse.hpp"

namespace polhode {
inline namespace v0 {
namespace {

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
  if (detail::TabulatedEllipse::serves(shape))
    table_ = std::make_shared<const detail::TabulatedEllipse>(shape);
}

DoubleDouble PlanarKepler::mean_anomaly(const DoubleDouble& t) const {
  const DoubleDouble elapsed = t - shape_.pericentre_time;
  if (hyperbola_) return shape_.mean_motion * elapsed;
  return DoubleDouble::two_pi() * fraction(frequency_ * elapsed);
}

PlanarKepler::Direction PlanarKepler::direction(double t, double rest) const {
  const double M = mean_anomaly(DoubleDouble::sum(t, rest)).hi;
  const KeplerAnomaly at = eccentric_anomaly(M, rounded_);
  return {at.sine, at.versine};
}

BasicKeplerAnomaly<DoubleDouble> PlanarKepler::anomaly(const DoubleDouble& t) const {
  return eccentric_anomaly(mean_anomaly(t), shape_.eccentricity);
}

BasicPlanarPoint<double> PlanarKepler::solved_point(double t, double rest) const {
  const Direction at = direction(t, rest);
  return {shape_.pericentre.hi - a_.hi * at.versine, b_.hi * at.sine};
}

BasicPlanarPoint<double> PlanarKepler::position(double t, double rest) const {
  return point(t, rest);
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
  if (table_ && table_->holds(t, 0.0)) {
    const BasicPlanarPoint<double> at = table_->at(t, 0.0);
    const double sine = at.y / b_.hi, versine = (shape_.pericentre.hi - at.x) / a_.hi;
    BasicPlanarMotion<double> motion =
        planar_motion<double>(sine, versine, shape_.pericentre.hi, a_.hi, b_.hi,
                              shape_.mean_motion.hi, rounded_, hyperbola_);
    motion.position = at;
    return motion;
  }
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
