// SPDX-License-Identifier: MIT
#include "dynamics/detail/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/detail/event_root.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

int sign_of(double x) { return x > 0.0 ? 1 : (x < 0.0 ? -1 : 0); }

}  // namespace

void EventWatch::begin(const Sample& start) {
  sides_.resize(events_.size());
  for (std::size_t i = 0; i < events_.size(); ++i) {
    sides_[i].value = events_[i].function(start);
    sides_[i].sign = sides_[i].old_sign = sign_of(sides_[i].value);
    if (std::isnan(sides_[i].value)) nan_event_ = events_[i].name;
  }
}

void EventWatch::transfer(StateBytes& bytes) {
  sides_.resize(events_.size());
  for (Side& side : sides_) bytes.all(side.before, side.value, side.old_sign, side.sign);
}

bool EventWatch::wanted(std::size_t i) const {
  const Side& side = sides_[i];
  if (side.old_sign * side.sign != -1) return false;
  const double period = events_[i].period;
  if (period > 0.0 && std::fabs(side.value - side.before) > 0.5 * period) return false;
  const Crossing crossing = events_[i].crossing;
  return crossing == Crossing::both || (crossing == Crossing::rising) == (side.sign > 0);
}

bool EventWatch::crossed(const Sample& end) {
  bool any = false;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    Side& side = sides_[i];
    side.before = side.value;
    side.old_sign = side.sign;
    side.value = events_[i].function(end);
    if (std::isnan(side.value)) nan_event_ = events_[i].name;
    const int sign = sign_of(side.value);
    if (sign != 0) side.sign = sign;  // on zero it is still on its old side
    any = any || wanted(i);
  }
  return any;
}

EventWatch::Found EventWatch::found(const DenseStep& step, const Sample& end) const {
  Found result;
  const bool forward = step.t0() <= step.t1();
  std::vector<std::pair<EventRecord, bool>> all;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (!wanted(i)) continue;
    const Side& side = sides_[i];
    const double t = event_root(events_[i], step, step.t0(), side.before, step.t1(), side.value);
    const Sample there = t == step.t1() ? end : step.sample(t);
    all.push_back({{events_[i].name, t, there.s, side.sign, there.damper_rate}, events_[i].stops});
  }
  std::stable_sort(all.begin(), all.end(), [forward](const auto& a, const auto& b) {
    return forward ? a.first.t < b.first.t : a.first.t > b.first.t;
  });
  for (auto& [record, stops] : all) {
    result.records.push_back(std::move(record));
    result.stops = stops;
    if (stops) break;
  }
  return result;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
