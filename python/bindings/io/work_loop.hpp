// SPDX-License-Identifier: MIT
// WorkLoop: work that takes long, a map or an ensemble, in a thread of its own. The thread that
// called waits for it, and alone runs Python: the function that hears how far the work is, and
// handlers of signals.
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
#include "polhode/run/resumable_run.hpp"

namespace polhode::python {

class WorkLoop {
 public:
  // `progress` is called with what is done and with the whole; None: nobody is.
  WorkLoop(std::string said_when_stopped, nb::handle progress);

  // With the GIL, which it gives up: `work`, of so many things, from beginning to end. What Python
  // raises meanwhile stops it, and is thrown; then what `work` has thrown.
  void do_work(std::int64_t of, const std::function<void()>& work);

  // Options by which the work can be stopped and reports its progress.
  void listen(RunOptions& options) {
    options.stop = [this] { return is_stopped(); };
    options.progress = [this](const RunProgress& at) {
      reach(static_cast<std::int64_t>(at.reached));
    };
  }

  // In the work, from any thread.
  bool is_stopped() const { return stopped_.load(std::memory_order_relaxed); }
  // The same, for work that throws when it shall end.
  void go_on() const {
    if (is_stopped()) throw std::runtime_error(said_when_stopped_);
  }
  // In the work, one call after the other: goes on when the function has returned; throws where it
  // has not.
  void reach(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;

  void wait(std::int64_t of);
  void end(std::exception_ptr failure);
  std::exception_ptr asked(bool tell, std::int64_t done, std::int64_t of);
  void ask_signals();

  std::string said_when_stopped_;
  PyObject* progress_;
  bool handles_signals_;
  Clock::time_point asked_ = Clock::now();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t reached_ = 0;
  std::int64_t told_ = 0;
  std::atomic<bool> stopped_ = false;
  bool ended_ = false;
  std::exception_ptr raised_;
  std::exception_ptr failure_;
};

}  // namespace polhode::python
