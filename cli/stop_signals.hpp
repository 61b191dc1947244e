// SPDX-License-Identifier: MIT
// Ctrl-C and SIGTERM while a run goes on: noted, and looked at by the run between two steps. A
// second one ends the process at once.
#pragma once

#include <signal.h>

namespace polhode::cli {

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
