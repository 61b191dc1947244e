// SPDX-License-Identifier: MIT
// The angles of the mean frame in each lane of a pack.
#pragma once

#include "free/detail/sadov/curve.hpp"
#include "polhode/math/pack_functions.hpp"
#include "polhode/math/quaternion.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A complex number: a direction in a plane, times a positive scale that is of no interest.
template <class T>
struct LanePhasor {
  T re, im;

  [[gnu::always_inline]] friend LanePhasor operator*(const LanePhasor& a, const LanePhasor& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  [[gnu::always_inline]] friend LanePhasor operator+(const LanePhasor& a, const LanePhasor& b) {
    return {a.re + b.re, a.im + b.im};
  }
  [[gnu::always_inline]] friend LanePhasor operator-(const LanePhasor& a, const LanePhasor& b) {
    return {a.re - b.re, a.im - b.im};
  }
  [[gnu::always_inline]] friend LanePhasor operator*(const T& s, const LanePhasor& a) {
    return {s * a.re, s * a.im};
  }
  [[gnu::always_inline]] friend LanePhasor conj(const LanePhasor& a) { return {a.re, -a.im}; }
  [[gnu::always_inline]] friend LanePhasor select(const typename T::Mask& mask, const LanePhasor& a,
                                                  const LanePhasor& b) {
    return {select(mask, a.re, b.re), select(mask, a.im, b.im)};
  }
};

// A quaternion as a + b i with a = w + z k, b = x + y k: turns about axis 3 are factors of a and b.
template <class T>
struct LanePhasorPair {
  LanePhasor<T> a, b;
};

// Times the inverse of the half turn that makes the momentum along axes 1 and 3 positive.
template <class T>
[[gnu::always_inline]] inline LanePhasorPair<T> with_positive_axes(const SadovCurve<T>& k,
                                                                   const BasicQuaternion<T>& q) {
  using P = LanePhasor<T>;
  const P a{q.w, q.z}, b{q.x, q.y}, ia{a.im, -a.re}, ib{b.im, -b.re};  // times -i
  const auto both = k.negative1 && k.negative3;
  const auto chosen = [&](const P& none, const P& x, const P& y, const P& z) {
    return select(both, y, select(k.negative1, z, select(k.negative3, x, none)));
  };
  return {chosen(a, b, ib, ia), chosen(b, {-a.re, -a.im}, ia, {-ib.re, -ib.im})};
}

// e^(i mean angle) but for that of theta, of an attitude of the body axes; not of length one.
template <class T>
[[gnu::always_inline]] inline LanePhasor<T> frame_phasor(const SadovConstants& c,
                                                         const SadovCurve<T>& k,
                                                         const BasicQuaternion<T>& attitude) {
  using P = LanePhasor<T>;
  const auto constant = [&](std::size_t j) {
    return select(k.long_axis, T(c.to_axes[1][j]), T(c.to_axes[0][j]));
  };
  const LanePhasorPair<T> s = with_positive_axes(
      k, attitude * BasicQuaternion<T>{constant(0), constant(1), constant(2), constant(3)});
  const T above = k.G + k.m.z;
  const P along = above * s.a + s.b * P{k.m.y, k.m.x};
  const P across = above * s.b - s.a * P{k.m.y, -k.m.x};
  return along * conj(across);
}

// H, with the rounding of the result alone near +-G: there G - |H| comes from the node.
template <class T>
[[gnu::always_inline]] inline T third_momentum(const T& G, const T& along, const T& node2) {
  const T size = G - node2 / (G + abs(along));
  return select(abs(along) < T(0.5) * G, along, negated(signbit(along), size));
}

// Within (-pi, pi] of an angle within three of it.
template <class T>
[[gnu::always_inline]] inline T wrapped_angle(const T& angle) {
  const T turn(6.283185307179586), pi(3.141592653589793);
  const T r = angle - select(angle > pi, turn, T(0.0));
  return r + select(r <= -pi, turn, T(0.0));
}

// An angle of less than 2^20 turns, in two parts, less whole turns: pairs of them where the half of
// it is to keep its sign.
template <int together, InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> whole_turns_off(const TwoTerms<Pack<isa>>& angle) {
  using T = Pack<isa>;
  // a turn in three parts; the first two have 33 bits
  const T part1(0x1.921fb544p+2), part2(0x1.0b4611a6p-32), part3(0x1.3198a2e037073p-67);
  const T k = T(together) * rint(T(angle.hi * T(0.15915494309189535 / together)));
  return ((angle.hi - k * part1) - k * part2) + (angle.lo - k * part3);
}
inline constexpr double most_radians = 1e6;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
