// SPDX-License-Identifier: MIT
// Legendre's F, E, D and B by Carlson's integrals, and their quasi-periodicity.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include "polhode/detail/math/wide_range.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/detail/packs.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

namespace detail {

// D^2 = cos^2 + m1 sin^2; not 1 - m sin^2: cancels
template <class T>
T squared_delta(const T& s, const T& c, const BasicModulus<T>& mod) {
  return c * c + mod.m1() * (s * s);
}

// The integral from 0 to atan2(s, c), given that from 0 to atan2(s, |c|) and the complete one.
template <class T, class Complete>
T continued(const T& s, const T& c, const T& inside, const Complete& complete) {
  const auto beyond = [&]() -> T {
    const T whole = T(2.0) * complete();
    return select(s < T(0.0), T(-whole), whole) - inside;
  };
  return where(c < T(0.0), beyond, [&]() -> T { return inside; });
}
// The integral from 0 to turns pi + atan2(s, c), c >= 0, given that from 0 to atan2(s, c).
template <class T, class Complete>
T continued(const T& turns, const T& inside, const Complete& complete) {
  return where(
      turns == T(0.0), [&]() -> T { return inside; },
      [&]() -> T { return T(2.0) * turns * complete() + inside; });
}

// Whether all lanes of a pack go by the same forms, where no step overflows or underflows.
template <class Pack>
bool is_ordinary(const Pack& s, const Pack& c, const BasicModulus<Pack>& mod) {
  return all_before_separatrix(mod) && lanes_within(0x1p-250, 2.0, s, c) &&
         lanes_within(0x1p-900, 0x1p300, mod.m1());
}
// integral(s, |c|, mod), where no step overflows or underflows.
template <class T, class Integral>
T inside_of(const Integral& integral, const T& s, const T& c, const BasicModulus<T>& mod) {
  using std::abs;
  if constexpr (NarrowRange<T>) {
    if (!within(0x1p-250, 2.0, s, c) || !within(0x1p-900, 0x1p300, mod.m1())) {
      return Widening<T>::narrowed(integral(widened(s), widened(T(abs(c))), widened_modulus(mod)));
    }
  }
  return integral(s, T(abs(c)), mod);
}

// The modulus in DoubleDouble. Of two members that are rounded, the one below 1 counts.
inline BasicModulus<DoubleDouble> promoted(const BasicModulus<double>& mod) {
  const double m = mod.m(), m1 = mod.m1();
  const bool by_m1 = std::abs(m1) < std::abs(m) && std::abs(m1) < 1.0;
  return by_m1 ? BasicModulus<DoubleDouble>::from_any_pair(1.0 - DoubleDouble(m1), m1)
               : BasicModulus<DoubleDouble>::from_any_pair(m, 1.0 - DoubleDouble(m));
}

struct LegendreF {
  template <class T>
  T operator()(const T& s, const T& c, const BasicModulus<T>& mod) const {
    return s * carlson_rf(T(c * c), squared_delta(s, c, mod), T(1.0));
  }
  template <class T>
  static T complete(const BasicModulus<T>& mod) {
    return complete_k(mod);
  }
  // The numerator of the integrand, times x.
  template <class T>
  static T weighted(const T& x, const T& /*s*/, const T& /*c*/) {
    return x;
  }
};
struct LegendreD {
  template <class T>
  T operator()(const T& s, const T& c, const BasicModulus<T>& mod) const {
    return s * s * s * carlson_rd(T(c * c), squared_delta(s, c, mod), T(1.0)) / 3.0;
  }
  template <class T>
  static T complete(const BasicModulus<T>& mod) {
    return complete_d(mod);
  }
  template <class T>
  static T weighted(const T& x, const T& s, const T& /*c*/) {
    return x * (s * s);
  }
};
struct LegendreB {
  // (E - m1 F)/m by the forms of E below: positive terms for every m.
  template <class T>
  T operator()(const T& s, const T& c, const BasicModulus<T>& mod) const {
    using std::sqrt;
    const T zero(0.0), one(1.0);
    const T c2 = c * c;
    const T s2 = s * s;
    const T d2 = squared_delta(s, c, mod);
    if constexpr (Real<T>) {
      if (mod.m1() == zero && (derivative_order<T> == 0 || c == zero)) return s;
      if (mod.m1() < zero) {
        const T integrals = carlson_rf(c2, d2, one) + s2 * carlson_rd(d2, one, c2) / 3.0;
        return s * ((sqrt(d2) / c - mod.m1() * integrals) / mod.m());
      }
    }
    return s * (mod.m1() * s2 * carlson_rd(c2, one, d2) / 3.0 + c / sqrt(d2));
  }
  template <class T>
  static T complete(const BasicModulus<T>& mod) {
    return complete_b(mod);
  }
  template <class T>
  static T weighted(const T& x, const T& /*s*/, const T& c) {
    return x * (c * c);
  }
};
struct LegendreE {
  template <class T>
  T operator()(const T& s, const T& c, const BasicModulus<T>& mod) const {
    using std::sqrt;
    const T zero(0.0), one(1.0);
    const T c2 = c * c;
    const T d2 = squared_delta(s, c, mod);
    if constexpr (Real<T>) {
      if (mod.m1() == zero) return s;
      if (mod.m1() < zero) {  // [DLMF 19.25.11]
        return s * (sqrt(d2) / c - mod.m1() * (s * s) * carlson_rd(d2, one, c2) / 3.0);
      }
      if (mod.m() < zero) {  // [DLMF 19.25.9]
        return s * (carlson_rf(c2, d2, one) - mod.m() * (s * s) * carlson_rd(c2, d2, one) / 3.0);
      }
    }
    // [DLMF 19.25.10]; not RF - (m/3) s^2 RD(c^2, D^2, 1): cancels as m -> 1.
    const T rd = carlson_rd(c2, one, d2);
    const T integrals = carlson_rf(c2, d2, one) + mod.m() * (s * s) * rd / 3.0;
    return s * (mod.m1() * integrals + mod.m() * c / sqrt(d2));
  }
  template <class T>
  static T complete(const BasicModulus<T>& mod) {
    return complete_e(mod);
  }
};

// The amplitude of a Dual: (s, c) as constants, and its derivative apart. Carlson's integrals are
// differentiated at fixed (s, c): through c^2 it would be inf * 0 at c = 0.
template <class T>
struct FixedAmplitude {
  T s;
  T c;
  T shift;  // value 0, derivative dphi = c ds - s dc
};
template <class T, int N>
FixedAmplitude<Dual<T, N>> fixed_amplitude(const Dual<T, N>& s, const Dual<T, N>& c) {
  return {s.value, c.value, Dual<T, N>::chained(T(0.0), c.value, s, -s.value, c)};
}

// The integral to phi = atan2(s, c). Of Duals, F, D and B alone.
template <class Integral, class T>
T legendre_at(const Integral& integral, const T& s, const T& c, const BasicModulus<T>& mod) {
  using std::sqrt;
  const auto complete = [&] { return Integral::complete(mod); };
  if constexpr (!Real<T>) {
    const auto alone = [&](const auto&... x) { return legendre_at(integral, x...); };
    if (!is_ordinary(s, c, mod)) return each_lane_of(alone, mod, s, c);
  }
  if constexpr (derivative_order<T> > 0) {
    const auto a = fixed_amplitude(s, c);
    return continued(s, c, inside_of(integral, a.s, a.c, mod), complete) +
           Integral::weighted(a.shift, a.s, a.c) / sqrt(squared_delta(a.s, a.c, mod));
  } else {
    return continued(s, c, inside_of(integral, s, c, mod), complete);
  }
}

// integral(phi, mod) of an angle: of a double with m > 1 in DoubleDouble.
template <class T, class Integral, class Complete>
T legendre_of_angle(const T& phi, const BasicModulus<T>& mod, const Integral& integral,
                    const Complete& complete) {
  if constexpr (std::same_as<T, double>) {
    if (mod.m1() < 0.0) {
      const auto wider = promoted(mod);
      return to_double(legendre_of_angle(DoubleDouble(phi), wider, integral, complete));
    }
  }
  if constexpr (!Real<T>) {
    const auto alone = [&](const auto& angle, const auto& at) {
      return legendre_of_angle(angle, at, integral, complete);
    };
    if (!all_before_separatrix(mod)) return each_lane_of(alone, mod, phi);
  }
  const HalfTurns<T> h = half_turns(phi);
  return continued(h.turns, integral(h.s, h.c, mod), [&] { return complete(mod); });
}

}  // namespace detail

