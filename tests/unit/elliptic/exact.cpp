// SPDX-License-Identifier: MIT
#include "unit/elliptic/exact.hpp"

#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/ellint_d.hpp>
#include <boost/math/special_functions/ellint_rc.hpp>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "worst.hpp"

namespace polhode::test {
namespace {

namespace mp = boost::multiprecision;
using Number = mp::number<mp::cpp_bin_float<60>, mp::et_off>;
using Wide = mp::number<mp::cpp_bin_float<350>, mp::et_off>;

template <class R>
R number(DoubleDouble x) {
  return R(x.hi) + R(x.lo);
}

template <class R>
Exact parts(const R& x) {
  const double a = static_cast<double>(x);
  if (!std::isfinite(a)) return {a, 0.0, 0.0};
  const double b = static_cast<double>(R(x - a));
  return {a, b, static_cast<double>(R(x - a - b))};
}

// The derivative of f at x: a central difference with a step of 1e-20 of the scale.
template <class R, class Function>
Exact slope(const R& x, const R& scale, const Function& f) {
  const R h = abs(scale) * R(1e-20);
  return parts<R>((f(x + h) - f(x - h)) / (2 * h));
}

// m, exactly, and m1.
template <class R>
struct Pair {
  R m;
  R m1;
};
template <class R>
Pair<R> pair(const ExactModulus& mod) {
  const R m = number<R>(mod.m());
  const R m1 = number<R>(mod.m1());
  return m < m1 ? Pair<R>{m, 1 - m} : Pair<R>{1 - m1, m1};
}

// Differences step by 1e-20 of the smaller member.
bool needs_width(const ExactModulus& mod, Along along) {
  const double least = smaller(to_double(mod.m()), to_double(mod.m1()));
  return least < (along == Along::none ? 1e-20 : 1e-2);
}

template <class R>
Exact complete(Complete kind, const ExactModulus& mod, Along along) {
  namespace bm = boost::math;
  const Pair<R> p = pair<R>(mod);
  const auto f = [&](const R& m) -> R {
    const R k = sqrt(m);
    switch (kind) {
      case Complete::k:
        return bm::ellint_1(k);
      case Complete::e:
        return bm::ellint_2(k);
      case Complete::d:
        return bm::ellint_d(k);
      case Complete::b:
        return bm::ellint_1(k) - bm::ellint_d(k);
    }
    return R(0);
  };
  if (along == Along::none) return parts<R>(f(p.m));
  return slope<R>(p.m, smaller(p.m, p.m1), f);
}

template <class R>
R legendre(Legendre kind, const R& phi, const R& n, const R& k) {
  namespace bm = boost::math;
  switch (kind) {
    case Legendre::f:
      return bm::ellint_1(k, phi);
    case Legendre::e:
      return bm::ellint_2(k, phi);
    case Legendre::d:
      return bm::ellint_d(k, phi);
    case Legendre::pi:
      return bm::ellint_3(k, n, phi);
  }
  return R(0);
}

template <class R>
Exact legendre(Legendre kind, DoubleDouble s, DoubleDouble c, DoubleDouble n,
               const ExactModulus& mod, Along along) {
  const Pair<R> p = pair<R>(mod);
  const R phi = atan2(number<R>(s), number<R>(c));
  const R nu = number<R>(n);
  switch (along) {
    case Along::amplitude:
      return slope<R>(phi, phi, [&](const R& x) { return legendre<R>(kind, x, nu, sqrt(p.m)); });
    case Along::characteristic:
      return slope<R>(nu, nu, [&](const R& x) { return legendre<R>(kind, phi, x, sqrt(p.m)); });
    case Along::modulus:
      return slope<R>(p.m, smaller(p.m, p.m1),
                      [&](const R& x) { return legendre<R>(kind, phi, nu, sqrt(x)); });
    default:
      return parts<R>(legendre<R>(kind, phi, nu, sqrt(p.m)));
  }
}

template <class R>
ExactJacobi jacobi(DoubleDouble u0, const ExactModulus& mod, Along along) {
  struct Triple {
    R sn, cn, dn;
  };
  const Pair<R> p = pair<R>(mod);
  const R u = number<R>(u0);
  const auto at = [](const R& x, const R& k) {
    Triple t;
    t.sn = boost::math::jacobi_elliptic(k, x, &t.cn, &t.dn);
    return t;
  };
  if (along == Along::none) {
    const Triple t = at(u, sqrt(p.m));
    return {parts<R>(t.sn), parts<R>(t.cn), parts<R>(t.dn)};
  }
  const bool by_u = along == Along::argument;
  const R h = R(1e-20) * (by_u ? R(abs(u)) : smaller(p.m, p.m1));
  const Triple plus = by_u ? at(u + h, sqrt(p.m)) : at(u, sqrt(p.m + h));
  const Triple minus = by_u ? at(u - h, sqrt(p.m)) : at(u, sqrt(p.m - h));
  const R d = 2 * h;
  return {parts<R>((plus.sn - minus.sn) / d), parts<R>((plus.cn - minus.cn) / d),
          parts<R>((plus.dn - minus.dn) / d)};
}

template <class R>
R nome(const R& m, const R& m1) {
  using boost::math::ellint_1;
  return exp(-boost::math::constants::pi<R>() * ellint_1(R(sqrt(m1))) / ellint_1(R(sqrt(m))));
}

template <class R>
Exact nome(const ExactModulus& mod, Along along) {
  const Pair<R> p = pair<R>(mod);
  if (along == Along::none) return parts<R>(nome<R>(p.m, p.m1));
  const R h = R(1e-20) * smaller(p.m, p.m1);
  return parts<R>((nome<R>(p.m + h, p.m1 - h) - nome<R>(p.m - h, p.m1 + h)) / (2 * h));
}

// The definition, by E, F and K.
template <class R>
Exact heuman_lambda0(DoubleDouble psi, const ExactModulus& mod) {
  namespace bm = boost::math;
  const Pair<R> p = pair<R>(mod);
  const R k = sqrt(p.m);
  const R k1 = sqrt(p.m1);
  const R x = number<R>(psi);
  const R f = bm::ellint_1(k1, x);
  const R rest = -p.m1 * bm::ellint_d(k1, x);  // E(psi|m1) - F(psi|m1)
  return parts<R>(R(2 * (bm::ellint_2(k) * f + bm::ellint_1(k) * rest) / bm::constants::pi<R>()));
}

template <class Function>
Exact by_argument(By by, std::array<Number, 4> x, const Function& f) {
  if (by == By::none) return parts<Number>(f(x));
  const std::size_t i = static_cast<std::size_t>(by) - 1;
  return slope<Number>(x[i], x[i], [&](const Number& value) {
    auto moved = x;
    moved[i] = value;
    return f(moved);
  });
}

}  // namespace

double absolute_error(DoubleDouble computed, const Exact& exact) {
  if (!std::isfinite(exact.a) && computed.hi == exact.a) return 0.0;
  const double error = ((computed - DoubleDouble(exact.a, exact.b)) - exact.c).hi;
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : std::abs(error);
}

double relative_error(DoubleDouble computed, const Exact& exact) {
  const double error = absolute_error(computed, exact);
  return error == 0.0 ? 0.0 : error / std::abs(exact.a);
}

Exact exact_rf(DoubleDouble x, DoubleDouble y, DoubleDouble z, By by) {
  return by_argument(by, {number<Number>(x), number<Number>(y), number<Number>(z), 0},
                     [](const auto& a) { return boost::math::ellint_rf(a[0], a[1], a[2]); });
}
Exact exact_rc(DoubleDouble x, DoubleDouble y, By by) {
  return by_argument(by, {number<Number>(x), number<Number>(y), 0, 0},
                     [](const auto& a) { return boost::math::ellint_rc(a[0], a[1]); });
}
Exact exact_rd(DoubleDouble x, DoubleDouble y, DoubleDouble z, By by) {
  return by_argument(by, {number<Number>(x), number<Number>(y), number<Number>(z), 0},
                     [](const auto& a) { return boost::math::ellint_rd(a[0], a[1], a[2]); });
}
Exact exact_rj(DoubleDouble x, DoubleDouble y, DoubleDouble z, DoubleDouble p, By by) {
  return by_argument(by,
                     {number<Number>(x), number<Number>(y), number<Number>(z), number<Number>(p)},
                     [](const auto& a) { return boost::math::ellint_rj(a[0], a[1], a[2], a[3]); });
}

Exact exact_complete(Complete kind, const ExactModulus& mod, Along along) {
  return needs_width(mod, along) ? complete<Wide>(kind, mod, along)
                                 : complete<Number>(kind, mod, along);
}

Exact exact_complete_pi(DoubleDouble n, const ExactModulus& mod, Along along) {
  const Pair<Number> p = pair<Number>(mod);
  const Number nu = number<Number>(n);
  switch (along) {
    case Along::modulus:
      return slope<Number>(p.m, smaller(p.m, p.m1), [&](const Number& m) {
        return boost::math::ellint_3(Number(sqrt(m)), nu);
      });
    case Along::characteristic:
      return slope<Number>(
          nu, nu, [&](const Number& x) { return boost::math::ellint_3(Number(sqrt(p.m)), x); });
    default:
      return parts<Number>(boost::math::ellint_3(Number(sqrt(p.m)), nu));
  }
}

Exact exact_cel(DoubleDouble kc, DoubleDouble p, DoubleDouble a, DoubleDouble b) {
  // With t = tan: integral over [0, inf) of (a + b t^2)/((1 + p t^2) sqrt((1 + t^2)(1 + kc^2
  // t^2))), and t = exp(x): smooth and exponentially small at both ends.
  const Number k = number<Number>(kc), q = number<Number>(p), u = number<Number>(a),
               v = number<Number>(b);
  Number sum = 0;
  const Number h = Number(1) / 10;
  const Number reach = 120 - log(k);
  for (Number x = -reach; x <= reach; x += h) {
    const Number t = exp(x);
    const Number t2 = t * t;
    sum += t * (u + v * t2) / ((1 + q * t2) * sqrt((1 + t2) * (1 + k * k * t2)));
  }
  return parts<Number>(sum * h);
}

Exact exact_legendre(Legendre kind, DoubleDouble s, DoubleDouble c, DoubleDouble n,
                     const ExactModulus& mod, Along along) {
  return needs_width(mod, along) ? legendre<Wide>(kind, s, c, n, mod, along)
                                 : legendre<Number>(kind, s, c, n, mod, along);
}

ExactJacobi exact_jacobi(DoubleDouble u, const ExactModulus& mod, Along along) {
  return needs_width(mod, along) ? jacobi<Wide>(u, mod, along) : jacobi<Number>(u, mod, along);
}

Exact exact_nome(const ExactModulus& mod, Along along) {
  return needs_width(mod, along) ? nome<Wide>(mod, along) : nome<Number>(mod, along);
}

Exact exact_heuman_lambda0(DoubleDouble psi, const ExactModulus& mod) {
  return needs_width(mod, Along::none) ? heuman_lambda0<Wide>(psi, mod)
                                       : heuman_lambda0<Number>(psi, mod);
}

}  // namespace polhode::test
