// SPDX-License-Identifier: MIT
#include "interface/gil.hpp"

#include <atomic>

namespace polhode::python {

namespace {

std::atomic<int> threads_without(0);

// Not in a destructor itself: what a function that must not throw has to undo is never undone.
[[gnu::noinline]] void take_back(PyThreadState* state) {
  StaysPut guard;
  PyEval_RestoreThread(state);
  guard.disarm();
}

[[gnu::noinline]] PyGILState_STATE taken() {
  StaysPut guard;
  const PyGILState_STATE state = PyGILState_Ensure();
  guard.disarm();
  return state;
}

}  // namespace

WithGil::WithGil() : state_(taken()) {}

WithoutGil::WithoutGil() {
  ++threads_without;
  state_ = PyEval_SaveThread();
}

WithoutGil::~WithoutGil() {
  take_back(state_);
  --threads_without;
}

int WithoutGil::threads() { return threads_without; }

}  // namespace polhode::python
