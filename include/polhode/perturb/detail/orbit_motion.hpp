// SPDX-License-Identifier: MIT
// Position and velocity on an orbit.
#pragma once

#include <concepts>

#include "polhode/orbit/any_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
struct OrbitMotion {
  BasicVec3<T> x;
  BasicVec3<T> v;
};

template <class O, Real T>
OrbitMotion<T> motion_at(const O& orbit, const T& t, const T& rest) {
  if constexpr (!std::same_as<O, AnyOrbit> || std::same_as<T, double>) {
    const BasicVec3<Dual<T, 1>> d = orbit.position(Dual<T, 1>::variable(t, 0));
    return {position_at(orbit, t, rest), {d.x.derivative[0], d.y.derivative[0], d.z.derivative[0]}};
  } else {  // its velocity is that of double
    const double rounded = to_double(t);
    const BasicVec3<Dual<double, 1>> d = orbit.position(Dual<double, 1>::variable(rounded, 0));
    return {position_at(orbit, t, rest),
            {T(d.x.derivative[0]), T(d.y.derivative[0]), T(d.z.derivative[0])}};
  }
}
// No variable moves the time of a state transition.
template <class O, Real T, int N>
OrbitMotion<Dual<T, N>> motion_at(const O& orbit, const Dual<T, N>& t, const Dual<T, N>& rest) {
  const OrbitMotion<T> m = motion_at(orbit, t.value, rest.value);
  return {{m.x.x, m.x.y, m.x.z}, {m.v.x, m.v.y, m.v.z}};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
