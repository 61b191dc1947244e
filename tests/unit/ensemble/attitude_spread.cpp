// SPDX-License-Identifier: MIT
// Frechet means and covariances of attitudes: clouds made about a known one, of every width, from
// references near and far; the bounds hold, and the same bits by every way and set.
#include "polhode/ensemble/attitude_spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/math/trigonometry.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

Quaternion turn(const Vec3& v) {
  const double angle = norm(v), s = angle == 0.0 ? 0.5 : std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * v.x, s * v.y, s * v.z};
}
double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = conj(a) * b;
  return 2.0 * std::atan2(norm(Vec3{d.x, d.y, d.z}), std::abs(d.w));
}
double difference(const Mat3& a, const Mat3& b) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += (a(i, j) - b(i, j)) * (a(i, j) - b(i, j));
  return std::sqrt(sum);
}
double trace(const Mat3& a) { return a(0, 0) + a(1, 1) + a(2, 2); }

const Quaternion centre = normalized(Quaternion{0.3, -0.5, 0.7, 0.1});

// Rotation vectors about `centre` whose mean is 0: then it is the Frechet mean, if all are within a
// right angle, and their covariance is the one about it.
struct Cloud {
  std::vector<RotorState> states;
  Mat3 covariance{};
  double widest = 0.0;

  Cloud(std::size_t count, double width, std::uint64_t seed) {
    oracle::Draw draw(3906, seed);
    std::vector<Vec3> vectors;
    Vec3 sum{};
    for (std::size_t k = 0; k < count; ++k) {
      const double a = draw.normal(), b = draw.normal(), c = draw.normal();
      // skew, of three widths
      Vec3 v = width * Vec3{a, 0.5 * b + 0.3 * a * a, 0.2 * c - 0.1 * a};
      if (norm(v) > 1.2) v = (1.2 / norm(v)) * v;
      vectors.push_back(v);
      sum = sum + v;
    }
    const double n = static_cast<double>(count);
    for (Vec3& v : vectors) {
      v = v - (1.0 / n) * sum;
      widest = test::larger(widest, norm(v));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) covariance(i, j) += v[i] * v[j] / (n - 1.0);
      const double sign = draw.sign(),
                   size = draw.chance(0.1) ? draw.power_of_ten(-99.0, 99.0) : 1.0;
      const Quaternion q = centre * turn(v);
      states.push_back(
          {{sign * size * q.w, sign * size * q.x, sign * size * q.y, sign * size * q.z},
           {1.0, 0.0, 0.0}});
    }
  }
};

AttitudeSpread spread(const Quaternion& reference, const std::vector<RotorState>& states,
                      std::size_t chunk) {
  AttitudeSpread total(reference);
  for (std::size_t begin = 0; begin < states.size(); begin += chunk) {
    AttitudeSpread part(reference);
    part.add(static_cast<std::int64_t>(begin),
             std::span(states).subspan(begin, std::min<std::size_t>(chunk, states.size() - begin)));
    total.merge(part);
  }
  return total;
}

TEST(AttitudeSpread, FindsTheMeanAndCovarianceThatWerePutIn) {
  for (const double width : {1e-6, 1e-3, 0.1, 0.4}) {
    const Cloud cloud(3000, width, 1);
    ASSERT_LT(cloud.widest, 0.5 * pi<double>());
    const auto found = frechet_mean(cloud.states);
    ASSERT_TRUE(found);
    EXPECT_LE(angle_between(found->mean, centre), budget::attitude_spread) << width;
    const double floor = budget::attitude_spread * std::sqrt(trace(cloud.covariance));
    EXPECT_LE(difference(found->covariance, cloud.covariance),
              budget::attitude_covariance * trace(cloud.covariance) + floor)
        << width;
    EXPECT_LE(found->mean_error, budget::attitude_spread);
  }
}

