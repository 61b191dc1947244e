// SPDX-License-Identifier: MIT
// Preparation of FreeRotation: from a state to the kernel that evaluates it.
#include "polhode/free/free_rotation.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "free/detail/assembly.hpp"
#include "free/detail/cayley_klein.hpp"
#include "free/detail/polhode_family.hpp"
#include "free/detail/precession.hpp"
#include "free/detail/primed_arc.hpp"
#include "free/detail/sorted_state.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::PrimedArc;
constexpr double infinity = std::numeric_limits<double>::infinity();

void require_valid(const RotorState& s, double t0) {
  const Quaternion& q = s.q;
  const bool finite_q =
      std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
  if (!finite_q || q == Quaternion{0.0, 0.0, 0.0, 0.0})
    throw DomainError("FreeRotation: q " + detail::tuple_text({q.w, q.x, q.y, q.z}) +
                      " is not a finite, non-zero quaternion");
  if (!std::isfinite(s.g.x) || !std::isfinite(s.g.y) || !std::isfinite(s.g.z))
    throw DomainError("FreeRotation: g " + detail::tuple_text({s.g.x, s.g.y, s.g.z}) +
                      " is not finite");
  if (!std::isfinite(t0))
    throw DomainError("FreeRotation: t0 = " + detail::number_text(t0) + " is not finite");
}

template <Real T>
BasicQuaternion<T> converted(const Quaternion& q) {
  return {T(q.w), T(q.x), T(q.y), T(q.z)};
}
template <Real T>
Quaternion rounded(const BasicQuaternion<T>& q) {
  return {to_double(q.w), to_double(q.x), to_double(q.y), to_double(q.z)};
}
DoubleDouble widened(double x) { return x; }
DoubleDouble widened(const DoubleDouble& x) { return x; }

template <Real T>
SeriesPolynomial<double> rounded(const SeriesPolynomial<T>& c) {
  SeriesPolynomial<double> d{};
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = to_double(c[i]);
  return d;
}

// The series in double, cut where the rest is below the rounding of double.
template <Real T>
CayleyKleinSeries<double> rounded(const CayleyKleinSeries<T>& s) {
  CayleyKleinSeries<double> d;
  d.hyperbolic = s.hyperbolic;
  d.terms = s.terms;
  d.A = rounded(s.A);
  d.B = rounded(s.B);
  d.C = rounded(s.C);
  d.D = rounded(s.D);
  d.nome = to_double(s.nome);
  d.chi_per_u = to_double(s.chi_per_u);
  d.phase_per_u = to_double(s.phase_per_u);
  const double least = 0x1p-58;
  const auto negligible = [&](std::size_t i) {
    return std::abs(d.A[i]) + std::abs(d.B[i]) < least * std::abs(d.A[0]) &&
           std::abs(d.C[i]) + std::abs(d.D[i]) <= least * (std::abs(d.C[0]) + std::abs(d.D[0]));
  };
  while (d.terms > 1 && negligible(static_cast<std::size_t>(d.terms - 1))) --d.terms;
  return d;
}

// omega constant: q(t) = q0 exp(omega (t - t0) / 2).
template <Real T>
FreeKernel steady_kernel(const Body& body, const RotorState& s0, const BasicQuaternion<T>& q0,
                         const PrimedArc<T>& arc) {
  FreeKernel k;
  k.form = FreeKernel::Form::steady;
  k.left = rounded(q0);
  k.g0 = s0.g;
  const BasicVec3<T> I = detail::converted<T>(detail::scaled(body.moments(), arc.scale.moment));
  const BasicVec3<T> w{arc.g.x / I.x, arc.g.y / I.y, arc.g.z / I.z};
  const T rate = norm(w);
  if (rate == T(0.0)) return k;
  k.axis = {to_double(w.x / rate), to_double(w.y / rate), to_double(w.z / rate)};
  k.half_precession = widened(T(0.5) * rate);
  return k;
}

template <Real T>
FreeKernel series_kernel(const BasicQuaternion<T>& q0, const PrimedArc<T>& arc) {
  FreeKernel k;
  const detail::PolhodeCurve<T>& c = arc.curve;
  const CayleyKleinSeries<T> series = detail::cayley_klein_series(c);
  if (series.hyperbolic) {
    k.form = FreeKernel::Form::hyperbolic;
    k.phase0 = widened(arc.u0);
    k.phase_rate = widened(c.n);
    if (!c.separatrix) k.phase_period = widened(T(T(2.0) * c.K));
  } else {
    k.form = FreeKernel::Form::trigonometric;
    k.phase0 = widened(T(T(0.5) * pi<T>() * arc.u0 / c.K));
    k.phase_rate = widened(detail::phase_rate(c));
    k.phase_period = DoubleDouble::two_pi();
  }
  if (k.phase_period.hi > 0.0) k.inverse_phase_period = 1.0 / k.phase_period.hi;
  const BasicQuaternion<T> p = detail::primed_attitude(c, series, arc.u0);
  const BasicQuaternion<T> right = detail::quaternion_of<T>(arc.primed);
  k.series = rounded(series);
  k.right = rounded(right);
  k.left = rounded(q0 * conj(right) * conj(normalized(p)));
  k.half_precession = widened(T(T(0.5) * detail::precession_of_axis1(c)));
  k.primed_axis = arc.primed.axis;
  k.primed_sign = arc.primed.sign;
  return k;
}

}  // namespace

