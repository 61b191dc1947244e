// SPDX-License-Identifier: MIT
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
#pragma once

#include <optional>

#include "polhode/math/vector.hpp"
#include "polhode/orbit/many_times.hpp"
#include "polhode/orbit/orbit.hpp"
#include "polhode/orbit/planar_kepler.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
