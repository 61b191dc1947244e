// SPDX-License-Identifier: MIT
#include "polhode/dynamics/integrate.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dynamics/detail/checked_problem.hpp"
#include "dynamics/detail/event_watch.hpp"
#include "dynamics/detail/sample_queue.hpp"
#include "dynamics/detail/stepper.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/resume.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::number_text;

// A run does not end that would need this many steps of the length that its last ones had: 1e12 of
// a microsecond are twelve days.
constexpr double most_steps = 1e12;
// The last ones: a step that a jump of a torque has cut is followed by longer ones long before.
constexpr std::int64_t settled = 1000;

Problem checked(const Problem& problem) {
  Problem result = detail::checked_problem("integrate", problem);
  for (const Event& event : result.events) require_valid(event);
  return result;
}

constexpr std::string_view mark = "polhode checkpoint 3";

// What a checkpoint says of its problem, in front of the state: two that differ are told apart.
std::vector<std::pair<std::string, std::string>> features(const Problem& problem,
                                                          const SaveAt& times) {
  const auto text = [](auto... x) {
    detail::StateBytes bytes;
    bytes.all(x...);
    return bytes.bytes();
  };
  const auto steps = std::visit(
      [&](const auto& m) {
        if constexpr (requires { m.first_step; }) return text(m.first_step, m.largest_step);
        if constexpr (requires { m.largest_step; }) return text(m.largest_step);
        return std::string();
      },
      problem.method);
  std::string events;
  for (const Event& e : problem.events)
    events += text(e.name, static_cast<int>(e.crossing), e.stops, e.period, e.interval);
  const std::int64_t n = times.size();
  const std::optional<KaneDamper>& damper = problem.system.damper();
  std::string terms;
  for (const AnyPerturbation& term : problem.system.terms()) terms += text(term.name());
  return {{"start", text(problem.start)},
          {"stop", text(problem.stop)},
          {"state", text(problem.initial)},
          {"body", text(problem.system.body().moments())},
          {"terms", terms},
          {"damper", damper ? text(damper->moment(), damper->friction()) : std::string()},
          {"damper_rate", text(problem.damper_rate)},
          {"continues", text(problem.continues)},
          {"method", method_text(problem.method) + steps},
          {"events", events},
          {"sample times", n == 0 ? text(n) : text(n, times[0], times[n / 2], times[n - 1])}};
}

// Where events are first looked at: the very state given, where it is normalised, so that a run
// that goes on from another sees the zero, or the side of it, that the other saw last.
Sample first_look(const Problem& given, const Problem& checked) {
  const Quaternion& q = given.initial.q;
  const double excess = (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z) - 1.0;
  const bool is_normal = std::abs(excess) <= 8.0 * std::numeric_limits<double>::epsilon();
  return {checked.start, is_normal ? given.initial : checked.initial, checked.damper_rate};
}

// One run: steps, and what they leave behind.
class Run {
 public:
  Run(const Problem& problem, bool keep_dense, detail::SampleQueue& samples,
      const Progress& progress)
      : problem_(checked(problem)),
        first_look_(first_look(problem, problem_)),
        keep_dense_(keep_dense),
        samples_(samples),
        progress_(progress),
        told_(progress),
        watch_(problem_.system, problem_.events),
        stepper_(std::visit([&](const auto& m) { return detail::make_stepper(problem_, m); },
                            problem_.method)) {}

  // What it gives out beside samples, and the times that it was asked for.
  void connect(const Streams& streams, const SaveAt& times) {
    streams_ = &streams;
    times_ = &times;
    if (!streams.checkpoint_due) return;
    told_ = [this](double t) {
      offer_checkpoint(t);
      if (progress_) progress_(t);
    };
  }

  // Goes on where a checkpoint was made.
  void restore(const Checkpoint& from) {
    detail::StateBytes bytes(from.bytes());
    std::string head;
    std::uint64_t hash = 0;
    double t = 0.0;
    bytes.all(head, hash, t);
    for (const auto& [name, value] : features(problem_, *times_)) {
      std::string kept;
      bytes(kept);
      if (kept != value)
        throw DomainError("resume: the checkpoint is of another problem: " + name + " differs");
    }
    transfer(bytes);
    continued_ = true;
  }

