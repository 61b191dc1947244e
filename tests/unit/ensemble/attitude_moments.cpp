// SPDX-License-Identifier: MIT
// Second moments of attitudes: closed forms, Haar's, clouds without a mean, and the same bits one
// by one, in blocks and in rows of epochs by every set of instructions.
#include "ensemble/attitude_moments.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "ensemble/attitude_spread.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/detail/math/trigonometry.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                            boost::multiprecision::et_off>;
constexpr double eps = std::numeric_limits<double>::epsilon();

Quaternion haar(oracle::Draw& draw) {
  return normalized(Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()});
}
// By an angle about the axis (1, 2, 2)/3.
Quaternion turn(double angle) {
  const double s = std::sin(0.5 * angle) / 3.0;
  return {std::cos(0.5 * angle), s, 2.0 * s, 2.0 * s};
}
double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = conj(a) * b;
  return 2.0 * std::atan2(norm(Vec3{d.x, d.y, d.z}), std::abs(d.w));
}
ensemble::AttitudeMoments moments(const std::vector<Quaternion>& all) {
  ensemble::AttitudeMoments found;
  std::int64_t member = 0;
  for (const Quaternion& q : all) found.add(member++, q);
  return found;
}

TEST(AttitudeMoments, AreThoseOfFiftyDigitsWhateverSignAndLength) {
  oracle::Draw draw(3902, 0);
  ensemble::AttitudeMoments found;
  Exact sums[4][4] = {};
  constexpr int n = 10'000;
  for (int k = 0; k < n; ++k) {
    Quaternion q = haar(draw);
    q.w += 0.7;
    const double size = k % 3 == 0 ? 1.0 : draw.sign() * draw.power_of_ten(-300.0, 300.0);
    q = normalized(q);
    q = {size * q.w, size * q.x, size * q.y, size * q.z};
    found.add(k, q);
    const Exact x[4] = {q.w, q.x, q.y, q.z};
    const Exact square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) sums[i][j] += x[i] * x[j] / square;
  }
  Worst worst;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      worst.add(std::abs(static_cast<double>(Exact(found.moment(i, j)) - sums[i][j] / n)) / eps);
  EXPECT_LE(worst.value(), budget::attitude_moments_eps);
  EXPECT_EQ(found.count(), n);
}

// Two attitudes at an angle a: the mean is half way, l = (1 +- cos(a/2))/2.
TEST(AttitudeMoments, OfTwoAttitudesAreInClosedForm) {
  oracle::Draw draw(3903, 0);
  for (const double a : {1e-3, 0.4, 0.8}) {
    const Quaternion start = haar(draw), end = start * turn(a);
    const ensemble::AttitudeMoments found = moments({start, {-end.w, -end.x, -end.y, -end.z}});
    const ensemble::PrincipalAttitudes p = found.principal();
    EXPECT_NEAR(p.values[0], 0.5 * (1.0 + std::cos(0.5 * a)), budget::attitude_values);
    EXPECT_NEAR(p.values[1], 0.5 * (1.0 - std::cos(0.5 * a)), budget::attitude_values);
    EXPECT_NEAR(p.values[2], 0.0, budget::attitude_values);
    ASSERT_TRUE(found.mean());
    EXPECT_LE(angle_between(*found.mean(), start * turn(0.5 * a)), budget::attitude_mean);
    EXPECT_GE(found.mean()->w, 0.0);
    EXPECT_NEAR(found.concentration(), (4.0 * p.values[0] - 1.0) / 3.0, budget::attitude_values);
  }
}

// Evenly about an axis, as tumblers whose phases have spread: l = 1/2, 1/2, 0, 0 and no mean.
TEST(AttitudeMoments, OfAttitudesAllAboutAnAxisHaveNoMean) {
  std::vector<Quaternion> all;
  for (int k = 0; k < 360; ++k) all.push_back(turn(2.0 * pi<double>() * k / 360.0));
  const ensemble::AttitudeMoments found = moments(all);
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(found.principal().values[static_cast<std::size_t>(k)], k < 2 ? 0.5 : 0.0,
                budget::attitude_values);
  EXPECT_FALSE(found.mean());
  // over half a turn they have: the middle
  all.resize(180);
  ASSERT_TRUE(moments(all).mean());
  EXPECT_LE(angle_between(*moments(all).mean(), turn(pi<double>() * 179.0 / 360.0)),
            budget::attitude_mean);
}

