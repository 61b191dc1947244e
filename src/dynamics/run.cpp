// SPDX-License-Identifier: MIT
// The loop of a run: its span, the queue of its samples, runs of models, and checkpoints.
#include "polhode/dynamics/detail/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/dynamics/detail/finite_span.hpp"
#include "polhode/dynamics/detail/model_run.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"
#include "polhode/dynamics/detail/sample_queue.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void require_finite_span(const std::string& function, double start, double stop) {
  if (!std::isfinite(start) || !std::isfinite(stop))
    throw DomainError(function + ": start " + number_text(start) + " and stop " +
                      number_text(stop) + " must be finite");
}

FiniteSpan::FiniteSpan(double start, double stop) { require_finite_span("Problem", start, stop); }

namespace {

// More than that of SaveAt::steps.
constexpr double slack = 8.0 * std::numeric_limits<double>::epsilon();

}  // namespace

DueTimes::DueTimes(double start, double stop, std::optional<SaveAt> times)
    : forward_(start <= stop),
      stop_(stop),
      reach_of_stop_(stop + (forward_ ? 1.0 : -1.0) * slack *
                                std::fmax(std::fabs(start), std::fabs(stop))),
      times_(std::move(times)) {
  if (!times_) return;
  while (!is_done() && is_before(due(), start)) ++next_;
  // the whole list before the first step: a run of hours must not end in this message
  const std::int64_t checked =
      times_->is_list() ? times_->size() : std::min(times_->size(), next_ + 2);
  for (std::int64_t k = next_ + 1; k < checked; ++k)
    if (is_before((*times_)[k], (*times_)[k - 1]))
      throw DomainError("integrate: sample times must run from start " + number_text(start) +
                        " to stop " + number_text(stop) + ": " + number_text((*times_)[k]) +
                        " comes after " + number_text((*times_)[k - 1]));
}

std::optional<double> DueTimes::last() const {
  if (is_done()) return std::nullopt;
  const double last = (*times_)[times_->size() - 1];
  return is_before(last, stop_) ? std::optional(last) : std::nullopt;
}

const Adaptive& adaptive_method(std::string_view model, const Method& method, bool has_wide,
                                bool has_frozen) {
  const auto* adaptive = std::get_if<Adaptive>(&method);
  if (adaptive == nullptr)
    throw DomainError("integrate: method of " + std::string(model) + " must be Adaptive" +
                      (has_frozen ? ", Collocation or Splitting" : " or Collocation") +
                      ": the others know a System alone");
  if (adaptive->precision == Precision::double_double && !has_wide)
    throw DomainError("integrate: " + std::string(model) +
                      " works on double alone: write its functions as templates on the number type "
                      "for Precision::double_double");
  return *adaptive;
}

void refuse_all_but_splitting(std::string_view model) {
  throw DomainError("integrate: method of " + std::string(model) +
                    " must be Splitting: it has no rates");
}

void refuse_events(std::string_view model, std::size_t count) {
  if (count > 0)
    throw DomainError("integrate: got " + std::to_string(count) + " events of " +
                      std::string(model) + "; expected none: it has no rates");
}

bool equal_but_for_rounding(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  double largest = 0.0;  // a state may have any unit: 1 says nothing about its size
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::fmax(largest, std::fmax(std::abs(a[i]), std::abs(b[i])));
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * largest;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) <= rounding)) return false;
  return true;
}

std::string frozen_failure_text(std::string_view name, double t, double step, bool is_finite) {
  if (is_finite)
    return "step " + number_text(step) + " is below the rounding of t = " + number_text(t) +
           ": take a larger step or count time from a nearer epoch";
  return "the state of " + std::string(name) +
         " is not finite after the step from t = " + number_text(t) +
         ": does what it depends on end there?";
}

std::string model_failure_text(std::string_view name, double t, double h, StepOutcome outcome) {
  const std::string where = number_text(t);
  if (outcome == StepOutcome::not_finite)
    return "the rates of " + std::string(name) + " are not finite at t = " + where +
           ": give them a value there, or stop before";
  return "the step at t = " + where + " would be " + number_text(std::abs(h)) +
         ", below the rounding of t: do the rates of " + std::string(name) +
         " jump there, or grow without bound? Try a larger tolerance";
}

}  // namespace detail

