// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "oracle/kepler.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using namespace oracle;

Wide wide(double x) { return x; }
Wide wide(const DoubleDouble& x) { return Wide(x.hi) + Wide(x.lo); }

struct WorstErrors {
  Worst<> anomaly, sine, versine;
};

// Errors in units of epsilon<T>(); of sin E over |sin E| + |E cos E| (dlog E/dlog M).
template <Real T>
void measure(const T& M, double e, WorstErrors& worst) {
  const auto eccentricity = BasicEccentricity<T>::of(T(e));
  const BasicKeplerAnomaly<T> got = eccentric_anomaly(M, eccentricity);
  const Wide m = wide(M), x = kepler_root(m, e);
  const bool ellipse = e < 1.0;
  const Wide s = ellipse ? sin(x) : sinh(x), half = ellipse ? sin(x / 2) : sinh(x / 2);
  const Wide slope = ellipse ? Wide(1 - e * cos(x)) : Wide(e * cosh(x) - 1);
  const Wide carried = ellipse ? Wide(abs(x * cos(x)) * (m / x / slope)) : Wide(0);
  const auto units = [](const Wide& error) { return static_cast<double>(error) / epsilon<T>(); };
  worst.anomaly.add(units(abs(wide(got.anomaly) - x) / x));
  worst.sine.add(units(abs(wide(got.sine) - s) / (abs(s) + carried)));
  worst.versine.add(units(abs(wide(got.versine) / (2 * half * half) - 1)));
}

// Every order of magnitude of 1 - e and of M that T holds the squares of.
template <Real T>
WorstErrors over_grid(bool ellipse, int cases, double smallest, double largest) {
  WorstErrors worst;
  for (int i = 0; i < cases; ++i) {
    Draw draw(401, static_cast<std::uint64_t>(i));
    const std::vector<double> gaps{
        draw.uniform(0.0, 1.0), draw.power_of_ten(-16.0, 0.0), ellipse ? 0x1p-53 : 0x1p-52,
        ellipse ? 1.0 - draw.power_of_ten(-20.0, 0.0) : draw.power_of_ten(0.0, 10.0)};
    for (const double gap : gaps) {
      const double e = ellipse ? 1.0 - gap : 1.0 + gap;
      if (e == 1.0 || e == 0.0) continue;
      const double bound = ellipse ? std::log10(3.141592653589793) : largest;
      for (const double M : {draw.uniform(1e-3, 3.14), draw.power_of_ten(smallest, bound),
                             draw.power_of_ten(-30.0, smaller(bound, 3.0))}) {
        measure<T>(T(M), e, worst);
      }
    }
  }
  return worst;
}

void expect_within(const WorstErrors& worst) {
  EXPECT_LE(worst.anomaly.value(), budget::kepler_anomaly_eps);
  EXPECT_LE(worst.sine.value(), budget::kepler_sine_eps);
  EXPECT_LE(worst.versine.value(), budget::kepler_versine_eps);
}

TEST(KeplerEquation, EllipsesInDouble) { expect_within(over_grid<double>(true, 1500, -130, 0)); }
TEST(KeplerEquation, HyperbolasInDouble) {
  expect_within(over_grid<double>(false, 1500, -130, 150));
}
TEST(KeplerEquation, EllipsesInDoubleDouble) {
  expect_within(over_grid<DoubleDouble>(true, 150, -110, 0));
}
TEST(KeplerEquation, HyperbolasInDoubleDouble) {
  expect_within(over_grid<DoubleDouble>(false, 150, -110, 100));
}

// Beyond the range where 1 - cos E can be told: E and sin E stay.
TEST(KeplerEquation, ExtremeMeanAnomalies) {
  WorstErrors worst;
  for (const double M : {1e-290, 1e-200, 1e200, 1e300, 1e307}) {
    for (const double e : {1.0 + 0x1p-52, 1.5, 1e8}) measure<double>(M, e, worst);
    if (M > 1.0) continue;
    for (const double e : {1e-300, 0.3, 1.0 - 0x1p-53}) measure<double>(M, e, worst);
  }
  EXPECT_LE(worst.anomaly.value(), budget::kepler_anomaly_eps);
  EXPECT_LE(worst.sine.value(), budget::kepler_sine_eps);
}

