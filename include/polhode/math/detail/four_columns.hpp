// SPDX-License-Identifier: MIT
// Four packs as rows of four numbers, one a lane, and back: what rows of structures are made of.
#pragma once

#include <array>
#include <cstring>

#include "polhode/detail/math/pack.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

using FourDoubles = double __attribute__((vector_size(32)));

template <class V>
[[gnu::always_inline]] inline V vector_at(const double* from) {
  V v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

// Lane i of four packs, side by side, for every i.
template <InstructionSet isa>
struct FourColumns {
  using P = Pack<isa>;
  using V = typename P::Doubles;
  using Rows = std::array<FourDoubles, P::width>;

  [[gnu::always_inline]] static Rows rows(const P& a, const P& b, const P& c, const P& d) {
    if constexpr (P::width == 8) {
      const V ab0 = __builtin_shufflevector(a.lanes, b.lanes, 0, 8, 2, 10, 4, 12, 6, 14);
      const V ab1 = __builtin_shufflevector(a.lanes, b.lanes, 1, 9, 3, 11, 5, 13, 7, 15);
      const V cd0 = __builtin_shufflevector(c.lanes, d.lanes, 0, 8, 2, 10, 4, 12, 6, 14);
      const V cd1 = __builtin_shufflevector(c.lanes, d.lanes, 1, 9, 3, 11, 5, 13, 7, 15);
      const V r02 = __builtin_shufflevector(ab0, cd0, 0, 1, 8, 9, 2, 3, 10, 11);
      const V r46 = __builtin_shufflevector(ab0, cd0, 4, 5, 12, 13, 6, 7, 14, 15);
      const V r13 = __builtin_shufflevector(ab1, cd1, 0, 1, 8, 9, 2, 3, 10, 11);
      const V r57 = __builtin_shufflevector(ab1, cd1, 4, 5, 12, 13, 6, 7, 14, 15);
      return {low(r02), low(r13), high(r02), high(r13), low(r46), low(r57), high(r46), high(r57)};
    } else if constexpr (P::width == 4) {
      const V ab0 = __builtin_shufflevector(a.lanes, b.lanes, 0, 4, 2, 6);
      const V ab1 = __builtin_shufflevector(a.lanes, b.lanes, 1, 5, 3, 7);
      const V cd0 = __builtin_shufflevector(c.lanes, d.lanes, 0, 4, 2, 6);
      const V cd1 = __builtin_shufflevector(c.lanes, d.lanes, 1, 5, 3, 7);
      return {__builtin_shufflevector(ab0, cd0, 0, 1, 4, 5),
              __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5),
              __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7),
              __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7)};
    } else {
      return {FourDoubles{a.lanes[0], b.lanes[0], c.lanes[0], d.lanes[0]},
              FourDoubles{a.lanes[1], b.lanes[1], c.lanes[1], d.lanes[1]}};
    }
  }

  [[gnu::always_inline]] static std::array<P, 4> columns(const Rows& r) {
    if constexpr (P::width == 8) {
      const V r04 = joined(r[0], r[4]), r15 = joined(r[1], r[5]);
      const V r26 = joined(r[2], r[6]), r37 = joined(r[3], r[7]);
      const V ac0 = __builtin_shufflevector(r04, r15, 0, 8, 2, 10, 4, 12, 6, 14);
      const V bd0 = __builtin_shufflevector(r04, r15, 1, 9, 3, 11, 5, 13, 7, 15);
      const V ac2 = __builtin_shufflevector(r26, r37, 0, 8, 2, 10, 4, 12, 6, 14);
      const V bd2 = __builtin_shufflevector(r26, r37, 1, 9, 3, 11, 5, 13, 7, 15);
      return {P(__builtin_shufflevector(ac0, ac2, 0, 1, 8, 9, 4, 5, 12, 13)),
              P(__builtin_shufflevector(bd0, bd2, 0, 1, 8, 9, 4, 5, 12, 13)),
              P(__builtin_shufflevector(ac0, ac2, 2, 3, 10, 11, 6, 7, 14, 15)),
              P(__builtin_shufflevector(bd0, bd2, 2, 3, 10, 11, 6, 7, 14, 15))};
    } else if constexpr (P::width == 4) {
      const V ac0 = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6);
      const V bd0 = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
      const V ac2 = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6);
      const V bd2 = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
      return {P(__builtin_shufflevector(ac0, ac2, 0, 1, 4, 5)),
              P(__builtin_shufflevector(bd0, bd2, 0, 1, 4, 5)),
              P(__builtin_shufflevector(ac0, ac2, 2, 3, 6, 7)),
              P(__builtin_shufflevector(bd0, bd2, 2, 3, 6, 7))};
    } else {
      return {P(V{r[0][0], r[1][0]}), P(V{r[0][1], r[1][1]}), P(V{r[0][2], r[1][2]}),
              P(V{r[0][3], r[1][3]})};
    }
  }

 private:
  [[gnu::always_inline]] static FourDoubles low(const V& v) {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3);
  }
  [[gnu::always_inline]] static FourDoubles high(const V& v) {
    return __builtin_shufflevector(v, v, 4, 5, 6, 7);
  }
  [[gnu::always_inline]] static V joined(const FourDoubles& a, const FourDoubles& b) {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
