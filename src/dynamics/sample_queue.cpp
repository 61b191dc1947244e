// SPDX-License-Identifier: MIT
#include "dynamics/detail/sample_queue.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t samples_per_block = 1024;
// More than that of SaveAt::steps.
constexpr double slack = 8.0 * std::numeric_limits<double>::epsilon();

}  // namespace

SampleQueue::SampleQueue(double start, double stop, std::optional<SaveAt> times,
                         const SampleSink& sink)
    : forward_(start <= stop),
      stop_(stop),
      reach_of_stop_(stop + (forward_ ? 1.0 : -1.0) * slack *
                                std::fmax(std::fabs(start), std::fabs(stop))),
      times_(std::move(times)),
      sink_(sink) {
  block_.reserve(samples_per_block);
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

void SampleQueue::push(const Sample& sample) {
  latest_ = sample.t;
  block_.push_back(sample);
  if (block_.size() == samples_per_block) flush();
}

void SampleQueue::flush() {
  if (block_.empty()) return;
  // emptied first: a sink that throws must not get the same samples again
  const std::vector<Sample> full = std::exchange(block_, {});
  block_.reserve(samples_per_block);
  sink_(full);
}

void SampleQueue::begin(const Sample& initial) {
  if (!times_) return push(initial);
  for (; !is_done() && due() == initial.t; ++next_) push(initial);
}

bool SampleQueue::wants_dense(double t) const {
  return times_ && !is_done() && (t == stop_ || is_before(due(), t));
}

void SampleQueue::step(const DenseStep* dense, const Sample& end, const Progress& progress) {
  if (!times_) return push(end);
  while (!is_done() && !is_before(reach(end.t), due())) {
    const double t = due();
    push(t == end.t ? end : dense->sample(t));
    ++next_;
    if (progress && is_before(t, end.t)) progress(t);
  }
}

void SampleQueue::last(const Sample& end) {
  if (!latest_ || is_before(*latest_, end.t)) push(end);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
