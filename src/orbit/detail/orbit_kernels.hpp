// SPDX-License-Identifier: MIT
// Orbits on packs: what the sources of orbit/lanes instantiate.
#pragma once

#include "orbit/detail/elliptic_anomaly.hpp"
#include "orbit/detail/orbit_lanes.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Operations of DoubleDouble, to the last bit for finite numbers.
template <class T>
[[gnu::always_inline]] inline TwoTerms<T> wide_sum(const TwoTerms<T>& a, const DoubleDouble& b) {
  const TwoTerms<T> high = two_sum(a.hi, T(b.hi)), low = two_sum(a.lo, T(b.lo));
  const TwoTerms<T> first = quick_two_sum(high.hi, T(high.lo + low.hi));
  return quick_two_sum(first.hi, T(first.lo + low.lo));
}
template <class T>
[[gnu::always_inline]] inline TwoTerms<T> wide_sum(const TwoTerms<T>& a, const T& b) {
  const TwoTerms<T> s = two_sum(a.hi, b);
  return quick_two_sum(s.hi, T(s.lo + a.lo));
}
template <class T>
[[gnu::always_inline]] inline TwoTerms<T> wide_product(const DoubleDouble& a,
                                                       const TwoTerms<T>& b) {
  const TwoTerms<T> p = two_prod(T(a.hi), b.hi);
  const T cross = T(a.hi) * b.lo + (T(a.lo) * b.hi + T(a.lo) * b.lo);
  return quick_two_sum(p.hi, T(p.lo + cross));
}

// That of PlanarKepler, rounded.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> mean_anomaly(const SteadyEllipse& of, const Pack<isa>& t,
                                                     const Pack<isa>& rest) {
  using T = Pack<isa>;
  const TwoTerms<T> elapsed = wide_sum(two_sum(t, rest), -of.pericentre_time);
  const TwoTerms<T> turns = wide_product(of.frequency, elapsed);
  const TwoTerms<T> nearly = wide_sum(turns, T(-rint(turns.hi)));
  const TwoTerms<T> fraction = wide_sum(nearly, T(-rint(nearly.hi)));
  return wide_product(DoubleDouble::two_pi(), fraction).hi;
}

template <InstructionSet isa>
[[gnu::always_inline]] inline EllipticAnomaly<Pack<isa>> anomaly(const SteadyEllipse& of,
                                                                 const LaneTimes& times,
                                                                 std::size_t i) {
  using T = Pack<isa>;
  const T M = mean_anomaly(of, T::loaded(times.t + i), T::loaded(times.rest + i));
  return elliptic_anomaly(M, T(of.e), T(of.complement));
}

template <InstructionSet isa>
void directions_in_lanes(const SteadyEllipse& of, const LaneTimes& times, const TwoRows& to) {
  for (std::size_t i = 0; i < times.count; i += Pack<isa>::width) {
    const EllipticAnomaly<Pack<isa>> at = anomaly<isa>(of, times, i);
    at.sine.store(to.first + i);
    at.versine.store(to.second + i);
  }
}

// Operations of PlanarKepler::point_of.
template <InstructionSet isa>
void points_in_lanes(const SteadyEllipse& of, const LaneTimes& times, const TwoRows& to) {
  using T = Pack<isa>;
  for (std::size_t i = 0; i < times.count; i += T::width) {
    const EllipticAnomaly<T> at = anomaly<isa>(of, times, i);
    T(T(of.pericentre) - T(of.a) * at.versine).store(to.first + i);
    T(T(of.b) * at.sine).store(to.second + i);
  }
}

template <InstructionSet isa>
void anomalies_in_lanes(std::size_t count, const double* M, const double* e,
                        const double* complement, const TwoRows& to) {
  using T = Pack<isa>;
  for (std::size_t i = 0; i < count; i += T::width) {
    const EllipticAnomaly<T> at =
        elliptic_anomaly(T::loaded(M + i), T::loaded(e + i), T::loaded(complement + i));
    at.sine.store(to.first + i);
    at.versine.store(to.second + i);
  }
}

// An angle and a little beyond it.
template <class T>
[[gnu::always_inline]] inline SinCos<T> sines_beyond(const T& angle, const T& beyond) {
  const SinCos<T> whole = sincos(angle);
  return {whole.sin + beyond * whole.cos, whole.cos - beyond * whole.sin};
}

template <InstructionSet isa>
void sines_in_lanes(std::size_t count, const double* angle, const double* beyond,
                    const TwoRows& to) {
  using T = Pack<isa>;
  for (std::size_t i = 0; i < count; i += T::width) {
    const SinCos<T> at = sines_beyond(T::loaded(angle + i), T::loaded(beyond + i));
    at.sin.store(to.first + i);
    at.cos.store(to.second + i);
  }
}

template <InstructionSet isa>
void places_in_lanes(std::size_t count, const PlaneAxes& axes, const VectorRows& to) {
  using T = Pack<isa>;
  const Vec3 &p = axes.to_pericentre, &q = axes.along_motion;
  for (std::size_t i = 0; i < count; i += T::width) {
    const T x = T::loaded(to.x + i), y = T::loaded(to.y + i);
    T(x * T(p.x) + y * T(q.x)).store(to.x + i);
    T(x * T(p.y) + y * T(q.y)).store(to.y + i);
    T(x * T(p.z) + y * T(q.z)).store(to.z + i);
  }
}

template <InstructionSet isa>
OrbitLanes orbit_kernels() {
  return {&directions_in_lanes<isa>, &points_in_lanes<isa>, &anomalies_in_lanes<isa>,
          &sines_in_lanes<isa>, &places_in_lanes<isa>};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
