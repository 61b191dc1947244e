// SPDX-License-Identifier: MIT
#include "polhode/light/ellipsoid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "budgets.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/math/dual.hpp"
#include "unit/light/typed_values.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using oracle::Draw;
using test::Worst;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                           boost::multiprecision::et_off>;
using Nine = std::array<double, 9>;  // a, b, c, to_sun, to_observer

constexpr double pi_ = 3.141592653589793;

template <Real T, class F>
T at(const std::array<T, 9>& x, const F& f) {
  return f(light::BasicEllipsoid<T>{x[0], x[1], x[2]}, BasicVec3<T>{x[3], x[4], x[5]},
           BasicVec3<T>{x[6], x[7], x[8]});
}
constexpr auto first_law = [](const auto& body, const auto& s, const auto& o) {
  return light::lommel_seeliger_brightness(body, s, o);
};
constexpr auto second_law = [](const auto& body, const auto& s, const auto& o) {
  return light::lambert_brightness(body, s, o);
};
constexpr auto both_laws = [](const auto& body, const auto& s, const auto& o) {
  using T = std::remove_cvref_t<decltype(s.x)>;
  return light::brightness(body, light::BasicScattering<T>::mixed(T(0.25)), s, o);
};

Nine drawn(Draw& draw) {
  Nine x;
  for (int i = 0; i < 3; ++i) x[static_cast<std::size_t>(i)] = draw.uniform(1.0, 2.0);
  for (std::size_t i = 3; i < 9; ++i) x[i] = draw.normal();
  return x;
}

template <class F>
Nine dual_gradient(const Nine& x, const F& f) {
  using D = Dual<double, 9>;
  std::array<D, 9> v;
  for (int i = 0; i < 9; ++i)
    v[static_cast<std::size_t>(i)] = D::variable(x[static_cast<std::size_t>(i)], i);
  return at(v, f).derivative;
}
Nine numbers(const light::EllipsoidGradient& g) {
  return {g.by_axes.x, g.by_axes.y,     g.by_axes.z,     g.by_sun.x,     g.by_sun.y,
          g.by_sun.z,  g.by_observer.x, g.by_observer.y, g.by_observer.z};
}
light::EllipsoidGradient gradient(const Nine& x, double single, double multiple) {
  return light::brightness_gradient(light::Ellipsoid{x[0], x[1], x[2]},
                                    light::Scattering{single, multiple}, Vec3{x[3], x[4], x[5]},
                                    Vec3{x[6], x[7], x[8]});
}

TEST(LightEllipsoid, LommelSeeligerIsTheIntegral) {
  Worst<> worst;
  for (const test::TypedBrightness& row : test::typed_brightness)
    worst.add(std::fabs(light::lommel_seeliger_brightness(row.body, row.to_sun, row.to_observer) /
                            row.lommel_seeliger -
                        1.0));
  EXPECT_LE(worst.value(), budget::light_ellipsoid);
}

TEST(LightEllipsoid, LambertIsTheIntegral) {
  Worst<> two, four, most;
  for (const test::TypedBrightness& row : test::typed_brightness) {
    const light::Ellipsoid& e = row.body;
    const double area = std::cbrt(e.a * e.b * e.c) * std::cbrt(e.a * e.b * e.c);
    const double ratio = test::larger<double>(e.a, e.b, e.c) / test::smaller<double>(e.a, e.b, e.c);
    const auto error = [&](double x) { return std::fabs(x - row.lambert) / area; };
    if (ratio <= 2.0) two.add(error(light::lambert_brightness<16>(e, row.to_sun, row.to_observer)));
    if (ratio <= 4.0)
      four.add(error(light::lambert_brightness<32>(e, row.to_sun, row.to_observer)));
    most.add(error(light::lambert_brightness<64>(e, row.to_sun, row.to_observer)));
  }
  EXPECT_LE(two.value(), budget::light_lambert_16);
  EXPECT_LE(four.value(), budget::light_lambert_32);
  EXPECT_LE(most.value(), budget::light_lambert_32);
}

