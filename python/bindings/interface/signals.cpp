// SPDX-License-Identifier: MIT
#include "interface/signals.hpp"

#include <algorithm>

#include "interface/gil.hpp"

namespace polhode::python {

namespace {

using std::chrono::microseconds;

// A clock costs 25 ns, the fastest step 300: a reading per 64 steps is not seen. Slow steps are
// looked at one by one.
constexpr int longest_stride = 64;
constexpr microseconds fast(200), slow(2000);
constexpr microseconds between_questions(20000);

}  // namespace

void SignalCheck::read_clock() {
  const Clock::time_point now = Clock::now();
  if (now - read_ < fast) stride_ = std::min(2 * stride_, longest_stride);
  if (now - read_ > slow) stride_ = 1;
  calls_left_ = stride_;
  read_ = now;
  if (now - asked_ < between_questions) return;
  const WithGil acquired;
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
  asked_ = Clock::now();  // the GIL may have been waited for
}

bool handles_signals() {
  const nb::module_ threading = nb::module_::import_("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

Progress signal_check() {
  if (!handles_signals()) return {};
  return [check = SignalCheck()](double) mutable { check(); };
}

bool Seldom::operator()() {
  if (++calls_ % 16 != 0) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return false;
  last_ = now;
  return true;
}

Progress time_listener(nb::handle function) {
  if (function.is_none()) return {};
  if (PyCallable_Check(function.ptr()) == 0)
    throw nb::type_error("progress: expected a function of the time");
  return [f = function.ptr()](double t) {
    const WithGil acquired;
    staying_put([&] { return nb::handle(f)(t); });
  };
}

Progress progress_to(nb::handle function) {
  const Progress told = time_listener(function);
  if (!told) return {};
  return [told, seldom = Seldom()](double t) mutable {
    if (seldom()) told(t);
  };
}

}  // namespace polhode::python
