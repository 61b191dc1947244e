// SPDX-License-Identifier: MIT
#include "polhode/dynamics/free_events.hpp"

#include <cmath>
#include <utility>

#include "dynamics/events/free_event_search.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr int intervals_at_once = 64;

RotorState seen(const System& system, double t, const RotorState& s_I) {
  return system.frame().is_inertial() ? s_I : reference_state(system, t, s_I);
}

// The closed form between two times.
class FreeStretch final : public DenseStep {
 public:
  FreeStretch(const FreeRotation& motion, const System& system, double t0, double t1)
      : DenseStep(t0, t1), motion_(motion), system_(system) {}
  RotorState at(double t) const override { return seen(system_, t, motion_.at(t)); }

 private:
  const FreeRotation& motion_;
  const System& system_;
};

std::vector<Event> valid(std::vector<Event> events) {
  for (const Event& event : events) require_valid(event);
  return events;
}

}  // namespace

FreeEventSearch::FreeEventSearch(const FreeRotation& motion, const Frame& frame,
                                 std::vector<Event> events, double start)
    : motion_(motion),
      system_(motion.body(), frame),
      watch_(RotorMotion(system_), valid(std::move(events))),
      t_(start) {
  // At its epoch the motion is what it was given, without a rounding.
  Sample first = sample(start);
  if (start == motion_.epoch()) {
    const auto& [q, g] = motion_.initial_state();
    first.s = seen(system_, start, {normalized(q), g});
  }
  watch_.begin(first, true);
}

Sample FreeEventSearch::sample(double t) const { return {t, seen(system_, t, motion_.at(t))}; }

RotorWatch::Found FreeEventSearch::advance(double until) {
  const bool forward = until >= t_;
  // infinite for a body at rest
  const double reach = intervals_at_once * watch_.interval(sample(t_), forward);
  double end = until;
  if (reach < std::fabs(until - t_)) {
    end = t_ + (forward ? reach : -reach);
    if (end == t_) end = std::nextafter(t_, until);
  }
  const FreeStretch stretch(motion_, system_, t_, end);
  RotorWatch::Found found = watch_.search(stretch, stretch, sample(end), intervals_at_once / 4);
  t_ = refusal().empty() ? end : watch_.reached();
  return found;
}

}  // namespace detail

FreeEvents free_events(const FreeRotation& motion, const std::vector<Event>& events, double start,
                       double stop, const Frame& frame, const Progress& progress) {
  if (!std::isfinite(start) || !std::isfinite(stop))
    throw DomainError("free_events: start " + detail::number_text(start) + " and stop " +
                      detail::number_text(stop) + " must be finite");
  FreeEvents result;
  detail::FreeEventSearch search(motion, frame, events, start);
  const auto keep = [&result](detail::RotorWatch::Found found) {
    for (EventRecord& event : found.records) result.events.push_back(std::move(event));
    if (!found.stops) return;
    result.outcome.status = Outcome::Status::stopped_by_event;
    result.outcome.t = result.events.back().t;
  };
  result.outcome.t = start;
  for (;;) {
    const std::string& refusal = search.refusal();
    if (!refusal.empty()) {
      result.outcome.status = Outcome::Status::failed;
      result.outcome.advice = refusal;
      return result;
    }
    if (search.t() == stop) break;
    keep(search.advance(stop));
    if (result.outcome.status == Outcome::Status::stopped_by_event) return result;
    result.outcome.t = search.t();
    if (progress) progress(search.t());
  }
  keep(search.finish());
  return result;
}

}  // namespace v0
}  // namespace polhode
