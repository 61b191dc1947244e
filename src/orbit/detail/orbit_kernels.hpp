// SPDX-License-Identifier: MIT
// Orbits on packs: what the sources of orbit/lanes instantiate.
#pragma once

#include "orbit/detail/elliptic_anomaly.hpp"
#include "orbit/detail/orbit_lanes.hpp"
#include "polhode/math/error_free.hpp"

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
void directions_in_lanes(const SteadyEllipse& of, std::size_t count, const double* t,
                         const double* rest, const AnomalyRows& to) {
  using T = Pack<isa>;
  const T e(of.e), complement(of.complement);
  for (std::size_t i = 0; i < count; i += T::width) {
    const T M = mean_anomaly(of, T::loaded(t + i), T::loaded(rest + i));
    const EllipticAnomaly<T> at = elliptic_anomaly(M, e, complement);
    at.sine.store(to.sine + i);
    at.versine.store(to.versine + i);
  }
}

template <InstructionSet isa>
void anomalies_in_lanes(std::size_t count, const double* M, const double* e,
                        const double* complement, const AnomalyRows& to) {
  using T = Pack<isa>;
  for (std::size_t i = 0; i < count; i += T::width) {
    const EllipticAnomaly<T> at =
        elliptic_anomaly(T::loaded(M + i), T::loaded(e + i), T::loaded(complement + i));
    at.sine.store(to.sine + i);
    at.versine.store(to.versine + i);
  }
}

template <InstructionSet isa>
void sines_in_lanes(std::size_t count, const double* angle, double* sine, double* cosine) {
  using T = Pack<isa>;
  for (std::size_t i = 0; i < count; i += T::width) {
    const SinCos<T> at = sincos(T::loaded(angle + i));
    at.sin.store(sine + i);
    at.cos.store(cosine + i);
  }
}

template <InstructionSet isa>
OrbitLanes orbit_kernels() {
  return {&directions_in_lanes<isa>, &anomalies_in_lanes<isa>, &sines_in_lanes<isa>};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
