// SPDX-License-Identifier: MIT
// What angles of packs are made of.
#pragma once

#include "polhode/detail/math/pack.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A product with what its rounding leaves over, the same by either way.
template <InstructionSet isa>
[[gnu::always_inline]] inline TwoTerms<Pack<isa>> exact_product(const Pack<isa>& a,
                                                                const Pack<isa>& b) {
  if constexpr (isa == InstructionSet::baseline)
    return two_prod(a, b);
  else
    return two_prod_fma(a, b);
}

// The angle of n / d in [0, 1] counted from that of 0, 1/2 or 1, whichever is nearest: its tangent
// u + more, and the angle counted from, as two parts.
template <class T>
struct NearAngle {
  T u, more;
  T from_hi, from_lo;
};

template <InstructionSet isa>
[[gnu::always_inline]] inline NearAngle<Pack<isa>> near_angle(const Pack<isa>& n,
                                                              const Pack<isa>& d) {
  using T = Pack<isa>;
  const T zero(0.0);
  const auto low = n<T(0.25) * d, high = n> T(0.71875) * d;
  const T c = select(low, zero, select(high, T(1.0), T(0.5)));
  // (n/d - c) / (1 + c n/d); the difference is exact
  const T difference = n - c * d;
  const TwoTerms<T> sum = quick_two_sum(d, T(c * n));
  const T inverse = T(1.0) / sum.hi;
  const T u = difference * inverse;
  const TwoTerms<T> p = exact_product(u, sum.hi);
  const T left_over = ((difference - p.hi) - p.lo) - u * sum.lo;
  // angles to 45 bits, of which sums are exact, and the rest
  return {u, left_over * inverse,
          select(low, zero, select(high, T(0x1.921fb54442d00p-1), T(0x1.dac670561bc00p-2))),
          select(low, zero, select(high, T(0x1.8469898cc5170p-49), T(-0x1.612ea406ee84dp-47)))};
}

// (arctan(u) - u) / u of z = u^2.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> atan_sum(const Pack<isa>& z) {
  using T = Pack<isa>;
  // minimax for |u| <= 1/4, to 1.2e-19; in pairs, for a short chain of operations
  const T z2 = z * z, z4 = z2 * z2;
  return z * (((T(-0.33333333333333326) + z * T(0.199999999999936561)) +
               z2 * (T(-0.142857142840788332) + z * T(0.111111109175474641))) +
              z4 * (((T(-0.0909089656709043991) + z * T(0.0769182725982938987)) +
                     z2 * (T(-0.0665540620312428445) + z * T(0.0572302031553740577))) +
                    z4 * T(-0.0399066613478556839)));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
