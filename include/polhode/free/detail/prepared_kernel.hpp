// SPDX-License-Identifier: MIT
// What is checked before a kernel is prepared, and the number type that it is prepared in.
#pragma once

#include <cstddef>

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/free/detail/kernel_pack.hpp"
#include "polhode/free/detail/prepared_arc.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// DomainError from `function` unless the state is finite, its quaternion not zero, and the rate in
// range.
void require_preparable(const char* function, const Body& body, const RotorState& s0, double t0);
// DomainError where squares of the rates of such moments are beyond double-double.
void require_held_moments(const char* function, const Body& body);

// The number that preparation computes in: 32 digits for a result in double.
template <class T>
struct WorkingNumber {
  using type = T;
};
template <>
struct WorkingNumber<double> {
  using type = DoubleDouble;
};
template <Real S, int N>
struct WorkingNumber<Dual<S, N>> {
  using type = Dual<typename WorkingNumber<S>::type, N>;
};

inline DoubleDouble in_working_number(double x) { return x; }
inline DoubleDouble in_working_number(const DoubleDouble& x) { return x; }
template <Real S, int N>
auto in_working_number(const Dual<S, N>& x) {
  typename WorkingNumber<Dual<S, N>>::type r(in_working_number(x.value));
  for (std::size_t i = 0; i < x.derivative.size(); ++i)
    r.derivative[i] = in_working_number(x.derivative[i]);
  return r;
}
template <Number T>
auto in_working_number(const BasicVec3<T>& v) {
  using P = typename WorkingNumber<T>::type;
  return BasicVec3<P>{in_working_number(v.x), in_working_number(v.y), in_working_number(v.z)};
}
template <Number T>
auto in_working_number(const BasicRotorState<T>& s) {
  using P = typename WorkingNumber<T>::type;
  return BasicRotorState<P>{{in_working_number(s.q.w), in_working_number(s.q.x),
                             in_working_number(s.q.y), in_working_number(s.q.z)},
                            in_working_number(s.g)};
}

// Values are doubles, also in T = DoubleDouble.
template <Number T>
BasicFreeKernel<T> prepared_kernel(const BasicVec3<T>& moments, const BasicRotorState<T>& s0,
                                   const T& t0) {
  if constexpr (!Real<T>) {  // a pack
    BasicFreeKernel<T> k;
    for (std::size_t i = 0; i < LaneTraits<T>::count; ++i)
      LaneOfKernel<T>(k, i).write(
          prepared_kernel(lane(moments, i), lane(s0, i), LaneTraits<T>::get(t0, i)));
    return k;
  } else {
    const Vec3 I = values_of(moments);
    const RotorState s{values_of(s0.q), values_of(s0.g)};
    require_preparable("prepare", Body(I.x, I.y, I.z), s, to_double(t0));
    const auto wide_moments = in_working_number(moments);
    const auto wide_s0 = in_working_number(s0);
    return arc_kernel<T>(normalized_arc(wide_moments, wide_s0.g), wide_moments, wide_s0, t0);
  }
}

// Compiled once, in the library.
extern template FreeKernel prepared_kernel<double>(const Vec3&, const RotorState&, const double&);
extern template BasicFreeKernel<DoubleDouble> prepared_kernel<DoubleDouble>(
    const BasicVec3<DoubleDouble>&, const BasicRotorState<DoubleDouble>&, const DoubleDouble&);

}  // namespace detail

}  // namespace v0
}  // namespace polhode
