// SPDX-License-Identifier: MIT
// How long the next step by collocation is.
#pragma once

#include <algorithm>
#include <cmath>

#include "dynamics/collocation/sweeps.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class StepChoice {
 public:
  StepChoice(const CollocationControl& control, std::size_t stages)
      : h(control.step.first_step), control_(control), stages_(stages) {}

  double h;  // wanted, without its sign

  // Towards an end at `rest`. Of fixed steps no sliver is left for it.
  double towards(double rest) const {
    if (control_.is_fixed) return h * (1.0 + 1e-9) < rest ? h : rest;
    return step_towards(rest, h, control_.step);
  }
  double largest_step() const { return control_.step.largest_step; }
  // No later step is longer.
  void limit(double largest) { control_.step.largest_step = largest; }

  // A step of `length` that went beyond an edge, of which it is to be made anew.
  void cut(double length) {
    h = length;
    is_cut_ = true;
  }
  // A step of `length` that erred too much.
  void shorten(double length, double error) { h = length * std::min(wanted(error), 0.9); }
  // Steps of one length keep their weights and their guess; and their errors, those of a symmetric
  // method, cancel, where those of steps of many lengths add up. So a step grows
  // after a while, and by what the largest error of that while allows.
  void made(double length, double error, bool repeated, bool is_slow) {
    constexpr int while_of_steps = 32;
    constexpr double least_growth = 1.2;
    // A step cut short by an end says little of the next one.
    if (!repeated && length < h) return;
    if (repeated) {
      patience_ = while_of_steps;
      h = length;
      is_cut_ = false;
    }
    largest_error_ = repeated ? error : std::max(largest_error_, error);
    since_ = repeated ? 1 : since_ + 1;
    kept_ = length == kept_length_ ? kept_ + 1 : 1;
    kept_length_ = length;
    if (kept_ >= while_of_steps) lasting_ = length;
    // What an edge has cut short was smooth before, and is so beyond.
    is_cut_ = is_cut_ && length < 0.5 * lasting_;
    if (since_ < (is_cut_ ? 1 : patience_)) return;
    const double factor = is_slow ? 0.9 : wanted(largest_error_);
    if (factor < 1.0 || factor >= least_growth) {
      h = length * factor;
    } else if (!is_cut_) {
      patience_ = while_of_steps;
    }
    since_ = 0;
    largest_error_ = 0.0;
  }

  template <class Visit>
  void transfer(Visit& visit) {
    visit.all(largest_error_, since_, patience_, kept_, kept_length_, lasting_, is_cut_);
  }

 private:
  static constexpr double safety = 0.9;

  double wanted(double error) const {
    const double ratio = std::max(error / control_.step.tolerance, 1e-300);
    if (!std::isfinite(ratio)) return 0.3;
    const double order = 2.0 * static_cast<double>(stages_);
    return std::clamp(safety * std::pow(ratio, -1.0 / order), 0.3, 2.0);
  }

  CollocationControl control_;
  std::size_t stages_;
  // Since the length of steps was looked at: the largest error, how many steps, and how many it
  // takes.
  double largest_error_ = 0.0;
  int since_ = 0;
  int patience_ = 1;
  // For how many steps their length has been the same, and the last that was for a while.
  int kept_ = 0;
  double kept_length_ = 0.0, lasting_ = 0.0;
  bool is_cut_ = false;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
