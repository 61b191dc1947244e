// SPDX-License-Identifier: MIT
// How far a long run has come, on standard error: a bar that is written over on a terminal, as wide
// as that is; a plain line now and then elsewhere. Silent for the first seconds, so that short runs
// stay clean.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "polhode/run/scenario_run.hpp"

namespace polhode::cli {

class ProgressLine {
 public:
  // A run to t = stop, in the unit of time `unit`.
  ProgressLine(double stop, std::string unit);
  // So many "members", of which some were done before.
  ProgressLine(double before, std::int64_t count, std::string things);
  // Parts, up to 1, of a "scan". Where it takes seconds its work is said first, with an estimate.
  ProgressLine(std::string stage, std::string work);
  // Leaves a terminal clean.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void operator()(const io::RunProgress& at);
  // The time that is left is measured from here on.
  void begin_at(const io::RunProgress& at);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Form { time, count, part };
  ProgressLine(Form form, double from, double stop, std::string unit);
  void show(const io::RunProgress& at, double seconds);

  Form form_;
  io::RunProgress from_;  // since when time is taken
  double stop_;
  std::string unit_;
  std::string work_;
  bool terminal_;
  bool shown_ = false;
  std::int64_t steps_ = 0;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace polhode::cli
