// SPDX-License-Identifier: MIT
// The times of the rows of a run.
//
// Equations   row k of a step is start + k step, of a count start + k (stop - start)/(count - 1).
// Units       the unit of time of the scenario.
// Domain      finite numbers; a step that leads from start towards stop; at most 2^53 rows. A row
//             that rounding puts beyond stop by a few units in the last place is kept.
// Accuracy    every time is rounded once, never accumulated: exactly, for a step; from
//             double-double, for a count.
// Errors      DomainError from the factories.
// Cost        a few flops per row.
#pragma once

#include <cstdint>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

class SaveAt {
 public:
  static SaveAt steps(double start, double stop, double step);
  static SaveAt count(double start, double stop, std::int64_t rows);
  static SaveAt times(std::vector<double> at);

  std::int64_t size() const { return size_; }
  double operator[](std::int64_t k) const;
  // Where a run along these rows ends: at `stop`, which may lie behind the last row of a step; at
  // the last row where rounding puts that beyond `stop`, and of a list.
  double end() const;
  // Whether the times are a list, in whatever order; steps and counts run one way.
  bool is_list() const { return !at_.empty(); }
  // What made steps and counts; a step of 0 is a count.
  double start() const { return start_; }
  double stop() const { return stop_; }
  double step() const { return step_; }

 private:
  SaveAt() = default;
  double start_ = 0.0;
  double stop_ = 0.0;
  double step_ = 0.0;  // 0: by count
  std::vector<double> at_;
  std::int64_t size_ = 0;
};

}  // namespace v0
}  // namespace polhode
