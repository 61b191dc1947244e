// SPDX-License-Identifier: MIT
#include "polhode/trajectory/save_at.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "polhode/error.hpp"

namespace polhode {
namespace {

TEST(SaveAt, StepsAreRoundedOnceNeverAccumulated) {
  const SaveAt times = SaveAt::steps(0.0, 1000.0, 0.1);
  ASSERT_EQ(times.size(), 10001);
  double accumulated = 0.0;
  for (int k = 0; k < 10000; ++k) accumulated += 0.1;
  EXPECT_NE(accumulated, 1000.0);
  EXPECT_EQ(times[10000], 1000.0);
  EXPECT_EQ(times[3], 0.30000000000000004);         // 3 times the double nearest to 0.1
  EXPECT_EQ(SaveAt::steps(1.0, 2.0, 0.1)[7], 1.7);  // one rounding; 1.0 + 7 * 0.1 has two
}

TEST(SaveAt, TheLastRowIsThereWhenOnlyRoundingPutsItBeyond) {
  EXPECT_EQ(SaveAt::steps(0.0, 0.3, 0.1).size(), 4);
  EXPECT_EQ(SaveAt::steps(0.0, 0.29, 0.1).size(), 3);
  EXPECT_EQ(SaveAt::steps(0.0, 720.0, 0.5).size(), 1441);
  EXPECT_EQ(SaveAt::steps(5.0, 5.0, 1.0).size(), 1);
  EXPECT_EQ(SaveAt::steps(0.0, 1.0, 10.0).size(), 1);
  EXPECT_EQ(SaveAt::steps(0.0, 1e9, 1.0).size(), 1000000001);
}

TEST(SaveAt, StepsMayRunBackwards) {
  const SaveAt times = SaveAt::steps(1.0, -1.0, -0.25);
  ASSERT_EQ(times.size(), 9);
  EXPECT_EQ(times[8], -1.0);
}

TEST(SaveAt, ACountEndsExactlyAtBothEnds) {
  const SaveAt times = SaveAt::count(0.1, 0.7, 7);
  ASSERT_EQ(times.size(), 7);
  EXPECT_EQ(times[0], 0.1);
  EXPECT_EQ(times[6], 0.7);
  EXPECT_EQ(SaveAt::count(0.0, 1.0, 4)[1], 1.0 / 3.0);
  EXPECT_EQ(SaveAt::count(0.0, 1.0, 11)[3], 0.3);
  EXPECT_EQ(SaveAt::count(2.0, 2.0, 1)[0], 2.0);
}

TEST(SaveAt, AListIsTakenAsItIs) {
  const SaveAt times = SaveAt::times({3.0, -1.0, 2.0});
  ASSERT_EQ(times.size(), 3);
  EXPECT_EQ(times[1], -1.0);
}

TEST(SaveAt, TellsWhatMadeIt) {
  const SaveAt steps = SaveAt::steps(0.1, 7.3, 0.7), count = SaveAt::count(0.1, 0.7, 7);
  EXPECT_EQ(steps.start(), 0.1);
  EXPECT_EQ(steps.stop(), 7.3);
  EXPECT_EQ(steps.step(), 0.7);
  EXPECT_EQ(count.stop(), 0.7);
  EXPECT_EQ(count.step(), 0.0);
  EXPECT_TRUE(SaveAt::times({1.0}).is_list());
}

TEST(SaveAt, RefusesWhatLeadsNowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(SaveAt::steps(0.0, 1.0, 0.0), DomainError);
  EXPECT_THROW(SaveAt::steps(0.0, 1.0, -1.0), DomainError);
  EXPECT_THROW(SaveAt::steps(0.0, 1.0, nan), DomainError);
  EXPECT_THROW(SaveAt::steps(0.0, infinity, 1.0), DomainError);
  EXPECT_THROW(SaveAt::steps(0.0, 1e300, 1e-300), DomainError);
  EXPECT_THROW(SaveAt::steps(-1e308, 1.5e308, 1.0), DomainError);
  EXPECT_THROW(SaveAt::count(0.0, 1.0, 0), DomainError);
  EXPECT_THROW(SaveAt::count(0.0, 1.0, 1), DomainError);
  EXPECT_THROW(SaveAt::times({0.0, nan}), DomainError);
}

}  // namespace
}  // namespace polhode
