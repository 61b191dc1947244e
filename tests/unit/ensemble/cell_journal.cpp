// SPDX-License-Identifier: MIT
// Results that a journal has are not computed again, and come to the sink in the same order.
#include "polhode/ensemble/cell_journal.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "polhode/error.hpp"

namespace {

using polhode::Archive;
using polhode::ensemble::CellJournal;

struct Interrupted {};

// Two stages of work that depend on each other; ends after `most` results.
std::vector<double> worked(CellJournal* journal, int threads, std::int64_t most,
                           std::atomic<int>& computed) {
  std::vector<double> seen;
  double sum = 0.0;
  for (const std::int64_t count : {7, 5}) {
    const double from = sum;
    polhode::ensemble::ordered_parallel_for(
        journal, count, threads,
        [&](std::int64_t k) {
          ++computed;
          return std::sin(from + static_cast<double>(k));
        },
        [&](std::int64_t, double x) {
          sum += x;
          seen.push_back(x);
          if (static_cast<std::int64_t>(seen.size()) == most) throw Interrupted();
        },
        [](Archive& bytes, double& x) { bytes(x); });
  }
  return seen;
}

CellJournal read_again(CellJournal& journal) {
  Archive bytes;
  journal.serialize(bytes);
  const std::string text = bytes.bytes();
  CellJournal read;
  Archive reader(text);
  read.serialize(reader);
  return read;
}

TEST(CellJournal, WorkThatWasInterruptedContinues) {
  std::atomic<int> computed{0};
  const std::vector<double> straight = worked(nullptr, 1, -1, computed);
  ASSERT_EQ(computed, 12);
  for (const int threads : {1, 3}) {
    for (std::int64_t most = 1; most <= 12; ++most) {
      CellJournal journal;
      EXPECT_THROW(worked(&journal, threads, most, computed), Interrupted);
      EXPECT_EQ(journal.results(), static_cast<std::size_t>(most));
      CellJournal read = read_again(journal);
      EXPECT_TRUE(read.is_replaying());
      computed = 0;
      EXPECT_EQ(worked(&read, threads, -1, computed), straight);
      EXPECT_EQ(computed, 12 - most);
      EXPECT_FALSE(read.is_replaying());
      EXPECT_EQ(read.results(), 12U);
    }
  }
}

TEST(CellJournal, TellsOfEachNewResult) {
  CellJournal journal;
  std::atomic<int> computed{0};
  int added = 0;
  journal.added = [&] { ++added; };
  EXPECT_THROW(worked(&journal, 1, 4, computed), Interrupted);
  EXPECT_EQ(added, 3);  // the sink of the fourth ended the work
  CellJournal read = read_again(journal);
  added = 0;
  read.added = [&] { ++added; };
  worked(&read, 1, -1, computed);
  EXPECT_EQ(added, 8);
}

TEST(CellJournal, BytesThatEndEarlyAreRejected) {
  CellJournal journal;
  std::atomic<int> computed{0};
  worked(&journal, 1, -1, computed);
  Archive bytes;
  journal.serialize(bytes);
  const std::string text = bytes.bytes().substr(0, bytes.bytes().size() - 3);
  CellJournal read;
  Archive reader(text);
  EXPECT_THROW(read.serialize(reader), polhode::DomainError);
}

}  // namespace
