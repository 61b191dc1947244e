// SPDX-License-Identifier: MIT
// PythonExecutor: the processes of an executor of Python as an Executor. A function of Python
// submits the cells and waits for what they give (python/polhode/_ensemble_executor.py); it is
// called in the thread of the loop, with the GIL.
#pragma once

#include <atomic>
#include <exception>
#include <functional>

#include "bindings.hpp"
#include "polhode/ensemble/executor.hpp"

namespace polhode::python {

class PythonExecutor : public Executor {
 public:
  // Called as function(stage, first, count, take, is_stopped). take(cell, bytes) is for cells in
  // order; it returns False, as is_stopped() returns True, when the function is to return.
  explicit PythonExecutor(nb::handle function) : function_(function.ptr()) {}

  // Of an executor nobody says how many work for this one.
  int processes() const override { return 1; }
  void run(ExecutorWork& work, const ExecutorStage& stage, const Take& take,
           const std::function<void()>& look) override;

  // Whether the function has raised; from any thread. The ensemble is then to stop, as at Ctrl-C.
  bool has_failed() const { return failed_.load(std::memory_order_relaxed); }
  // Throws what it has raised, if it has.
  void raise() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  PyObject* function_;
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;
};

}  // namespace polhode::python
