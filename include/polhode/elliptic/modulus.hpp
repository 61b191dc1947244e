// SPDX-License-Identifier: MIT
// Modulus: the parameter m = k^2 of elliptic integrals and functions, together with m1 = 1 - m.
//
// Equations   m + m1 = 1, both in [0, 1] but for from_any_pair. Everything that is delicate near
//             the separatrix hangs on m1, so no function of polhode takes m alone.
// Domain      from_ratio(a, b): a, b >= 0, not both 0, a + b finite. m = 1 (m1 = 0) is ordinary.
//             In DoubleDouble a member is 0 or above 1e-230: below, its low part has no room.
//             from_any_pair: any finite m: m < 0 is an imaginary modulus, m > 1 (m1 < 0) a modulus
//             k > 1. The functions of Legendre, Jacobi and the nome say what they return there.
// Accuracy    m and m1 each to one rounding of the quotient, however small.
// Errors      DomainError from the factories: a negative, non-finite or empty ratio; a pair that
//             does not add up to 1.
// Cost        one addition and two divisions.
#pragma once

#include <cmath>
#include <cstddef>

#include "polhode/elliptic/detail/modulus_errors.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

using polhode::to_double;

template <Number T>
class BasicModulus {
 public:
  // m = a / (a + b), m1 = b / (a + b).
  static BasicModulus from_ratio(const T& a, const T& b) {
    const T sum = a + b;
    if constexpr (Real<T>) {
      const double total = to_double(sum);
      if (!(a >= T(0.0) && b >= T(0.0) && total > 0.0) || std::isinf(total)) {
        detail::throw_bad_ratio(to_double(a), to_double(b));
      }
    } else {
      each_lane([](const auto& x, const auto& y) { return ScalarModulus::from_ratio(x, y).m(); }, a,
                b);
    }
    return {a / sum, b / sum};
  }

  // A pair known already, each member to its own full relative accuracy.
  static BasicModulus from_pair(const T& m, const T& m1) {
    if constexpr (Real<T>) {
      const double defect = to_double(m + m1 - T(1.0));
      if (!(m >= T(0.0) && m1 >= T(0.0) && std::abs(defect) <= 8.0 * epsilon<T>())) {
        detail::throw_bad_modulus_pair(to_double(m), to_double(m1));
      }
    } else {
      each_lane([](const auto& x, const auto& y) { return ScalarModulus::from_pair(x, y).m(); }, m,
                m1);
    }
    return {m, m1};
  }
  // The same for any m, below 0 and above 1 too.
  static BasicModulus from_any_pair(const T& m, const T& m1) {
    if constexpr (Real<T>) {
      const double defect = to_double(m + m1 - T(1.0));
      if (!(std::abs(defect) <= 8.0 * epsilon<T>() * (1.0 + std::abs(to_double(m))))) {
        detail::throw_bad_any_pair(to_double(m), to_double(m1));
      }
    } else {
      each_lane([](const auto& x, const auto& y) { return ScalarModulus::from_any_pair(x, y).m(); },
                m, m1);
    }
    return {m, m1};
  }

  const T& m() const { return m_; }
  const T& m1() const { return m1_; }
  // That of one lane of a pack.
  BasicModulus<ScalarOf<T>> lane(std::size_t i) const {
    return BasicModulus<ScalarOf<T>>::from_any_pair(LaneTraits<T>::get(m_, i),
                                                    LaneTraits<T>::get(m1_, i));
  }
  // The modulus with m and m1 exchanged: that of K', E', q1.
  BasicModulus complement() const { return {m1_, m_}; }

 private:
  using ScalarModulus = BasicModulus<ScalarOf<T>>;
  BasicModulus(const T& m, const T& m1) : m_(m), m1_(m1) {}
  T m_;
  T m1_;
};
using Modulus = BasicModulus<double>;

// Each member rounded to double: for decisions and reports.
template <Real T>
Modulus to_double(const BasicModulus<T>& mod) {
  return Modulus::from_any_pair(to_double(mod.m()), to_double(mod.m1()));
}

// The modulus of a Dual without its derivatives.
template <Real T, int N>
BasicModulus<T> values(const BasicModulus<Dual<T, N>>& mod) {
  return BasicModulus<T>::from_any_pair(mod.m().value, mod.m1().value);
}

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
