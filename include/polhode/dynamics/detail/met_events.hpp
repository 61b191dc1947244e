// SPDX-License-Identifier: MIT
// The events that a step has met, put in order up to the one that ends the run.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A record, and whether it stops the run.
template <MotionState S>
struct MetEvent {
  BasicEventRecord<S> record;
  bool stops;
};

// Those asked for, in order of time, up to the first that stops the run and those at the same
// instant.
template <MotionState S>
struct FoundEvents {
  std::vector<BasicEventRecord<S>> records;
  bool stops = false;
};

inline bool is_after(double a, double b, bool forward) { return forward ? a > b : a < b; }

// Roots of two functions at one instant may differ by roundings.
inline bool is_same_instant(double a, double b) {
  constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
  return std::fabs(a - b) <= rounding * std::fmax(std::fabs(a), std::fabs(b));
}

// Of the first that stops the run; nullptr where none does.
template <MotionState S>
const BasicEventRecord<S>* first_stop(const std::vector<MetEvent<S>>& met, bool forward) {
  const BasicEventRecord<S>* first = nullptr;
  for (const MetEvent<S>& one : met)
    if (one.stops && (first == nullptr || is_after(first->t, one.record.t, forward)))
      first = &one.record;
  return first;
}

template <MotionState S>
FoundEvents<S> in_order(std::vector<MetEvent<S>>& met, bool forward) {
  std::stable_sort(met.begin(), met.end(), [forward](const MetEvent<S>& a, const MetEvent<S>& b) {
    return is_after(b.record.t, a.record.t, forward);
  });
  FoundEvents<S> result;
  double end = 0.0;
  for (MetEvent<S>& one : met) {
    if (result.stops && !is_same_instant(end, one.record.t)) break;
    if (one.stops && !result.stops) end = one.record.t;
    result.stops = result.stops || one.stops;
    result.records.push_back(std::move(one.record));
  }
  return result;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
