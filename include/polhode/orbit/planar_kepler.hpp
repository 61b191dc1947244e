// SPDX-License-Identifier: MIT
// PlanarKepler: motion on a conic in its own axes, x towards the pericentre, y along the motion
// there.
//
// Equations   M = n (t - t_p), x = q - a (1 - cos E), y = b sin E; for a hyperbola cosh, sinh and 1
//             + e for 1 - e. n may differ from sqrt(gm / a^3) (secular rates).
// Units       lengths of `pericentre`, times of 1 / `mean_motion`.
// Domain      0 <= e < 1 and e > 1.
// Accuracy    budget kepler_*. The phase is formed in double-double, or as an integer modulo one
//             turn: after any number of orbits the error is that of a rounding of t.
// Errors      none; the orbits that hold one check.
// Cost        in double, for e <= 0.5, polynomials of the phase: 7 ns, 17 ns as one link of a
//             chain, velocities 12 ns; 150 ns above and within 2^-24 turns of t = 0, 300 ns for
//             hyperbolas. The constructor takes 60 us for e < 0.2, 220 us for 0.5; copies share.
#pragma once

#include <memory>

#include "polhode/math/double_double.hpp"
#include "polhode/orbit/kepler_equation.hpp"
#include "polhode/orbit/many_times.hpp"

namespace polhode {
inline namespace v0 {

class KeplerOrbit;
namespace detail {
class TabulatedEllipse;
struct SteadyEllipse;
}  // namespace detail

template <Real T>
struct BasicPlanarPoint {
  T x;
  T y;
};
template <Real T>
struct BasicPlanarMotion {
  BasicPlanarPoint<T> position;
  BasicPlanarPoint<T> velocity;
};

// As many as there are times.
struct PlanarRows {
  double* x;
  double* y;
};

class PlanarKepler {
 public:
  struct Shape {
    DoubleDouble pericentre;
    BasicEccentricity<DoubleDouble> eccentricity;
    DoubleDouble mean_motion;
    DoubleDouble pericentre_time;
  };
  explicit PlanarKepler(const Shape& shape);

  const Shape& shape() const { return shape_; }
  // a > 0 also for a hyperbola.
  const DoubleDouble& semi_axis() const { return a_; }

  // Of ellipses in [-pi, pi].
  DoubleDouble mean_anomaly(const DoubleDouble& t) const;
  // At t + rest: what a double cannot hold of a time counts after thousands of turns.
  BasicPlanarPoint<double> position(double t, double rest = 0.0) const;
  BasicPlanarPoint<DoubleDouble> position(const DoubleDouble& t) const;
  BasicPlanarMotion<double> motion(double t) const;
  BasicPlanarMotion<DoubleDouble> motion(const DoubleDouble& t) const;
  // position() at many times, and motion() without their rests: the same bits.
  void positions(const TimeRows& times, const PlanarRows& to, InstructionSet set) const;
  void motions(const TimeRows& times, const PlanarRows& position, const PlanarRows& velocity,
               InstructionSet set) const;

 private:
  friend class KeplerOrbit;

  struct Direction {
    double sine;
    double versine;
  };
  Direction direction(double t, double rest) const;
  // position(), by table; where it does not serve, by Kepler's equation
  inline BasicPlanarPoint<double> point(double t, double rest) const;
  BasicPlanarPoint<double> solved_point(double t, double rest) const;
  inline BasicPlanarPoint<double> point_of(const Direction& at) const;
  inline BasicPlanarMotion<double> motion_of(const Direction& at) const;
  detail::SteadyEllipse ellipse() const;
  BasicKeplerAnomaly<DoubleDouble> anomaly(const DoubleDouble& t) const;

  Shape shape_;
  Eccentricity rounded_;
  bool hyperbola_;
  DoubleDouble a_, b_;
  DoubleDouble frequency_;                                 // turns per time
  std::shared_ptr<const detail::TabulatedEllipse> table_;  // null for e > 0.5
};

}  // namespace v0
}  // namespace polhode
