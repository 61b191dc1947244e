// SPDX-License-Identifier: MIT
// The two forms of the Cayley-Klein series are one function; its momentum is Jacobi's.
#include <gtest/gtest.h>

#include "budgets.hpp"
#include "free/detail/polhode_family.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/free/detail/cayley_klein_coefficients.hpp"
#include "polhode/free/detail/normalized_arc.hpp"
#include "polhode/math/double_double.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using namespace polhode;
using polhode::detail::PolhodeCurve;
namespace detail = polhode::detail;

template <class T>
class CayleyKlein : public ::testing::Test {};
using Types = ::testing::Types<double, DoubleDouble>;
TYPED_TEST_SUITE(CayleyKlein, Types);

// A polhode of momentum 1 with this 1 - k^2.
template <class T>
PolhodeCurve<T> curve_with(Draw& draw, double kp2) {
  const auto I = oracle::detail::triaxial_moments(draw);
  const BasicVec3<T> sorted{T(I[0]), T(I[1]), T(I[2])};
  const bool long_axis = draw.chance(0.5);
  const T kap2 = detail::kappa_squared(detail::primed_moments(sorted, long_axis));
  const T r2 = (T(1.0) - T(kp2)) / kap2;  // k2 = kap2 r2
  return detail::family_curve(sorted, long_axis, T(1.0), {r2, T(kp2)});
}

template <class T>
BasicQuaternion<T> trigonometric(const PolhodeCurve<T>& c, const T& u) {
  using std::cos;
  using std::sin;
  const T x = T(0.5) * polhode::pi<T>() * u / c.K;
  return normalized(trigonometric_sum(detail::trigonometric_series(c), T(sin(x)), T(cos(x))));
}
template <class T>
BasicQuaternion<T> hyperbolic(const PolhodeCurve<T>& c, const T& u) {
  const CayleyKleinSeries<T> s = detail::hyperbolic_series(c);
  const T turn = T(2.0) * s.phase_per_u * u;
  return normalized(rotation_z(turn) * hyperbolic_sum(s, T(s.chi_per_u * u), false));
}

template <class T>
double gap(const BasicQuaternion<T>& p, const BasicQuaternion<T>& q) {
  const BasicQuaternion<T> d = conj(p) * q;
  return to_double(norm(BasicVec3<T>{d.x, d.y, d.z}));
}

// Around the border k'^2 = 0.01 both are to full accuracy.
TYPED_TEST(CayleyKlein, BothFormsAgreeAtTheirBorder) {
  using T = TypeParam;
  for (const double kp2 : {0.005, 0.0099999, 0.01, 0.0100001, 0.02}) {
    for (std::uint64_t i = 0; i < 40; ++i) {
      Draw draw(51, i);
      const PolhodeCurve<T> c = curve_with<T>(draw, kp2);
      for (double f = -1.0; f <= 1.0; f += 0.125) {
        const T u = T(f) * c.K;
        EXPECT_LE(gap(trigonometric(c, u), hyperbolic(c, u)),
                  budget::cayley_klein_eps * epsilon<T>())
            << kp2 << " " << f;
      }
    }
  }
}

TEST(CayleyKleinForm, ChangesAtTheBorder) {
  Draw draw(52, 0);
  EXPECT_FALSE(detail::cayley_klein_series(curve_with<double>(draw, 0.0101)).hyperbolic);
  EXPECT_TRUE(detail::cayley_klein_series(curve_with<double>(draw, 0.0099)).hyperbolic);
  for (const double kp2 : {0.9999999, 0.5, 0.02, 0.009, 1e-10}) {
    const PolhodeCurve<DoubleDouble> c = curve_with<DoubleDouble>(draw, kp2);
    EXPECT_LE(detail::cayley_klein_series(c).terms, int(max_series_terms)) << kp2;
  }
}

// g' = (a1 cn u, a2 sn u, a3 dn u) [SA (A24)] from the rotation that the four numbers are, beyond
// one period too.
TYPED_TEST(CayleyKlein, ThirdRowIsJacobisMomentum) {
  using T = TypeParam;
  for (const double kp2 : {1.0 - 1e-12, 0.9, 0.5, 0.05, 0.008, 1e-6, 1e-20}) {
    for (std::uint64_t i = 0; i < 20; ++i) {
      Draw draw(53, i);
      const PolhodeCurve<T> c = curve_with<T>(draw, kp2);
      const auto mod = elliptic::BasicModulus<T>::from_pair(c.k2, c.kp2);
      const bool is_hyperbolic = detail::cayley_klein_series(c).hyperbolic;
      for (double f = -1.0; f <= 1.0; f += 0.25) {
        const T u = T(f) * c.K;
        const BasicQuaternion<T> p = is_hyperbolic ? hyperbolic(c, u) : trigonometric(c, u);
        const elliptic::Jacobi<T> j = elliptic::jacobi(u, mod);
        const BasicVec3<T> g{c.a1 * j.cn, c.a2 * j.sn, c.a3 * j.dn};
        const BasicVec3<T> third = rotate(conj(p), BasicVec3<T>{T(0.0), T(0.0), T(1.0)});
        EXPECT_LE(to_double(norm(third - g)),
                  budget::cayley_klein_eps * epsilon<T>() * (1.0 + std::abs(to_double(u))))
            << kp2 << " " << f;
      }
    }
  }
}

}  // namespace
