// SPDX-License-Identifier: MIT
// The cells that one process computes, on threads beside the one that speaks with the others.
#pragma once

#include <tbb/concurrent_queue.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "mpi/messages.hpp"
#include "polhode/ensemble/executor.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

class OwnCells {
 public:
  explicit OwnCells(int threads);
  // Drops what is left, and waits for it.
  ~OwnCells();
  OwnCells(const OwnCells&) = delete;
  OwnCells& operator=(const OwnCells&) = delete;

  int threads() const { return threads_; }
  // `work` is there until next() has given the cell back.
  void add(const ExecutorWork& work, std::int64_t index);
  // One that has come to its end, if there is one.
  std::optional<Cell> next();
  // Those that wait are not computed, and those that are look and stop; until resume().
  void drop() { drops_ = true; }
  void resume() { drops_ = false; }

 private:
  Cell computed(const ExecutorWork& work, std::int64_t index) const;

  int threads_;
  int unfinished_ = 0;
  std::atomic<bool> drops_ = false;
  tbb::concurrent_queue<Cell> ended_;
  tbb::global_control allowed_;  // as many as asked for, even beyond the processors
  tbb::task_arena arena_;
};

// Sleeps between two looks in vain, a little longer each time: a processor that waits is not kept
// from the threads that compute on it.
class Patience {
 public:
  void wait();
  void renew() { microseconds_ = least; }

 private:
  static constexpr int least = 20, most = 1000;
  int microseconds_ = least;
};

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
