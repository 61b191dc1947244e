// SPDX-License-Identifier: MIT
// The loops of the arithmetic-geometric mean and of cel, and the complete integrals.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "polhode/detail/math/wide_range.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/detail/lockstep.hpp"
#include "polhode/elliptic/detail/packs.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

namespace detail {

// a and b whose product T can hold.
template <class T>
T agm_loop(T a, T b) {
  using std::sqrt;
  const T zero(0.0);
  Lockstep<T> trips;
  T result = zero;
  for (int i = 0; i < 64; ++i) {  // at most 12: |ln(a/b)| halves, then digits double
    const auto none = !(a > zero) || !(b > zero);  // 0, or NaN
    const T gap = a - b;
    const T mean = T(0.5) * (a + b);
    const T product = a * b;
    result = trips.kept(result, select(none, product, mean));
    // The next gap is gap^2 / (8 mean): below the last digit.
    trips.converge(gap * gap <= T(epsilon<T>()) * (mean * mean));
    trips.stop(none);
    if (trips.all_done()) return result;
    b = sqrt(product);
    a = mean;
  }
  return trips.kept(result, a);
}

// Bulirsch's loop; kc > 0 and p > 0, given by its root.
template <class T>
T cel_loop(T kc, T p, T a, T b) {
  using std::abs;
  using std::sqrt;
  const T tolerance = sqrt(T(epsilon<T>()));
  Lockstep<T> trips;
  T product = kc;
  T mean(1.0);
  b = b / p;
  for (int i = 0; i < 64; ++i) {  // at most 13
    const T ratio = product / p;
    const T next_a = a + b / p;
    b = trips.kept(b, T(2.0) * (a * ratio + b));
    a = trips.kept(a, next_a);
    p = trips.kept(p, ratio + p);
    const T last = mean;
    mean = trips.kept(mean, kc + mean);
    trips.converge(abs(last - kc) <= last * tolerance);
    if (trips.all_done()) break;
    kc = T(2.0) * sqrt(product);
    product = kc * mean;
  }
  return T(0.5) * pi<T>() * (b + a * mean) / (mean * (mean + p));
}

// kc small and b small next to a, with derivatives. The part of a has a small slope in kc, which
// the loop would find as a difference of slopes of order 1/kc: it has a closed rule instead,
// d cel(kc, p, 1, 0)/d kc = -kc (D - cel(kc, p, 1, 0))/(p - kc^2).
template <class T, int N>
Dual<T, N> cel_of_cosine(const Dual<T, N>& kc, const Dual<T, N>& p, const Dual<T, N>& a,
                         const Dual<T, N>& b) {
  using D = Dual<T, N>;
  const T k = kc.value;
  const D root = sqrt(p);
  const D by_p = cel_loop(D(k), root, D(1.0), D(0.0));
  const T d = cel_loop(k, T(1.0), T(0.0), T(1.0));
  const D by_kc = kc.chained(T(0.0), -k * (d - by_p.value) / (p.value - k * k));
  return a * (by_p + by_kc) + b * cel_loop(kc, root, D(0.0), D(1.0));
}

template <class T>
BasicModulus<typename Widening<T>::Wide> widened_modulus(const BasicModulus<T>& mod) {
  return BasicModulus<typename Widening<T>::Wide>::from_any_pair(widened(mod.m()),
                                                                 widened(mod.m1()));
}

// Whether Bulirsch's loop stays in the range of T.
template <class T>
bool cel_within(const T& kc, const T& p, const T& a, const T& b) {
  const double size = largest(std::abs(to_double(a)), std::abs(to_double(b)));
  return within(0x1p-540, 0x1p270, kc) && within(0x1p-270, 0x1p270, p, size);
}

}  // namespace detail

template <Number T>
T agm(T a, T b) {
  const T zero(0.0);
  if constexpr (Real<T>) {
    if (a < zero || b < zero) return T(std::numeric_limits<double>::quiet_NaN()) * (a * b);
  } else if (!lanes_within(0x1p-480, 0x1p480, a, b) || !all(a >= zero && b >= zero)) {
    return each_lane([](const auto& x, const auto& y) { return agm(x, y); }, a, b);
  }
  if constexpr (NarrowRange<T>) {
    if (!within(0x1p-480, 0x1p480, a, b)) {
      return Widening<T>::narrowed(detail::agm_loop(widened(a), widened(b)));
    }
  }
  return detail::agm_loop(a, b);
}