// From references off the mean: what one step leaves is within the bounds, and these shrink with
// the square of the distance.
TEST(AttitudeSpread, OneStepIsWithinItsBounds) {
  for (const double width : {1e-3, 0.03, 0.1, 0.4}) {
    const Cloud cloud(2000, width, 2);
    double before = 0.0;
    for (const double part : {0.003, 0.03, 0.3}) {
      const Vec3 off = (part * width) * Vec3{0.6, -0.64, 0.48};
      const AttitudeSpread once = spread(centre * turn(off), cloud.states, 500);
      const auto found = once.frechet();
      ASSERT_TRUE(found);
      const double error = angle_between(found->mean, centre);
      EXPECT_LE(error, found->mean_error + budget::attitude_spread) << width << ", " << part;
      EXPECT_LE(difference(found->covariance, cloud.covariance),
                found->covariance_error + budget::attitude_covariance * trace(cloud.covariance) +
                    budget::attitude_spread * width)
          << width << ", " << part;
      // bounds say something, and where the cloud is narrow, nearly nothing is left
      EXPECT_LT(found->mean_error, 4.0 * cloud.widest * part * part * width * width);
      EXPECT_LT(found->covariance_error, 4.0 * cloud.widest * part * width * width);
      EXPECT_GT(found->mean_error, 50.0 * before);  // 0 at first
      before = found->mean_error;
      // a second pass about what was found
      const auto again = spread(found->mean, cloud.states, 500).frechet();
      ASSERT_TRUE(again);
      EXPECT_LE(angle_between(again->mean, centre), again->mean_error + budget::attitude_spread);
      EXPECT_LT(again->mean_error, found->mean_error);
    }
  }
}

// Clouds of two to seven attitudes of every width and shape, from references as far as they are
// wide.
TEST(AttitudeSpread, BoundsHoldOfSmallClouds) {
  int bounded = 0;
  Worst of_mean, of_covariance;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    oracle::Draw draw(3919, seed);
    std::vector<Vec3> vectors(2 + draw.index(6));
    const double width = draw.power_of_ten(-2.0, 0.1), n = static_cast<double>(vectors.size());
    const double flat = draw.uniform(0.0, 1.0);
    Vec3 sum{};
    for (Vec3& v : vectors) {
      v = width * Vec3{draw.normal(), draw.normal(), flat * draw.normal()};
      sum = sum + v;
    }
    const double off = width * draw.power_of_ten(-2.0, 0.0);
    AttitudeSpread all(centre * turn(off * Vec3{draw.normal(), draw.normal(), draw.normal()}));
    Mat3 covariance{};
    bool is_narrow = true;  // so that the mean is the one put in
    for (Vec3& v : vectors) {
      v = v - (1.0 / n) * sum;
      is_narrow = is_narrow && norm(v) < 1.5;
      all.add(0, centre * turn(v));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) covariance(i, j) += v[i] * v[j] / (n - 1.0);
    }
    const auto found = all.frechet();
    if (!is_narrow || !found || std::isinf(found->mean_error)) continue;
    ++bounded;
    of_mean.add(angle_between(found->mean, centre) / (found->mean_error + budget::attitude_spread));
    of_covariance.add(difference(found->covariance, covariance) /
                      (found->covariance_error + budget::attitude_spread));
  }
  EXPECT_GT(bounded, 2000);
  EXPECT_LE(of_mean.value(), 1.0);
  EXPECT_LE(of_covariance.value(), 1.0);
  EXPECT_GT(of_covariance.value(), 0.1);  // they say something
}

// A cloud along one axis in closed form: plane rotations of arithmetic mean.
TEST(AttitudeSpread, OfTurnsAboutOneAxisIsThatOfTheirAngles) {
  std::vector<RotorState> states;
  for (const double a : {0.1, 0.5, 1.2, -0.3, 0.9}) states.push_back({turn({0.0, a, 0.0}), {}});
  const auto found = frechet_mean(states);
  ASSERT_TRUE(found);
  EXPECT_LE(angle_between(found->mean, turn({0.0, 0.48, 0.0})), budget::attitude_spread);
  EXPECT_NEAR(found->covariance(1, 1), 0.362, budget::attitude_covariance);
  EXPECT_NEAR(found->covariance(0, 0), 0.0, budget::attitude_covariance);
}