// n (M - 1/4) of uniform attitudes: 12 n sum (l - 1/4)^2 is chi^2 with 9 degrees [Bingham], pooled.
TEST(AttitudeMoments, OfUniformAttitudesAreHaars) {
  constexpr int seeds = 60, n = 2000;
  double sum = 0.0;
  int with_mean = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    oracle::Draw draw(3904, seed);
    ensemble::AttitudeMoments found;
    for (int k = 0; k < n; ++k) found.add(k, haar(draw));
    for (const double l : found.principal().values) sum += 12.0 * n * (l - 0.25) * (l - 0.25);
    with_mean += found.mean() ? 1 : 0;
  }
  const double p = boost::math::cdf(boost::math::chi_squared(9.0 * seeds), sum);
  EXPECT_GT(p, budget::least_chance) << sum;
  EXPECT_LT(p, 1.0 - budget::least_chance) << sum;
  EXPECT_EQ(with_mean, 0);
}

TEST(AttitudeMoments, OfNoneAreNotNumbers) {
  const ensemble::AttitudeMoments none;
  EXPECT_TRUE(std::isnan(none.moment(0, 0)));
  EXPECT_TRUE(std::isnan(none.concentration()));
  EXPECT_FALSE(none.mean());
  EXPECT_EQ(moments({turn(0.3)}).mean()->w, turn(0.3).w);
}

// What is hard: lengths, zeros, NaN; in some epochs and members alone.
std::vector<RotorState> hard_rows(std::size_t members, std::size_t epochs) {
  oracle::Draw draw(3905, 0);
  std::vector<RotorState> all;
  for (std::size_t k = 0; k < members * epochs; ++k) {
    RotorState s{haar(draw), {1.0, 2.0, 3.0}};
    if (draw.chance(0.02)) s.q = {};
    if (draw.chance(0.02)) s.q = {0.0, 0.0, 0.0, 0.0};
    if (draw.chance(0.02)) s.q.y = std::numeric_limits<double>::quiet_NaN();
    if (draw.chance(0.02)) s.q.z = std::numeric_limits<double>::infinity();
    if (draw.chance(0.05)) {
      const double size = draw.power_of_ten(-300.0, 300.0);
      s.q = {size * s.q.w, size * s.q.x, size * s.q.y, size * s.q.z};
    }
    all.push_back(s);
  }
  return all;
}

TEST(AttitudeMoments, HaveTheBitsOfOneByOneInRowsAndBlocksByEverySet) {
  for (const std::size_t epochs : {1u, 2u, 7u, 8u, 61u}) {
    constexpr std::size_t members = 37;
    const std::vector<RotorState> states = hard_rows(members, epochs);
    std::vector<ensemble::AttitudeMoments> expected(epochs);
    for (std::size_t m = 0; m < members; ++m)
      for (std::size_t e = 0; e < epochs; ++e)
        expected[e].add(static_cast<std::int64_t>(100 + m), states[m * epochs + e].q);
    for (const InstructionSet set : supported_instruction_sets())
      for (const std::size_t at_a_time : {1u, 16u, 37u}) {
        std::vector<ensemble::AttitudeMoments> found(epochs);
        for (std::size_t m = 0; m < members; m += at_a_time) {
          const std::size_t end = std::min<std::size_t>(members, m + at_a_time);
          ensemble::add_rows(std::span(found), static_cast<std::int64_t>(100 + m),
                             std::span(states).subspan(m * epochs, (end - m) * epochs), set);
        }
        for (std::size_t e = 0; e < epochs; ++e)
          EXPECT_EQ(found[e].numbers(), expected[e].numbers()) << e << " of " << epochs;
      }
    std::vector<RotorState> of_epoch;
    for (std::size_t m = 0; m < members; ++m) of_epoch.push_back(states[m * epochs]);
    ensemble::AttitudeMoments block;
    block.add(100, std::span(of_epoch).first(20));
    block.add(120, std::span(of_epoch).subspan(20));
    EXPECT_EQ(block.numbers(), expected[0].numbers());
    EXPECT_GT(expected[0].left_out().count() + expected[epochs - 1].left_out().count(), 0);
  }
}

