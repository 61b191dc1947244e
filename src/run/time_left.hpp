// SPDX-License-Identifier: MIT
// seconds_left, CellClock: the time left of cells that some workers, threads or processes, compute.
//
// Equations   A worker that has ended a cell begins the next one. So of the cells that are under
//             way, the i-th began when the i-th of the last `workers` cells had ended, or at 0; all
//             these times over the number of cells that have ended are the mean duration. Cells
//             that are under way end after it, and each worker that is free takes a cell that
//             waits.
// Units       seconds.
// Accuracy    within a factor of two for cells of about the same duration, up to the last one. If
//             durations differ, as good as their mean so far.
// Cost        that of a list with one number for each worker.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace io {

// `ends`: when the last cells ended, in order, one for each worker, 0 for those that have ended
// none; the last one is now. `done` cells have ended; `left` have not, where the last one may be a
// part of a cell.
double seconds_left(std::span<const double> ends, std::int64_t done, double left);

class CellClock {
 public:
  explicit CellClock(int workers = 1) { begin(workers); }

  // Cells of another kind follow.
  void begin(int workers);
  // One cell has ended.
  void ended();
  // The fraction of the time that has passed since the clock was made, if so many cells are left;
  // 0 before the first has ended.
  double part(double left) const;

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point made_ = Clock::now();
  Clock::time_point begun_;
  std::vector<double> ends_;
  std::int64_t done_ = 0;
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
