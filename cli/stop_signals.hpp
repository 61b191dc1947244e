// SPDX-License-Identifier: MIT
// Ctrl-C and SIGTERM while a run goes on: noted, and looked at by the run between two steps. A
// second one ends the process at once. And the signal of a file that may not grow.
#pragma once

#include <signal.h>

namespace polhode::cli {

// A write beyond the limit on the size of files (ulimit -f) fails, instead of ending the process.
void let_large_writes_fail();

class StopSignals {
 public:
  StopSignals();
  // As it was before.
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // The signal that came; 0: none.
  static int came();

 private:
  struct sigaction interrupt_ {};
  struct sigaction terminate_ {};
};

}  // namespace polhode::cli
