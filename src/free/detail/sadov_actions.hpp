// SPDX-License-Identifier: MIT
// What Sadov's variables and their generating function share: the polhode of an action, units, and
// the conditions on actions.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <string>
#include <type_traits>

#include "free/detail/polhode_family.hpp"
#include "free/detail/sorted_state.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/detail/prepared_kernel.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/math/dual.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <class T>
T narrowed(const DoubleDouble& x) {
  if constexpr (std::same_as<T, double>)
    return x.hi;
  else
    return x;
}

// v of the member with this action deficit, by Newton's steps in DoubleDouble from a root in
// double: a tenth of the evaluations that bisection takes. Next to the ends, where the action
// hardly depends on v, and where the steps do not settle, by bisection.
inline DoubleDouble family_root_of_deficit(const DoubleDouble& kap2, const DoubleDouble& target) {
  const DoubleDouble highest = family_end(kap2);
  const auto excess = [&](const auto& v) {
    using T = std::remove_cvref_t<decltype(v)>;
    const T k = narrowed<T>(kap2);
    using std::log;
    return T(log(T(action_deficit(k, family_member(k, v)) / narrowed<T>(target))));
  };
  const double seed = family_root(excess, family_start<double>(), highest.hi);
  if (std::abs(seed) < 50.0) {
    DoubleDouble v = seed;
    for (int i = 0; i < 6; ++i) {  // 2 in practice
      const FamilyMember<DoubleDouble> f = family_member(kap2, v);
      if (!(f.kp2 > DoubleDouble(1e-10))) break;
      const DoubleDouble deficit = action_deficit(kap2, f);
      const DoubleDouble slope = action_deficit_slope(kap2, f) * f.r2 * f.kp2 / deficit;
      const DoubleDouble step = log(deficit / target) / slope;
      v -= step;
      if (std::abs(step.hi) < 1e-17) return v;  // the next would be its square
    }
  }
  return family_root(excess, family_start<DoubleDouble>(), highest);
}

// The polhode with this action: a root in DoubleDouble, then one Newton step in T, which carries
// the derivatives when T is dual.
template <Real T>
FamilyMember<T> member_with_deficit(const BasicVec3<DoubleDouble>& sorted, bool long_axis,
                                    const T& deficit) {
  const DoubleDouble kap2 = kappa_squared(primed_moments(sorted, long_axis));
  const DoubleDouble target = value_of(deficit);
  if (!(target > DoubleDouble(0.0))) return {deficit, T(1.0)};
  const DoubleDouble v = family_root_of_deficit(kap2, target);
  const FamilyMember<DoubleDouble> f = family_member(kap2, v);
  const DoubleDouble slope = action_deficit_slope(kap2, f);
  const T step = (deficit - T(target)) / T(slope);
  return {T(f.r2) + step, T(f.kp2) - T(kap2) * step};
}

// The variables of a motion in units in which all momenta are 2^exponent times smaller.
inline SadovState in_units(SadovState s, int exponent) {
  for (double* action : {&s.I_l, &s.I_g, &s.I_h}) *action = std::ldexp(*action, -exponent);
  return s;
}
inline int unit_exponent(const SadovState& s) { return momentum_exponent({s.I_g, 0.0, 0.0}); }

// At rest, as for a sphere, there is no polhode and the variables are Andoyer's.
inline bool is_andoyer(const Body& body, const SadovState& s) {
  return is_sphere(body) || s.I_g == 0.0;
}

inline void require_actions(const Body& body, const SadovState& s) {
  const double slack = 1.0 + 8.0 * epsilon<double>();
  const double I[3] = {s.I_l, s.I_g, s.I_h};
  if (s.lobe != 1 && s.lobe != -1)
    throw DomainError("SadovState: lobe " + std::to_string(s.lobe) + " must be 1 or -1");
  if (!std::all_of(I, I + 3, [](double x) { return std::isfinite(x); }) || !(s.I_g >= 0.0) ||
      std::abs(s.I_h) > s.I_g * slack || std::abs(s.I_l) > s.I_g * slack)
    throw DomainError("SadovState: actions (" + number_text(s.I_l) + ", " + number_text(s.I_g) +
                      ", " + number_text(s.I_h) + ") need I_g >= 0, |I_l| <= I_g, |I_h| <= I_g");
  if (is_andoyer(body, s)) return;
  require_held_moments("SadovState", body);
  const BasicVec3<DoubleDouble> sorted = sorted_moments(body);
  const bool long_axis = s.region == SadovRegion::long_axis;
  const PrimedMoments<DoubleDouble> primed = primed_moments(sorted, long_axis);
  if (!mode_exists(primed))
    throw DomainError(std::string("SadovState: a body with equal ") +
                      (long_axis ? "lesser" : "greater") + " moments has no " +
                      (long_axis ? "long" : "short") + "-axis mode");
  const double kappa = std::sqrt(kappa_squared(primed).hi);
  const double border = std::atan2(1.0, kappa) / (0.5 * pi<double>());  // 1 - (2/pi) arctan(kappa)
  const double deficit = long_axis ? s.I_l / s.I_g : (s.I_g - std::abs(s.I_l)) / s.I_g;
  if (!(deficit >= -8.0 * epsilon<double>() && deficit <= border + 8.0 * epsilon<double>()))
    throw DomainError("SadovState: I_l / I_g = " + number_text(s.I_l / s.I_g) + " is not in the " +
                      (long_axis ? "long-axis region [0, " + number_text(border)
                                 : "short-axis region [" + number_text(1.0 - border) + ", 1") +
                      "] of this body");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
