// SPDX-License-Identifier: MIT
// Second moments of attitudes: closed forms, Haar's, clouds without a mean, and the same bits one
// by one, in blocks and in rows of epochs by every set of instructions.
#include "polhode/ensemble/attitude_moments.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
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
AttitudeMoments moments(const std::vector<Quaternion>& all) {
  AttitudeMoments found;
  std::int64_t member = 0;
  for (const Quaternion& q : all) found.add(member++, q);
  return found;
}

TEST(AttitudeMoments, AreThoseOfFiftyDigitsWhateverSignAndLength) {
  oracle::Draw draw(3902, 0);
  AttitudeMoments found;
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
    const AttitudeMoments found = moments({start, {-end.w, -end.x, -end.y, -end.z}});
    const PrincipalAttitudes p = found.principal();
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
  const AttitudeMoments found = moments(all);
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
    AttitudeMoments found;
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
  const AttitudeMoments none;
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
    std::vector<AttitudeMoments> expected(epochs);
    for (std::size_t m = 0; m < members; ++m)
      for (std::size_t e = 0; e < epochs; ++e)
        expected[e].add(static_cast<std::int64_t>(100 + m), states[m * epochs + e].q);
    for (const InstructionSet set : supported_instruction_sets())
      for (const std::size_t at_a_time : {1u, 16u, 37u}) {
        std::vector<AttitudeMoments> found(epochs);
        for (std::size_t m = 0; m < members; m += at_a_time) {
          const std::size_t end = std::min<std::size_t>(members, m + at_a_time);
          add_rows(std::span(found), static_cast<std::int64_t>(100 + m),
                   std::span(states).subspan(m * epochs, (end - m) * epochs), set);
        }
        for (std::size_t e = 0; e < epochs; ++e)
          EXPECT_EQ(found[e].numbers(), expected[e].numbers()) << e << " of " << epochs;
      }
    std::vector<RotorState> of_epoch;
    for (std::size_t m = 0; m < members; ++m) of_epoch.push_back(states[m * epochs]);
    AttitudeMoments block;
    block.add(100, std::span(of_epoch).first(20));
    block.add(120, std::span(of_epoch).subspan(20));
    EXPECT_EQ(block.numbers(), expected[0].numbers());
    EXPECT_GT(expected[0].left_out().count() + expected[epochs - 1].left_out().count(), 0);
  }
}

TEST(AttitudeMoments, SayWhatTheyRefuse) {
  std::vector<AttitudeMoments> three(3);
  const std::vector<RotorState> states(7);
  EXPECT_MESSAGE(add_rows(std::span(three), 0, states),
                 "add_rows: got 7 states at 3 epochs; expected as many, or a multiple");
  EXPECT_MESSAGE(add_rows(std::span<AttitudeMoments>(), 0, states),
                 "add_rows: got 7 states at 0 epochs; expected as many, or a multiple");
  EXPECT_MESSAGE(three[0].moment(0, 4),
                 "AttitudeMoments::moment: got components 0 and 4; expected 0 to 3");
}

}  // namespace
