// SPDX-License-Identifier: MIT
// Means and covariances of numbers: against 50 digits, at means far from 0, in chunks; minima and
// maxima with their members.
#include "ensemble/number_moments.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;
using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                            boost::multiprecision::et_off>;
using Row = std::vector<double>;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Three numbers that hang together, `offset` deviations from 0.
std::vector<Row> rows(std::size_t count, double offset) {
  oracle::Draw draw(3901, static_cast<std::uint64_t>(offset));
  std::vector<Row> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = draw.normal(), b = draw.normal(), c = draw.normal();
    all.push_back({offset + a, offset + 0.6 * a + 0.8 * b, 1e3 * (offset - a + b + 2.0 * c)});
  }
  return all;
}

// In chunks of so many, merged in order.
ensemble::NumberMoments moments(const std::vector<Row>& all, std::size_t chunk) {
  ensemble::NumberMoments total(static_cast<int>(all[0].size()));
  for (std::size_t begin = 0; begin < all.size(); begin += chunk) {
    ensemble::NumberMoments part(total.size());
    for (std::size_t i = begin; i < all.size() && i < begin + chunk; ++i)
      part.add(static_cast<std::int64_t>(i), all[i]);
    total.merge(part);
  }
  return total;
}

TEST(NumberMoments, AreThoseOfFiftyDigits) {
  for (const double offset : {0.0, 1.0, 1e4, 1e8}) {
    const std::vector<Row> all = rows(20'000, offset);
    const auto n = static_cast<double>(all.size());
    Exact mean[3] = {0, 0, 0}, product[3][3] = {};
    for (const Row& row : all)
      for (int i = 0; i < 3; ++i) mean[i] += Exact(row[static_cast<std::size_t>(i)]);
    for (Exact& m : mean) m /= n;
    for (const Row& row : all)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          product[i][j] += (Exact(row[i]) - mean[i]) * (Exact(row[j]) - mean[j]);
    for (const std::size_t chunk : {1u, 7u, 1000u, 20'000u}) {
      const ensemble::NumberMoments found = moments(all, chunk);
      const double most =
          chunk == 1000 ? budget::number_moments_eps : budget::number_moments_long_eps;
      Worst means, covariances;
      for (int i = 0; i < 3; ++i) {
        const double size =
            test::larger(std::abs(found.least(i).value), std::abs(found.greatest(i).value));
        means.add(std::abs(static_cast<double>(Exact(found.mean(i)) - mean[i])) / (eps * size));
        for (int j = 0; j < 3; ++j) {
          const auto kappa = [&](int k) {
            const double ratio = found.mean(k) / found.deviation(k);
            return std::sqrt(1.0 + ratio * ratio);
          };
          const double scale = found.deviation(i) * found.deviation(j) * kappa(i);
          const Exact exact = product[i][j] / (n - 1.0);
          covariances.add(std::abs(static_cast<double>(Exact(found.covariance(i, j)) - exact)) /
                          (eps * scale));
        }
      }
      EXPECT_LE(means.value(), most) << offset << ", chunks of " << chunk;
      EXPECT_LE(covariances.value(), most) << offset << ", chunks of " << chunk;
    }
  }
}

// A known table: variances of 1, ..., n are n (n + 1)/12, of its squares in closed form too.
TEST(NumberMoments, OfTheFirstIntegers) {
  ensemble::NumberMoments all(2);
  for (std::int64_t k = 1; k <= 1000; ++k)
    all.add(k - 1, Row{static_cast<double>(k), static_cast<double>(-k)});
  EXPECT_EQ(all.count(), 1000);
  EXPECT_DOUBLE_EQ(all.mean(0), 500.5);
  EXPECT_DOUBLE_EQ(all.covariance(0, 0), 1000.0 * 1001.0 / 12.0);
  EXPECT_DOUBLE_EQ(all.covariance(0, 1), -1000.0 * 1001.0 / 12.0);
  EXPECT_EQ(all.covariance(0, 1), all.covariance(1, 0));
}

TEST(NumberMoments, NameTheMembersOfExtremesTheFirstOfEqualOnes) {
  const std::vector<Row> all{{2.0}, {-1.0}, {5.0}, {-1.0}, {5.0}};
  for (const std::size_t chunk : {1u, 2u, 5u}) {
    const ensemble::NumberMoments found = moments(all, chunk);
    EXPECT_EQ(found.least(0).value, -1.0);
    EXPECT_EQ(found.least(0).member, 1);
    EXPECT_EQ(found.greatest(0).value, 5.0);
    EXPECT_EQ(found.greatest(0).member, 2);
  }
}

TEST(NumberMoments, LeaveOutAndNameMembersWithANumberThatIsNotFinite) {
  ensemble::NumberMoments all(2), without(2);
  for (std::int64_t k = 0; k < 40; ++k) {
    Row row{0.1 * static_cast<double>(k), 1.0 / static_cast<double>(k + 1)};
    if (k % 3 == 1)
      row[static_cast<std::size_t>(k) % 2] = k % 2 == 0 ? nan : -infinity;
    else
      without.add(k, row);
    all.add(k, row);
  }
  EXPECT_EQ(all.left_out().count(), 13);
  ASSERT_EQ(all.left_out().first().size(), ensemble::LeftOut::kept);
  for (std::size_t i = 0; i < ensemble::LeftOut::kept; ++i)
    EXPECT_EQ(all.left_out().first()[i], static_cast<std::int64_t>(3 * i + 1));
  EXPECT_EQ(all.count(), without.count());
  EXPECT_EQ(all.mean(1), without.mean(1));
  EXPECT_EQ(all.covariance(1, 0), without.covariance(1, 0));
}

TEST(NumberMoments, OfNoneAndOfOneAreNotNumbers) {
  ensemble::NumberMoments all(1);
  EXPECT_TRUE(std::isnan(all.mean(0)));
  EXPECT_TRUE(std::isnan(all.least(0).value));
  EXPECT_EQ(all.greatest(0).member, -1);
  all.add(7, Row{2.5});
  EXPECT_EQ(all.mean(0), 2.5);
  EXPECT_TRUE(std::isnan(all.covariance(0, 0)));
}

TEST(NumberMoments, SayWhatTheyRefuse) {
  EXPECT_MESSAGE(ensemble::NumberMoments(0),
                 "NumberMoments: got 0 numbers a member; expected 1 to 1000");
  ensemble::NumberMoments two(2);
  EXPECT_MESSAGE(two.add(5, Row{1.0}), "NumberMoments::add: got 1 numbers of member 5; expected 2");
  EXPECT_MESSAGE(two.merge(ensemble::NumberMoments(3)),
                 "NumberMoments::merge: got moments of 3 numbers; expected of 2");
  EXPECT_MESSAGE(two.covariance(0, 2), "NumberMoments::covariance: got number 2; expected 0 to 1");
  EXPECT_MESSAGE(two.mean(-1), "NumberMoments::mean: got number -1; expected 0 to 1");
}

}  // namespace
