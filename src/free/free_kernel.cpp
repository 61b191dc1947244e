// SPDX-License-Identifier: MIT
// Evaluation of a FreeKernel: reduce two phases in double-double, sum a short series, turn.
#include "polhode/free/free_kernel.hpp"

#include <cmath>

#include "free/detail/evaluated_without_fma.hpp"
#include "free/detail/reduced_sincos.hpp"
#include "polhode/math/error_free.hpp"
#include "polhode/math/trigonometry.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// The two ways to an exact product; both give the same bits.
struct DekkerProduct {
  static TwoTerms<double> of(double a, double b) {
    if (!(std::abs(b) > 0x1p990)) return two_prod(a, b);
    const TwoTerms<double> p = two_prod(a, 0x1p-60 * b);  // the halves of b overflow at 2^996
    return {0x1p60 * p.hi, 0x1p60 * p.lo};
  }
};
struct FmaProduct {
  [[gnu::always_inline]] static TwoTerms<double> of(double a, double b) {
    return two_prod_fma(a, b);
  }
};

// rate * elapsed + start, and the same less a whole number of periods. Unlike DoubleDouble's
// operators this carries one low part through the whole chain; what that loses is 2^-104 of the
// phase.
template <class Product>
[[gnu::always_inline]] inline TwoTerms<double> phase_at(const DoubleDouble& rate,
                                                        const TwoTerms<double>& elapsed,
                                                        const DoubleDouble& start) {
  const TwoTerms<double> p = Product::of(rate.hi, elapsed.hi);
  const TwoTerms<double> s = two_sum(p.hi, start.hi);
  const double lo = p.lo + (rate.hi * elapsed.lo + rate.lo * elapsed.hi);
  return {s.hi, s.lo + (lo + start.lo)};
}

template <class Product>
[[gnu::always_inline]] inline TwoTerms<double> less_periods(const TwoTerms<double>& phase,
                                                            const DoubleDouble& period,
                                                            double count) {
  const TwoTerms<double> c = Product::of(count, period.hi);
  const double hi = phase.hi - c.hi;  // exact: within a factor of two, or count = 0
  return quick_two_sum(hi, phase.lo - (c.lo + count * period.lo));
}

// The phase less its whole periods, and how many of them: first + more, not added up, since the sum
// may need more than 53 bits. Beyond 2^52 periods the rounded count itself is off, so what it
// leaves is reduced once more.
struct Remainder {
  TwoTerms<double> phase;
  double first, more;
};

template <class Product>
[[gnu::always_inline]] inline Remainder reduced(const TwoTerms<double>& phase,
                                                const DoubleDouble& period, double inverse) {
  const double periods = std::rint(phase.hi * inverse);
  const TwoTerms<double> r = less_periods<Product>(phase, period, periods);
  if (!(std::abs(r.hi * inverse) > 0.75)) return {r, periods, 0.0};
  const double more = std::rint(r.hi * inverse);
  return {less_periods<Product>(r, period, more), periods, more};
}

// A phase beyond 2^90 has no digit left: any point of the orbit is as good, so 0 is taken; t - t is
// NaN when t is infinite or NaN.
constexpr double phase_limit = 0x1p90;
[[gnu::always_inline]] inline TwoTerms<double> bounded(const TwoTerms<double>& phase, double t) {
  if (std::abs(phase.hi) < phase_limit) return phase;
  return {t - t, 0.0};
}

template <class Product>
[[gnu::always_inline]] inline SinCos<double> sincos_of_turn(const TwoTerms<double>& turn) {
  constexpr double inverse_two_pi = 0.15915494309189535;
  return detail::reduced_sincos(
      reduced<Product>(turn, DoubleDouble::two_pi(), inverse_two_pi).phase);
}

template <class Product>
[[gnu::always_inline]] inline RotorState state_at(const FreeKernel& k, double t) {
  const TwoTerms<double> difference = two_sum(t, -k.epoch);
  const TwoTerms<double> elapsed{k.time_scale * difference.hi, k.time_scale * difference.lo};
  TwoTerms<double> turn = bounded(phase_at<Product>(k.half_precession, elapsed, {}), t);
  if (k.form == FreeKernel::Form::steady) {
    const SinCos<double> c = sincos_of_turn<Product>(turn);
    return {k.left * Quaternion{c.cos, c.sin * k.axis.x, c.sin * k.axis.y, c.sin * k.axis.z}, k.g0};
  }
  const auto [phase, first, more] =
      reduced<Product>(bounded(phase_at<Product>(k.phase_rate, elapsed, k.phase0), t),
                       k.phase_period, k.inverse_phase_period);
  Quaternion p;
  if (k.form == FreeKernel::Form::trigonometric) {
    const SinCos<double> x = detail::reduced_sincos(phase);
    p = trigonometric_sum(k.series, x.sin, x.cos);
  } else {
    const bool odd = std::fmod(std::abs(first), 2.0) != std::fmod(std::abs(more), 2.0);
    p = hyperbolic_sum(k.series, k.series.chi_per_u * phase.hi, odd);
    turn.lo += k.series.phase_per_u * phase.hi;
    turn = two_sum(turn.hi, turn.lo);
  }
  const double inverse_n2 = 1.0 / (p.w * p.w + p.x * p.x + p.y * p.y + p.z * p.z);
  const SinCos<double> c = sincos_of_turn<Product>(turn);
  const double f = std::sqrt(inverse_n2);
  const Quaternion spun{f * (c.cos * p.w - c.sin * p.z), f * (c.cos * p.x - c.sin * p.y),
                        f * (c.cos * p.y + c.sin * p.x), f * (c.cos * p.z + c.sin * p.w)};
  const Vec3 m = momentum_direction(p, inverse_n2);
  const double n1 = k.G * m.x, n2 = k.G * m.y, n3 = k.G * m.z;
  RotorState s{k.left * (spun * k.right), {}};
  s.g[k.primed_axis[0]] = k.primed_sign[0] * n1;
  s.g[k.primed_axis[1]] = k.primed_sign[1] * n2;
  s.g[k.primed_axis[2]] = k.primed_sign[2] * n3;
  return s;
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) RotorState state_at_fma(const FreeKernel& k, double t) {
  return state_at<FmaProduct>(k, t);
}
bool processor_has_fma() {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}
#endif

}  // namespace

RotorState evaluated(const FreeKernel& k, double t) noexcept {
#if defined(__x86_64__)
  if (processor_has_fma()) return state_at_fma(k, t);
#endif
  return state_at<DekkerProduct>(k, t);
}

namespace detail {

RotorState evaluated_without_fma(const FreeKernel& k, double t) noexcept {
  return state_at<DekkerProduct>(k, t);
}

}  // namespace detail

}  // namespace v0
}  // namespace polhode
