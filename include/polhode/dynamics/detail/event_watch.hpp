// SPDX-License-Identifier: MIT
// The events of a run, step by step: how often their functions are looked at inside one, and what
// they meet there.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/dynamics/detail/met_events.hpp"
#include "polhode/dynamics/detail/time_zeros.hpp"
#include "polhode/dynamics/event.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Between two looks, where the fastest rate is so many radians per unit of time; and the time over
// which a slope is taken in one of n intervals of a step.
double time_between_looks(double turning_rate);
double time_of_slope(double from, double to, double n);
bool are_too_many_looks(double n);
std::string nan_event_text(const std::string& event, double t);
std::string too_many_looks_text(const std::string& event, double interval, double from, double to);

// `Motion` says how a sample moves on, and how fast it turns:
//   BasicSample<State> moved(const BasicSample<State>&, double time) const
//     after a time so short that the rates stay what they are, on the side of it;
//   double turning_rate(const BasicSample<State>&, bool forward) const
//     rad per unit of time: nothing turns faster before the terms have changed the motion;
//   static State near(const State& to, State s)
//     the same state in that of its forms which is nearer: q and -q are one attitude;
//   serialize, evaluations: of the terms, so far.
// The time between two looks from a state on.
template <class Motion, MotionState S = typename Motion::State>
double time_between_looks(const Motion& motion, const std::vector<BasicEvent<S>>& events,
                          const BasicSample<S>& from, bool forward) {
  double least = time_between_looks(motion.turning_rate(from, forward));
  for (const auto& event : events)
    if (event.interval > 0.0) least = std::fmin(least, event.interval);
  return least;
}

template <class Motion>
class EventWatch {
 public:
  using State = typename Motion::State;
  using Sample = BasicSample<State>;
  using Record = BasicEventRecord<State>;
  using Dense = BasicDenseStep<State>;

  EventWatch(Motion motion, std::vector<BasicEvent<State>> events)
      : events_(std::move(events)), motion_(std::move(motion)) {
    for (const auto& event : events_) watched_.push_back({.search = ZeroSearch(event.period)});
  }

  bool watches() const { return !events_.empty(); }

  // The values at the start of the run; whether a zero there is an event of it.
  void begin(const Sample& start, bool reports_start) {
    last_ = start;
    reached_ = start.t;
    for (std::size_t i = 0; i < events_.size(); ++i) {
      Watched& w = watched_[i];
      w.value = value(i, start);
      w.at_zero = start;
      w.search.begin(start.t, w.value, reports_start);
    }
    if (nan_event_) refuse_nan();
  }

  using Found = FoundEvents<State>;
  // Those of a step from the last end to `end`, and of earlier zeros that it decides on. States
  // come from `step`; `inside`, of the same step, is what is looked at, `intervals` times at least.
  Found search(const Dense& inside, const Dense& step, const Sample& end, int intervals);

  // A zero where the run ends.
  Found finish() {
    std::vector<Met> met;
    for (std::size_t i = 0; i < events_.size(); ++i) {
      std::vector<Zero> zeros;
      watched_[i].search.end(zeros);
      for (const Zero& zero : zeros)
        if (is_asked_for(i, zero.direction)) met.push_back(met_at(i, zero, watched_[i].at_zero));
    }
    return in_order<State>(met, true);
  }

  // Why the run cannot go on: an event is NaN, or a step would need too many looks; else empty.
  const std::string& refusal() const { return refusal_; }
  // Up to where events are known.
  double reached() const { return reached_; }
  // Of the terms, for slopes of the functions.
  std::int64_t evaluations() const { return motion_.evaluations(); }

  void serialize(Archive& bytes) {
    for (Watched& w : watched_) {
      w.search.serialize(bytes);
      bytes.all(w.value, w.at_zero);
    }
    bytes(last_);
    motion_.serialize(bytes);
  }

 private:
  struct Watched {
    ZeroSearch search;
    double value = 0.0;  // at the last look
    Sample at_zero{};    // where the last zero is that is not decided about
  };
  using Met = MetEvent<State>;
  // A step, and the time over which slopes are taken in it.
  struct Looked {
    const Dense& inside;
    const Dense& states;
    const Sample& end;
    bool forward;
    double apart_by;
  };

  // Methods give an attitude either sign, and a function of the components of q is continuous in
  // one.
  static Sample in_near_form(const Sample& near, const Sample& s) {
    return {s.t, Motion::near(near.s, s.s)};
  }
  Met met_at(std::size_t i, const Zero& zero, const Sample& there) const {
    return {{events_[i].name, zero.t, there.s, zero.direction}, events_[i].stops};
  }
  bool is_asked_for(std::size_t i, int direction) const {
    const Crossing crossing = events_[i].crossing;
    return crossing == Crossing::both || direction == (crossing == Crossing::rising ? 1 : -1);
  }
  double value(std::size_t i, const Sample& at) {
    const double value = events_[i].function(at);
    if (std::isnan(value)) nan_event_ = i;
    return value;
  }
  void refuse_nan() { refusal_ = nan_event_text(events_[*nan_event_].name, reached_); }
  void refuse_looks(double end) {
    const auto shorter = [](const auto& a, const auto& b) {
      return a.interval > 0.0 && !(b.interval > 0.0 && b.interval <= a.interval);
    };
    const auto& event = *std::min_element(events_.begin(), events_.end(), shorter);
    refusal_ = too_many_looks_text(event.name, event.interval, reached_, end);
  }

