// SPDX-License-Identifier: MIT
// The events of a run, step by step: how often their functions are looked at inside one, and what
// they meet there.
#pragma once

#include <optional>
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
  // Why the run cannot go on: an event is NaN, or a step would need too many looks; else empty.
  const std::string& refusal() const { return refusal_; }
  // Up to where events are known.
  double reached() const { return reached_; }
  void transfer(StateBytes& bytes);

 private:
  struct Watched {
    ZeroSearch search;
    double value = 0.0;  // at the last look
    Sample at_zero{};    // where the last zero is that is not decided about
  };
  // A record, and whether it stops the run.
  struct Met {
    EventRecord record;
    bool stops;
  };
  // A step, and the time over which slopes are taken in it.
  struct Looked {
    const DenseStep& inside;
    const DenseStep& states;
    const Sample& end;
    bool forward;
    double apart_by;
  };
  static Found in_order(std::vector<Met>& met, bool forward);
  double value(std::size_t i, const Sample& at);
  void look(std::size_t i, const Looked& step, const Sample& at, Look& last, std::vector<Met>& met);
  Look first_look(std::size_t i, const Sample& after, double apart_by) const;
  bool stops_before_nan(const std::vector<Met>& met, bool forward) const;
  void refuse_nan();
  void refuse_looks(double end);
  void keep_undecided(const DenseStep& step, const Sample& end);
  bool is_asked_for(std::size_t i, int direction) const;

  std::vector<Event> events_;
  SampleMotion motion_;
  std::vector<Watched> watched_;
  Sample last_{};                         // the end of the last step
  std::optional<std::size_t> nan_event_;  // whose value was NaN last
  std::string refusal_;
  double reached_ = 0.0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
