// SPDX-License-Identifier: MIT
#include "polhode/ensemble/cells.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <string>
#include <utility>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::size_t waiting_per_thread = 4;

struct Done {
  std::int64_t index;
  std::shared_ptr<const void> result;
};

}  // namespace

int hardware_threads() { return tbb::info::default_concurrency(); }

namespace detail {

void run_erased_cells(std::int64_t first, std::int64_t count, int threads,
                      const std::function<std::shared_ptr<const void>(std::int64_t)>& cell,
                      const std::function<void(std::int64_t, const void*)>& sink) {
  if (threads < 1)
    throw DomainError("run_cells: threads " + std::to_string(threads) + " must be at least 1");
  std::int64_t next = first;
  const auto counted = tbb::make_filter<void, std::int64_t>(
      tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) -> std::int64_t {
        if (next < count) return next++;
        control.stop();
        return count;
      });
  const auto evaluated = tbb::make_filter<std::int64_t, Done>(tbb::filter_mode::parallel,
                                                              [&](std::int64_t index) -> Done {
                                                                return {index, cell(index)};
                                                              });
  const auto taken =
      tbb::make_filter<Done, void>(tbb::filter_mode::serial_in_order,
                                   [&](const Done& done) { sink(done.index, done.result.get()); });
  // as many as asked for, even beyond the processors
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_pipeline(waiting_per_thread * static_cast<std::size_t>(threads),
                           counted & evaluated & taken);
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
