// SPDX-License-Identifier: MIT
// Histograms of members: chunk by chunk and through numbers the same, kept numbers as in bins.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "polhode/error.hpp"
#include "run/ensemble/statistics/statistics.hpp"

namespace polhode {
namespace {

using io::detail::MemberHistogram;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> rows_of(const MemberHistogram& of) {
  std::vector<double> rows;
  of.append_rows(3.0, 4, rows);
  return rows;
}

// Members 0 to 39 of two numbers; one in seven has none.
void add(MemberHistogram& to, int begin, int end) {
  for (int k = begin; k < end; ++k) {
    const double x[] = {k % 7 == 3 ? std::nan("") : std::sin(k), std::cos(2 * k)};
    to.add(k, std::span(x).first(to.axes()));
  }
}

TEST(MemberHistogram, ChunksThroughNumbersAreOne) {
  const std::vector<ensemble::Bins> two = {ensemble::Bins::linear(-0.5, 1.0, 3),
                                           ensemble::Bins::linear(-1.0, 1.0, 5)};
  for (const MemberHistogram& empty :
       {MemberHistogram(two), MemberHistogram(std::span(two).first(1)), MemberHistogram::kept(1),
        MemberHistogram::kept(2)}) {
    MemberHistogram all = empty, merged = empty;
    add(all, 0, 40);
    for (int k = 0; k < 40; k += 8) {
      MemberHistogram chunk = empty;
      add(chunk, k, k + 8);
      merged.merge(empty.restored(chunk.numbers()));
      merged = empty.restored(merged.numbers());
    }
    EXPECT_EQ(rows_of(merged), rows_of(all));
    EXPECT_EQ(merged.numbers(), all.numbers());
  }
  EXPECT_THROW(MemberHistogram(two).merge(MemberHistogram::kept(2)), DomainError);
  EXPECT_THROW(MemberHistogram::kept(1).merge(MemberHistogram::kept(2)), DomainError);
  EXPECT_THROW(static_cast<void>(MemberHistogram::kept(2).restored(std::vector{1.0})), DomainError);
}

TEST(MemberHistogram, NumbersThatAreKeptFillTheirRange) {
  MemberHistogram kept = MemberHistogram::kept(1);
  const double own[] = {1.0, 2.0, 2.5, 5.0, 5.0, infinity};
  for (int k = 0; k < 6; ++k) kept.add(k, {&own[k], 1});
  // t, low, high, members, part
  const std::vector<double> expected = {3, -infinity, 1,        0, 0,    //
                                        3, 1,         2,        1, 0.2,  //
                                        3, 2,         3,        2, 0.4,  //
                                        3, 3,         4,        0, 0,    //
                                        3, 4,         5,        2, 0.4,  //
                                        3, 5,         infinity, 0, 0};
  EXPECT_EQ(rows_of(kept), expected);
}

TEST(MemberHistogram, OfOneNumberAndOfNone) {
  for (const double x : {0.0, 3.0}) {
    MemberHistogram kept = MemberHistogram::kept(1);
    for (int k = 0; k < 3; ++k) kept.add(k, {&x, 1});
    const std::vector<double> rows = rows_of(kept);
    double inside = 0.0;
    for (std::size_t k = 5; k + 5 < rows.size(); k += 5) inside += rows[k + 3];
    EXPECT_EQ(inside, 3.0);
  }
  const std::vector<double> rows = rows_of(MemberHistogram::kept(1));
  EXPECT_EQ(rows.size(), 30U);
  EXPECT_EQ(rows[8], 0.0);
  EXPECT_TRUE(std::isnan(rows[9]));
}

}  // namespace
}  // namespace polhode
