// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace polhode::cli {

namespace {

using std::chrono::milliseconds;

// Steps between two looks at the clock, which costs a tenth of the cheapest step.
constexpr std::int64_t stride = 16;
constexpr milliseconds quiet(2000), on_terminal(200), elsewhere(30000);

// "8 s", "12 min", "3.5 h"
std::string duration_text(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5970.0) return fmt::format("{:.0f} min", seconds / 60.0);
  if (seconds < 172800.0) return fmt::format("{:.1f} h", seconds / 3600.0);
  return fmt::format("{:.1f} d", seconds / 86400.0);
}

}  // namespace

ProgressLine::ProgressLine(double start, double stop, std::string unit)
    : start_(start),
      stop_(stop),
      unit_(std::move(unit)),
      terminal_(isatty(STDERR_FILENO) == 1),
      next_(begun_ + quiet) {}

ProgressLine::~ProgressLine() {
  if (terminal_ && shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::operator()(double t) {
  if (++steps_ % stride == 0) look(t);
}

void ProgressLine::look(double t) {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? on_terminal : elsewhere);
  show(t, std::chrono::duration<double>(now - begun_).count());
}

void ProgressLine::show(double t, double seconds) {
  const double done = stop_ == start_ ? 0.0 : std::clamp((t - start_) / (stop_ - start_), 0.0, 1.0);
  const double rate = std::abs(t - start_) / seconds;
  std::string text = fmt::format("{:3.0f} %, t = {:.6g} {}, {:.3g} {} per second",
                                 std::floor(100.0 * done), t, unit_, rate, unit_);
  if (done > 0.0) text += ", " + duration_text(seconds / done - seconds) + " left";
  shown_ = true;
  const std::string line = terminal_ ? "\r" + text + "\033[K" : text + "\n";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace polhode::cli
