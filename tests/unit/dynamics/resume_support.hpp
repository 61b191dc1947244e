// SPDX-License-Identifier: MIT
// What a run gives out, and goes on with from its checkpoints, for states of any kind.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "polhode/dynamics/integrate.hpp"

namespace polhode::test {

// All that a run gives out.
template <class S>
struct RecordOf {
  std::vector<BasicSample<S>> samples;
  std::vector<BasicEventRecord<S>> events;
  std::vector<Checkpoint> checkpoints;
  std::vector<std::pair<std::size_t, std::size_t>> given;  // samples, events before each
};

template <class S>
BasicStreams<S> into(RecordOf<S>& record, int every) {
  return {[&record](std::span<const BasicSample<S>> block) {
            record.samples.insert(record.samples.end(), block.begin(), block.end());
          },
          [&record](const BasicEventRecord<S>& event) { record.events.push_back(event); },
          [every, calls = 0](double) mutable { return every > 0 && ++calls % every == 0; },
          [&record](const Checkpoint& now) {
            record.checkpoints.push_back(now);
            record.given.emplace_back(record.samples.size(), record.events.size());
          }};
}

// From each checkpoint the run goes on in the bits of the one without a stop.
template <class P>
void expect_the_straight_run(const P& problem, const SaveAt& times, int every) {
  using Record = RecordOf<std::decay_t<decltype(problem.initial)>>;
  Record straight;
  const auto whole = integrate(problem, times, into(straight, every));
  ASSERT_GE(straight.checkpoints.size(), 10U);
  const std::size_t stride = 1 + straight.checkpoints.size() / 8;
  for (std::size_t k = 0; k < straight.checkpoints.size(); k += stride) {
    Record rest;
    // through bytes, as a file would keep them
    const Checkpoint from(straight.checkpoints[k].bytes());
    EXPECT_EQ(from.t(), straight.checkpoints[k].t());
    const auto end = resume(problem, times, from, into(rest, 0));
    const auto [samples, events] = straight.given[k];
    ASSERT_EQ(samples + rest.samples.size(), straight.samples.size()) << k;
    for (std::size_t i = 0; i < rest.samples.size(); ++i)
      ASSERT_EQ(rest.samples[i], straight.samples[samples + i]) << k << " " << i;
    ASSERT_EQ(events + rest.events.size(), straight.events.size()) << k;
    for (std::size_t i = 0; i < rest.events.size(); ++i)
      ASSERT_EQ(rest.events[i], straight.events[events + i]) << k << " " << i;
    EXPECT_EQ(end.outcome().t, whole.outcome().t);
    EXPECT_EQ(end.outcome().status, whole.outcome().status);
    EXPECT_EQ(end.statistics().steps, whole.statistics().steps);
    EXPECT_EQ(end.statistics().rejected, whole.statistics().rejected);
    EXPECT_EQ(end.statistics().evaluations, whole.statistics().evaluations);
  }
}

}  // namespace polhode::test
