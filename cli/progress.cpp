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

ProgressLine::ProgressLine(double start, double stop, std::string unit)
    : start_(start),
      stop_(stop),
      from_(start),
      unit_(std::move(unit)),
      terminal_(isatty(STDERR_FILENO) == 1),
      next_(begun_ + quiet) {}

ProgressLine::ProgressLine(std::int64_t count, std::string things)
    : ProgressLine(0.0, static_cast<double>(count), std::move(things)) {
  form_ = Form::count;
}

ProgressLine::ProgressLine(std::string stage, std::string work)
    : ProgressLine(0.0, 1.0, std::move(stage)) {
  work_ = std::move(work);
  form_ = Form::part;
}

ProgressLine::~ProgressLine() {
  if (terminal_ && shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::operator()(double t) {
  if (steps_++ == 0) {
    from_ = t;
    begun_ = Clock::now();
    return;
  }
  if (form_ != Form::time || steps_ % stride == 0) look(t);
}

void ProgressLine::look(double t) {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? on_terminal : elsewhere);
  show(t, std::chrono::duration<double>(now - begun_).count());
}

void ProgressLine::show(double t, double seconds) {
  const double span = stop_ - start_;
  const auto part = [&](double x) { return span == 0.0 ? 0.0 : std::clamp(x / span, 0.0, 1.0); };
  const double done = part(t - start_), made = part(t - from_);
  const double rate = std::abs(t - from_) / seconds, percent = std::floor(100.0 * done);
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
    const std::string reached = form_ == Form::count
                                    ? fmt::format("{:.0f} of {:.0f} {}", t, stop_, unit_)
                                    : fmt::format("t = {:.6g} {}", t, unit_);
    text = fmt::format("{:3.0f} %, {}, {:.3g} {} per second", percent, reached, rate, unit_);
  }
  if (is_known) text += ", " + duration_text((1.0 - done) * seconds / made) + " left";
  if (terminal_) text = on_line(text, done, columns());
  shown_ = true;
  const std::string line = terminal_ ? "\r" + text + "\033[K" : text + "\n";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace polhode::cli