TEST(KeplerEquation, ManyTurns) {
  Draw draw(402, 0);
  for (int i = 0; i < 300; ++i) {
    const double M = draw.sign() * draw.power_of_ten(0.6, 15.0), e = draw.uniform(0.0, 0.999);
    const Wide turn = 2 * wide_pi();
    const Wide turns = round(Wide(M) / turn) * turn, m = Wide(M) - turns;
    const Wide x = (m < 0 ? -1 : 1) * kepler_root(abs(m), e);
    const KeplerAnomaly got = eccentric_anomaly(M, Eccentricity::of(e));
    const double cost = static_cast<double>(abs(m) / (1 - e * cos(x)));  // of a rounding of m
    const double eps = epsilon<double>();
    EXPECT_LE(std::abs(static_cast<double>(Wide(got.sine) - sin(x))),
              budget::kepler_sine_eps * eps * (1.0 + cost));
    EXPECT_LE(std::abs(static_cast<double>(Wide(got.anomaly) - x - turns)),
              budget::kepler_anomaly_eps * eps * (std::abs(M) + cost));
  }
}

TEST(KeplerEquation, OddInMeanAnomalyAndExactAtZero) {
  for (const double e : {0.0, 0.4, 1.0 - 0x1p-53, 1.0 + 0x1p-52, 3.0}) {
    const KeplerAnomaly at = eccentric_anomaly(0.7, Eccentricity::of(e));
    const KeplerAnomaly mirrored = eccentric_anomaly(-0.7, Eccentricity::of(e));
    EXPECT_EQ(mirrored.anomaly, -at.anomaly);
    EXPECT_EQ(mirrored.sine, -at.sine);
    EXPECT_EQ(mirrored.versine, at.versine);
    const KeplerAnomaly zero = eccentric_anomaly(0.0, Eccentricity::of(e));
    EXPECT_EQ(zero.anomaly, 0.0);
    EXPECT_EQ(zero.sine, 0.0);
    EXPECT_EQ(zero.versine, 0.0);
  }
}

// Any ordinary arguments give ordinary numbers: no loop that may not end, no overflow.
TEST(KeplerEquation, NeverFails) {
  for (int i = 0; i < 20000; ++i) {
    Draw draw(403, static_cast<std::uint64_t>(i));
    const double M = draw.sign() * draw.power_of_ten(-323.0, 308.2);
    const double gap = draw.power_of_ten(-16.2, 0.0);
    const double far = draw.power_of_ten(0.0, 300.0);
    for (const double e : {1.0 - gap, 1.0 + gap, far, gap}) {
      if (e == 1.0) continue;
      const KeplerAnomaly at = eccentric_anomaly(M, Eccentricity::of(e));
      ASSERT_TRUE(std::isfinite(at.anomaly) && std::isfinite(at.sine)) << M << ' ' << e;
      ASSERT_GE(at.versine, 0.0) << M << ' ' << e;
      if (e < 1.0) {
        ASSERT_LE(std::abs(at.sine), 1.0 + budget::kepler_sine_eps * epsilon<double>());
      }
    }
  }
}

// e rounds to 1, and its complement says how far from it: an ellipse, E - sin E = M to 1e-20.
TEST(KeplerEquation, EccentricityThatRoundsToOneIsAnEllipse) {
  for (const double M : {1e-6, 0.3, 1.0, 3.0}) {
    const Wide E = kepler_root(M, 1 - Wide("1e-20"));
    const auto error = [&](const KeplerAnomaly& x) {
      return static_cast<double>(abs(Wide(x.anomaly) - E) / E) / epsilon<double>();
    };
    EXPECT_LE(error(eccentric_anomaly(M, {1.0, 1e-20})), budget::kepler_anomaly_eps) << M;
  }
}

TEST(KeplerEquation, NotANumberOutsideTheDomain) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = HUGE_VAL;
  for (const double e : {1.0, -0.1, nan, infinite}) {
    EXPECT_TRUE(std::isnan(eccentric_anomaly(1.0, Eccentricity::of(e)).anomaly)) << e;
    EXPECT_TRUE(isnan(
        eccentric_anomaly(DoubleDouble(1.0), BasicEccentricity<DoubleDouble>::of(e)).anomaly));
  }
  EXPECT_TRUE(std::isnan(eccentric_anomaly(nan, Eccentricity::of(0.5)).sine));
  EXPECT_TRUE(std::isnan(eccentric_anomaly(infinite, Eccentricity::of(2.0)).sine));
}

}  // namespace
}  // namespace polhode::test