TEST(AttitudeSpread, OfCloudsWithoutAMeanSaysSo) {
  oracle::Draw draw(3907, 0);
  std::vector<RotorState> uniform, about_axis, opposite;
  for (int k = 0; k < 2000; ++k) {
    uniform.push_back(
        {normalized(Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}), {}});
    about_axis.push_back({turn({0.0, 0.0, 2.0 * pi<double>() * k / 2000.0}), {}});
    opposite.push_back({turn({k % 2 == 0 ? 0.0 : pi<double>(), 0.0, 0.0}), {}});
  }
  for (const auto& states : {uniform, about_axis, opposite}) {
    EXPECT_FALSE(frechet_mean(states));
    EXPECT_FALSE(spread(states[0].q, states, 100).frechet());
  }
  EXPECT_FALSE(AttitudeSpread(centre).frechet());
  EXPECT_FALSE(frechet_mean({}));
}

// One member far away: no bound from a single pass.
TEST(AttitudeSpread, HasNoBoundWhereAMemberMayBeHalfATurnAway) {
  Cloud cloud(500, 0.1, 3);
  cloud.states.push_back({centre * turn({3.14, 0.0, 0.0}), {}});
  const AttitudeSpread all = spread(centre * turn({0.05, 0.0, 0.0}), cloud.states, 100);
  const auto found = all.frechet();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->mean_error, std::numeric_limits<double>::infinity());
  EXPECT_EQ(all.farthest().member, 500);
  EXPECT_LE(all.farthest().value, pi<double>());
}

TEST(AttitudeSpread, OfOneHasAMeanAndNoCovariance) {
  AttitudeSpread one(centre);
  one.add(4, centre * turn({0.1, 0.2, 0.0}));
  const auto found = one.frechet();
  ASSERT_TRUE(found);
  EXPECT_LE(angle_between(found->mean, centre * turn({0.1, 0.2, 0.0})),
            found->mean_error + budget::attitude_spread);
  EXPECT_TRUE(std::isnan(found->covariance(0, 0)));
  EXPECT_EQ(one.farthest().member, 4);
}

TEST(AttitudeSpread, HasTheBitsOfOneByOneInRowsByEverySet) {
  oracle::Draw draw(3908, 0);
  for (const std::size_t epochs : {1u, 8u, 27u}) {
    constexpr std::size_t members = 21;
    std::vector<AttitudeSpread> empty;
    for (std::size_t e = 0; e < epochs; ++e)
      empty.emplace_back(Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()});
    std::vector<RotorState> states;
    for (std::size_t k = 0; k < members * epochs; ++k) {
      RotorState s{{draw.normal(), draw.normal(), draw.normal(), draw.normal()}, {}};
      if (draw.chance(0.05)) s.q = empty[k % epochs].reference();
      if (draw.chance(0.03)) s.q = {0.0, 0.0, 0.0, 0.0};
      if (draw.chance(0.03)) s.q.w = std::numeric_limits<double>::quiet_NaN();
      if (draw.chance(0.03)) s.q.x = 1e250;
      states.push_back(s);
    }
    std::vector<AttitudeSpread> expected = empty;
    for (std::size_t m = 0; m < members; ++m)
      for (std::size_t e = 0; e < epochs; ++e)
        expected[e].add(static_cast<std::int64_t>(m + 5), states[m * epochs + e].q);
    for (const InstructionSet set : supported_instruction_sets())
      for (const std::size_t at_a_time : {1u, 8u, 21u}) {
        std::vector<AttitudeSpread> found = empty;
        for (std::size_t m = 0; m < members; m += at_a_time) {
          const std::size_t end = std::min<std::size_t>(members, m + at_a_time);
          add_rows(std::span(found), static_cast<std::int64_t>(m + 5),
                   std::span(states).subspan(m * epochs, (end - m) * epochs), set);
        }
        for (std::size_t e = 0; e < epochs; ++e)
          EXPECT_EQ(found[e].numbers(), expected[e].numbers()) << e << " of " << epochs;
      }
  }
}

TEST(AttitudeSpread, SaysWhatItRefuses) {
  EXPECT_MESSAGE(AttitudeSpread({0.0, 0.0, 0.0, 0.0}),
                 "AttitudeSpread: reference (0, 0, 0, 0) is no attitude; expected a finite "
                 "quaternion other than 0");
  AttitudeSpread all({});
  EXPECT_MESSAGE(
      all.merge(AttitudeSpread({0.0, 1.0, 0.0, 0.0})),
      "AttitudeSpread::merge: got moments about (0, 1, 0, 0); expected about (1, 0, 0, 0)");
}

}  // namespace
