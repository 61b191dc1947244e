// SPDX-License-Identifier: MIT
#include <tbb/info.h>

#include <atomic>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "ensemble/detail/ordered_pipeline.hpp"
#include "polhode/ensemble/executor.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace {

constexpr std::size_t waiting_per_thread = 4;

// What a cell leaves for the sink. The pipeline passes indices alone: oneTBB does not free what is
// in flight when a function throws.
struct Slot {
  std::shared_ptr<const void> result;
  std::exception_ptr failure;
};

class Cells {
 public:
  Cells(std::int64_t first, std::int64_t count, std::size_t at_a_time,
        const std::function<std::shared_ptr<const void>(std::int64_t)>& cell,
        const std::function<void(std::int64_t, const void*)>& sink)
      : cell_(cell), sink_(sink), next_(first), stop_(count), slots_(at_a_time) {}

  // The next index, or `none` after the last one.
  static constexpr std::int64_t none = -1;
  std::int64_t next() noexcept { return next_ < stop_ ? next_++ : none; }

  void evaluate(std::int64_t index) noexcept {
    Slot& slot = slot_of(index);
    try {
      if (index < stop_) slot.result = cell_(index);
    } catch (...) {
      slot.failure = std::current_exception();
      end_before(index);
    }
  }

  void take(std::int64_t index) noexcept {
    const Slot done = std::exchange(slot_of(index), {});
    if (!failure_) failure_ = done.failure;
    try {
      if (!failure_) sink_(index, done.result.get());
    } catch (...) {
      failure_ = std::current_exception();
      end_before(index);
    }
  }

  void finish() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  Slot& slot_of(std::int64_t index) {
    return slots_[static_cast<std::size_t>(index) % slots_.size()];
  }
  // Cells of this index and after it are not needed any more; those before it are.
  void end_before(std::int64_t index) {
    std::int64_t stop = stop_;
    while (index < stop && !stop_.compare_exchange_weak(stop, index)) {
    }
  }

  const std::function<std::shared_ptr<const void>(std::int64_t)>& cell_;
  const std::function<void(std::int64_t, const void*)>& sink_;
  std::int64_t next_;
  std::atomic<std::int64_t> stop_;
  std::vector<Slot> slots_;     // of the cells in flight, which follow each other
  std::exception_ptr failure_;  // of the first index that has one
};

}  // namespace

int hardware_threads() { return tbb::info::default_concurrency(); }

namespace detail {

void erased_parallel_for(std::int64_t first, std::int64_t count, int threads,
                         const std::function<std::shared_ptr<const void>(std::int64_t)>& cell,
                         const std::function<void(std::int64_t, const void*)>& sink) {
  if (threads < 1)
    throw DomainError("ordered_parallel_for: threads " + std::to_string(threads) +
                      " must be at least 1");
  const std::size_t at_a_time = waiting_per_thread * static_cast<std::size_t>(threads);
  Cells cells(first, count, at_a_time, cell, sink);
  run_pipeline(cells, threads, at_a_time);
  cells.finish();
}

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
