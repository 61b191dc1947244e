// SPDX-License-Identifier: MIT
#include "polhode/orbit/planar_kepler.hpp"

#include <cmath>

#include "orbit/detail/orbit_lanes.hpp"
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

inline BasicPlanarPoint<double> PlanarKepler::point_of(const Direction& at) const {
  return {shape_.pericentre.hi - a_.hi * at.versine, b_.hi * at.sine};
}

BasicPlanarPoint<double> PlanarKepler::solved_point(double t, double rest) const {
  return point_of(direction(t, rest));
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

inline BasicPlanarMotion<double> PlanarKepler::motion_of(const Direction& at) const {
  return planar_motion<double>(at.sine, at.versine, shape_.pericentre.hi, a_.hi, b_.hi,
                               shape_.mean_motion.hi, rounded_, hyperbola_);
}

BasicPlanarMotion<double> PlanarKepler::motion(double t) const {
  if (table_ && table_->holds(t, 0.0)) {
    const BasicPlanarPoint<double> at = table_->at(t, 0.0);
    BasicPlanarMotion<double> motion =
        motion_of({at.y / b_.hi, (shape_.pericentre.hi - at.x) / a_.hi});
    motion.position = at;
    return motion;
  }
  return motion_of(direction(t, 0.0));
}

BasicPlanarMotion<DoubleDouble> PlanarKepler::motion(const DoubleDouble& t) const {
  const BasicKeplerAnomaly<DoubleDouble> at = anomaly(t);
  return planar_motion<DoubleDouble>(at.sine, at.versine, shape_.pericentre, a_, b_,
                                     shape_.mean_motion, shape_.eccentricity, hyperbola_);
}

detail::SteadyEllipse PlanarKepler::ellipse() const {
  return {frequency_,
          shape_.pericentre_time,
          rounded_.e,
          rounded_.complement,
          shape_.pericentre.hi,
          a_.hi,
          b_.hi};
}

// Rows of a table are looked up one by one: so many gathers would take as long.
void PlanarKepler::positions(const TimeRows& times, const PlanarRows& to,
                             InstructionSet set) const {
  if (table_ || hyperbola_) {
    for (std::size_t i = 0; i < times.count; ++i) {
      const BasicPlanarPoint<double> at = point(times.t[i], times.rest_of(i));
      to.x[i] = at.x;
      to.y[i] = at.y;
    }
    return;
  }
  const detail::OrbitLanes lanes = detail::orbit_lanes(set);
  detail::each_block(times, [&](const detail::LaneTimes& block) {
    detail::OrbitBlock x, y;
    lanes.points(ellipse(), block, {block.room(to.x, x), block.room(to.y, y)});
    block.take(to.x, x);
    block.take(to.y, y);
  });
}

void PlanarKepler::motions(const TimeRows& times, const PlanarRows& position,
                           const PlanarRows& velocity, InstructionSet set) const {
  const auto place = [&](std::size_t i, const BasicPlanarMotion<double>& at) {
    position.x[i] = at.position.x;
    position.y[i] = at.position.y;
    velocity.x[i] = at.velocity.x;
    velocity.y[i] = at.velocity.y;
  };
  if (table_ || hyperbola_) {
    for (std::size_t i = 0; i < times.count; ++i) place(i, motion(times.t[i]));
  } else {
    const detail::OrbitLanes lanes = detail::orbit_lanes(set);
    detail::each_block({times.count, times.t}, [&](const detail::LaneTimes& block) {
      detail::OrbitBlock sine, versine;
      lanes.directions(ellipse(), block, {sine.of, versine.of});
      for (std::size_t i = 0; i < block.count; ++i)
        place(block.first + i, motion_of({sine.of[i], versine.of[i]}));
    });
  }
}

}  // namespace v0
}  // namespace polhode
