// SPDX-License-Identifier: MIT
#include "polhode/ensemble/cells.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::size_t waiting_per_thread = 4;

// What a cell leaves for the sink. The pipeline passes indices: it frees no token of a function
// that throws, so that it may own nothing.
struct Slot {
  std::shared_ptr<const void> result;
  std::exception_ptr failure;
  std::atomic<bool> ready = false;
};

// One run. Its atomics order all that goes from the caller to the cells, from there to the sink and
// back: the pipeline does so too, but a sanitizer cannot see into the library.
class Cells {
 public:
  Cells(std::int64_t first, std::int64_t count, std::size_t at_a_time,
        const std::function<std::shared_ptr<const void>(std::int64_t)>& cell,
        const std::function<void(std::int64_t, const void*)>& sink)
      : cell_(cell), sink_(sink), next_(first), stop_(count), slots_(at_a_time), taken_(first) {}

  // The next index, or `none` after the last one; one call after the other.
  static constexpr std::int64_t none = -1;
  std::int64_t next() {
    const std::int64_t index = next_.load();
    if (index >= stop_.load()) return none;
    next_.store(index + 1);
    return index;
  }

  // From any thread.
  void evaluate(std::int64_t index) noexcept {
    taken_.load();
    Slot& slot = slot_of(index);
    try {
      if (index < stop_.load()) slot.result = cell_(index);
    } catch (...) {
      slot.failure = std::current_exception();
      end_before(index);
    }
    slot.ready.store(true);
  }

  // In the order of indices, one call after the other.
  void take(std::int64_t index) noexcept {
    taken_.load();
    Slot& slot = slot_of(index);
    slot.ready.exchange(false);
    const std::shared_ptr<const void> result = std::move(slot.result);
    if (!failure_) failure_ = std::exchange(slot.failure, nullptr);
    try {
      if (!failure_) sink_(index, result.get());
    } catch (...) {
      failure_ = std::current_exception();
      end_before(index);
    }
    taken_.store(index + 1);
  }

  void finish() {
    taken_.load();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  Slot& slot_of(std::int64_t index) {
    return slots_[static_cast<std::size_t>(index) % slots_.size()];
  }
  // No cell of this index or after it is needed any more; those before it are.
  void end_before(std::int64_t index) {
    std::int64_t stop = stop_.load();
    while (index < stop && !stop_.compare_exchange_weak(stop, index)) {
    }
  }

  const std::function<std::shared_ptr<const void>(std::int64_t)>& cell_;
  const std::function<void(std::int64_t, const void*)>& sink_;
  std::atomic<std::int64_t> next_;
  std::atomic<std::int64_t> stop_;
  std::vector<Slot> slots_;  // of the cells in flight, which follow each other
  std::atomic<std::int64_t> taken_;
  std::exception_ptr failure_;
};

}  // namespace

int hardware_threads() { return tbb::info::default_concurrency(); }

namespace detail {

void run_erased_cells(std::int64_t first, std::int64_t count, int threads,
                      const std::function<std::shared_ptr<const void>(std::int64_t)>& cell,
                      const std::function<void(std::int64_t, const void*)>& sink) {
  if (threads < 1)
    throw DomainError("run_cells: threads " + std::to_string(threads) + " must be at least 1");
  const std::size_t at_a_time = waiting_per_thread * static_cast<std::size_t>(threads);
  Cells cells(first, count, at_a_time, cell, sink);
  const auto counted = tbb::make_filter<void, std::int64_t>(
      tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) -> std::int64_t {
        const std::int64_t index = cells.next();
        if (index == Cells::none) control.stop();
        return index;
      });
  const auto evaluated = tbb::make_filter<std::int64_t, std::int64_t>(
      tbb::filter_mode::parallel, [&](std::int64_t index) -> std::int64_t {
        cells.evaluate(index);
        return index;
      });
  const auto taken = tbb::make_filter<std::int64_t, void>(
      tbb::filter_mode::serial_in_order, [&](std::int64_t index) { cells.take(index); });
  // as many as asked for, even beyond the processors
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] { tbb::parallel_pipeline(at_a_time, counted & evaluated & taken); });
  cells.finish();
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
