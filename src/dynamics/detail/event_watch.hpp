// SPDX-License-Identifier: MIT
// The events of a run, step by step: how often their functions are looked at inside one, and what
// they meet there.
#pragma once

#include <string>
#include <vector>

#include "dynamics/detail/sample_motion.hpp"
#include "dynamics/detail/state_bytes.hpp"
#include "dynamics/detail/time_zeros.hpp"
#include "polhode/dynamics/event.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class EventWatch {
 public:
  EventWatch(const System& system, std::vector<Event> events);

  bool watches() const { return !events_.empty(); }
  // The values at the start of the run; whether a zero there is an event of it.
  void begin(const Sample& start, bool reports_start);
  // The events asked for, in order of time, up to the first that stops the run.
  struct Found {
    std::vector<EventRecord> records;
    bool stops = false;
  };
  // Those of a step from the last end to `end`, and of zeros before that it decides about. States
  // come from `step`; `inside`, of the same step, is what is looked at, `intervals` times at least.
  Found search(const DenseStep& inside, const DenseStep& step, const Sample& end, int intervals);
  // A zero where the run ends.
  Found finish();
  // Between two looks from a state on.
  double interval(const Sample& from, bool forward) const;
  // Of the event whose value was NaN last.
  const std::string& nan_event() const { return nan_event_; }
  void transfer(StateBytes& bytes);

 private:
  struct Watched {
    ZeroSearch search;
    double value = 0.0;  // at the last look
    Sample at_zero{};    // where the last zero is that is not decided about
  };
  double value(std::size_t i, const Sample& at);
  void keep_undecided(const DenseStep& step, const Sample& end);
  bool is_asked_for(std::size_t i, int direction) const;

  std::vector<Event> events_;
  SampleMotion motion_;
  std::vector<Watched> watched_;
  Sample last_{};  // the end of the last step
  std::string nan_event_;
};

// The sentence of an event whose value is NaN.
std::string nan_text(const std::string& event, double t);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
