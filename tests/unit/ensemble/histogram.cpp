// SPDX-License-Identifier: MIT
// Bins and histograms: every number between its own edges, those beyond counted.
#include "ensemble/histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "message_of.hpp"
#include "oracle/random_draw.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// By its definition.
std::size_t plain_index(const ensemble::Bins& bins, double x) {
  const auto edges = bins.edges();
  std::size_t k = 0;
  while (k < edges.size() && edges[k] <= x) ++k;
  return x == edges.back() ? bins.count() : k;
}

TEST(Bins, HoldWhatIsBetweenTheirEdges) {
  const std::vector<ensemble::Bins> all{
      ensemble::Bins::linear(-1.0, 2.0, 30),
      ensemble::Bins::linear(1e15, 1e15 + 4.0, 16),
      ensemble::Bins::linear(-1e308, 1.5e308, 7),
      ensemble::Bins::linear(0.0, 1e-320, 3),
      ensemble::Bins::logarithmic(0.05, 1e-3, 1e3),
      ensemble::Bins::signed_logarithmic(0.2, 0.1, 100.0),
      ensemble::Bins::of_edges({-3.0, -1.0, 0.0, 0.5, 10.0}),
      ensemble::Bins::around(std::vector{1.0, nan, 3.0}, 0.25, 8)};
  oracle::Draw draw(3913, 0);
  for (const ensemble::Bins& bins : all) {
    const auto edges = bins.edges();
    std::vector<double> hard{-infinity, infinity, 0.0, -0.0};
    for (const double e : edges)
      for (const double x : {std::nextafter(e, -infinity), e, std::nextafter(e, infinity)})
        hard.push_back(x);
    const double width = 0.5 * edges.back() - 0.5 * edges.front();
    for (int k = 0; k < 2000; ++k)
      hard.push_back(edges.front() + 2.0 * draw.uniform(-0.1, 1.1) * width);
    for (const double x : hard) EXPECT_EQ(bins.index(x), plain_index(bins, x)) << x;
    for (std::size_t k = 1; k <= bins.count(); ++k) {
      EXPECT_GE(bins.middle(k), edges[k - 1]);
      EXPECT_LE(bins.middle(k), edges[k]);
    }
  }
  EXPECT_EQ(all[7].edges().front(), 0.5);
  EXPECT_EQ(all[7].edges().back(), 3.5);
  EXPECT_EQ(ensemble::Bins::around(std::vector{4.0}, 0.1, 4).edges().front(), 2.0);
  EXPECT_TRUE(all[0] == ensemble::Bins::linear(-1.0, 2.0, 30));
  EXPECT_FALSE(all[0] == ensemble::Bins::linear(-1.0, 2.0, 31));
}

TEST(Bins, SayWhatTheyRefuse) {
  EXPECT_MESSAGE(ensemble::Bins::linear(1.0, 1.0, 3),
                 "Bins::linear: got edges (1, 1); expected two finite ones, the lower first");
  EXPECT_MESSAGE(ensemble::Bins::linear(0.0, 1.0, 0),
                 "Bins::linear: got 0 bins; expected 1 to 1000000");
  EXPECT_MESSAGE(
      ensemble::Bins::linear(1.0, 1.0 + 4e-16, 9),
      "Bins: edge 1 is 1 after 1; expected finite edges, each greater than the one before");
  EXPECT_MESSAGE(
      ensemble::Bins::of_edges({0.0, 2.0, nan}),
      "Bins: edge 2 is nan after 2; expected finite edges, each greater than the one before");
  EXPECT_MESSAGE(ensemble::Bins::of_edges({0.0}), "Bins: got 1 edges; expected 2 to 1000001");
  EXPECT_MESSAGE(ensemble::Bins::logarithmic(1.0, 1.0, 2.0),
                 "Bins::logarithmic: got a relative error of 1; expected one between 0 and 1");
  EXPECT_MESSAGE(ensemble::Bins::logarithmic(0.1, 0.0, 2.0),
                 "Bins::logarithmic: got numbers (0, 2); expected two positive finite ones, the "
                 "smaller first");
  EXPECT_MESSAGE(ensemble::Bins::logarithmic(1e-6, 1e-9, 1e9),
                 "Bins::logarithmic: relative error 1e-06 from 1e-09 to 1e+09 takes 2.07e+07 bins; "
                 "expected at most 500000");
  EXPECT_MESSAGE(ensemble::Bins::around(std::vector{nan}, 0.1, 3),
                 "Bins::around: got 1 numbers, none finite; expected one at least");
  EXPECT_NE(message_of([] { ensemble::Bins::around(std::vector{1.0}, -0.1, 3); }), "");
}

