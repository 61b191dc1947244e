// SPDX-License-Identifier: MIT
// Cells: every index once, in order, from any number of threads; exceptions pass through.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "polhode/ensemble/executor.hpp"
#include "polhode/error.hpp"

namespace {

using namespace polhode;
using CellRow = std::vector<double>;

// Cells of very different cost.
CellRow work(std::int64_t index) {
  double x = 0.1 * static_cast<double>(index);
  const std::int64_t rounds = index % 7 == 0 ? 200000 : 20;
  for (std::int64_t k = 0; k < rounds; ++k) x = std::sin(x) + 0.3;
  return {static_cast<double>(index), x};
}

std::vector<CellRow> rows(std::int64_t first, std::int64_t count, int threads) {
  std::vector<CellRow> result;
  ensemble::ordered_parallel_for(
      first, count, threads, work, [&](std::int64_t index, const CellRow& row) {
        EXPECT_EQ(index, first + static_cast<std::int64_t>(result.size()));
        result.push_back(row);
      });
  return result;
}

TEST(Cells, AreThoseOfAPlainLoopForAnyNumberOfThreads) {
  std::vector<CellRow> plain;
  for (std::int64_t k = 0; k < 200; ++k) plain.push_back(work(k));
  for (const int threads : {1, 2, 3, 8}) EXPECT_EQ(rows(0, 200, threads), plain) << threads;
  EXPECT_EQ(rows(150, 200, 2), std::vector<CellRow>(plain.begin() + 150, plain.end()));
  EXPECT_TRUE(rows(5, 5, 2).empty());
}

TEST(Cells, RunAtTheSameTime) {
  if (ensemble::hardware_threads() < 2) GTEST_SKIP() << "one processor";
  std::atomic<int> here = 0;
  std::atomic<bool> met = false;
  // A thread of a busy machine may wait for long before it begins.
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  ensemble::ordered_parallel_for(
      0, 64, 2,
      [&](std::int64_t) -> CellRow {
        ++here;
        while (!met && std::chrono::steady_clock::now() < patience)
          if (here >= 2) met = true;
        --here;
        return {};
      },
      [](std::int64_t, const CellRow&) {});
  EXPECT_TRUE(met);
}

TEST(Cells, WhatIsThrownPassesThroughAfterTheRowsBefore) {
  for (const int threads : {1, 2, 8}) {
    std::int64_t last = -1;
    const auto sink = [&](std::int64_t index, const CellRow&) { last = index; };
    // the later one long before the first one
    const auto cell = [](std::int64_t index) -> CellRow {
      if (index == 20) work(0);
      if (index == 20 || index == 22) throw std::runtime_error(std::to_string(index));
      return {};
    };
    std::string thrown;
    try {
      ensemble::ordered_parallel_for(0, 100, threads, cell, sink);
    } catch (const std::runtime_error& error) {
      thrown = error.what();
    }
    EXPECT_EQ(thrown, "20") << threads;
    EXPECT_EQ(last, 19) << threads;
    EXPECT_THROW(ensemble::ordered_parallel_for(0, 100, 0, cell, sink), DomainError);
  }
}

TEST(Cells, WhatTheSinkThrowsPassesThrough) {
  for (const int threads : {1, 2, 8}) {
    std::int64_t last = -1;
    const auto sink = [&](std::int64_t index, const CellRow&) {
      last = index;
      if (index == 20) throw std::runtime_error("sink");
    };
    EXPECT_THROW(ensemble::ordered_parallel_for(0, 100, threads, work, sink), std::runtime_error);
    EXPECT_EQ(last, 20) << threads;
  }
}

// A result that counts how many of it there are.
struct Counted {
  static inline std::atomic<int> alive = 0;
  Counted() { ++alive; }
  Counted(const Counted&) { ++alive; }
  ~Counted() { --alive; }
};

// Those that wait for the first one when that throws are freed.
TEST(Cells, LeaveNothingBehindWhenOneThrows) {
  std::atomic<int> waiting = 0;
  const auto cell = [&](std::int64_t index) -> Counted {
    if (index > 0) {
      ++waiting;
      return {};
    }
    const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (waiting < 3 && std::chrono::steady_clock::now() < latest) std::this_thread::yield();
    throw std::runtime_error("first");
  };
  int taken = 0;
  const auto sink = [&](std::int64_t, const Counted&) { ++taken; };
  EXPECT_THROW(ensemble::ordered_parallel_for(0, 100, 2, cell, sink), std::runtime_error);
  EXPECT_GE(waiting, 3);
  EXPECT_EQ(taken, 0);
  EXPECT_EQ(Counted::alive, 0);
}

}  // namespace
