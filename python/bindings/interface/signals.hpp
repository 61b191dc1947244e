// SPDX-License-Identifier: MIT
// Ctrl-C in long runs: a look at Python's signals some fifty times a second, from code that runs
// without the GIL.
#pragma once

#include <chrono>

#include "bindings.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode::python {

// Called after every step of a run, in whatever time a step takes: it reads a clock every so many
// calls, and asks Python every 20 ms. Throws what the handler of a signal raised.
class SignalCheck {
 public:
  void operator()() {
    if (--calls_left_ == 0) read_clock();
  }

 private:
  using Clock = std::chrono::steady_clock;
  void read_clock();

  int stride_ = 1;  // calls between two readings
  int calls_left_ = 1;
  Clock::time_point read_ = Clock::now();
  Clock::time_point asked_ = read_;
};

// Whether this is the main thread, which alone handles signals. With the GIL.
bool handles_signals();

// A listener that raises KeyboardInterrupt. Empty outside the main thread, which alone handles
// signals: runs in other threads never wait for the GIL. With the GIL.
Progress signal_check();

// True for about ten calls a second of those after every step.
class Seldom {
 public:
  bool operator()();

 private:
  int calls_ = 0;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// A listener that calls a function of Python with the time; empty for None. The function outlives
// the run.
Progress time_listener(nb::handle function);
// The same about ten times a second.
Progress progress_to(nb::handle function);

}  // namespace polhode::python