// Against four or two times as many points.
TEST(LightEllipsoid, LambertIsAsGoodAsItsBudgets) {
  Worst<> two, four;
  Draw draw(19, 4);
  for (int trial = 0; trial < 60; ++trial) {
    const double ratio = trial % 2 == 0 ? 2.0 : 4.0;
    const light::Ellipsoid body{ratio, draw.uniform(1.0, ratio), 1.0};
    const Vec3 s{draw.normal(), draw.normal(), draw.normal()};
    const Vec3 o{draw.normal(), draw.normal(), draw.normal()};
    const double size = std::cbrt(body.a * body.b), area = size * size;
    const double exact = light::lambert_brightness<64>(body, s, o);
    if (trial % 2 == 0)
      two.add(std::fabs(light::lambert_brightness<16>(body, s, o) - exact) / area);
    else
      four.add(std::fabs(light::lambert_brightness<32>(body, s, o) - exact) / area);
  }
  EXPECT_LE(two.value(), budget::light_lambert_16);
  EXPECT_LE(four.value(), budget::light_lambert_32);
}

// Lambert (1760): 2/3 (sin alpha + (pi - alpha) cos alpha) for radius 1. Lommel and Seeliger:
// pi/2 (1 - sin(alpha/2) tan(alpha/2) ln cot(alpha/4)).
TEST(LightEllipsoid, SpheresHaveTheirPhaseFunctions) {
  Worst<> first, second;
  for (int degrees = 1; degrees < 180; degrees += 3) {
    const double alpha = degrees * pi_ / 180.0;
    const Vec3 s{0.0, 3.0, 0.0}, o{0.0, 0.5 * std::cos(alpha), 0.5 * std::sin(alpha)};
    const double seeliger =
        0.5 * pi_ *
        (1.0 + std::sin(alpha / 2.0) * std::tan(alpha / 2.0) * std::log(std::tan(alpha / 4.0)));
    const double lambert = 2.0 / 3.0 * (std::sin(alpha) + (pi_ - alpha) * std::cos(alpha));
    const light::Ellipsoid ball{2.0, 2.0, 2.0};
    first.add(std::fabs(light::lommel_seeliger_brightness(ball, s, o) / 4.0 - seeliger));
    second.add(std::fabs(light::lambert_brightness(ball, s, o) / 4.0 - lambert));
  }
  EXPECT_LE(first.value(), budget::light_ellipsoid);
  EXPECT_LE(second.value(), budget::light_lambert_sphere);
}

TEST(LightEllipsoid, BehindTheSunHalfOfTheAreaSeen) {
  const light::Ellipsoid body{3.0, 2.0, 1.0};
  const Vec3 s{1.0, -2.0, 0.5};
  const Vec3 n = (1.0 / norm(s)) * s;
  const double seen = pi_ * 6.0 * std::sqrt(n.x * n.x / 9.0 + n.y * n.y / 4.0 + n.z * n.z);
  const light::EllipsoidGradient g = light::lommel_seeliger_gradient(body, s, 7.0 * s);
  EXPECT_NEAR(light::lommel_seeliger_brightness(body, s, s), 0.5 * seen,
              budget::light_ellipsoid * seen);
  EXPECT_NEAR(g.value, 0.5 * seen, budget::light_ellipsoid * seen);
  const Nine x{3.0, 2.0, 1.0, 1.0, -2.0, 0.5, 7.0, -14.0, 3.5};
  // half of the gradient of the area seen, each way
  const Nine d = dual_gradient(x, first_law), explicit_ = numbers(g);
  for (int i = 0; i < 3; ++i) {
    const double k[3] = {9.0, 4.0, 1.0};
    const double stretched = n[i] / k[i] - n[i] * dot(n, Vec3{n.x / 9.0, n.y / 4.0, n.z});
    const double by = 0.25 * 36.0 * pi_ * pi_ / seen * stretched / norm(s);
    const auto at_sun = static_cast<std::size_t>(3 + i);
    EXPECT_NEAR(d[at_sun], by, budget::light_ellipsoid_gradient * seen);
    EXPECT_NEAR(explicit_[at_sun], by, budget::light_ellipsoid_gradient * seen);
    EXPECT_NEAR(7.0 * d[at_sun + 3], by, budget::light_ellipsoid_gradient * seen);
    EXPECT_NEAR(d[static_cast<std::size_t>(i)], explicit_[static_cast<std::size_t>(i)],
                budget::light_ellipsoid_gradient * seen);
  }
}