TEST(Histogram, CountsAllAndWhatIsBeyond) {
  const ensemble::Bins bins = ensemble::Bins::linear(-2.0, 2.0, 17);
  ensemble::Histogram straight(bins), total(bins);
  std::vector<std::int64_t> expected(bins.count() + 2);
  oracle::Draw draw(3914, 0);
  for (int chunk = 0; chunk < 9; ++chunk) {
    ensemble::Histogram part(bins);
    for (int k = 0; k < 700; ++k) {
      const double x = draw.normal();
      straight.add(k, x);
      part.add(k, x);
      ++expected[plain_index(bins, x)];
    }
    total.merge(part);
  }
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(total.count(k), expected[k]);
    EXPECT_GT(expected[k], 0);
  }
  EXPECT_EQ(total.count(), 6300);
  EXPECT_EQ(total.numbers(), straight.numbers());
}

TEST(Histogram, LeavesOutAndNamesWhatIsNotFinite) {
  ensemble::Histogram one(ensemble::Bins::linear(0.0, 1.0, 2));
  ensemble::Histogram2D two(ensemble::Bins::linear(0.0, 1.0, 2),
                            ensemble::Bins::linear(0.0, 1.0, 2));
  int k = 0;
  for (const double x : {0.1, nan, infinity, 5.0}) {
    one.add(k, x);
    two.add(k, x, 0.2);
    two.add(10 + k, 0.2, x);
    ++k;
  }
  EXPECT_EQ(one.count(), 2);
  EXPECT_EQ(one.count(3), 1);
  EXPECT_EQ(one.left_out().count(), 2);
  EXPECT_EQ(one.left_out().first()[1], 2);
  EXPECT_EQ(two.count(), 4);
  EXPECT_EQ(two.left_out().count(), 4);
  EXPECT_EQ(two.left_out().first()[1], 11);
}

TEST(Histogram2D, CountsPairs) {
  const ensemble::Bins x = ensemble::Bins::linear(-1.0, 1.0, 5),
                       y = ensemble::Bins::logarithmic(0.3, 0.1, 10.0);
  ensemble::Histogram2D total(x, y);
  std::vector<std::vector<std::int64_t>> expected(x.count() + 2,
                                                  std::vector<std::int64_t>(y.count() + 2));
  oracle::Draw draw(3915, 0);
  for (int chunk = 0; chunk < 5; ++chunk) {
    ensemble::Histogram2D part(x, y);
    for (int k = 0; k < 1000; ++k) {
      const double a = draw.normal(), b = draw.power_of_ten(-1.5, 1.5);
      part.add(k, a, b);
      ++expected[plain_index(x, a)][plain_index(y, b)];
    }
    total.merge(part);
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (std::size_t j = 0; j < expected[i].size(); ++j)
      EXPECT_EQ(total.count(i, j), expected[i][j]) << i << ", " << j;
}

TEST(Histogram, SaysWhatItRefuses) {
  ensemble::Histogram one(ensemble::Bins::linear(0.0, 1.0, 2));
  EXPECT_MESSAGE(one.count(4), "Histogram::count: got bin 4; expected 0 to 3");
  EXPECT_MESSAGE(one.merge(ensemble::Histogram(ensemble::Bins::linear(0.0, 1.0, 3))),
                 "Histogram::merge: got other bins; expected the same edges");
  const ensemble::Bins many = ensemble::Bins::linear(0.0, 1.0, 20'000);
  EXPECT_MESSAGE(ensemble::Histogram2D(many, many),
                 "Histogram2D: got 20000 by 20000 bins; expected at most 100000000 cells");
}

}  // namespace
