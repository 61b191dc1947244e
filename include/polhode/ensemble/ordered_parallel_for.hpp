// SPDX-License-Identifier: MIT
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
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>

#include "polhode/ensemble/detail/erased_parallel_for.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
