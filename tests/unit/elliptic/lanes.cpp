// SPDX-License-Identifier: MIT
// Elliptic kernels of a pack: loops run until the last lane has converged, and every lane has the
// bits that its arguments have alone.
#include "lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>

#include "oracle/random_draw.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/elliptic/legendre_pi.hpp"
#include "polhode/math/double_double.hpp"

namespace {

using namespace polhode;
constexpr std::size_t lanes = 5;
constexpr int packs = 2000;

// Doubles of all sizes, zeros, and now and then a negative number or NaN.
double drawn(oracle::Draw& draw) {
  const double kind = draw.uniform(0.0, 1.0);
  if (kind < 0.6) return draw.uniform(0.0, 2.0);
  if (kind < 0.85) return draw.power_of_ten(-25.0, 25.0);
  if (kind < 0.95) return draw.power_of_ten(-307.0, 307.0);
  if (kind < 0.98) return 0.0;
  return kind < 0.99 ? -draw.uniform(0.0, 2.0) : std::numeric_limits<double>::quiet_NaN();
}
// Ordinary in most packs, so that these go in lockstep.
double drawn(oracle::Draw& draw, bool ordinary) {
  return ordinary ? draw.power_of_ten(-20.0, 3.0) : drawn(draw);
}

template <class T>
using Pack = test::Lanes<T, lanes>;

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(std::isnan(x) ? std::numeric_limits<double>::quiet_NaN() : x);
}
void expect_equal(double a, double b) { EXPECT_EQ(bits(a), bits(b)) << a << " " << b; }
void expect_equal(const DoubleDouble& a, const DoubleDouble& b) {
  expect_equal(a.hi, b.hi);
  if (std::isfinite(a.hi)) expect_equal(a.lo, b.lo);
}

// The number with digits of its own behind those of a double.
template <class T>
T with_digits(oracle::Draw& draw, double x) {
  if constexpr (std::is_same_v<T, DoubleDouble>) {
    const double low = std::abs(x) > 1e-250 ? x * draw.uniform(-0.5, 0.5) * 0x1p-53 : 0.0;
    return DoubleDouble(x) + low;
  } else {
    return x;
  }
}

template <class T>
class EllipticLanes : public testing::Test {};
using Types = testing::Types<double, DoubleDouble>;
TYPED_TEST_SUITE(EllipticLanes, Types);

// f of packs against f of their lanes.
template <class T, std::size_t arguments, class F>
void expect_lanes(const F& f) {
  oracle::Draw draw(61, arguments);
  for (int k = 0; k < packs; ++k) {
    const bool ordinary = k % 4 != 0;
    std::array<Pack<T>, arguments> x;
    for (Pack<T>& pack : x)
      for (T& lane : pack.lane) lane = with_digits<T>(draw, drawn(draw, ordinary));
    const Pack<T> got = std::apply([&](const auto&... a) { return f(a...); }, x);
    for (std::size_t i = 0; i < lanes; ++i) {
      const T alone = std::apply([&](const auto&... a) { return f(a.lane[i]...); }, x);
      expect_equal(got.lane[i], alone);
    }
    if (testing::Test::HasFailure()) return;
  }
}

TYPED_TEST(EllipticLanes, Agm) {
  expect_lanes<TypeParam, 2>([](const auto& a, const auto& b) { return elliptic::agm(a, b); });
}
TYPED_TEST(EllipticLanes, Cel) {
  expect_lanes<TypeParam, 4>([](const auto& kc, const auto& p, const auto& a, const auto& b) {
    return elliptic::cel(kc, p, a, b);
  });
}
TYPED_TEST(EllipticLanes, CarlsonRf) {
  expect_lanes<TypeParam, 3>(
      [](const auto& x, const auto& y, const auto& z) { return elliptic::carlson_rf(x, y, z); });
}
TYPED_TEST(EllipticLanes, CarlsonRd) {
  expect_lanes<TypeParam, 3>(
      [](const auto& x, const auto& y, const auto& z) { return elliptic::carlson_rd(x, y, z); });
}