  Trajectory::Parts result() {
    parts_.initial = {problem_.start, problem_.initial, problem_.damper_rate};
    parts_.method = method_text(problem_.method);
    if (!continued_) parts_.outcome.t = judged_t_ = problem_.start;
    try {
      if (!continued_) {
        samples_.begin(parts_.initial);
        watch_.begin(first_look_, !problem_.continues);
        if (refused()) return finished();
      }
      const std::shared_ptr<const DenseStep> dense =
          inside_step_ ? stepper_->dense(false) : nullptr;
      if (inside_step_ && !samples_of_step(dense.get())) return finished();
      bool goes_on = true;
      while (goes_on && stepper_->time() != problem_.stop) goes_on = step();
      if (goes_on) end_events();
    } catch (...) {
      samples_.flush();
      throw;
    }
    return finished();
  }

 private:
  // Whether the run goes on.
  bool step() {
    const std::string advice = stepper_->advance(problem_.stop);
    if (!advice.empty()) {
      keep(watch_.finish().records);
      fail(advice);
      return false;
    }
    Sample end{stepper_->time(), stepper_->state(), stepper_->damper_rate()};
    std::shared_ptr<const DenseStep> dense;
    if (keep_dense_ || watch_.watches() || samples_.wants_dense(end.t))
      dense = stepper_->dense(keep_dense_);
    stopped_ = false;
    if (watch_.watches()) {
      const detail::EventWatch::Found found =
          watch_.search(*stepper_->inside(), *dense, end, stepper_->intervals());
      keep(found.records);
      stopped_ = found.stops;
      if (!stopped_ && refused()) return false;
      if (stopped_) end = sample_of(found.records.back());
    }
    if (keep_dense_) parts_.dense.push_back(dense);
    end_ = end;
    return samples_of_step(dense.get());
  }

  static Sample sample_of(const EventRecord& event) {
    return {event.t, event.s, event.damper_rate};
  }

  // Zeros at the stop itself.
  void end_events() {
    const detail::EventWatch::Found found = watch_.finish();
    keep(found.records);
    if (found.stops) parts_.outcome.status = Outcome::Status::stopped_by_event;
  }

  // A step may hold many samples: a checkpoint may be made among them. Whether the run goes on.
  bool samples_of_step(const DenseStep* dense) {
    inside_step_ = true;
    samples_.step(dense, end_, told_);
    inside_step_ = false;
    if (stopped_) {
      samples_.last(end_);
      parts_.outcome.status = Outcome::Status::stopped_by_event;
    }
    parts_.outcome.t = end_.t;
    const bool goes_on = !stopped_ && !endless();
    if (goes_on && end_.t != problem_.stop) offer_checkpoint(end_.t);
    if (progress_) progress_(end_.t);
    return goes_on;
  }

  void keep(const std::vector<EventRecord>& found) {
    if (streams_ != nullptr && streams_->events) {
      for (const EventRecord& event : found) streams_->events(event);
    } else {
      parts_.events.insert(parts_.events.end(), found.begin(), found.end());
    }
  }

  void transfer(detail::StateBytes& bytes) {
    bytes.all(parts_.outcome.t, parts_.events, inside_step_, stopped_, end_, judged_t_,
              judged_steps_);
    stepper_->transfer(bytes);
    watch_.transfer(bytes);
    samples_.transfer(bytes);
  }

  void offer_checkpoint(double t) {
    if (streams_ == nullptr || !streams_->checkpoint_due || !streams_->checkpoint_due(t)) return;
    detail::StateBytes state;
    for (auto& [name, value] : features(problem_, *times_)) state(value);
    transfer(state);
    detail::StateBytes head;
    std::string text(mark);
    std::uint64_t hash = detail::fingerprint(state.bytes());
    head.all(text, hash, t);
    if (streams_->checkpoint) streams_->checkpoint(Checkpoint(head.bytes() + state.bytes()));
  }

