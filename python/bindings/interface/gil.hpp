// SPDX-License-Identifier: MIT
// Taking and giving up the GIL in threads that the interpreter may leave behind (daemon threads).
#pragma once

#include <chrono>
#include <thread>

#include "bindings.hpp"

namespace polhode::python {

// Before 3.14, Python ends a thread that wants the GIL after the interpreter's end, by unwinding
// its stack: through functions that must not throw, which ends the whole process with a complaint.
// A thread that is unwound over one of these waits for the end of the process, as from 3.14 on.
class StaysPut {
 public:
  StaysPut() = default;
  StaysPut(const StaysPut&) = delete;
  StaysPut& operator=(const StaysPut&) = delete;
  ~StaysPut() {
    while (armed_) std::this_thread::sleep_for(std::chrono::hours(1));
  }
  // Called where the stack was not unwound, or by an exception of C++.
  void disarm() { armed_ = false; }

 private:
  bool armed_ = true;
};

// f(), which runs Python code: a thread is also ended between two instructions of that.
template <class F>
auto staying_put(F f) {
  StaysPut guard;
  try {
    auto result = f();
    guard.disarm();
    return result;
  } catch (const std::exception&) {  // not (...), which would catch the unwinding
    guard.disarm();
    throw;
  }
}

class WithGil {
 public:
  WithGil();
  WithGil(const WithGil&) = delete;
  WithGil& operator=(const WithGil&) = delete;
  ~WithGil() { PyGILState_Release(state_); }

 private:
  PyGILState_STATE state_;
};

class WithoutGil {
 public:
  WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;
  ~WithoutGil();

  // Threads that have given up the GIL and have not got it back for good.
  static int threads();

 private:
  PyThreadState* state_;
};

}  // namespace polhode::python
