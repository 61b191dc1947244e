// SPDX-License-Identifier: MIT
// The polhode of a momentum in each lane of a pack, as Sadov's variables in lanes need it.
#pragma once

#include "free/detail/sadov/constants.hpp"
#include "polhode/math/pack_functions.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <class T>
struct SadovCurve {
  using Mask = typename T::Mask;
  // negative1, negative3: momentum along primed axes 1 and 3; small: k^2 < 0.01; usual: not next to
  // what degenerates
  Mask long_axis, negative1, negative3, by_deficit, small, usual;
  BasicVec3<T> m;  // momentum along primed axes; m.x, m.z >= 0
  T G, k2, kp2, kap2, r2;
};

template <class T>
[[gnu::always_inline]] inline T of_mode(const typename T::Mask& long_axis, const double (&x)[2]) {
  return select(long_axis, T(x[1]), T(x[0]));
}

// G^2 - 2 T I2 times I1 I3, with its digits however much cancels.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> lane_separatrix_distance(const SadovConstants& c,
                                                                 const Pack<isa>& g1,
                                                                 const Pack<isa>& g3) {
  using T = Pack<isa>;
  const auto term = [](const T& g, const DoubleDouble& factor) {
    const TwoTerms<T> square = exact_product(g, g);
    const TwoTerms<T> p = exact_product(square.hi, T(factor.hi));
    return TwoTerms<T>{p.hi, p.lo + (square.hi * T(factor.lo) + square.lo * T(factor.hi))};
  };
  const TwoTerms<T> plus = term(g3, c.plus), minus = term(g1, c.minus);
  const TwoTerms<T> d = two_sum(plus.hi, T(-minus.hi));
  return d.hi + (d.lo + (plus.lo - minus.lo));
}

// Far enough from the separatrix for six terms of the theta function.
inline constexpr double least_complement = 1e-6;

// Of a momentum along the body axes.
template <InstructionSet isa>
[[gnu::always_inline]] inline SadovCurve<Pack<isa>> sadov_curve(const SadovConstants& c,
                                                                const BasicVec3<Pack<isa>>& g) {
  using T = Pack<isa>;
  const T one(1.0), zero(0.0);
  const T* const v[] = {&g.x, &g.y, &g.z};
  const T x = T(c.sign[0]) * *v[c.axis[0]], y = T(c.sign[1]) * *v[c.axis[1]],
          z = T(c.sign[2]) * *v[c.axis[2]];
  SadovCurve<T> k;
  const T g1 = x * x, g2 = y * y, g3 = z * z;
  k.G = sqrt(T(g1 + g2 + g3));
  const T D1 = g2 * T(c.d1[0]) + g3 * T(c.d1[1]);
  const T D3 = g1 * T(c.d3[0]) + g2 * T(c.d3[1]);
  const T D2 = lane_separatrix_distance(c, x, z);
  k.long_axis = D2 < zero;
  const T DA = select(k.long_axis, D3, D1), DC = select(k.long_axis, D1, D3);
  const T inverse = one / DA;
  k.k2 = of_mode<T>(k.long_axis, c.k2_per_DC) * DC * inverse;
  k.kp2 = of_mode<T>(k.long_axis, c.kp2_per_D2) * abs(D2) * inverse;
  k.r2 = of_mode<T>(k.long_axis, c.A_over_C) * DC * inverse;
  k.kap2 = of_mode<T>(k.long_axis, c.kap2);
  k.by_deficit = k.long_axis || k.r2 < one;
  const T x1 = select(k.long_axis, z, x), z1 = select(k.long_axis, x, z);
  k.negative1 = x1 < zero;
  k.negative3 = z1 < zero;
  k.m = {abs(x1), negated(k.long_axis != (k.negative1 != k.negative3), y), abs(z1)};
  k.small = k.k2 < T(0.01);
  k.usual = k.kp2 > T(least_complement) && k.r2 > T(1e-24) && k.r2 < T(1e12) && DC > zero &&
            of_mode<T>(k.long_axis, c.usual) > zero && k.G > T(0x1p-100) && k.G < T(0x1p100);
  return k;
}

// The momentum's length and the energy, to their last digits: elements hold the polhode by them.
template <class T>
struct LaneInvariants {
  T G, energy;
};
template <InstructionSet isa>
[[gnu::always_inline]] inline LaneInvariants<Pack<isa>> lane_invariants(
    const SadovConstants& c, const BasicVec3<Pack<isa>>& g) {
  using T = Pack<isa>;
  TwoTerms<T> G2{T(0.0), T(0.0)}, energy = G2;
  const T* const v[] = {&g.x, &g.y, &g.z};
  for (std::size_t j = 0; j < 3; ++j) {
    const DoubleDouble w = c.half_inverse[j];
    const TwoTerms<T> square = exact_product(*v[j], *v[j]);
    const TwoTerms<T> p = exact_product(square.hi, T(w.hi));
    const T rest = p.lo + (square.hi * T(w.lo) + square.lo * T(w.hi));
    const TwoTerms<T> sum = two_sum(G2.hi, square.hi), more = two_sum(energy.hi, p.hi);
    G2 = {sum.hi, G2.lo + (sum.lo + square.lo)};
    energy = {more.hi, energy.lo + (more.lo + rest)};
  }
  const T G = sqrt(G2.hi);
  const TwoTerms<T> again = exact_product(G, G);
  const T missing = ((G2.hi - again.hi) - again.lo) + G2.lo;
  return {G + missing * (T(0.5) / G), energy.hi + energy.lo};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