TYPED_TEST(EllipticLanes, CarlsonRc) {
  expect_lanes<TypeParam, 2>(
      [](const auto& x, const auto& y) { return elliptic::carlson_rc(x, y); });
  // arguments next to each other, by the series and by both logarithms
  expect_lanes<TypeParam, 2>([](const auto& x, const auto& y) {
    using std::abs;
    return elliptic::carlson_rc(abs(x), abs(x) * (1.0 + 0.001 * (y - 10.0)));
  });
}
TYPED_TEST(EllipticLanes, CarlsonRj) {
  expect_lanes<TypeParam, 4>([](const auto& x, const auto& y, const auto& z, const auto& p) {
    return elliptic::carlson_rj(x, y, z, p);
  });
  // p not far above the others
  expect_lanes<TypeParam, 4>([](const auto& x, const auto& y, const auto& z, const auto& p) {
    return elliptic::carlson_rj(x, y, z, (x + y + z) * (p / (1.0 + p)));
  });
}

template <class T>
elliptic::BasicModulus<Pack<T>> pack_of(const std::array<std::array<double, 2>, lanes>& ratio) {
  Pack<T> a, b;
  for (std::size_t i = 0; i < lanes; ++i) {
    a.lane[i] = T(ratio[i][0]);
    b.lane[i] = T(ratio[i][1]);
  }
  return elliptic::BasicModulus<Pack<T>>::from_ratio(a, b);
}

// Lanes of moduli with angles, sines and cosines or arguments, and characteristics.
template <class T>
struct Arguments {
  Pack<T> m, m1, s, c, u, n;

  elliptic::BasicModulus<Pack<T>> modulus() const {
    return elliptic::BasicModulus<Pack<T>>::from_any_pair(m, m1);
  }
};
// Ordinary: 0 <= m < 1, n < 1. Otherwise any m and n, multiples of the quarter turn, 0 and NaN.
template <class T>
Arguments<T> drawn_arguments(oracle::Draw& draw, bool ordinary) {
  Arguments<T> a;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double lowest = ordinary ? -200.0 : -300.0;
    const double small = !ordinary && draw.chance(0.2) ? 0.0 : draw.power_of_ten(lowest, 0.0);
    const bool near_one = draw.chance(0.5);
    T m = near_one ? T(1.0) / (T(1.0) + small) : T(small) / (T(1.0) + small);
    T m1 = near_one ? T(small) / (T(1.0) + small) : T(1.0) / (T(1.0) + small);
    if (!ordinary && draw.chance(0.2)) {
      m = T(draw.sign() * draw.power_of_ten(-3.0, 3.0));
      m1 = T(1.0) - m;
    }
    double u = draw.sign() * draw.power_of_ten(-20.0, 3.0);
    double n = draw.chance(0.5) ? draw.uniform(-3.0, 1.0) : -draw.power_of_ten(-10.0, 10.0);
    if (!ordinary) {
      if (draw.chance(0.1)) u = 0.0;
      if (draw.chance(0.1)) u = 1.5707963267948966 * std::floor(draw.uniform(-9.0, 9.0));
      if (draw.chance(0.05)) u = std::numeric_limits<double>::quiet_NaN();
      if (draw.chance(0.3)) n = draw.chance(0.2) ? 1.0 : draw.power_of_ten(-3.0, 3.0);
    }
    a.m.lane[i] = m;
    a.m1.lane[i] = m1;
    a.u.lane[i] = with_digits<T>(draw, u);
    const auto [s, c] = sincos(a.u.lane[i]);
    a.s.lane[i] = s;
    a.c.lane[i] = c;
    a.n.lane[i] = with_digits<T>(draw, n);
  }
  return a;
}

// An argument, its sine and cosine, a characteristic and a modulus.
template <class T, class M>
struct Asked {
  T u, s, c, n;
  M mod;
};
template <class T, class M>
Asked(T, T, T, T, M) -> Asked<T, M>;

// f of packs against that of their lanes.
template <class T, class F>
void expect_lanes_of_moduli(const F& f) {
  oracle::Draw draw(63, 0);
  for (int k = 0; k < packs; ++k) {
    const Arguments<T> a = drawn_arguments<T>(draw, k % 4 != 0);
    const elliptic::BasicModulus<Pack<T>> mod = a.modulus();
    const Pack<T> got = f(Asked{a.u, a.s, a.c, a.n, mod});
    for (std::size_t i = 0; i < lanes; ++i) {
      SCOPED_TRACE(testing::Message() << "pack " << k << ", lane " << i);
      const Asked one{a.u.lane[i], a.s.lane[i], a.c.lane[i], a.n.lane[i], mod.lane(i)};
      expect_equal(got.lane[i], f(one));
    }
    if (testing::Test::HasFailure()) return;
  }
}