TEST(LightEllipsoid, OppositeToTheSunThereIsNoLight) {
  for (const Nine& x : {Nine{3.0, 2.0, 1.0, 1.0, -2.0, 0.5, -2.0, 4.0, -1.0},
                        Nine{1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0}}) {
    EXPECT_NEAR(at(x, both_laws), 0.0, budget::light_ellipsoid);
    for (const Nine& g : {dual_gradient(x, both_laws), numbers(gradient(x, 1.0, 0.25))})
      for (const double d : g) EXPECT_NEAR(d, 0.0, budget::light_ellipsoid_gradient);
  }
}

// Up to rounding: the sum of both unit vectors is then as often 1e-16 as 0, in any direction.
TEST(LightEllipsoid, NearlyOppositeToTheSunThereIsNoLight) {
  Draw draw(19, 5);
  Worst<> value, slope;
  const auto add = [&](const Nine& x, double single) {
    const light::EllipsoidGradient g = gradient(x, single, 1.0);
    value.add(std::fabs(g.value));
    value.add(std::fabs(at(x, second_law)));
    for (const Nine& by : {dual_gradient(x, second_law), numbers(g)})
      for (const double d : by) slope.add(std::fabs(d));
  };
  for (int k = 1; k <= 60; ++k)
    add({1.3, 1.1, 0.9, 1.0, 0.0, 0.0, -static_cast<double>(k), 0.0, 0.0}, 1.0);
  for (int trial = 0; trial < 60; ++trial) {
    Nine x = drawn(draw);
    const double k = draw.uniform(1.0, 60.0);
    // the light of the first law is as the square of what is off, that of Lambert's as its cube
    const double off = trial % 3 == 0 ? 0.0 : (trial % 3 == 1 ? 1e-15 : 1e-9);
    const double length = std::sqrt(x[3] * x[3] + x[4] * x[4] + x[5] * x[5]);
    for (std::size_t i = 3; i < 6; ++i) {
      x[i] /= length;
      x[i + 3] = -k * (x[i] + off * x[i + 3]);
    }
    add(x, off < 1e-12 ? 1.0 : 0.0);
  }
  EXPECT_LE(value.value(), budget::light_ellipsoid);
  EXPECT_LE(slope.value(), budget::light_ellipsoid_gradient);
}

// Templates and gradients; and both against differences of 60 digits.
TEST(LightEllipsoid, GradientsAgree) {
  Worst<> templates, differences;
  Draw draw(19, 1);
  for (int trial = 0; trial < 40; ++trial) {
    Nine x = drawn(draw);
    if (trial >= 30)  // close to opposition, where the series ends, behind the Sun
      for (std::size_t i = 6; i < 9; ++i)
        x[i] = (trial % 2 == 0 ? 1.0 : -1.0) * x[i - 3] + 0.01 * x[i];
    const Nine first = numbers(gradient(x, 1.0, 0.0));
    const Nine got = dual_gradient(x, first_law);
    const Nine mixed = numbers(gradient(x, 1.0, 0.25)), dual = dual_gradient(x, both_laws);
    for (std::size_t i = 0; i < 9; ++i) {
      templates.add(std::fabs(first[i] - got[i]));
      templates.add(std::fabs(mixed[i] - dual[i]));
      std::array<Wide, 9> up, down;
      for (std::size_t k = 0; k < 9; ++k) up[k] = down[k] = Wide(x[k]);
      const Wide h = ldexp(Wide(1.0), -60);
      up[i] += h;
      down[i] -= h;
      const Wide slope = (at(up, first_law) - at(down, first_law)) / (Wide(2.0) * h);
      differences.add(std::fabs(static_cast<double>(slope - Wide(first[i]))));
    }
    EXPECT_NEAR(gradient(x, 1.0, 0.25).value, at(x, both_laws), budget::light_ellipsoid_gradient);
  }
  EXPECT_LE(templates.value(), budget::light_ellipsoid_gradient);
  EXPECT_LE(differences.value(), budget::light_ellipsoid_gradient);
}

