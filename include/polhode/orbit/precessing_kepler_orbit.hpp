// SPDX-License-Identifier: MIT
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
#pragma once

#include <optional>

#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/uniform_angle.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
