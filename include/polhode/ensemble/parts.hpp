// SPDX-License-Identifier: MIT
// run_parts: one function for the parts of many items, on the processors of one machine.
//
// Domain      `part(begin, end)` may be called from any thread, for several parts at a time, and
//             does for each item what depends on that item alone: where a part begins depends on
//             the number of threads. `sink(begin, result)` is called part after part, in order.
// Accuracy    none of its own.
// Errors      DomainError for fewer than one thread. What `part` or `sink` throws ends the rest and
//             passes through: that of the first part, when several do.
// Cost        some microseconds a part, and tens to begin with; one part is a plain call.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "polhode/ensemble/ordered_parallel_for.hpp"

namespace polhode {
inline namespace v0 {

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

// Of a function that returns nothing.
template <class Part>
  requires std::is_void_v<std::invoke_result_t<const Part&, std::size_t, std::size_t>>
void run_parts(std::size_t size, std::size_t least, int threads, const Part& part) {
  const auto done = [&](std::size_t begin, std::size_t end) {
    part(begin, end);
    return true;
  };
  run_parts(size, least, threads, done, [](std::size_t, bool) {});
}

}  // namespace v0
}  // namespace polhode
