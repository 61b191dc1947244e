// SPDX-License-Identifier: MIT
// Directions and attitudes drawn alike: lengths, moments and distributions in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "polhode/ensemble/distributions.hpp"
#include "polhode/ensemble/draws.hpp"
#include "statistics.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;
using std::numbers::pi;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr std::uint64_t members = 8192;
constexpr int seeds = 12;

Vec3 direction(std::uint64_t seed, std::uint64_t member) {
  const ensemble::CounterRandom random(seed, ensemble::key_of("spin.axis"));
  return ensemble::IsotropicDirection{}.from_uniform(random.uniform(member, 0),
                                                     random.uniform(member, 1));
}

Quaternion attitude(std::uint64_t seed, std::uint64_t member) {
  const ensemble::CounterRandom random(seed, ensemble::key_of("state.attitude"));
  return ensemble::UniformAttitude{}.from_uniform(
      random.uniform(member, 0), random.uniform(member, 1), random.uniform(member, 2));
}

// Pooled over the seeds: the probability of a number of each member.
template <class Number, class Probability>
void expect_drawn(const Number& number, const Probability& probability) {
  expect_as_it_should_be(over_seeds(seeds, [&](std::uint64_t seed) {
    std::vector<double> sample;
    for (std::uint64_t m = 0; m < members; ++m) sample.push_back(number(seed, m));
    return probability(sample);
  }));
}
template <class Number>
void expect_mean(double mean, const Number& number) {
  expect_drawn(number, [&](const std::vector<double>& sample) { return mean_is(sample, mean); });
}
template <class Number, class Below>
void expect_below(const Below& below, const Number& number) {
  expect_drawn(number,
               [&](const std::vector<double>& sample) { return kolmogorov(sample, below); });
}

TEST(IsotropicDirection, HasLengthOne) {
  Worst<> worst;
  for (std::uint64_t m = 0; m < members; ++m)
    worst.add(std::abs(norm(direction(1, m)) - 1.0) / eps);
  for (const double u : {0x1p-53, 0.5, 1.0 - 0x1p-53})  // at the poles
    worst.add(std::abs(norm(ensemble::IsotropicDirection{}.from_uniform(u, 0.3)) - 1.0) / eps);
  EXPECT_LE(worst.value(), budget::unit_length);
}

// Next to a pole the distance from it keeps its digits: sqrt(1 - z^2) would lose all of them.
TEST(IsotropicDirection, IsExactNextToThePoles) {
  Worst<> worst;
  for (const double u : {0x1p-53, 1.37e-9, 3e-5, 1.0 - 0x1p-53, 1.0 - 0x1.3p-30}) {
    const Vec3 v = ensemble::IsotropicDirection{}.from_uniform(u, 0.3);
    const double across = 2.0 * std::sqrt(u) * std::sqrt(1.0 - u);
    worst.add(std::abs(std::hypot(v.x, v.y) / across - 1.0) / eps);
  }
  EXPECT_LE(worst.value(), budget::unit_length);
}

// Any component is uniform in [-1, 1] (Archimedes), any product of two has the mean 0.
TEST(IsotropicDirection, IsTheSameAlongAnyAxis) {
  const auto below = [](double x) { return 0.5 * (1.0 + x); };
  expect_below(below, [](auto s, auto m) { return direction(s, m).x; });
  expect_below(below, [](auto s, auto m) { return direction(s, m).y; });
  expect_below(below, [](auto s, auto m) { return direction(s, m).z; });
  expect_below(below, [](auto s, auto m) { return dot(direction(s, m), {0.6, 0.48, 0.64}); });
  expect_mean(0.0, [](auto s, auto m) { return direction(s, m).x * direction(s, m).y; });
  expect_mean(0.0, [](auto s, auto m) { return direction(s, m).y * direction(s, m).z; });
  expect_mean(0.0, [](auto s, auto m) { return direction(s, m).z * direction(s, m).x; });
  expect_mean(1.0 / 15.0, [](auto s, auto m) {
    const Vec3 v = direction(s, m);
    return v.x * v.x * v.z * v.z;
  });
}

TEST(UniformAttitude, HasLengthOne) {
  Worst<> worst;
  for (std::uint64_t m = 0; m < members; ++m) {
    const Quaternion q = attitude(1, m);
    worst.add(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) / eps);
  }
  EXPECT_LE(worst.value(), budget::unit_length);
}

// On the sphere of four dimensions: E a^2 = 1/4, E a^4 = 1/8, E a^2 b^2 = 1/24, E a b = 0.
TEST(UniformAttitude, HasTheMomentsOfHaar) {
  using Of = double Quaternion::*;
  const Of all[] = {&Quaternion::w, &Quaternion::x, &Quaternion::y, &Quaternion::z};
  for (const Of a : all) {
    expect_mean(0.0, [&](auto s, auto m) { return attitude(s, m).*a; });
    expect_mean(0.25, [&](auto s, auto m) { return std::pow(attitude(s, m).*a, 2); });
    expect_mean(0.125, [&](auto s, auto m) { return std::pow(attitude(s, m).*a, 4); });
    for (const Of b : all) {
      if (a == b) break;
      expect_mean(0.0, [&](auto s, auto m) { return attitude(s, m).*a * attitude(s, m).*b; });
      expect_mean(1.0 / 24.0, [&](auto s, auto m) {
        return std::pow(attitude(s, m).*a * attitude(s, m).*b, 2);
      });
    }
  }
}

double trace(const Quaternion& q) {
  const Mat3 r = rotation_matrix(q);
  return r(0, 0) + r(1, 1) + r(2, 2);
}

// The trace of a rotation has the means 0, E t^2 = 1 and E |t| = 3 sqrt(3) / (2 pi); its angle is
// below a with the probability (a - sin a) / pi. So it is for the rotation after a given one, and
// before it: the measure is the same from either side.
TEST(UniformAttitude, HasTheTracesAndAnglesOfHaar) {
  expect_mean(0.0, [](auto s, auto m) { return trace(attitude(s, m)); });
  expect_mean(1.0, [](auto s, auto m) { return std::pow(trace(attitude(s, m)), 2); });
  expect_mean(1.5 * std::sqrt(3.0) / pi,
              [](auto s, auto m) { return std::abs(trace(attitude(s, m))); });
  const auto below = [](double a) { return (a - std::sin(a)) / pi; };
  const auto angle = [](const Quaternion& q) {
    return 2.0 * std::atan2(std::hypot(q.x, q.y, q.z), std::abs(q.w));
  };
  const Quaternion given = normalized(Quaternion{0.3, -0.5, 0.9, 0.2});
  expect_below(below, [&](auto s, auto m) { return angle(attitude(s, m)); });
  expect_below(below, [&](auto s, auto m) { return angle(given * attitude(s, m)); });
  expect_below(below, [&](auto s, auto m) { return angle(attitude(s, m) * given); });
  // where it takes an axis is isotropic
  expect_below([](double x) { return 0.5 * (1.0 + x); },
               [&](auto s, auto m) {
                 return rotate(attitude(s, m), Vec3{0.6, 0.0, 0.8}).y;
               });
}

}  // namespace
