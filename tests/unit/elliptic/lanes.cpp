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

#include "oracle/random_draw.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson_rf_rd.hpp"
#include "polhode/elliptic/jacobi.hpp"

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

template <class T>
class EllipticLanes : public testing::Test {};
using Types = testing::Types<double>;
TYPED_TEST_SUITE(EllipticLanes, Types);

// f of packs against f of their lanes.
template <class T, std::size_t arguments, class F>
void expect_lanes(const F& f) {
  oracle::Draw draw(61, arguments);
  for (int k = 0; k < packs; ++k) {
    const bool ordinary = k % 4 != 0;
    std::array<Pack<T>, arguments> x;
    for (Pack<T>& pack : x)
      for (T& lane : pack.lane) lane = T(drawn(draw, ordinary));
    const Pack<T> got = std::apply([&](const auto&... a) { return f(a...); }, x);
    for (std::size_t i = 0; i < lanes; ++i) {
      const T alone = std::apply([&](const auto&... a) { return f(a.lane[i]...); }, x);
      expect_equal(got.lane[i], alone);
    }
    if (testing::Test::HasFailure()) return;
  }
}

TYPED_TEST(EllipticLanes, Agm) {
  expect_lanes<TypeParam, 2>([](const auto& a, const auto& b) { return agm(a, b); });
}
TYPED_TEST(EllipticLanes, Cel) {
  expect_lanes<TypeParam, 4>(
      [](const auto& kc, const auto& p, const auto& a, const auto& b) { return cel(kc, p, a, b); });
}
TYPED_TEST(EllipticLanes, CarlsonRf) {
  expect_lanes<TypeParam, 3>(
      [](const auto& x, const auto& y, const auto& z) { return carlson_rf(x, y, z); });
}
TYPED_TEST(EllipticLanes, CarlsonRd) {
  expect_lanes<TypeParam, 3>(
      [](const auto& x, const auto& y, const auto& z) { return carlson_rd(x, y, z); });
}

template <class T>
BasicModulus<Pack<T>> pack_of(const std::array<std::array<double, 2>, lanes>& ratio) {
  Pack<T> a, b;
  for (std::size_t i = 0; i < lanes; ++i) {
    a.lane[i] = T(ratio[i][0]);
    b.lane[i] = T(ratio[i][1]);
  }
  return BasicModulus<Pack<T>>::from_ratio(a, b);
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
    const BasicModulus<Pack<T>> mod = pack_of<T>(ratio);
    const Jacobi<Pack<T>> j = jacobi(u, mod);
    const Pack<T> K = complete_k(mod), E = complete_e(mod), B = complete_b(mod);
    const Pack<T> D = complete_d(mod);
    for (std::size_t i = 0; i < lanes; ++i) {
      const auto one = BasicModulus<T>::from_ratio(T(ratio[i][0]), T(ratio[i][1]));
      const Jacobi<T> alone = jacobi(u.lane[i], one);
      expect_equal(j.sn.lane[i], alone.sn);
      expect_equal(j.cn.lane[i], alone.cn);
      expect_equal(j.dn.lane[i], alone.dn);
      expect_equal(K.lane[i], complete_k(one));
      expect_equal(E.lane[i], complete_e(one));
      expect_equal(B.lane[i], complete_b(one));
      expect_equal(D.lane[i], complete_d(one));
    }
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
