// SPDX-License-Identifier: MIT
// PythonExecutor: the processes of an executor of Python as an Executor. A function of Python
// submits the cells and waits for what they give (python/polhode/_executor.py); it is called in the
// thread of the loop, with the GIL.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "io/work_loop.hpp"
#include "polhode/ensemble/executor.hpp"
#include "polhode/run/scenario_run.hpp"

namespace polhode::python {

class PythonExecutor : public ensemble::Executor {
 public:
  // Called as function(stage, first, count, take, is_stopped). take(cell, bytes) is for cells in
  // order; it returns False, as is_stopped() returns True, when the function is to return.
  explicit PythonExecutor(nb::handle function) : function_(function.ptr()) {}

  // Of an executor nobody says how many work for this one.
  int processes() const override { return 1; }
  void run(ensemble::ExecutorWork& work, const ensemble::ExecutorStage& stage, const Take& take,
           const std::function<void()>& look) override;

  // True if the function has raised: the work must stop, as at Ctrl-C. Asked from any thread.
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

// A loop of a map or an ensemble, on threads or on an executor of Python.
class ExecutorLoop {
 public:
  // `executor`: the function of a PythonExecutor, or None.
  ExecutorLoop(std::string said_when_stopped, WorkLoop::Tell tell, nb::handle executor)
      : loop_(std::move(said_when_stopped), std::move(tell)),
        workers_(executor),
        has_workers_(!executor.is_none()) {}

  void listen(io::RunOptions& options) {
    loop_.listen(options);
    if (!has_workers_) return;
    options.executor = &workers_;
    options.stop = [this] { return loop_.is_stopped() || workers_.has_failed(); };
  }
  // As WorkLoop does; also throws what the function of the executor has raised.
  void do_work(const std::function<void()>& work);

 private:
  WorkLoop loop_;
  PythonExecutor workers_;
  bool has_workers_;
};

// A worker's map or ensemble: _ExecutorWork.
struct WorkerCells {
  std::unique_ptr<ensemble::ExecutorWork> work;
};

}  // namespace polhode::python
