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

WorkLoop::WorkLoop(std::string said_when_stopped, Tell tell)
    : said_when_stopped_(std::move(said_when_stopped)),
      tell_(std::move(tell)),
      handles_signals_(handles_signals()) {}

void WorkLoop::do_work(const std::function<void()>& work) {
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
    wait();
    thread.join();
  }
  finish();
}

void WorkLoop::do_work_here(const std::function<void()>& work) {
  is_here_ = true;
  try {
    const WithoutGil released;
    work();
  } catch (...) {
    failure_ = std::current_exception();
  }
  finish();
}

void WorkLoop::finish() const {
  if (raised_) std::rethrow_exception(raised_);
  if (failure_) std::rethrow_exception(failure_);
}

template <class F>
void WorkLoop::call_here(const F& f) {
  if (stopped_) return;
  try {
    f();
  } catch (...) {
    raised_ = std::current_exception();
    stopped_ = true;
  }
}

bool WorkLoop::is_stopped() {
  if (is_here_ && handles_signals_) call_here([this] { signals_(); });
  return stopped_.load(std::memory_order_relaxed);
}

void WorkLoop::tell(double done) {
  if (!tell_) return;
  if (is_here_)
    return call_here([&] {
      const WithGil acquired;
      tell_(done);
    });
  std::unique_lock<std::mutex> lock(mutex_);
  reached_ = done;
  changed_.notify_all();
  changed_.wait(lock, [&] { return told_ == reached_ || is_stopped(); });
}

void WorkLoop::end(std::exception_ptr failure) {
  const std::lock_guard<std::mutex> lock(mutex_);
  failure_ = std::move(failure);
  ended_ = true;
  changed_.notify_all();
}

// Without the GIL, until the work has ended.
void WorkLoop::wait() {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto tells = [&] { return tell_ && told_ != reached_ && !is_stopped(); };
  while (!ended_) {
    changed_.wait_for(lock, between_looks, [&] { return ended_ || tells(); });
    if (ended_ || is_stopped()) continue;
    const bool tell = tells();
    const double done = reached_;
    lock.unlock();
    const std::exception_ptr raised = asked(tell, done);
    lock.lock();
    if (tell) told_ = done;
    if (raised) {
      raised_ = raised;
      stopped_ = true;
    }
    changed_.notify_all();
  }
}

std::exception_ptr WorkLoop::asked(bool tell, double done) {
  try {
    if (tell) {
      const WithGil acquired;
      tell_(done);
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

WorkLoop::Tell count_to(nb::handle progress, std::int64_t whole) {
  if (progress.is_none()) return {};
  return [function = progress.ptr(), whole](double done) {
    staying_put([&] { return nb::handle(function)(static_cast<std::int64_t>(done), whole); });
  };
}

}  // namespace polhode::python
