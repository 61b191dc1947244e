// SPDX-License-Identifier: MIT
// What steps by collocation keep to, and the sweeps that solve one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "polhode/ode/step_control.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct CollocationControl {
  StepControl step;
  bool is_fixed = false;  // every step is step.first_step long but where something ends it
};

enum class SweepsEnd { converged, diverging, not_finite };

// Sweeps go on until rounding alone changes the stages, or what a term has of noise: its changes
// may be `enough`.
class SweepJudge {
 public:
  // `settled`: a change so small that none is looked for.
  explicit SweepJudge(double enough = 0.0, double settled = 0.0)
      : enough_(enough), settled_(settled) {}

  bool goes_on() const { return goes_on_; }
  std::int64_t sweeps() const { return sweeps_; }
  // Of a sweep, its largest change.
  void see(double change) {
    ++sweeps_;
    if (change == 0.0) {
      ends(SweepsEnd::converged);
    } else if (!std::isfinite(change)) {
      // sweeps that lead away from any solution overflow, too
      ends(sweeps_ > 1 && before_ >= 1.0 ? SweepsEnd::diverging : SweepsEnd::not_finite);
    } else if (sweeps_ >= least_sweeps && !(change < before_)) {
      ends(judged());
    } else {
      before_ = change;
      if (change <= settled_) {
        ends(SweepsEnd::converged);
      } else if (sweeps_ == most_sweeps) {
        ends(judged());
      }
    }
  }
  // Once they do not go on.
  SweepsEnd end() const { return end_; }

 private:
  static constexpr std::int64_t most_sweeps = 60, least_sweeps = 3;

  SweepsEnd judged() const {
    constexpr double largest_rounding = 256.0 * std::numeric_limits<double>::epsilon();
    return before_ <= std::max(enough_, largest_rounding) ? SweepsEnd::converged
                                                          : SweepsEnd::diverging;
  }
  void ends(SweepsEnd end) {
    end_ = end;
    goes_on_ = false;
  }

  double enough_, settled_;
  double before_ = std::numeric_limits<double>::infinity();
  std::int64_t sweeps_ = 0;
  bool goes_on_ = true;
  SweepsEnd end_ = SweepsEnd::diverging;
};

// Stages may say how small a change their sweeps need not look for.
template <class Stages>
SweepJudge judge_of(double enough) {
  if constexpr (requires { Stages::settled; })
    return SweepJudge(enough, Stages::settled);
  else
    return SweepJudge(enough);
}

template <class Stages>
SweepsEnd swept(Stages& stages, double enough, std::int64_t& sweeps) {
  SweepJudge judge = judge_of<Stages>(enough);
  while (judge.goes_on()) judge.see(stages.sweep());
  sweeps += judge.sweeps();
  return judge.end();
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