template <Number T>
T legendre_f(const T& s, const T& c, const BasicModulus<T>& mod) {
  return detail::legendre_at(detail::LegendreF{}, s, c, mod);
}
template <Number T>
T legendre_d(const T& s, const T& c, const BasicModulus<T>& mod) {
  return detail::legendre_at(detail::LegendreD{}, s, c, mod);
}
template <Number T>
T legendre_b(const T& s, const T& c, const BasicModulus<T>& mod) {
  return detail::legendre_at(detail::LegendreB{}, s, c, mod);
}
template <Number T>
T legendre_e(const T& s, const T& c, const BasicModulus<T>& mod) {
  using std::sqrt;
  if constexpr (derivative_order<T> > 0) {
    // dE/dm = -D/2: through the sum above the slope of a short arc would cancel.
    const auto base = values(mod);
    const auto delta = sqrt(detail::squared_delta(s.value, c.value, base));
    const auto by_m = -0.5 * legendre_d(s.value, c.value, base);
    const auto shift = detail::fixed_amplitude(s, c).shift;
    return T::chained(legendre_e(s.value, c.value, base), delta, shift, by_m, mod.m());
  } else {
    return detail::legendre_at(detail::LegendreE{}, s, c, mod);
  }
}

// The same of any angle phi.
template <Number T>
T legendre_f(const T& phi, const BasicModulus<T>& mod) {
  return detail::legendre_of_angle(
      phi, mod, [](const auto& s, const auto& c, const auto& at) { return legendre_f(s, c, at); },
      [](const auto& at) { return complete_k(at); });
}
template <Number T>
T legendre_e(const T& phi, const BasicModulus<T>& mod) {
  return detail::legendre_of_angle(
      phi, mod, [](const auto& s, const auto& c, const auto& at) { return legendre_e(s, c, at); },
      [](const auto& at) { return complete_e(at); });
}
template <Number T>
T legendre_d(const T& phi, const BasicModulus<T>& mod) {
  return detail::legendre_of_angle(
      phi, mod, [](const auto& s, const auto& c, const auto& at) { return legendre_d(s, c, at); },
      [](const auto& at) { return complete_d(at); });
}
template <Number T>
T legendre_b(const T& phi, const BasicModulus<T>& mod) {
  return detail::legendre_of_angle(
      phi, mod, [](const auto& s, const auto& c, const auto& at) { return legendre_b(s, c, at); },
      [](const auto& at) { return complete_b(at); });
}

// Compiled once, in the library.
extern template double legendre_f<double>(const double&, const double&,
                                          const BasicModulus<double>&);
extern template double legendre_f<double>(const double&, const BasicModulus<double>&);
extern template double legendre_e<double>(const double&, const double&,
                                          const BasicModulus<double>&);
extern template double legendre_e<double>(const double&, const BasicModulus<double>&);
extern template double legendre_d<double>(const double&, const double&,
                                          const BasicModulus<double>&);
extern template double legendre_d<double>(const double&, const BasicModulus<double>&);
extern template double legendre_b<double>(const double&, const double&,
                                          const BasicModulus<double>&);
extern template double legendre_b<double>(const double&, const BasicModulus<double>&);
extern template DoubleDouble legendre_f<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_f<DoubleDouble>(const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_e<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_e<DoubleDouble>(const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_d<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_d<DoubleDouble>(const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_b<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);
extern template DoubleDouble legendre_b<DoubleDouble>(const DoubleDouble&,
                                                      const BasicModulus<DoubleDouble>&);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
