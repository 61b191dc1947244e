// SPDX-License-Identifier: MIT
// The generating function of Sadov's transformation and its quadratures.
#include <cmath>
#include <string>

#include "free/detail/mean_frame.hpp"
#include "free/detail/sadov_actions.hpp"
#include "free/detail/serret_elements.hpp"
#include "math/number_text.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/elliptic/legendre_pi.hpp"
#include "polhode/error.hpp"
#include "polhode/free/generating_function.hpp"

namespace polhode {
inline namespace v0 {
namespace free {
namespace {

using DD = DoubleDouble;

// The polhode of the actions at I_g = 1, and the sense of its primed axes.
struct ActionCurve {
  polhode::detail::PolhodeCurve<DD> curve;
  polhode::detail::PrimedSense sense;
};

ActionCurve action_curve(const Body& body, const SadovState& s) {
  const bool long_axis = s.region == SadovRegion::long_axis;
  const DD I_l = s.I_l, I_g = s.I_g;
  const DD deficit = (long_axis ? I_l : I_g - abs(I_l)) / I_g;
  const auto fail = [&](const char* need) {
    throw DomainError("sadov_generating_function: I_l = " + polhode::detail::number_text(s.I_l) +
                      " of I_g = " + polhode::detail::number_text(s.I_g) + " needs " + need);
  };
  if (!(deficit > DD(0.0)))
    fail(long_axis ? "I_l > 0: the spin about the long axis has no phi_l"
                   : "|I_l| < I_g: the spin about the short axis has no phi_l");
  const BasicVec3<DD> sorted = polhode::detail::sorted_moments(body);
  const polhode::detail::FamilyMember<DD> f =
      polhode::detail::member_with_deficit<DD>(sorted, long_axis, deficit);
  const double third = long_axis ? s.lobe : (s.I_l < 0.0 ? -1.0 : 1.0);
  const ActionCurve a{polhode::detail::family_curve(sorted, long_axis, DD(1.0), f),
                      {long_axis, 1.0, third}};
  if (a.curve.separatrix || !(a.curve.kp2.hi > 1e-20))
    fail("an action off the separatrix: the variables do not exist there");
  return a;
}

// The argument u, nearest to `near`, of the place on the polhode with Andoyer's angle l.
DD argument_of(const ActionCurve& a, double given, const DD& near) {
  const polhode::detail::PolhodeCurve<DD>& c = a.curve;
  const auto [sine, cosine] = sincos(DD(given));
  const BasicVec3<DD> k = polhode::detail::reordered(
      polhode::detail::primed_axes(a.sense.long_axis, a.sense.s1, a.sense.s3),
      BasicVec3<DD>{sine, cosine, DD(0.0)});
  const DD zero(0.0), one(1.0), half_period = DD(2.0) * c.K, period = DD(4.0) * c.K;
  const auto next = [&](const DD& u) { return u + period * std::rint(((near - u) / period).hi); };
  if (!a.sense.long_axis) {
    const DD u = polhode::detail::place_on(c, {abs(k.x), k.y, zero});
    if (!(k.x < zero)) return next(u);
    return next((k.y < zero ? -half_period : half_period) - u);
  }
  const DD q = k.y / k.z * (c.a3 / c.a2);  // sn/dn
  const DD left = one - c.kp2 * q * q;     // cn^2/dn^2
  if (!(k.z > zero) || left.hi < -16.0 * epsilon<double>()) {
    const double widest = std::atan2((c.a2 / c.a3).hi, std::sqrt(c.kp2.hi));
    throw DomainError("sadov_generating_function: l = " + polhode::detail::number_text(given) +
                      " must be within " + polhode::detail::number_text(widest) + " of " +
                      (a.sense.s3 < 0.0 ? "-" : "") + "pi/2, where it librates");
  }
  const DD dn2 = one / (one + c.k2 * q * q), cn2 = (left < zero ? zero : left) * dn2;
  const DD u = q * sqrt(dn2) * elliptic::carlson_rf(cn2, dn2, one);
  const DD forth = next(u), back = next(half_period - u);
  return abs(back - near) < abs(forth - near) ? back : forth;
}

}  // namespace

SadovGeneratingFunction sadov_generating_function(const Body& body, double l, double g, double h,
                                                  const SadovState& given) {
  polhode::detail::require_actions(body, given);
  for (const double x : {l, g, h, given.phi_l, given.phi_g, given.phi_h})
    if (!std::isfinite(x))
      throw DomainError(
          "sadov_generating_function: (l, g, h) = " + polhode::detail::tuple_text({l, g, h}) +
          " and the angles of the branch must be finite");
  const int e = polhode::detail::unit_exponent(given);
  const SadovState s = polhode::detail::in_units(given, e);
  const auto momentum = [&](const DD& x) { return std::ldexp(x.hi, e); };
  const DD phi_h = polhode::detail::turned_to(s.phi_h, h), I_l = s.I_l, I_g = s.I_g, I_h = s.I_h;
  if (polhode::detail::is_andoyer(body, s)) {
    const DD phi_l = polhode::detail::turned_to(s.phi_l, DD(l) - DD::pi() * DD(0.5)),
             phi_g = polhode::detail::turned_to(s.phi_g, g);
    const DD V = I_l * phi_l;
    return {momentum(V + I_g * phi_g + I_h * phi_h),
            momentum(V),
            given.I_l,
            given.I_g,
            given.I_h,
            phi_l.hi,
            phi_g.hi,
            phi_h.hi};
  }
  const ActionCurve a = action_curve(body, s);
  const polhode::detail::PolhodeCurve<DD>& c = a.curve;
  const bool along = a.sense.long_axis || s.I_l < 0.0;  // phi_l rises with u
  const DD x_per_u = DD(0.5) * DD::pi() / c.K, near = (along ? s.phi_l : -s.phi_l) / x_per_u;
  const DD u = argument_of(a, l, near), x = u * x_per_u;
  const polhode::detail::AxisOrder primed =
      polhode::detail::primed_axes(a.sense.long_axis, a.sense.s1, a.sense.s3);
  const BasicQuaternion<DD> p =
      normalized(polhode::detail::primed_attitude(c, polhode::detail::cayley_klein_series(c), u));
  const DD cosJ = polhode::detail::restored(primed, momentum_direction(p, DD(1.0))).z;
  // the mean frame where g = 0
  const DD half(0.5), one(1.0);
  const BasicQuaternion<DD> tilt{sqrt(half * (one + cosJ)), sqrt(half * (one - cosJ)), DD(0.0),
                                 DD(0.0)};
  const BasicQuaternion<DD> mean =
      tilt * rotation_z(DD(l)) * conj(polhode::detail::quaternion_of<DD>(primed)) * conj(p);
  const DD swing = polhode::detail::wrapped(DD(2.0) * atan2(mean.z, mean.w) -
                                            polhode::detail::node_offset<DD>(a.sense) +
                                            (a.sense.long_axis ? DD(0.0) : x));  // phi_g - g
  const DD phi_l = along ? x : -x, phi_g = polhode::detail::turned_to(s.phi_g, DD(g) + swing);
  const DD V = I_l * phi_l + I_g * swing;
  const DD W = I_l * phi_l + I_g * phi_g + I_h * phi_h;
  return {momentum(W), momentum(V), momentum(I_g * cosJ), given.I_g, given.I_h, phi_l.hi,
          phi_g.hi,    phi_h.hi};
}

SadovParameters sadov_parameters(const Body& body, double G, double T) {
  const Vec3 I = polhode::detail::sorted_doubles(body);
  const double excess = 2.0 * I.z * T - G * G, rest = G * G - 2.0 * I.x * T;
  if (!(I.x < I.y && I.y < I.z))
    throw DomainError("sadov_parameters: moments " + polhode::detail::tuple_text({I.x, I.y, I.z}) +
                      " must be three different ones: kappa is 0 or infinite");
  if (!(G > 0.0 && excess >= 0.0 && rest > 0.0 && std::isfinite(T)))
    throw DomainError("sadov_parameters: T = " + polhode::detail::number_text(T) + " of G = " +
                      polhode::detail::number_text(G) + " must be in [G^2/2I3, G^2/2I1) = [" +
                      polhode::detail::number_text(0.5 * G * (G / I.z)) + ", " +
                      polhode::detail::number_text(0.5 * G * (G / I.x)) + ")");
  const double kappa2 = I.z * (I.y - I.x) / (I.x * (I.z - I.y));
  return {std::sqrt(kappa2), std::sqrt(kappa2 * (I.x / I.z) * (excess / rest))};
}

SadovQuadratures sadov_quadratures(const SadovParameters& p, double I_g, double l) {
  const double kappa2 = p.kappa * p.kappa, lambda2 = p.lambda * p.lambda;
  if (!(p.kappa > 0.0 && p.lambda > 0.0 && p.lambda != 1.0 && std::isfinite(kappa2) &&
        std::isfinite(lambda2)))
    throw DomainError(
        "sadov_quadratures: (kappa, lambda) = " + polhode::detail::tuple_text({p.kappa, p.lambda}) +
        " must be positive, lambda not 1, where K is infinite");
  if (!(I_g > 0.0 && std::isfinite(I_g) && std::isfinite(l)))
    throw DomainError("sadov_quadratures: (I_g, l) = " + polhode::detail::tuple_text({I_g, l}) +
                      " must be finite, I_g positive");
  const double turn = 2.0 * pi<double>(), root = std::sqrt(1.0 + kappa2);
  const bool is_long = p.lambda > 1.0;
  // [SA "changeAction"]; around -b1 the sine and cosine of l both change sign
  const double lobe = is_long && std::sin(l) < 0.0 ? -1.0 : 1.0;
  double z = std::atan2(-lobe * std::cos(l) / root, lobe * std::sin(l));
  if (!is_long) z += turn * std::round((l - 0.5 * pi<double>() - z) / turn);
  const double k2 = is_long ? 1.0 / lambda2 : lambda2;
  const elliptic::Modulus mod =
      elliptic::Modulus::from_pair(k2, is_long ? (p.lambda - 1.0) * (p.lambda + 1.0) / lambda2
                                               : (1.0 - p.lambda) * (1.0 + p.lambda));
  const double scale = is_long ? 1.0 / p.lambda : 1.0, n = is_long ? kappa2 / lambda2 : kappa2;
  const double sine = p.lambda * std::sin(z);
  if (is_long && std::abs(sine) > 1.0)
    throw DomainError("sadov_quadratures: l = " + polhode::detail::number_text(l) +
                      " must have |lambda sin z| <= 1, where it librates; |lambda sin z| = " +
                      polhode::detail::number_text(std::abs(sine)));
  const double amplitude = is_long ? std::asin(sine) : z;
  const double K = scale * elliptic::complete_k(mod), Pi = scale * elliptic::complete_pi(-n, mod);
  const double F = scale * elliptic::legendre_f(amplitude, mod);
  const double Pi_z = scale * elliptic::legendre_pi(amplitude, -n, mod);
  const double both = kappa2 + lambda2, size = std::sqrt(both), kl = p.kappa * p.lambda;
  const double action = 2.0 * root / (pi<double>() * p.kappa * size) * (both * Pi - lambda2 * K);
  const double slope = -2.0 * kl * root / (pi<double>() * both * size) * K;  // of I_l / I_g
  SadovQuadratures q{};
  q.z = z;
  q.I_l = I_g * action;
  q.dI_l_dlambda = I_g * slope;
  q.dlambda_dI_l = 1.0 / (I_g * slope);
  q.dlambda_dI_g = -action / (I_g * slope);
  q.L_dl = I_g / p.kappa * root / size * (both * Pi_z - lambda2 * F);
  q.dL_dlambda_dl = -I_g * kl * root / (both * size) * F;
  q.phi_l = q.dlambda_dI_l * q.dL_dlambda_dl;
  q.phi_g_minus_g = q.L_dl / I_g + q.dlambda_dI_g * q.dL_dlambda_dl;
  return q;
}

}  // namespace free
}  // namespace v0
}  // namespace polhode
