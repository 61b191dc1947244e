// SPDX-License-Identifier: MIT
// The way of a driven body from t0 to all times that are asked for, forwards and backwards.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "polhode/fit/driven_spin_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A part of the motion without a jump, its times in order, of which the first are asked for and
// `to` is one; then a jump, made forwards and unmade backwards.
struct DrivenLeg {
  double from, to;
  std::vector<double> times;
  std::size_t asked;
  std::optional<std::size_t> jump;
  bool is_first;  // of those that begin at t0
};

// They end at jumps and where terms are not smooth in time.
std::vector<DrivenLeg> driven_legs(std::span<const double> times, double t0,
                                   const std::vector<SpinJump>& jumps,
                                   const std::vector<AnyPerturbation>& terms);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