  // What is zero at the last look, `at`, if the run stops there: no other look will decide about
  // it.
  void meet_undecided(const Looked& step, const Sample& at, std::vector<Met>& met) {
    const Record* const stop = first_stop<State>(met, step.forward);
    if (stop == nullptr || !is_same_instant(stop->t, at.t)) return;
    for (std::size_t i = 0; i < events_.size(); ++i) {
      std::vector<Zero> zeros;
      if (!watched_[i].search.is_in_stretch()) watched_[i].search.end(zeros, true);
      for (const Zero& zero : zeros) meet(i, step, zero, at, met);
    }
  }

  // Whether the first event that stops the run does so where none is NaN.
  bool stops_before_nan(const std::vector<Met>& met, bool forward) const {
    const Record* const first = first_stop<State>(met, forward);
    if (first == nullptr) return false;
    const Sample there{first->t, first->s};
    return std::none_of(events_.begin(), events_.end(),
                        [&](const auto& event) { return std::isnan(event.function(there)); });
  }

  // The states at zeros that the next step decides about.
  void keep_undecided(const Dense& step, const Sample& end) {
    for (Watched& w : watched_) {
      const std::optional<double> t = w.search.undecided();
      if (t && *t != w.at_zero.t)
        w.at_zero = *t == end.t ? end : in_near_form(end, step.sample(*t));
    }
    last_ = end;
  }

  Look first_look(std::size_t i, const Sample& after, double apart_by) const;
  void look(std::size_t i, const Looked& step, const Sample& at, Look& last, std::vector<Met>& met);
  void meet(std::size_t i, const Looked& step, const Zero& zero, const Sample& near,
            std::vector<Met>& met) const;

  std::vector<BasicEvent<State>> events_;
  Motion motion_;
  std::vector<Watched> watched_;
  Sample last_{};                         // the end of the last step
  std::optional<std::size_t> nan_event_;  // whose value was NaN last
  std::string refusal_;
  double reached_ = 0.0;
};

template <class Motion>
auto EventWatch<Motion>::search(const Dense& inside, const Dense& step, const Sample& end,
                                int intervals) -> Found {
  const double t0 = last_.t, h = end.t - t0;
  const bool forward = h >= 0.0;
  reached_ = t0;
  const double apart = std::fmin(time_between_looks(motion_, events_, last_, forward),
                                 time_between_looks(motion_, events_, end, !forward));
  const double n = std::fmax(intervals, std::ceil(std::fabs(h) / apart));
  if (are_too_many_looks(n)) {
    refuse_looks(end.t);
    return {};
  }
  const double apart_by = time_of_slope(t0, end.t, n);

  const Looked looked{inside, step, end, forward, apart_by};
  std::vector<Look> last(events_.size());
  const Sample after = motion_.moved(last_, apart_by);
  for (std::size_t i = 0; i < events_.size(); ++i) last[i] = first_look(i, after, apart_by);
  std::vector<Met> met;
  bool stops = false;
  Sample at = last_;
  for (double k = 1.0; k <= n && !stops; ++k) {
    const double t = k == n ? end.t : t0 + h * (k / n);
    if (t == at.t) continue;
    at = in_near_form(at, k == n ? end : inside.sample(t));
    for (std::size_t i = 0; i < events_.size(); ++i) look(i, looked, at, last[i], met);
    stops = std::any_of(met.begin(), met.end(), [](const Met& one) { return one.stops; });
    if (nan_event_ && !stops_before_nan(met, forward)) {
      std::erase_if(met, [&](const Met& one) { return is_after(one.record.t, reached_, forward); });
      refuse_nan();
      return in_order<State>(met, forward);
    }
    reached_ = t;
  }
  if (stops) meet_undecided(looked, at, met);
  keep_undecided(step, at);
  return in_order<State>(met, forward);
}

// With the slope after it; but before it where the function turns around so near that neither this
// step nor the last would see it.
template <class Motion>
Look EventWatch<Motion>::first_look(std::size_t i, const Sample& after, double apart_by) const {
  const auto slope = [&](const Sample& s, double time) {
    return (events_[i].function(s) - watched_[i].value) / time;
  };
  Look look{last_.t, watched_[i].value, slope(after, apart_by)};
  const bool rises = look.value * look.slope * apart_by > 0.0;
  if (rises && std::fabs(look.value) <= std::fabs(look.slope * apart_by)) {
    const double before = slope(motion_.moved(last_, -apart_by), -apart_by);
    if (before * look.slope < 0.0) look.slope = before;
  }
  return look;
}

// One event, from the last look at it to that at `at`.
template <class Motion>
void EventWatch<Motion>::look(std::size_t i, const Looked& step, const Sample& at, Look& last,
                              std::vector<Met>& met) {
  Watched& w = watched_[i];
  w.value = value(i, at);
  if (std::isnan(w.value)) return;
  const Sample before = motion_.moved(at, -step.apart_by);
  const Look now{at.t, w.value, (w.value - events_[i].function(before)) / step.apart_by};
  const TimeFunction f = [&](double t) {
    return value(i, in_near_form(at, step.inside.sample(t)));
  };
  std::vector<Zero> zeros;
  w.search.between(f, last, now, zeros);
  last = now;
  for (const Zero& zero : zeros) meet(i, step, zero, at, met);
}

// If it is asked for, with the state there, in the form of one near it.
template <class Motion>
void EventWatch<Motion>::meet(std::size_t i, const Looked& step, const Zero& zero,
                              const Sample& near, std::vector<Met>& met) const {
  if (!is_asked_for(i, zero.direction)) return;
  const bool is_new = is_after(zero.t, last_.t, step.forward);
  met.push_back(met_at(
      i, zero,
      is_new ? in_near_form(near, zero.t == step.end.t ? step.end : step.states.sample(zero.t))
             : watched_[i].at_zero));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
