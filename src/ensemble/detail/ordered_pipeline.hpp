// SPDX-License-Identifier: MIT
// The pipeline of ordered_parallel_for on oneTBB. Alone in its file, so that tests/tsan.supp can
// name it.
#pragma once

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__SANITIZE_THREAD__)
#define POLHODE_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define POLHODE_THREAD_SANITIZER 1
#endif
#endif
#ifdef POLHODE_THREAD_SANITIZER
extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}
#endif

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

// ThreadSanitizer does not see into the distribution's oneTBB, which orders what stages of a
// pipeline do: all before publish(key) happens before all after observe(key).
#ifdef POLHODE_THREAD_SANITIZER
inline void publish(char* key) { __tsan_release(key); }
inline void observe(char* key) { __tsan_acquire(key); }
#else
inline void publish(char*) {}
inline void observe(char*) {}
#endif

// cells.next() until it is cells.none, one call after the other; cells.evaluate(index) on any
// thread; cells.take(index) in order, one call after the other. At most at_a_time indices are
// between the first and the last. None of the three may throw.
template <class Cells>
void run_pipeline(Cells& cells, int threads, std::size_t at_a_time) {
  std::vector<char> keys(at_a_time + 2);
  char* const token = keys.data();
  char* const counting = token + at_a_time;
  char* const taking = counting + 1;
  const auto counted = tbb::make_filter<void, std::int64_t>(
      tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) -> std::int64_t {
        observe(counting);
        const std::int64_t index = cells.next();
        if (index == Cells::none) {
          control.stop();
        } else {
          observe(token +
                  static_cast<std::size_t>(index) % at_a_time);  // at_a_time before this one
          publish(token + static_cast<std::size_t>(index) % at_a_time);
        }
        publish(counting);
        return index;
      });
  const auto evaluated = tbb::make_filter<std::int64_t, std::int64_t>(
      tbb::filter_mode::parallel, [&](std::int64_t index) -> std::int64_t {
        observe(token + static_cast<std::size_t>(index) % at_a_time);
        cells.evaluate(index);
        publish(token + static_cast<std::size_t>(index) % at_a_time);
        return index;
      });
  const auto taken = tbb::make_filter<std::int64_t, void>(
      tbb::filter_mode::serial_in_order, [&](std::int64_t index) {
        observe(token + static_cast<std::size_t>(index) % at_a_time);
        observe(taking);
        cells.take(index);
        publish(token + static_cast<std::size_t>(index) % at_a_time);
        publish(taking);  // last: the end of the pipeline observes it
      });
  // as many as asked for, even beyond the processors
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  publish(counting);
  arena.execute([&] { tbb::parallel_pipeline(at_a_time, counted & evaluated & taken); });
  observe(counting);
  observe(taking);
}

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