TYPED_TEST(EllipticLanes, LegendreOfSineAndCosine) {
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::legendre_f(a.s, a.c, a.mod); });
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::legendre_e(a.s, a.c, a.mod); });
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::legendre_d(a.s, a.c, a.mod); });
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::legendre_b(a.s, a.c, a.mod); });
}
TYPED_TEST(EllipticLanes, LegendreOfAngle) {
  expect_lanes_of_moduli<TypeParam>([](const auto& a) { return elliptic::legendre_f(a.u, a.mod); });
  expect_lanes_of_moduli<TypeParam>([](const auto& a) { return elliptic::legendre_e(a.u, a.mod); });
  expect_lanes_of_moduli<TypeParam>([](const auto& a) { return elliptic::legendre_d(a.u, a.mod); });
  expect_lanes_of_moduli<TypeParam>([](const auto& a) { return elliptic::legendre_b(a.u, a.mod); });
}
TYPED_TEST(EllipticLanes, LegendrePi) {
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::legendre_pi(a.s, a.c, a.n, a.mod); });
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::legendre_pi(a.u, a.n, a.mod); });
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::complete_pi(a.n, a.mod); });
}
TYPED_TEST(EllipticLanes, Amplitude) {
  expect_lanes_of_moduli<TypeParam>([](const auto& a) { return elliptic::amplitude(a.u, a.mod); });
}
TYPED_TEST(EllipticLanes, Nome) {
  expect_lanes_of_moduli<TypeParam>([](const auto& a) { return elliptic::nome(a.mod); });
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::complementary_nome(a.mod); });
}
TYPED_TEST(EllipticLanes, HeumanAndZeta) {
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::heuman_lambda0(a.s, a.c, a.mod); });
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::heuman_lambda0(a.u, a.mod); });
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::jacobi_zeta(a.s, a.c, a.mod); });
  expect_lanes_of_moduli<TypeParam>(
      [](const auto& a) { return elliptic::jacobi_zeta(a.u, a.mod); });
}

// Moduli 0 and 1 and next to both, arguments up to many periods, 0 and NaN.
TYPED_TEST(EllipticLanes, JacobiAndCompleteIntegrals) {
  using T = TypeParam;
  oracle::Draw draw(62, 0);
  for (int k = 0; k < packs; ++k) {
    std::array<std::array<double, 2>, lanes> ratio{};
    Pack<T> u;
    for (std::size_t i = 0; i < lanes; ++i) {
      const double kind = draw.uniform(0.0, 1.0);
      const double small = draw.chance(0.2) ? 0.0 : draw.power_of_ten(-300.0, 0.0);
      ratio[i] = kind < 0.5 ? std::array<double, 2>{1.0, small} : std::array<double, 2>{small, 1.0};
      u.lane[i] = T(draw.chance(0.1) ? 0.0 : draw.sign() * draw.power_of_ten(-20.0, 3.0));
      if (draw.chance(0.02)) u.lane[i] = T(std::numeric_limits<double>::quiet_NaN());
    }
    const elliptic::BasicModulus<Pack<T>> mod = pack_of<T>(ratio);
    const elliptic::Jacobi<Pack<T>> j = elliptic::jacobi(u, mod);
    const Pack<T> K = elliptic::complete_k(mod), E = elliptic::complete_e(mod),
                  B = elliptic::complete_b(mod);
    const Pack<T> D = elliptic::complete_d(mod);
    for (std::size_t i = 0; i < lanes; ++i) {
      const auto one = elliptic::BasicModulus<T>::from_ratio(T(ratio[i][0]), T(ratio[i][1]));
      const elliptic::Jacobi<T> alone = elliptic::jacobi(u.lane[i], one);
      expect_equal(j.sn.lane[i], alone.sn);
      expect_equal(j.cn.lane[i], alone.cn);
      expect_equal(j.dn.lane[i], alone.dn);
      expect_equal(K.lane[i], elliptic::complete_k(one));
      expect_equal(E.lane[i], elliptic::complete_e(one));
      expect_equal(B.lane[i], elliptic::complete_b(one));
      expect_equal(D.lane[i], elliptic::complete_d(one));
    }
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
