// SPDX-License-Identifier: MIT
// A run of one state shown as that of another: of a rotor with a damper as that of the rotor, and
// of a rotor as that of one whose damper rests in the body.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "polhode/dynamics/resume.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <MotionState To, MotionState From>
To shown(const From& s);
template <>
inline RotorState shown(const DampedRotorState& s) {
  return s.rotor;
}
template <>
inline DampedRotorState shown(const RotorState& s) {
  return {s, {}};
}

template <MotionState To, MotionState From>
BasicSample<To> shown_sample(const BasicSample<From>& at) {
  return {at.t, shown<To>(at.s)};
}
template <MotionState To, MotionState From>
BasicEventRecord<To> shown_event(const BasicEventRecord<From>& e) {
  return {e.name, e.t, shown<To>(e.s), e.direction};
}

// The problem whose run is shown.
template <MotionState From, MotionState To>
BasicProblem<System, From> problem_of(const BasicProblem<System, To>& p) {
  BasicProblem<System, From> result{
      p.system, shown<From>(p.initial), p.start, p.stop, p.method, {}, p.continues};
  for (const BasicEvent<To>& e : p.events) {
    BasicEventFunction<From> function;
    if (e.function)
      function = [f = e.function](const BasicSample<From>& at) { return f(shown_sample<To>(at)); };
    result.events.push_back(
        {e.name, std::move(function), e.crossing, e.stops, e.period, e.interval});
  }
  return result;
}

template <MotionState From, MotionState To>
BasicSampleSink<From> sink_into(const BasicSampleSink<To>& sink) {
  return [sink](std::span<const BasicSample<From>> block) {
    std::vector<BasicSample<To>> rows;
    rows.reserve(block.size());
    for (const BasicSample<From>& at : block) rows.push_back(shown_sample<To>(at));
    sink(rows);
  };
}

template <MotionState From, MotionState To>
BasicStreams<From> streams_into(const BasicStreams<To>& streams) {
  BasicStreams<From> result{
      {}, {}, streams.checkpoint_due, streams.checkpoint, streams.steps_to_last_sample, {}};
  if (streams.samples) result.samples = sink_into<From>(streams.samples);
  if (streams.events)
    result.events = [events = streams.events](const BasicEventRecord<From>& e) {
      events(shown_event<To>(e));
    };
  if (streams.end)
    result.end = [end = streams.end](const BasicSample<From>& at) { end(shown_sample<To>(at)); };
  return result;
}

template <MotionState To, MotionState From>
class ShownStep final : public BasicDenseStep<To> {
 public:
  explicit ShownStep(std::shared_ptr<const BasicDenseStep<From>> step)
      : BasicDenseStep<To>(step->t0(), step->t1()), step_(std::move(step)) {}
  To at(double t) const override { return shown<To>(step_->at(t)); }
  std::size_t bytes() const override { return sizeof(*this) + step_->bytes(); }

 private:
  std::shared_ptr<const BasicDenseStep<From>> step_;
};

template <MotionState To, MotionState From>
BasicTrajectory<To> shown_run(BasicTrajectory<From> run) {
  typename BasicTrajectory<From>::Parts parts = std::move(run).parts();
  typename BasicTrajectory<To>::Parts result{.initial = shown_sample<To>(parts.initial),
                                             .samples = {},
                                             .events = {},
                                             .outcome = std::move(parts.outcome),
                                             .statistics = parts.statistics,
                                             .method = std::move(parts.method),
                                             .dense = {}};
  result.samples.reserve(parts.samples.size());
  for (const BasicSample<From>& at : parts.samples) result.samples.push_back(shown_sample<To>(at));
  for (const auto& event : parts.events) result.events.push_back(shown_event<To>(event));
  for (auto& step : parts.dense)
    result.dense.push_back(std::make_shared<const ShownStep<To, From>>(std::move(step)));
  return BasicTrajectory<To>(std::move(result));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
