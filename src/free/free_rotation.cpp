// SPDX-License-Identifier: MIT
// Preparation of FreeRotation: from a state to the kernel that evaluates it.
#include "polhode/free/free_rotation.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "free/detail/polhode_family.hpp"
#include "free/detail/sorted_state.hpp"
#include "free/prepare.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/detail/precession.hpp"
#include "polhode/free/detail/prepared_arc.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

// Below this ratio of moments squares of rates are beyond double-double.
constexpr double least_moment_ratio = 0x1p-900;

}  // namespace

void require_held_moments(const char* function, const Body& body) {
  const Vec3 I = sorted_doubles(body);
  if (I.x >= least_moment_ratio * I.z) return;
  throw DomainError(std::string(function) + ": moments " + tuple_text({I.x, I.y, I.z}) +
                    " must have a ratio of at least 2^-900, " + number_text(least_moment_ratio));
}

void require_preparable(const char* function, const Body& body, const RotorState& s, double t0) {
  const auto name = [&] { return std::string(function); };
  const Quaternion& q = s.q;
  const bool finite_q =
      std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
  if (!finite_q || q == Quaternion{0.0, 0.0, 0.0, 0.0})
    throw DomainError(name() + ": q " + tuple_text({q.w, q.x, q.y, q.z}) +
                      " is not a finite, non-zero quaternion");
  if (!std::isfinite(s.g.x) || !std::isfinite(s.g.y) || !std::isfinite(s.g.z))
    throw DomainError(name() + ": g " + tuple_text({s.g.x, s.g.y, s.g.z}) + " is not finite");
  if (!std::isfinite(t0))
    throw DomainError(name() + ": t0 = " + number_text(t0) + " is not finite");
  require_held_moments(function, body);
  const Vec3& I = body.moments();
  const Scale scale{exponent_of_largest(I), exponent_of_largest(s.g)};
  using Limits = std::numeric_limits<double>;
  // 2^rate is not a normal double
  if (scale.rate() < Limits::min_exponent - 1 || scale.rate() >= Limits::max_exponent)
    throw DomainError(name() + ": g " + tuple_text({s.g.x, s.g.y, s.g.z}) + " over moments " +
                      tuple_text({I.x, I.y, I.z}) + " is a rate too " +
                      (scale.rate() < 0 ? "small" : "large") + " for a double");
}

template FreeKernel prepared_kernel<double>(const Vec3&, const RotorState&, const double&);
template BasicFreeKernel<DoubleDouble> prepared_kernel<DoubleDouble>(
    const BasicVec3<DoubleDouble>&, const BasicRotorState<DoubleDouble>&, const DoubleDouble&);

}  // namespace detail

namespace {

using detail::NormalizedArc;
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

template <Real T>
FreeRotation::Summary FreeRotation::summarized(const Body& body, const NormalizedArc<T>& arc,
                                               const FreeKernel& k, const Vec3& g_B) {
  using std::abs;
  const detail::PolhodeCurve<T>& c = arc.curve;
  const bool has_polhode = !k.steady;
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
  s.modulus = to_double(elliptic::BasicModulus<T>::from_ratio(c.k2, c.kp2));
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
  detail::require_preparable("FreeRotation", body, s0, t0);
  const BasicVec3<T> moments = detail::converted<T>(body.moments());
  const BasicRotorState<T> s{detail::converted<T>(s0.q), detail::converted<T>(s0.g)};
  const NormalizedArc<T> arc = detail::normalized_arc(moments, s.g);
  Parts parts{detail::arc_kernel<double>(arc, moments, s, t0), {}};
  parts.summary = summarized(body, arc, parts.kernel, s0.g);
  return parts;
}

FreeRotation::FreeRotation(const Body& body, const RotorState& s0, double t0)
    : FreeRotation(body, s0, prepared<DoubleDouble>(body, s0, t0)) {}

FreeRotation FreeRotation::short_arc(const Body& body, const RotorState& s0, double t0) {
  return {body, s0, prepared<double>(body, s0, t0)};
}

}  // namespace v0
}  // namespace polhode