  // By the mean of many steps in a row.
  bool endless() {
    const std::int64_t steps = stepper_->statistics().steps;
    if (steps < judged_steps_ + settled) return false;
    const double made =
        std::abs(parts_.outcome.t - judged_t_) / static_cast<double>(steps - judged_steps_);
    const double left = std::abs(problem_.stop - parts_.outcome.t);
    judged_steps_ = steps;
    judged_t_ = parts_.outcome.t;
    if (!(left > most_steps * made)) return false;
    double power = std::pow(10.0, std::floor(std::log10(left / made)));
    if (power * made > left) power *= 0.1;  // its logarithm was rounded up
    fail(
        "at t = " + number_text(parts_.outcome.t) + " the last " + number_text(settled) +
        " steps are " + number_text(made) + " each, so reaching the end would take " +
        number_text(power) +
        " of them and more: is the rotation, an orbit or a torque that fast, does it grow, or is a "
        "damping that stiff? Try a shorter run");
    return true;
  }

  bool refused() {
    if (watch_.refusal().empty()) return false;
    fail(watch_.refusal());
    return true;
  }

  void fail(const std::string& advice) {
    parts_.outcome.status = Outcome::Status::failed;
    parts_.outcome.advice = advice;
  }

  Trajectory::Parts finished() {
    samples_.flush();
    parts_.statistics = stepper_->statistics();
    return std::move(parts_);
  }

  Problem problem_;
  Sample first_look_;
  bool keep_dense_;
  detail::SampleQueue& samples_;
  const Progress& progress_;
  Progress told_;  // of samples inside a step
  detail::EventWatch watch_;
  std::unique_ptr<detail::Stepper> stepper_;
  Trajectory::Parts parts_{};
  const Streams* streams_ = nullptr;
  const SaveAt* times_ = nullptr;
  bool continued_ = false;
  // The step made last, while its samples are pushed.
  bool inside_step_ = false;
  bool stopped_ = false;  // by an event, at
  Sample end_{};
  // Where it was seen last whether the run will end.
  double judged_t_ = 0.0;
  std::int64_t judged_steps_ = 0;
};

Trajectory streamed(const Problem& problem, const SaveAt& times, const Checkpoint* from,
                    const Streams& streams, const Progress& progress) {
  const SampleSink nowhere = [](std::span<const Sample>) {};
  detail::SampleQueue samples(problem.start, problem.stop, times,
                              streams.samples ? streams.samples : nowhere);
  Run run(problem, false, samples, progress);
  run.connect(streams, times);
  if (from != nullptr) run.restore(*from);
  return Trajectory(run.result());
}

}  // namespace

Trajectory integrate(const Problem& problem, const Keep& keep, const Progress& progress) {
  std::vector<Sample> kept;
  const SampleSink into_memory = [&kept](std::span<const Sample> block) {
    kept.insert(kept.end(), block.begin(), block.end());
  };
  detail::SampleQueue samples(problem.start, problem.stop, keep.samples, into_memory);
  Trajectory::Parts parts = Run(problem, keep.dense, samples, progress).result();
  parts.samples = std::move(kept);
  return Trajectory(std::move(parts));
}

Trajectory integrate(const Problem& problem, const SaveAt& times, const SampleSink& sink,
                     const Progress& progress) {
  detail::SampleQueue samples(problem.start, problem.stop, times, sink);
  return Trajectory(Run(problem, false, samples, progress).result());
}

Checkpoint::Checkpoint(std::string bytes) : bytes_(std::move(bytes)) {
  detail::StateBytes reader(bytes_);
  std::string head;
  std::uint64_t hash = 0;
  reader.all(head, hash, t_);
  if (head != mark) throw DomainError("Checkpoint: bytes that are no checkpoint of this version");
  const std::size_t length = 8 + head.size() + 8 + 8;
  if (detail::fingerprint(std::string_view(bytes_).substr(length)) != hash)
    throw DomainError("Checkpoint: its bytes were damaged");
}

Trajectory integrate(const Problem& problem, const SaveAt& samples, const Streams& streams,
                     const Progress& progress) {
  return streamed(problem, samples, nullptr, streams, progress);
}

Trajectory resume(const Problem& problem, const SaveAt& samples, const Checkpoint& from,
                  const Streams& streams, const Progress& progress) {
  return streamed(problem, samples, &from, streams, progress);
}

}  // namespace v0
}  // namespace polhode
