// SPDX-License-Identifier: MIT
#include "dynamics/detail/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// In the time of the fastest turn. With slopes a function is known by twice as many numbers: a sine
// of three times that frequency is still told from its neighbours.
constexpr double looks_per_turn = 12.0;
// Over which a slope is taken, in intervals; and in roundings of the time, where these are coarse.
constexpr double short_while = 0x1p-16;
constexpr double roundings = 64.0 * std::numeric_limits<double>::epsilon();
// In one step, in which nobody can stop the run: minutes.
constexpr double most_looks = 1e8;

bool is_after(double a, double b, bool forward) { return forward ? a > b : a < b; }

// The same attitude with the sign of q that is nearer: methods give it either sign, and a function
// of the components of q is continuous in one.
Sample beside(const Sample& near, Sample s) {
  const Quaternion &p = near.s.q, q = s.s.q;
  if (p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z < 0.0) s.s.q = {-q.w, -q.x, -q.y, -q.z};
  return s;
}

}  // namespace

EventWatch::EventWatch(const System& system, std::vector<Event> events)
    : events_(std::move(events)), motion_(system) {
  for (const Event& event : events_) watched_.push_back({ZeroSearch(event.period), 0.0, {}});
}

double EventWatch::value(std::size_t i, const Sample& at) {
  const double value = events_[i].function(at);
  if (std::isnan(value)) nan_event_ = i;
  return value;
}

void EventWatch::refuse_nan() {
  refusal_ = "event \"" + events_[*nan_event_].name +
             "\" is NaN after t = " + number_text(reached_) +
             ": mend its function, or leave it out";
}

void EventWatch::refuse_looks(double end) {
  const auto shorter = [](const Event& a, const Event& b) {
    return a.interval > 0.0 && !(b.interval > 0.0 && b.interval <= a.interval);
  };
  const Event& event = *std::min_element(events_.begin(), events_.end(), shorter);
  refusal_ = "event \"" + event.name + "\" needs more than " + number_text(most_looks) +
             " looks in the step from t = " + number_text(reached_) + " to " + number_text(end) +
             ": ";
  if (event.interval > 0.0)
    refusal_ += "is its interval of " + number_text(event.interval) + " too short? ";
  refusal_ += "Give the method a largest_step, or take free_events where the body is free";
}

void EventWatch::begin(const Sample& start, bool reports_start) {
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

void EventWatch::transfer(StateBytes& bytes) {
  for (Watched& w : watched_) {
    w.search.transfer(bytes);
    bytes.all(w.value, w.at_zero);
  }
  bytes(last_);
}

bool EventWatch::is_asked_for(std::size_t i, int direction) const {
  const Crossing crossing = events_[i].crossing;
  return crossing == Crossing::both || direction == (crossing == Crossing::rising ? 1 : -1);
}

double EventWatch::interval(const Sample& from, bool forward) const {
  const double turn = 2.0 * std::numbers::pi / motion_.turning_rate(from, forward);
  double least = turn / looks_per_turn;
  for (const Event& event : events_)
    if (event.interval > 0.0) least = std::fmin(least, event.interval);
  return least;
}

EventWatch::Found EventWatch::search(const DenseStep& inside, const DenseStep& step,
                                     const Sample& end, int intervals) {
  const double t0 = last_.t, h = end.t - t0;
  const bool forward = h >= 0.0;
  reached_ = t0;
  const double apart = std::fmin(interval(last_, forward), interval(end, !forward));
  const double n = std::fmax(intervals, std::ceil(std::fabs(h) / apart));
  if (n > most_looks) {
    refuse_looks(end.t);
    return {};
  }
  const double least = roundings * std::fmax(std::fabs(t0), std::fabs(end.t));
  const double apart_by = std::copysign(std::fmax(short_while * std::fabs(h / n), least), h);

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
    at = beside(at, k == n ? end : inside.sample(t));
    for (std::size_t i = 0; i < events_.size(); ++i) look(i, looked, at, last[i], met);
    stops = std::any_of(met.begin(), met.end(), [](const Met& one) { return one.stops; });
    if (nan_event_ && !stops_before_nan(met, forward)) {
      std::erase_if(met, [&](const Met& one) { return is_after(one.record.t, reached_, forward); });
      refuse_nan();
      return in_order(met, forward);
    }
    reached_ = t;
  }
  keep_undecided(step, at);
  return in_order(met, forward);
}

// With the slope after it; but before it where the function turns around so near that neither this
// step nor the last would see it.
Look EventWatch::first_look(std::size_t i, const Sample& after, double apart_by) const {
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
void EventWatch::look(std::size_t i, const Looked& step, const Sample& at, Look& last,
                      std::vector<Met>& met) {
  const Event& event = events_[i];
  Watched& w = watched_[i];
  w.value = value(i, at);
  if (std::isnan(w.value)) return;
  const Sample before = motion_.moved(at, -step.apart_by);
  const Look now{at.t, w.value, (w.value - event.function(before)) / step.apart_by};
  const TimeFunction f = [&](double t) { return value(i, beside(at, step.inside.sample(t))); };
  std::vector<Zero> zeros;
  w.search.between(f, last, now, zeros);
  last = now;
  for (const Zero& zero : zeros) {
    if (!is_asked_for(i, zero.direction)) continue;
    const bool is_new = is_after(zero.t, last_.t, step.forward);
    const Sample there =
        is_new ? beside(at, zero.t == step.end.t ? step.end : step.states.sample(zero.t))
               : w.at_zero;
    met.push_back({{event.name, zero.t, there.s, zero.direction, there.damper_rate}, event.stops});
  }
}

// Whether the first event that stops the run does so where none is NaN.
bool EventWatch::stops_before_nan(const std::vector<Met>& met, bool forward) const {
  const Met* first = nullptr;
  for (const Met& one : met)
    if (one.stops && (first == nullptr || is_after(first->record.t, one.record.t, forward)))
      first = &one;
  if (first == nullptr) return false;
  const Sample there{first->record.t, first->record.s, first->record.damper_rate};
  return std::none_of(events_.begin(), events_.end(),
                      [&](const Event& event) { return std::isnan(event.function(there)); });
}

EventWatch::Found EventWatch::in_order(std::vector<Met>& met, bool forward) {
  std::stable_sort(met.begin(), met.end(), [forward](const Met& a, const Met& b) {
    return is_after(b.record.t, a.record.t, forward);
  });
  Found result;
  for (Met& one : met) {
    result.records.push_back(std::move(one.record));
    result.stops = one.stops;
    if (one.stops) break;
  }
  return result;
}

// The states at zeros that the next step decides about.
void EventWatch::keep_undecided(const DenseStep& step, const Sample& end) {
  for (Watched& w : watched_) {
    const std::optional<double> t = w.search.undecided();
    if (t && *t != w.at_zero.t) w.at_zero = *t == end.t ? end : beside(end, step.sample(*t));
  }
  last_ = end;
}

EventWatch::Found EventWatch::finish() {
  std::vector<Met> met;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const Sample& there = watched_[i].at_zero;
    std::vector<Zero> zeros;
    watched_[i].search.end(zeros);
    for (const Zero& zero : zeros)
      if (is_asked_for(i, zero.direction))
        met.push_back({{events_[i].name, zero.t, there.s, zero.direction, there.damper_rate},
                       events_[i].stops});
  }
  return in_order(met, true);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
