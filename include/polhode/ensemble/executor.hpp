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

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "polhode/ensemble/detail/erased_parallel_for.hpp"
#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace ensemble {

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

// ordered_parallel_for: one function for many indices, on the processors of one machine, results in
// order.
//
// Domain      `cell` may be called from any thread, for several indices at a time, and must depend
//             on its index alone; `sink` is called for first, first + 1, ... one after the other.
// Accuracy    the results are those of a plain loop, to the last bit, whatever the threads.
// Errors      DomainError for fewer than one thread. What `cell` or `sink` throws ends the rest and
//             passes through, after the rows before it: that of the first index, when several do.
// Cost        a microsecond a cell. At most four cells per thread wait for an earlier one, so that
//             memory does not grow with their number.

// How many threads this machine runs at a time.
int hardware_threads();

// sink(k, cell(k)) for the cells first to count - 1.
template <class Cell, class Sink>
void ordered_parallel_for(std::int64_t first, std::int64_t count, int threads, const Cell& cell,
                          const Sink& sink) {
  using Result = std::invoke_result_t<const Cell&, std::int64_t>;
  detail::erased_parallel_for(
      first, count, threads,
      [&](std::int64_t k) -> std::shared_ptr<const void> {
        return std::make_shared<const Result>(cell(k));
      },
      [&](std::int64_t k, const void* result) { sink(k, *static_cast<const Result*>(result)); });
}

// run_parts: one function for the parts of many items, on the processors of one machine.
//
// Domain      `part(begin, end)` may be called from any thread, for several parts at a time, and
//             does for each item what depends on that item alone: where a part begins depends on
//             the number of threads. `sink(begin, result)` is called part after part, in order.
// Accuracy    none of its own.
// Errors      DomainError for fewer than one thread. What `part` or `sink` throws ends the rest and
//             passes through: that of the first part, when several do.
// Cost        some microseconds a part, and tens to begin with; one part is a plain call.

// Items 0 to size - 1 in `count` parts of `each`, of which the last may be shorter.
struct Parts {
  std::size_t size, each;
  std::int64_t count;
};

// As many as keep so many threads at work until the end, of `least` items or a multiple of it.
Parts parts_for(std::size_t size, std::size_t least, int threads);

template <class Part, class Sink>
void run_parts(std::size_t size, std::size_t least, int threads, const Part& part,
               const Sink& sink) {
  const Parts parts = parts_for(size, least, threads);
  const auto begin = [&](std::int64_t k) { return static_cast<std::size_t>(k) * parts.each; };
  const auto result = [&](std::int64_t k) {
    return part(begin(k), std::min(size, begin(k) + parts.each));
  };
  if (parts.count == 0) return;
  if (parts.count == 1) return sink(std::size_t{0}, result(0));
  ordered_parallel_for(0, parts.count,
                       static_cast<int>(std::min<std::int64_t>(threads, parts.count)), result,
                       [&](std::int64_t k, const auto& found) { sink(begin(k), found); });
}

// For a function without a result.
template <class Part>
  requires std::is_void_v<std::invoke_result_t<const Part&, std::size_t, std::size_t>>
void run_parts(std::size_t size, std::size_t least, int threads, const Part& part) {
  const auto done = [&](std::size_t begin, std::size_t end) {
    part(begin, end);
    return true;
  };
  run_parts(size, least, threads, done, [](std::size_t, bool) {});
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