// Lambert's at points that stay: the border of the lune adds nothing, as differences of the whole
// show to the error of the rule.
TEST(LightEllipsoid, LambertGradientIsThatOfTheIntegral) {
  Worst<> worst;
  Draw draw(19, 2);
  for (int trial = 0; trial < 10; ++trial) {
    const Nine x = drawn(draw);
    const Nine got = numbers(light::lambert_gradient<32>(
        light::Ellipsoid{x[0], x[1], x[2]}, Vec3{x[3], x[4], x[5]}, Vec3{x[6], x[7], x[8]}));
    for (std::size_t i = 0; i < 9; ++i) {
      Nine up = x, down = x;
      const double h = 1e-4 * std::fabs(x[i]);
      up[i] += h;
      down[i] -= h;
      const auto whole = [](const auto& body, const auto& s, const auto& o) {
        return light::lambert_brightness<32>(body, s, o);
      };
      worst.add(std::fabs((at(up, whole) - at(down, whole)) / (up[i] - down[i]) - got[i]));
    }
  }
  EXPECT_LE(worst.value(), budget::light_lambert_differences);
}

TEST(LightEllipsoid, LengthsOfDirectionsDoNotMatter) {
  const light::Ellipsoid body{2.0, 1.5, 1.0};
  const Vec3 s{1.0, 2.0, -0.5}, o{-1.0, 1.0, 2.0};
  const double near = both_laws(body, s, o), far = both_laws(body, 1.5e11 * s, 1e-9 * o);
  EXPECT_NEAR(far, near, budget::light_ellipsoid * near);
}

TEST(LightEllipsoid, MomentsAndBack) {
  Draw draw(19, 3);
  Worst<> worst;
  for (int trial = 0; trial < 20; ++trial) {
    const light::Ellipsoid body{draw.uniform(0.5, 2.0), draw.uniform(0.5, 2.0),
                                draw.uniform(0.5, 2.0)};
    const Vec3 moments = light::homogeneous_moments(body, 3.0);
    EXPECT_DOUBLE_EQ(moments.x, 0.6 * (body.b * body.b + body.c * body.c));
    const light::Ellipsoid back = light::homogeneous_ellipsoid(moments, 3.0);
    worst.add(std::fabs(back.a - body.a));
    worst.add(std::fabs(back.b - body.b));
    worst.add(std::fabs(back.c - body.c));
  }
  EXPECT_LE(worst.value(), budget::light_semi_axes);
  EXPECT_TRUE(std::isnan(light::homogeneous_ellipsoid(Vec3{3.0, 1.0, 1.0}, 1.0).a));
}

TEST(LightScattering, IsTheSumOfBothLaws) {
  EXPECT_DOUBLE_EQ(light::Scattering::lommel_seeliger().at(0.25, 0.75), 0.1875);
  EXPECT_DOUBLE_EQ(light::Scattering::lambert().at(0.25, 0.5), 0.125);
  EXPECT_DOUBLE_EQ(light::Scattering::mixed(0.5).at(0.25, 0.75), 0.1875 * 1.5);
  for (const double mu : {-1.0, 0.0})
    for (const double other : {-1.0, 0.0, 0.5}) {
      EXPECT_EQ(light::Scattering::mixed(0.5).at(mu, other), 0.0);
      EXPECT_EQ(light::Scattering::mixed(0.5).at(other, mu), 0.0);
    }
}

TEST(LightScattering, PhaseFunctionAndAngle) {
  EXPECT_DOUBLE_EQ((light::PhaseFunction{0.5, 0.1, -0.25}.at(0.2)), 0.5 * std::exp(-2.0) + 0.95);
  EXPECT_DOUBLE_EQ(light::PhaseFunction{}.at(1.0), 1.0);
  EXPECT_DOUBLE_EQ(light::phase_angle(Vec3{2.0, 0.0, 0.0}, Vec3{0.0, 0.0, 5.0}), pi_ / 2.0);
  EXPECT_EQ(light::phase_angle(Vec3{2.0, 0.0, 0.0}, Vec3{3.0, 0.0, 0.0}), 0.0);
  EXPECT_DOUBLE_EQ(light::phase_angle(Vec3{2.0, 0.0, 0.0}, Vec3{-3.0, 0.0, 0.0}), pi_);
}

}  // namespace