template <Real T>
FreeRotation::Summary FreeRotation::summarized(const Body& body, const PrimedArc<T>& arc,
                                               const FreeKernel& k, const Vec3& g_B) {
  using std::abs;
  const detail::PolhodeCurve<T>& c = arc.curve;
  const bool has_polhode = k.form != FreeKernel::Form::steady;
  Summary s;
  s.regime = k.G == 0.0     ? Regime::rest
             : !has_polhode ? Regime::steady
             : c.separatrix ? Regime::separatrix
             : c.long_axis  ? Regime::long_axis
                            : Regime::short_axis;
  const Vec3 g = detail::scaled(g_B, arc.scale.momentum);
  const Vec3 I = detail::scaled(body.moments(), arc.scale.moment);
  DoubleDouble twice_energy = 0.0;
  for (int i = 0; i < 3; ++i) twice_energy += DoubleDouble::product(g[i], g[i]) / I[i];
  s.energy = std::ldexp(0.5 * twice_energy.hi, 2 * arc.scale.momentum - arc.scale.moment);
  s.D2 = std::ldexp(arc.D2.mantissa.hi, arc.D2.exponent + 2 * arc.scale.momentum);
  s.polhode_period = infinity;
  const auto user_rate = [&](double x) { return std::ldexp(x, arc.scale.rate()); };
  if (c.steady) {
    s.rate_long = s.rate_short = user_rate(2.0 * k.half_precession.hi);
    return s;
  }
  s.long_axis = c.long_axis;
  s.sign_g1 = static_cast<int>(c.long_axis ? arc.s3 : arc.s1);
  s.sign_g3 = static_cast<int>(c.long_axis ? arc.s1 : arc.s3);
  if (detail::is_across(c)) {
    s.action = k.G * to_double(detail::action_ratio_across(c));
    s.deficit = k.G - s.action;
  } else {
    const detail::FamilyMember<T> member{c.r2, c.kp2};
    s.deficit = k.G * to_double(detail::action_deficit(c.kap2, member));
    s.action =
        c.r2 < T(1.0) ? k.G - s.deficit : k.G * to_double(detail::action_ratio(c.kap2, member));
  }
  s.modulus = to_double(BasicModulus<T>::from_ratio(c.k2, c.kp2));
  if (!c.separatrix) {
    const T x_rate = abs(detail::phase_rate(c));
    s.polhode_period = std::ldexp(to_double(T(2.0) * pi<T>() / x_rate), -arc.scale.rate());
  }
  const double rate1 = user_rate(2.0 * k.half_precession.hi);
  const double rate3 = user_rate(to_double(detail::precession_of_axis3(c)));
  s.rate_long = c.long_axis ? rate3 : rate1;
  s.rate_short = c.long_axis ? rate1 : rate3;
  return s;
}

template <Real T>
FreeRotation::Parts FreeRotation::prepared(const Body& body, const RotorState& s0, double t0) {
  require_valid(s0, t0);
  detail::require_held_moments("FreeRotation", body);
  const PrimedArc<T> arc = detail::primed_arc<T>(body, s0.g);
  const BasicQuaternion<T> q0 = normalized(converted<T>(s0.q));
  const bool has_polhode = !arc.curve.steady && arc.curve.DC > T(0.0);
  FreeKernel k = has_polhode ? series_kernel(q0, arc) : steady_kernel(body, s0, q0, arc);
  k.epoch = t0;
  k.time_scale = std::ldexp(1.0, arc.scale.rate());
  k.G = std::ldexp(to_double(arc.curve.G), arc.scale.momentum);
  if (!std::isnormal(k.time_scale))
    throw DomainError("FreeRotation: g " + detail::tuple_text({s0.g.x, s0.g.y, s0.g.z}) +
                      " over moments " +
                      detail::tuple_text({body.moments().x, body.moments().y, body.moments().z}) +
                      " is a rate beyond double range");
  return {k, summarized(body, arc, k, s0.g)};
}

FreeRotation::FreeRotation(const Body& body, const RotorState& s0, double t0)
    : FreeRotation(body, s0, prepared<DoubleDouble>(body, s0, t0)) {}

FreeRotation FreeRotation::short_arc(const Body& body, const RotorState& s0, double t0) {
  return {body, s0, prepared<double>(body, s0, t0)};
}

}  // namespace v0
}  // namespace polhode