TEST(AttitudeMoments, SayWhatTheyRefuse) {
  std::vector<ensemble::AttitudeMoments> three(3);
  const std::vector<RotorState> states(7);
  EXPECT_MESSAGE(ensemble::add_rows(std::span(three), 0, states),
                 "add_rows: got 7 states at 3 epochs; expected as many, or a multiple");
  EXPECT_MESSAGE(ensemble::add_rows(std::span<ensemble::AttitudeMoments>(), 0, states),
                 "add_rows: got 7 states at 0 epochs; expected as many, or a multiple");
  EXPECT_MESSAGE(three[0].moment(0, 4),
                 "AttitudeMoments::moment: got components 0 and 4; expected 0 to 3");
}

// Frechet means and covariances of attitudes: clouds made about a known one, of every width, from
// references near and far; the bounds hold, and the same bits by every way and set.

Quaternion turn(const Vec3& v) {
  const double angle = norm(v), s = angle == 0.0 ? 0.5 : std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * v.x, s * v.y, s * v.z};
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

ensemble::AttitudeSpread spread(const Quaternion& reference, const std::vector<RotorState>& states,
                                std::size_t chunk) {
  ensemble::AttitudeSpread total(reference);
  for (std::size_t begin = 0; begin < states.size(); begin += chunk) {
    ensemble::AttitudeSpread part(reference);
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
    const auto found = ensemble::frechet_mean(cloud.states);
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
      const ensemble::AttitudeSpread once = spread(centre * turn(off), cloud.states, 500);
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
    ensemble::AttitudeSpread all(centre *
                                 turn(off * Vec3{draw.normal(), draw.normal(), draw.normal()}));
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
  const auto found = ensemble::frechet_mean(states);
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
    EXPECT_FALSE(ensemble::frechet_mean(states));
    EXPECT_FALSE(spread(states[0].q, states, 100).frechet());
  }
  EXPECT_FALSE(ensemble::AttitudeSpread(centre).frechet());
  EXPECT_FALSE(ensemble::frechet_mean({}));
}

// One member far away: no bound from a single pass.
TEST(AttitudeSpread, HasNoBoundWhereAMemberMayBeHalfATurnAway) {
  Cloud cloud(500, 0.1, 3);
  cloud.states.push_back({centre * turn({3.14, 0.0, 0.0}), {}});
  const ensemble::AttitudeSpread all = spread(centre * turn({0.05, 0.0, 0.0}), cloud.states, 100);
  const auto found = all.frechet();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->mean_error, std::numeric_limits<double>::infinity());
  EXPECT_EQ(all.farthest().member, 500);
  EXPECT_LE(all.farthest().value, pi<double>());
}

TEST(AttitudeSpread, OfOneHasAMeanAndNoCovariance) {
  ensemble::AttitudeSpread one(centre);
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
    std::vector<ensemble::AttitudeSpread> empty;
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
    std::vector<ensemble::AttitudeSpread> expected = empty;
    for (std::size_t m = 0; m < members; ++m)
      for (std::size_t e = 0; e < epochs; ++e)
        expected[e].add(static_cast<std::int64_t>(m + 5), states[m * epochs + e].q);
    for (const InstructionSet set : supported_instruction_sets())
      for (const std::size_t at_a_time : {1u, 8u, 21u}) {
        std::vector<ensemble::AttitudeSpread> found = empty;
        for (std::size_t m = 0; m < members; m += at_a_time) {
          const std::size_t end = std::min<std::size_t>(members, m + at_a_time);
          ensemble::add_rows(std::span(found), static_cast<std::int64_t>(m + 5),
                             std::span(states).subspan(m * epochs, (end - m) * epochs), set);
        }
        for (std::size_t e = 0; e < epochs; ++e)
          EXPECT_EQ(found[e].numbers(), expected[e].numbers()) << e << " of " << epochs;
      }
  }
}

TEST(AttitudeSpread, SaysWhatItRefuses) {
  EXPECT_MESSAGE(ensemble::AttitudeSpread({0.0, 0.0, 0.0, 0.0}),
                 "AttitudeSpread: reference (0, 0, 0, 0) is no attitude; expected a finite "
                 "quaternion other than 0");
  ensemble::AttitudeSpread all({});
  EXPECT_MESSAGE(
      all.merge(ensemble::AttitudeSpread({0.0, 1.0, 0.0, 0.0})),
      "AttitudeSpread::merge: got moments about (0, 1, 0, 0); expected about (1, 0, 0, 0)");
}

}  // namespace
