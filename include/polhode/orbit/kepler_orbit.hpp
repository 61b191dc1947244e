// SPDX-License-Identifier: MIT
// In this header: kepler_equation, planar_kepler, kepler_orbit, precessing_kepler_orbit,
// turned_kepler_orbit.
#pragma once

#include <memory>
#include <numbers>
#include <optional>

#include "polhode/detail/orbit/many_times.hpp"
#include "polhode/detail/orbit/uniform_angle.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/orbit/orbit.hpp"

namespace polhode {
inline namespace v0 {

// Kepler's equation: the eccentric anomaly of a mean anomaly, for ellipses and hyperbolas.
//
// Equations   M = E - e sin E (e < 1), M = e sinh H - H (e > 1); solved as M = |1 - e| E + e (E -
//             sin E), a sum of terms of one sign, which keeps its digits where e is next to 1.
//             Starter and fifth-order correction for ellipses: Markley (1995); for hyperbolas the
//             root of the cubic that bounds the equation from below, carried through asinh, and
//             Halley's steps.
// Units       radians.
// Domain      any finite M and 0 <= e < 1 or e > 1. NaN for e = 1, e < 0 and NaN.
// Accuracy    budget kepler_*: a few roundings of E, sin E and 1 - cos E, each relative, times what
//             a rounding of M does.
// Cost        about 120 ns for ellipses, 250 ns for hyperbolas; 1 us in double-double. A fixed
//             number of steps, whatever the arguments.

// e with |1 - e|, which subtraction could not give where e was itself computed.
template <Real T>
struct BasicEccentricity {
  T e;
  T complement;

  static BasicEccentricity of(const T& e) {
    const T one(1.0);
    return {e, e < one ? one - e : e - one};
  }
};
using Eccentricity = BasicEccentricity<double>;

template <Real T>
struct BasicKeplerAnomaly {
  T anomaly;  // E, with the turns of M; or H
  T sine;     // sin E or sinh H
  T versine;  // 1 - cos E or cosh H - 1
};
using KeplerAnomaly = BasicKeplerAnomaly<double>;

KeplerAnomaly eccentric_anomaly(double M, const Eccentricity& e);
BasicKeplerAnomaly<DoubleDouble> eccentric_anomaly(const DoubleDouble& M,
                                                   const BasicEccentricity<DoubleDouble>& e);

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

// KeplerOrbit: motion about a point mass, ellipse or hyperbola, in the axes of its elements.
//
// Equations   x = Rz(node) Rx(inclination) Rz(argument) (x, y, 0) of PlanarKepler; n = sqrt(gm /
//             a^3).
// Units       any consistent set: gm in length^3 / time^2.
// Domain      gm > 0, pericentre > 0, 0 <= e < 1 or e > 1, as near to 1 as double holds; |i| up to
//             a turn. From a position and a velocity: angular momentum not 0. Circular orbits have
//             their pericentre where they are given; orbits in the xy plane their node along x.
// Accuracy    budget kepler_*: a few roundings of |position| plus what a rounding of t does, after
//             any number of orbits and at pericentre of an orbit next to a parabola.
// Errors      DomainError for elements out of the domain; for e = 1 it says what to use.
// Cost        for e <= 0.5 a position 8 ns, 20 ns where the next time waits for it, a velocity
//             14 ns; 150 ns above, in lanes 20 to 80, 300 ns for hyperbolas. The constructor takes
//             60 to 220 us where it prepares for the former. Copies share what is prepared.

struct KeplerElements {
  double gm;
  double pericentre;  // distance q = a (1 - e)
  double eccentricity;
  double inclination = 0.0;
  double node = 0.0;
  double argument = 0.0;      // of the pericentre, from the node
  double mean_anomaly = 0.0;  // at `epoch`; 0 where the epoch is a time of pericentre
  double epoch = 0.0;

  constexpr bool operator==(const KeplerElements&) const = default;
};

// q = a (1 - e): a < 0 for a hyperbola.
constexpr double pericentre_distance(double semi_major_axis, double eccentricity) {
  return semi_major_axis * (1.0 - eccentricity);
}
constexpr double semi_major_axis(const KeplerElements& elements) {
  return elements.pericentre / (1.0 - elements.eccentricity);
}
// n = sqrt(gm / |a|^3)
double mean_motion(const KeplerElements& elements);
// Of a quarter of a turn at the rate of the pericentre, at least a thousandth of one at the mean
// rate; for every conic.
double quarter_turn(const KeplerElements& elements);

// DomainError, naming `function`, where the elements are those of no orbit.
void require_valid(const KeplerElements& elements, const char* function);

// Where a body is, and where it goes.
struct OrbitState {
  Vec3 position;
  Vec3 velocity;

  constexpr bool operator==(const OrbitState&) const = default;
};

class KeplerOrbit {
 public:
  explicit KeplerOrbit(const KeplerElements& elements);
  static KeplerOrbit from_state(const Vec3& position, const Vec3& velocity, double gm,
                                double epoch = 0.0);

  const KeplerElements& elements() const { return elements_; }
  // The state at their epoch that it was made of, which says more than they do.
  const std::optional<OrbitState>& state() const { return state_; }
  bool operator==(const KeplerOrbit& other) const {
    return elements_ == other.elements_ && state_ == other.state_;
  }
  bool shares_with(const KeplerOrbit& other) const { return *this == other; }
  double gm() const { return elements_.gm; }
  double time_scale() const { return quarter_turn(elements_); }
  double mean_motion() const { return plane_.shape().mean_motion.hi; }

  // T = double or DoubleDouble, or a Dual of them; `rest` is what a double cannot hold of the time.
  Vec3 position(double t, double rest = 0.0) const;
  BasicVec3<DoubleDouble> position(const DoubleDouble& t) const;
  Vec3 velocity(double t) const;
  BasicVec3<DoubleDouble> velocity(const DoubleDouble& t) const;
  // At many times, in lanes: many_times.hpp.
  void positions(const TimeRows& times, const VectorRows& to, InstructionSet set) const;
  void motions(const TimeRows& times, const VectorRows& position, const VectorRows& velocity,
               InstructionSet set) const;

  template <Real T, int N>
  BasicVec3<Dual<T, N>> position(const Dual<T, N>& t) const {
    return chained(t, position(t.value), velocity(t.value));
  }
  template <Real T, int N>
  BasicVec3<Dual<T, N>> velocity(const Dual<T, N>& t) const {
    const BasicVec3<T> x = position(t.value);
    const T r = norm(x);
    return chained(t, velocity(t.value), (T(-elements_.gm) / (r * r * r)) * x);
  }

 private:
  struct Axes {
    BasicVec3<DoubleDouble> to_pericentre;
    BasicVec3<DoubleDouble> along_motion;
  };
  KeplerOrbit(const KeplerElements& elements, const PlanarKepler::Shape& shape, const Axes& axes);
  static Axes axes_of(const KeplerElements& elements);
  Vec3 placed(const BasicPlanarPoint<double>& at) const {
    return at.x * to_pericentre_ + at.y * along_motion_;
  }

  KeplerElements elements_;
  std::optional<OrbitState> state_;
  PlanarKepler plane_;
  Axes axes_;
  Vec3 to_pericentre_, along_motion_;  // axes_ in double
};

// PrecessingKeplerOrbit: a Kepler orbit whose elements, all but the axis, change uniformly.
//
// Equations   node, argument, mean anomaly, inclination and eccentricity are those of the elements
//             at their epoch plus rate (t - epoch); the mean anomaly also has n = sqrt(gm / a^3),
//             and a stays. Velocities are derivatives of positions, with the rates of all five.
//             j2_rates: the secular rates of first order of an oblate body, with p = a (1 - e^2)
//             and k = (3/2) n J2 (R / p)^2: node -k cos i, argument k (2 - (5/2) sin^2 i), mean
//             anomaly k sqrt(1 - e^2) (1 - (3/2) sin^2 i). mean_elements: the axis a of the mean
//             ellipse has the energy of the state, 1/a = 1/a_s + J2 R^2 ((1 - 3 z^2 / r^2) / r^3 -
//             (1 - (3/2) sin^2 i) / (a^3 (1 - e^2)^(3/2))), a_s and r at the epoch, the last part
//             the mean of the one before.
// Units       any consistent set; rates in rad per time, of the eccentricity per time.
// Domain      that of KeplerOrbit; n plus the rate of the mean anomaly must be positive; of a
//             hyperbola the eccentricity stays; NaN where it has left [0, 1). J2 of any sign,
//             ellipses only, inclination against the equator of the body. mean_elements moves the
//             axis alone, whose error would grow along the orbit; the other elements keep their
//             short-period terms, and the orbit has none (docs/guide/orbits.md). time_scale is
//             that of the pericentre at the epoch, which limits the steps of a run: where the
//             eccentricity falls far from there, a run takes many times the steps it needs, and
//             where it rises the limit is no help. Put the epoch where the run is.
// Accuracy    budget kepler_*: all angles are formed and reduced in double-double. Rates and mean
//             axis are of first order in J2: budget j2_*.
// Errors      DomainError for elements out of the domain, rates that are not finite, a hyperbola
//             whose eccentricity changes, a J2 too large for a mean ellipse.
// Cost        some 50 ns for e <= 0.5, 240 ns above or where it changes (benchmarks/orbit.cpp).

struct SecularRates {
  double node = 0.0;
  double argument = 0.0;
  double mean_anomaly = 0.0;  // in addition to the mean motion
  double inclination = 0.0;
  double eccentricity = 0.0;  // per time

  constexpr bool operator==(const SecularRates&) const = default;
};

SecularRates j2_rates(const KeplerElements& elements, double J2, double equatorial_radius);

// Of the ellipse through a state of an orbit about an oblate body, what j2_rates and a
// PrecessingKeplerOrbit take.
KeplerElements mean_elements(const KeplerElements& osculating, double J2, double equatorial_radius);

class PrecessingKeplerOrbit {
 public:
  PrecessingKeplerOrbit(const KeplerElements& elements, const SecularRates& rates);

  const KeplerElements& elements() const { return elements_; }
  const SecularRates& rates() const { return rates_; }
  bool shares_with(const PrecessingKeplerOrbit& other) const {
    return elements_ == other.elements_ && rates_ == other.rates_;
  }
  double gm() const { return elements_.gm; }
  double time_scale() const { return quarter_turn(elements_); }
  // At a time.
  double eccentricity(double t) const;
  // When the eccentricity leaves [0, 1): the times between which there is an orbit.
  double first_time() const;
  double last_time() const;

  // T = double or DoubleDouble, or a Dual of them.
  Vec3 position(double t, double rest = 0.0) const;  // at t + rest
  BasicVec3<DoubleDouble> position(const DoubleDouble& t) const;
  // The derivative of the position: the turning of the orbit is in it.
  Vec3 velocity(double t) const;
  BasicVec3<DoubleDouble> velocity(const DoubleDouble& t) const;
  // At many times, in lanes: many_times.hpp.
  void positions(const TimeRows& times, const VectorRows& to, InstructionSet set) const;
  void motions(const TimeRows& times, const VectorRows& position, const VectorRows& velocity,
               InstructionSet set) const;

  template <Real T, int N>
  BasicVec3<Dual<T, N>> position(const Dual<T, N>& t) const {
    const BasicMotion<T> at = motion(t.value);
    return chained(t, at.position, at.velocity);
  }

 private:
  template <Real T>
  struct BasicMotion {
    BasicVec3<T> position;
    BasicVec3<T> velocity;
  };
  BasicMotion<double> motion(double t) const;
  BasicMotion<DoubleDouble> motion(const DoubleDouble& t) const;
  template <Real T>
  struct Axes {
    SinCos<T> node;
    SinCos<T> argument;
    SinCos<T> inclination;
  };
  Axes<double> axes(double t) const;
  Axes<DoubleDouble> axes(const DoubleDouble& t) const;
  BasicPlanarMotion<double> planar(double t, double rest) const;
  BasicPlanarMotion<DoubleDouble> planar(const DoubleDouble& t) const;
  BasicEccentricity<DoubleDouble> wide_eccentricity(const DoubleDouble& t) const;
  // f(i, axes) of every time, without rests
  template <class F>
  void each_axes(const TimeRows& times, InstructionSet set, const F& f) const;
  // f(i, motion) of every time, where the eccentricity changes
  template <class F>
  void each_planar(const TimeRows& times, InstructionSet set, const F& f) const;
  template <Real T>
  static BasicVec3<T> placed(const Axes<T>& axes, const BasicPlanarPoint<T>& at);
  template <Real T>
  BasicMotion<T> moved(const Axes<T>& axes, const BasicPlanarMotion<T>& motion) const;

  KeplerElements elements_;
  SecularRates rates_;
  PlanarKepler plane_;
  UniformAngle node_, argument_;
  SinCos<DoubleDouble> inclination_;
  std::optional<UniformAngle> tilt_;  // the inclination, where it changes
};

// TurnedKeplerOrbit: a PrecessingKeplerOrbit with its elements in axes that are turned about axis
// 1, as those of a satellite are in a run along the ecliptic.
//
// Equations   x = R1(angle) x', R1 = ((1, 0, 0), (0, cos, sin), (0, -sin, cos)), x' the position in
//             the axes of the elements: with obliquity_J2000 from the equator to the ecliptic.
// Units       those of the orbit; the angle in rad.
// Domain      any angle that is finite; the orbit at any time.
// Accuracy    that of the orbit, and one rotation.
// Errors      DomainError for an angle that is not finite.
// Cost        that of the orbit and 1 ns.

// Of the ecliptic of J2000 against the equator, IAU 1976; they share axis 1, the equinox.
constexpr double obliquity_J2000 = 84381.448 * (std::numbers::pi / 648000.0);

class TurnedKeplerOrbit {
 public:
  TurnedKeplerOrbit(const PrecessingKeplerOrbit& orbit, double angle);
  // Elements along the equator of J2000, positions along the ecliptic; and the reverse.
  static TurnedKeplerOrbit from_equator(const PrecessingKeplerOrbit& orbit) {
    return {orbit, obliquity_J2000};
  }
  static TurnedKeplerOrbit from_ecliptic(const PrecessingKeplerOrbit& orbit) {
    return {orbit, -obliquity_J2000};
  }

  const PrecessingKeplerOrbit& orbit() const { return orbit_; }
  double angle() const { return angle_; }
  bool shares_with(const TurnedKeplerOrbit& other) const {
    return angle_ == other.angle_ && orbit_.shares_with(other.orbit_);
  }
  double gm() const { return orbit_.gm(); }
  double time_scale() const { return orbit_.time_scale(); }

  // T = double or DoubleDouble, or a Dual of them.
  Vec3 position(double t, double rest = 0.0) const { return turned(orbit_.position(t, rest)); }
  BasicVec3<DoubleDouble> position(const DoubleDouble& t) const {
    return turned(orbit_.position(t));
  }
  // At many times, in lanes: many_times.hpp.
  void positions(const TimeRows& times, const VectorRows& to, InstructionSet set) const {
    orbit_.positions(times, to, set);
    for (std::size_t i = 0; i < times.count; ++i) to.set(i, turned(to.at(i)));
  }
  void motions(const TimeRows& times, const VectorRows& position, const VectorRows& velocity,
               InstructionSet set) const {
    orbit_.motions(times, position, velocity, set);
    for (std::size_t i = 0; i < times.count; ++i) {
      position.set(i, turned(position.at(i)));
      velocity.set(i, turned(velocity.at(i)));
    }
  }
  template <Real T, int N>
  BasicVec3<Dual<T, N>> position(const Dual<T, N>& t) const {
    return turned(orbit_.position(t));
  }
  // The derivative of the position.
  template <class T>
  BasicVec3<T> velocity(const T& t) const {
    return turned(orbit_.velocity(t));
  }

 private:
  template <Real T>
  BasicVec3<T> turned(const BasicVec3<T>& x) const {
    return {x.x, T(cosine_) * x.y + T(sine_) * x.z, T(cosine_) * x.z - T(sine_) * x.y};
  }

  PrecessingKeplerOrbit orbit_;
  double angle_, sine_, cosine_;
};

}  // namespace v0
}  // namespace polhode
