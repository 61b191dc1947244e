// SPDX-License-Identifier: MIT
#include "dynamics/detail/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "math/detail/number_text.hpp"

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
// Looks in a step that cannot be counted would not end.
constexpr double most_intervals = 1e15;

// A record, and whether it stops the run.
struct Met {
  EventRecord record;
  bool stops;
};

EventWatch::Found in_order(std::vector<Met>& met, bool forward) {
  std::stable_sort(met.begin(), met.end(), [forward](const Met& a, const Met& b) {
    return forward ? a.record.t < b.record.t : a.record.t > b.record.t;
  });
  EventWatch::Found result;
  for (Met& one : met) {
    result.records.push_back(std::move(one.record));
    result.stops = one.stops;
    if (one.stops) break;
  }
  return result;
}

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
  if (std::isnan(value)) nan_event_ = events_[i].name;
  return value;
}

void EventWatch::begin(const Sample& start, bool reports_start) {
  last_ = start;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    Watched& w = watched_[i];
    w.value = value(i, start);
    w.at_zero = start;
    w.search.begin(start.t, w.value, reports_start);
  }
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
  const double apart = std::fmin(interval(last_, forward), interval(end, !forward));
  const double n = std::fmin(std::fmax(intervals, std::ceil(std::fabs(h) / apart)), most_intervals);
  const double least = roundings * std::fmax(std::fabs(t0), std::fabs(end.t));
  const double while_ = std::copysign(std::fmax(short_while * std::fabs(h / n), least), h);

  std::vector<Look> last(events_.size());
  const Sample after = motion_.moved(last_, while_);
  for (std::size_t i = 0; i < events_.size(); ++i)
    last[i] = {t0, watched_[i].value, (events_[i].function(after) - watched_[i].value) / while_};
  std::vector<Met> met;
  bool stops = false;
  Sample at = last_;
  for (double k = 1.0; k <= n && !stops; ++k) {
    const double t = k == n ? end.t : t0 + h * (k / n);
    if (t == at.t) continue;
    at = beside(at, k == n ? end : inside.sample(t));
    const Sample before = motion_.moved(at, -while_);
    for (std::size_t i = 0; i < events_.size(); ++i) {
      Watched& w = watched_[i];
      w.value = value(i, at);
      if (std::isnan(w.value)) return in_order(met, forward);
      const Look now{t, w.value, (w.value - events_[i].function(before)) / while_};
      const TimeFunction f = [&, &function = events_[i].function](double when) {
        return function(beside(at, inside.sample(when)));
      };
      std::vector<Zero> zeros;
      w.search.between(f, last[i], now, zeros);
      last[i] = now;
      for (const Zero& zero : zeros) {
        if (!is_asked_for(i, zero.direction)) continue;
        const bool is_new = forward ? zero.t > t0 : zero.t < t0;
        const Sample there =
            is_new ? beside(at, zero.t == end.t ? end : step.sample(zero.t)) : w.at_zero;
        met.push_back({{events_[i].name, zero.t, there.s, zero.direction, there.damper_rate},
                       events_[i].stops});
        stops = stops || events_[i].stops;
      }
    }
  }
  keep_undecided(step, at);
  return in_order(met, forward);
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

std::string nan_text(const std::string& event, double t) {
  return "event \"" + event + "\" is NaN after t = " + number_text(t) +
         ": mend its function, or leave it out";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
