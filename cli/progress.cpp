// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
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

int columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// "[#####.......] text": the text, or as much of it as the line has place for, and a bar where
// there is place for that too.
std::string on_line(const std::string& text, double done, int columns) {
  constexpr int shortest = 8, longest = 40;
  const int left = columns - 1 - static_cast<int>(text.size());  // a full line would wrap
  if (left < shortest + 3)
    return text.substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
  const int length = std::min(left - 3, longest);
  const auto filled = static_cast<std::size_t>(std::floor(done * length));
  return "[" + std::string(filled, '#') +
         std::string(static_cast<std::size_t>(length) - filled, '.') + "] " + text;
}

}  // namespace

ProgressLine::ProgressLine(Form form, double from, double stop, std::string unit)
    : form_(form),
      from_{from, 0.0},
      stop_(stop),
      unit_(std::move(unit)),
      terminal_(isatty(STDERR_FILENO) == 1),
      next_(begun_ + quiet) {}

ProgressLine::ProgressLine(double stop, std::string unit)
    : ProgressLine(Form::time, 0.0, stop, std::move(unit)) {}
ProgressLine::ProgressLine(double before, std::int64_t count, std::string things)
    : ProgressLine(Form::count, before, static_cast<double>(count), std::move(things)) {}
ProgressLine::ProgressLine(std::string stage, std::string work)
    : ProgressLine(Form::part, 0.0, 1.0, std::move(stage)) {
  work_ = std::move(work);
}

ProgressLine::~ProgressLine() {
  if (terminal_ && shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::begin_at(const io::RunProgress& at) {
  from_ = at;
  begun_ = Clock::now();
}

void ProgressLine::operator()(const io::RunProgress& at) {
  const std::int64_t step = steps_++;
  if (form_ == Form::time && step == 0) return begin_at(at);  // after it was prepared
  if (form_ == Form::time && step % stride != 0) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? on_terminal : elsewhere);
  show(at, std::chrono::duration<double>(now - begun_).count());
}

void ProgressLine::show(const io::RunProgress& at, double seconds) {
  const double done = stop_ == 0.0 ? 0.0 : std::clamp(at.reached / stop_, 0.0, 1.0);
  const double made = at.part - from_.part, percent = std::floor(100.0 * done);
  const bool is_known = made > 0.0;
  if (!work_.empty()) {
    std::string said = unit_ + ": " + work_;
    if (is_known) said += ", about " + duration_text(seconds / made);
    std::fputs((terminal_ ? "\r" + said + "\033[K\n" : said + "\n").c_str(), stderr);
    work_.clear();
  }
  std::string text;
  if (form_ == Form::part) {
    text = fmt::format("{}: {:.0f} %", unit_, percent);
  } else {
    const double rate = std::abs(at.reached - from_.reached) / seconds;
    const std::string reached = form_ == Form::count
                                    ? fmt::format("{:.0f} of {:.0f} {}", at.reached, stop_, unit_)
                                    : fmt::format("t = {:.6g} {}", at.reached, unit_);
    text = fmt::format("{:3.0f} %, {}, {:.3g} {} per second", percent, reached, rate, unit_);
  }
  if (is_known) text += ", " + duration_text((1.0 - at.part) * seconds / made) + " left";
  if (terminal_) text = on_line(text, done, columns());
  shown_ = true;
  const std::string line = terminal_ ? "\r" + text + "\033[K" : text + "\n";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace polhode::cli
