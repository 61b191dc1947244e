// SPDX-License-Identifier: MIT
// When to make a checkpoint.
#pragma once

#include <algorithm>
#include <chrono>

namespace polhode {
inline namespace v0 {
namespace detail {

// Looks at the clock after every 1 to 64 steps, and leaves most of the
// time to the run.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Pace(double seconds) : seconds_(std::max(seconds, 0.0)) { wait(0.0); }
  bool due() {
    if (--calls_left_ > 0) return false;
    const Clock::time_point now = Clock::now();
    if (now - looked_ < std::chrono::microseconds(200)) stride_ = std::min(2 * stride_, 64);
    if (now - looked_ > std::chrono::microseconds(2000)) stride_ = 1;
    calls_left_ = stride_;
    looked_ = now;
    return now >= next_;
  }
  void made(Clock::time_point begun) {
    wait(std::chrono::duration<double>(Clock::now() - begun).count() / share);
  }

 private:
  static constexpr double share = 0.05;  // of the time that checkpoints may take

  void wait(double least) {
    const std::chrono::duration<double> pause(std::min(std::max(seconds_, least), 1e9));
    next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(pause);
  }

  double seconds_;
  int stride_ = 1;
  int calls_left_ = 1;
  Clock::time_point looked_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
