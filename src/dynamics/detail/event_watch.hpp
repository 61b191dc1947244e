// SPDX-License-Identifier: MIT
// The events of a run: which side of zero each function was on, and what it met in a step.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "dynamics/detail/state_bytes.hpp"
#include "polhode/dynamics/event.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class EventWatch {
 public:
  explicit EventWatch(std::span<const Event> events) : events_(events) {}

  // The values at the start of the run.
  void begin(const Sample& start);
  // Whether a function changed its sign over a step that ends there. Its name comes back when its
  // value is NaN.
  bool crossed(const Sample& end);
  const std::string& nan_event() const { return nan_event_; }
  void transfer(StateBytes& bytes);
  // The crossings asked for in that step, in order of time, up to the first that stops the run.
  struct Found {
    std::vector<EventRecord> records;
    bool stops = false;
  };
  Found found(const DenseStep& step, const Sample& end) const;

 private:
  struct Side {
    double before = 0.0;  // the value at the start of the step
    double value = 0.0;   // at its end
    int old_sign = 0;     // of the last value that was not zero; 0: none yet
    int sign = 0;
  };
  bool wanted(std::size_t i) const;

  std::span<const Event> events_;
  std::vector<Side> sides_;
  std::string nan_event_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