namespace {

constexpr std::string_view magic = "polhode checkpoint 5";

template <class... X>
std::string bytes_of(X... x) {
  StateBytes bytes;
  bytes.all(x...);
  return bytes.bytes();
}

}  // namespace

Checkpoint::Checkpoint(std::string bytes) : bytes_(std::move(bytes)) {
  StateBytes reader(bytes_);
  std::string head;
  std::uint64_t hash = 0;
  reader.all(head, hash, t_);
  if (head != magic) throw DomainError("Checkpoint: bytes that are no checkpoint of this version");
  const std::size_t hashed = 8 + head.size() + 8;  // t and all that follows
  if (fingerprint(std::string_view(bytes_).substr(hashed)) != hash)
    throw DomainError("Checkpoint: its bytes were damaged");
}

namespace detail {
namespace {

// A run does not end that would need this many steps of the length that its last ones had: 1e12 of
// a microsecond are twelve days.
constexpr double most_steps = 1e12;
// The last ones: a step that a jump of a torque has cut is followed by longer ones long before.
constexpr std::int64_t settled = 1000;

}  // namespace

std::string full_text(double most_bytes, double t) {
  return "the steps up to t = " + number_text(t) + " fill the " + number_text(most_bytes) +
         " bytes that a trajectory may take in memory (most_bytes): take samples at fewer times "
         "and no dense output, a shorter run, or a higher limit";
}

std::string number_bytes(double x) { return bytes_of(x); }

std::string event_bytes(const std::string& name, Crossing crossing, bool stops, double period,
                        double interval) {
  return bytes_of(name, static_cast<int>(crossing), stops, period, interval);
}

std::string method_bytes(const Method& method) {
  const MethodTraits traits = method_traits(method);
  std::string bytes = traits.text;
  for (const double x : traits.further) bytes += bytes_of(x);
  return bytes;
}

std::string times_bytes(const SaveAt& times) {
  const std::int64_t n = times.size();
  return n == 0 ? bytes_of(n) : bytes_of(n, times[0], times[n / 2], times[n - 1]);
}

Checkpoint made_checkpoint(const Features& features, double t, const std::string& state) {
  const std::string hashed = bytes_of(t, features) + state;
  return Checkpoint(bytes_of(std::string(magic), fingerprint(hashed)) + hashed);
}

StateBytes opened_checkpoint(const Checkpoint& from, const Features& features) {
  StateBytes bytes(from.bytes());
  std::string head;
  std::uint64_t hash = 0;
  double t = 0.0;
  Features kept;
  bytes.all(head, hash, t, kept);
  for (std::size_t i = 0; i < features.size(); ++i)
    if (i >= kept.size() || kept[i] != features[i])
      throw DomainError("resume: the checkpoint is of another problem: " + features[i].first +
                        " differs");
  if (kept.size() != features.size())
    throw DomainError("resume: the checkpoint is of another problem: its state differs");
  return bytes;
}

std::string EndJudge::judged(double t, double stop, std::int64_t steps) {
  if (steps < steps_ + settled) return {};
  const double made = std::abs(t - t_) / static_cast<double>(steps - steps_);
  const double left = std::abs(stop - t);
  steps_ = steps;
  t_ = t;
  if (!(left > most_steps * made)) return {};
  double power = std::pow(10.0, std::floor(std::log10(left / made)));
  if (power * made > left) power *= 0.1;  // its logarithm was rounded up
  return "at t = " + number_text(t) + " the last " + number_text(settled) + " steps are " +
         number_text(made) + " each, so reaching the end would take " + number_text(power) +
         " of them and more: is the rotation, an orbit or a torque that fast, does it grow, or is "
         "a damping that stiff? Try a shorter run";
}

}  // namespace detail

}  // namespace v0
}  // namespace polhode
