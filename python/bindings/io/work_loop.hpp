// SPDX-License-Identifier: MIT
// WorkLoop: work that takes long, a run, a map, an ensemble or a fit, which stops at Ctrl-C. Only
// the thread that called runs Python's listener and its handlers of signals. Work on several
// threads has one more, and the caller waits for it; a run stays in the thread of the caller, since
// one more would take longer than a short run.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>

#include "bindings.hpp"
#include "interface/signals.hpp"
#include "polhode/run/scenario_run.hpp"

namespace polhode::python {

class WorkLoop {
 public:
  // Called with the progress of the work, holding the GIL; empty if nobody listens.
  using Tell = std::function<void(double reached)>;
  explicit WorkLoop(std::string said_when_stopped, Tell tell = {});

  // With the GIL, which it gives up: `work` from beginning to end. What Python raises meanwhile
  // stops it, and is thrown; then what `work` has thrown.
  void do_work(const std::function<void()>& work);
  // The same in this thread, the only one that asks is_stopped().
  void do_work_here(const std::function<void()>& work);

  // Options by which the work can be stopped and reports its progress.
  void listen(io::RunOptions& options) {
    options.stop = [this] { return is_stopped(); };
    options.progress = [this](const io::RunProgress& at) { reach(at.reached); };
  }

  // In the work, from any thread.
  bool is_stopped();
  // The same, for work that throws when it shall end.
  void go_on() {
    if (is_stopped()) throw std::runtime_error(said_when_stopped_);
  }
  // In the work, one call after the other: waits until the listener has returned or raised.
  void tell(double done);
  // The same, for work that throws when it shall end.
  void reach(double done) {
    tell(done);
    go_on();
  }

 private:
  using Clock = std::chrono::steady_clock;

  void wait();
  void end(std::exception_ptr failure);
  std::exception_ptr asked(bool tell, double done);
  void ask_signals();
  void finish() const;
  // Calls f(); an exception from it stops the work.
  template <class F>
  void call_here(const F& f);

  std::string said_when_stopped_;
  Tell tell_;
  bool handles_signals_;
  bool is_here_ = false;
  SignalCheck signals_;  // of work in the thread of the caller
  Clock::time_point asked_ = Clock::now();
  std::mutex mutex_;
  std::condition_variable changed_;
  double reached_ = 0.0;
  double told_ = 0.0;
  std::atomic<bool> stopped_ = false;
  bool ended_ = false;
  std::exception_ptr raised_;
  std::exception_ptr failure_;
};

// Calls a function of Python, which outlives it, with what is done and with the whole; empty for
// None.
WorkLoop::Tell count_to(nb::handle progress, std::int64_t whole);

}  // namespace polhode::python
