// SPDX-License-Identifier: MIT
// The search for events along a free rotation, a few turns at a time.
#pragma once

#include <string>
#include <vector>

#include "dynamics/events/term_motion.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class FreeEventSearch {
 public:
  // `motion` is in inertial axes, samples are in the frame. Zeros at `start` count.
  FreeEventSearch(const FreeRotation& motion, const Frame& frame, std::vector<Event> events,
                  double start);

  double t() const { return t_; }  // how far it has come: where it cannot go on, up to there
  // On towards `until`, by some turns at most.
  RotorWatch::Found advance(double until);
  // A zero where it has come to.
  RotorWatch::Found finish() { return watch_.finish(); }
  // Why it cannot go on; empty where it can.
  const std::string& refusal() const { return watch_.refusal(); }
  Sample sample(double t) const;
  void transfer(StateBytes& bytes) {
    bytes(t_);
    watch_.transfer(bytes);
  }

 private:
  FreeRotation motion_;
  System system_;
  RotorWatch watch_;
  double t_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
