// SPDX-License-Identifier: MIT
// Executor: processes that share the cells of one piece of work, as ordered_parallel_for shares
// them among threads. What a process must know comes as bytes, and so does what a cell gives.
//
// Domain      each process has an ExecutorWork of its own, made from the same input. The leader
//             runs stages one after the other: before the cells of a stage every process that
//             computes some of them begins it; `cell` may be called from any thread, for several
//             indices at a time, and must depend on the stage and its index alone. `take` is called
//             on the leader for first, first + 1, ... one after the other.
// Accuracy    the results are those of a plain loop, to the last bit, whoever computes a cell.
// Errors      what a cell or `take` throws ends the stage, after the cells before it: that of the
//             first index. What another process throws arrives as an ExecutorError with its
//             message. What `look` throws ends the stage at once and passes through.
// Cost        that of the cells and of their bytes. With MPI at most four cells for each that is
//             computed at a time wait for an earlier one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

class ExecutorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ExecutorWork {
 public:
  virtual ~ExecutorWork() = default;
  virtual void begin(const std::string& stage) = 0;
  // `look` is called now and then; what it throws passes through.
  virtual std::string cell(std::int64_t index, const std::function<void()>& look) const = 0;
};

struct ExecutorStage {
  std::string bytes;  // what begin() gets
  std::int64_t first = 0;
  std::int64_t count = 0;  // the cells are first to count - 1
};

class Executor {
 public:
  virtual ~Executor() = default;
  // How many processes compute cells.
  virtual int processes() const = 0;
  // How many cells they compute at a time.
  virtual int at_a_time() const { return processes(); }
  using Take = std::function<void(std::int64_t cell, const std::string& bytes)>;
  // On the leader, whose own `work` it may use too.
  virtual void run(ExecutorWork& work, const ExecutorStage& stage, const Take& take,
                   const std::function<void()>& look) = 0;
};

// Every process is this same program, such as those that mpirun starts.
class Ranks : public Executor {
 public:
  virtual bool leads() const = 0;
  // On those that do not lead: computes cells until the leader is gone. What `make` throws is told
  // to the leader.
  using MakeWork = std::function<std::unique_ptr<ExecutorWork>()>;
  virtual void serve(const MakeWork& make) = 0;
};

}  // namespace v0
}  // namespace polhode
