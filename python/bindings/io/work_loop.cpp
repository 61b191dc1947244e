// SPDX-License-Identifier: MIT
#include "io/work_loop.hpp"

#include <stdexcept>
#include <thread>
#include <utility>

#include "interface/gil.hpp"
#include "interface/signals.hpp"

namespace polhode::python {

namespace {

constexpr std::chrono::milliseconds between_looks(20);

}  // namespace

WorkLoop::WorkLoop(std::string said_when_stopped, nb::handle progress)
    : said_when_stopped_(std::move(said_when_stopped)),
      progress_(progress.is_none() ? nullptr : progress.ptr()),
      handles_signals_(handles_signals()) {}

void WorkLoop::do_work(std::int64_t of, const std::function<void()>& work) {
  {
    const WithoutGil released;
    std::thread thread([&] {
      std::exception_ptr failure;
      try {
        work();
      } catch (...) {
        failure = std::current_exception();
      }
      end(std::move(failure));
    });
    wait(of);
    thread.join();
  }
  if (raised_) std::rethrow_exception(raised_);
  if (failure_) std::rethrow_exception(failure_);
}

void WorkLoop::reach(std::int64_t done) {
  std::unique_lock<std::mutex> lock(mutex_);
  reached_ = done;
  if (progress_ == nullptr) return;
  changed_.notify_all();
  changed_.wait(lock, [&] { return told_ == reached_ || is_stopped(); });
  go_on();
}

void WorkLoop::end(std::exception_ptr failure) {
  const std::lock_guard<std::mutex> lock(mutex_);
  failure_ = std::move(failure);
  ended_ = true;
  changed_.notify_all();
}

// Without the GIL, until the work has ended.
void WorkLoop::wait(std::int64_t of) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto tells = [&] { return progress_ != nullptr && told_ != reached_ && !is_stopped(); };
  while (!ended_) {
    changed_.wait_for(lock, between_looks, [&] { return ended_ || tells(); });
    if (ended_ || is_stopped()) continue;
    const bool tell = tells();
    const std::int64_t done = reached_;
    lock.unlock();
    const std::exception_ptr raised = asked(tell, done, of);
    lock.lock();
    if (tell) told_ = done;
    if (raised) {
      raised_ = raised;
      stopped_ = true;
    }
    changed_.notify_all();
  }
}

std::exception_ptr WorkLoop::asked(bool tell, std::int64_t done, std::int64_t of) {
  try {
    if (tell) {
      const WithGil acquired;
      staying_put([&] { return nb::handle(progress_)(done, of); });
    }
    ask_signals();
  } catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

// By the clock, since the thread also wakes for everything that is done.
void WorkLoop::ask_signals() {
  if (!handles_signals_ || Clock::now() - asked_ < between_looks) return;
  const WithGil acquired;
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
  asked_ = Clock::now();  // the GIL may have been waited for
}

}  // namespace polhode::python
