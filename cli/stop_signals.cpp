// SPDX-License-Identifier: MIT
#include "stop_signals.hpp"

#include <atomic>

namespace polhode::cli {
namespace {

// The threads of a map read it, too. A handler may write an atomic that needs no lock.
std::atomic<int> signal_that_came = 0;
static_assert(std::atomic<int>::is_always_lock_free);

void note(int signal) { signal_that_came = signal; }

// What the caller of the program ignores stays ignored (nohup, a shell's background job).
void watch(int signal, struct sigaction& old) {
  struct sigaction ours {};
  ours.sa_handler = note;
  ours.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigemptyset(&ours.sa_mask);
  sigaction(signal, nullptr, &old);
  if (old.sa_handler != SIG_IGN) sigaction(signal, &ours, nullptr);
}

}  // namespace

void let_large_writes_fail() { signal(SIGXFSZ, SIG_IGN); }

StopSignals::StopSignals() {
  signal_that_came = 0;
  watch(SIGINT, interrupt_);
  watch(SIGTERM, terminate_);
}

StopSignals::~StopSignals() {
  sigaction(SIGINT, &interrupt_, nullptr);
  sigaction(SIGTERM, &terminate_, nullptr);
}

int StopSignals::came() { return signal_that_came; }

}  // namespace polhode::cli
