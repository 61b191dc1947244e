// SPDX-License-Identifier: MIT
// How far a long run has come, on standard error: a bar that is written over on a terminal, as wide
// as that is; a plain line now and then elsewhere. Silent for the first seconds, so that short runs
// stay clean.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace polhode::cli {

class ProgressLine {
 public:
  // From start to stop, in the unit of time `unit` names.
  ProgressLine(double start, double stop, std::string unit);
  // So many "members".
  ProgressLine(std::int64_t count, std::string things);
  // Parts, up to 1, of a "scan". Where it takes seconds its work is said first, with an estimate.
  ProgressLine(std::string stage, std::string work);
  // Leaves a terminal clean.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // The run has reached time t.
  void operator()(double t);

 private:
  using Clock = std::chrono::steady_clock;
  void look(double t);
  void show(double t, double seconds);

  double start_;
  double stop_;
  double from_;  // at the first call, from which the rate is measured
  std::string unit_;
  std::string work_;
  enum class Form { time, count, part };
  Form form_ = Form::time;
  bool terminal_;
  bool shown_ = false;
  std::int64_t steps_ = 0;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace polhode::cli
