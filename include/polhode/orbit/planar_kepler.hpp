// SPDX-License-Identifier: MIT
// PlanarKepler: motion on a conic in its own axes, x towards the pericentre, y along the motion
// there.
//
// Equations   M = n (t - t_p), x = q - a (1 - cos E), y = b sin E; for a hyperbola cosh, sinh and 1
//             + e for 1 - e. n may differ from sqrt(gm / a^3) (secular rates).
// Units       lengths of `pericentre`, times of 1 / `mean_motion`.
// Domain      0 <= e < 1 and e > 1.
// Accuracy    budget kepler_*. The phase is formed and reduced in double-double: after any number
//             of orbits the error is that of a rounding of t.
// Errors      none; the orbits that hold one check.
// Cost        some 30 ns in double for e <= 0.5, from 65 points prepared in double-double; 150 ns
//             above, 300 ns for hyperbolas.
#pragma once

#include <array>
#include <memory>

#include "polhode/math/double_double.hpp"
#include "polhode/orbit/kepler_equation.hpp"

namespace polhode {
inline namespace v0 {

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

  // At t + rest: what a double cannot hold of a time counts after thousands of turns.
  BasicPlanarPoint<double> position(double t, double rest = 0.0) const;
  BasicPlanarPoint<DoubleDouble> position(const DoubleDouble& t) const;
  BasicPlanarMotion<double> motion(double t) const;
  BasicPlanarMotion<DoubleDouble> motion(const DoubleDouble& t) const;

 private:
  // The ellipse at the phase j / (2 intervals) turns, and how E leaves it.
  struct alignas(64) Node {
    double sine;
    double versine;
    double rate;    // dE / d(phase in turns)
    double second;  // d = u - second u^2 + third u^3 reverts Kepler's equation, u = rate x phase
    double third;
    double e_sine;  // e sin E, e cos E, 1 - e cos E
    double e_cosine;
    double slope;
  };
  static constexpr int intervals = 64;
  using Nodes = std::array<Node, intervals + 1>;

  struct Direction {
    double sine;
    double versine;
  };
  Direction direction(double t, double rest) const;
  Direction far_direction(const DoubleDouble& t) const;  // hyperbolas, and phases beyond 2^50 turns
  DoubleDouble mean_anomaly(const DoubleDouble& t) const;
  BasicKeplerAnomaly<DoubleDouble> anomaly(const DoubleDouble& t) const;
  static std::shared_ptr<const Nodes> prepared_nodes(const BasicEccentricity<DoubleDouble>& e);

  Shape shape_;
  Eccentricity rounded_;
  bool hyperbola_;
  DoubleDouble a_, b_;
  DoubleDouble frequency_;              // turns per time
  std::shared_ptr<const Nodes> nodes_;  // null where the general solution is used
};

}  // namespace v0
}  // namespace polhode
