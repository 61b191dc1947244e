// SPDX-License-Identifier: MIT
// Where a run begins and ends, and what stands for its events where it has none.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "polhode/detail/trajectory/archive.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where a run begins and ends.
template <MotionState S>
struct RunSpan {
  BasicSample<S> initial;
  double stop;
  std::string method;  // in words
  // Where events are first looked at: the very state given, where it is normalised, so that a run
  // that goes on from another sees the zero, or the side of it, that the other saw last.
  BasicSample<S> first_look;
  bool continues = false;
  // Every sample is the end of a step; otherwise samples come from inside.
  bool ends_at_samples = false;
};

// In place of an EventWatch where there are no events.
template <MotionState S>
struct NoEvents {
  using State = S;
  struct Found {
    std::vector<BasicEventRecord<S>> records;
    bool stops = false;
  };
  static bool watches() { return false; }
  void begin(const BasicSample<S>&, bool) {}
  Found search(const BasicDenseStep<S>&, const BasicDenseStep<S>&, const BasicSample<S>&, int) {
    return {};
  }
  Found finish() { return {}; }
  std::string refusal() const { return {}; }
  static double reached() { return 0.0; }
  static std::int64_t evaluations() { return 0; }
  void serialize(Archive&) {}
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