template <Number T>
T cel(T kc, T p, T a, T b) {
  using std::abs;
  using std::sqrt;
  const T zero(0.0);
  if constexpr (Real<T>) {
    if (kc == zero) return b == zero ? a * carlson_rc(T(1.0), p) : b / zero;
    if (!(p > zero && kc > zero)) return p * T(std::numeric_limits<double>::quiet_NaN());
  } else {
    const bool ordinary = all(kc > zero && p > zero) && lanes_within(0x1p-540, 0x1p270, kc) &&
                          lanes_within(0x1p-270, 0x1p270, p, detail::largest(T(abs(a)), T(abs(b))));
    if (!ordinary) return each_lane([](const auto&... x) { return cel(x...); }, kc, p, a, b);
  }
  if constexpr (NarrowRange<T>) {
    if (!detail::cel_within(kc, p, a, b)) {
      return Widening<T>::narrowed(cel(widened(kc), widened(p), widened(a), widened(b)));
    }
  }
  if constexpr (derivative_order<T> > 0) {
    if (4.0 * kc * kc < p && 8.0 * abs(b) < abs(a)) return detail::cel_of_cosine(kc, p, a, b);
  }
  return detail::cel_loop(kc, T(sqrt(p)), a, b);
}

template <Number T>
T complete_k(const BasicModulus<T>& mod) {
  using std::sqrt;
  return T(0.5) * pi<T>() / detail::agm_loop(T(1.0), T(sqrt(mod.m1())));
}
template <Number T>
T complete_e(const BasicModulus<T>& mod) {
  using std::sqrt;
  return cel(T(sqrt(mod.m1())), T(1.0), T(1.0), mod.m1());
}
template <Number T>
T complete_b(const BasicModulus<T>& mod) {
  using std::sqrt;
  return cel(T(sqrt(mod.m1())), T(1.0), T(1.0), T(0.0));
}
template <Number T>
T complete_d(const BasicModulus<T>& mod) {
  using std::sqrt;
  return cel(T(sqrt(mod.m1())), T(1.0), T(0.0), T(1.0));
}
template <Number T>
T complete_pi(const T& n, const BasicModulus<T>& mod) {
  using std::sqrt;
  const T one(1.0);
  if constexpr (Real<T>) {
    if (n == one) return T(std::numeric_limits<double>::infinity());
    if (n > one) {
      if constexpr (NarrowRange<T>) {
        // cel is 1/(p kc) there: out of range, though its product with m is not
        if (!within(0.0, 0x1p270, mod.m1()))
          return Widening<T>::narrowed(complete_pi(widened(n), detail::widened_modulus(mod)));
      }
      const T p = ((n - one) + mod.m1()) / n;  // 1 - m/n
      return -(mod.m() / n) * cel(T(sqrt(mod.m1())), p, T(0.0), one);
    }
  } else if (!all(n < one)) {
    return detail::each_lane_of([](const auto&... x) { return complete_pi(x...); }, mod, n);
  }
  return cel(T(sqrt(mod.m1())), T(one - n), one, one);
}

// Compiled once, in the library.
extern template double agm<double>(double, double);
extern template double cel<double>(double, double, double, double);
extern template double complete_k<double>(const BasicModulus<double>&);
extern template double complete_e<double>(const BasicModulus<double>&);
extern template double complete_b<double>(const BasicModulus<double>&);
extern template double complete_d<double>(const BasicModulus<double>&);
extern template double complete_pi<double>(const double&, const BasicModulus<double>&);
extern template DoubleDouble agm<DoubleDouble>(DoubleDouble, DoubleDouble);
extern template DoubleDouble cel<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble,
                                               DoubleDouble);
extern template DoubleDouble complete_k<DoubleDouble>(const BasicModulus<DoubleDouble>&);
extern template DoubleDouble complete_e<DoubleDouble>(const BasicModulus<DoubleDouble>&);
extern template DoubleDouble complete_b<DoubleDouble>(const BasicModulus<DoubleDouble>&);
extern template DoubleDouble complete_d<DoubleDouble>(const BasicModulus<DoubleDouble>&);
extern template DoubleDouble complete_pi<DoubleDouble>(const DoubleDouble&,
                                                       const BasicModulus<DoubleDouble>&);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
