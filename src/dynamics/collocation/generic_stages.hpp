// SPDX-License-Identifier: MIT
// The stages of any numbers whose rates are asked for one stage after the other.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "dynamics/collocation/gauss_scheme.hpp"
#include "polhode/dynamics/detail/number_steps.hpp"
#include "system/rotor_equations.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class GenericStages {
 public:
  using Field = NumberField;
  using Values = std::vector<double>;
  using Rows = std::vector<StageRow>;
  struct State {
    Values y, carry;
  };
  struct Rates {
    std::shared_ptr<const Field> field;
    std::shared_ptr<const SwitchSides> sides = nullptr;  // none

    Values operator()(const DoubleDouble& t, const Values& y) const {
      Values f(y.size());
      field->rates(t, y, f);
      return f;
    }
  };

  // The first step says how many numbers there are.
  GenericStages(std::shared_ptr<const Field> field, std::size_t stages, InstructionSet set)
      : field_(std::move(field)),
        scheme_(gauss_scheme(stages)),
        lanes_(number_lanes(stages, set)) {}

  const GaussScheme& scheme() const { return scheme_; }
  const DoubleDouble& length() const { return weights_.length; }
  static Rows blank(std::size_t numbers) { return Rows(numbers); }

  void begin(const DoubleDouble& t, const State& start, double h, const SwitchSides*) {
    if (h != h_) {
      weights_ = step_weights(scheme_, h);
      h_ = h;
    }
    if (step_.y.size() != start.y.size()) step_ = NumberStep(start.y.size());
    step_.y = start.y;
    step_.carry = start.carry;
    at_.resize(start.y.size());
    rates_.resize(start.y.size());
    changes_.resize(start.y.size());
    for (std::size_t i = 0; i < scheme_.stages; ++i)
      t_[i] = DoubleDouble::sum(t.hi, t.lo + scheme_.c[i] * h);
  }
  void guess_start() {
    for (StageRow& row : step_.F) row = {};
    move();
  }
  void guess(const Rows& coefficients, const StageMatrix& at_stages, const GenericStages& of) {
    of.lanes_.transform(at_stages, scheme_.stages, coefficients.data(), coefficients.size(),
                        step_.F.data());
    move();
  }

  // The largest change of any stage, in the measure of the field.
  double sweep() {
    for (std::size_t i = 0; i < scheme_.stages; ++i) {
      for (std::size_t n = 0; n < at_.size(); ++n) at_[n] = step_.Y[n][i];
      field_->rates(t_[i], at_, rates_);
      for (std::size_t n = 0; n < at_.size(); ++n) step_.F[n][i] = rates_[n];
    }
    move();
    for (std::size_t n = 0; n < at_.size(); ++n) {
      // whatever a measure of errors makes of it
      if (!std::isfinite(changes_[n])) return std::numeric_limits<double>::quiet_NaN();
      rates_[n] = 0.0;
      for (std::size_t i = 0; i < scheme_.stages; ++i) rates_[n] += step_.L[n][i];
    }
    return field_->error_size(changes_, step_.y, rates_);
  }

  void coefficients(Rows& to) const {
    lanes_.transform(scheme_.coefficient, scheme_.stages, step_.F.data(), step_.F.size(),
                     to.data());
  }
  State finished() {
    lanes_.finish(weights_.hb, step_);
    return {step_.y, step_.carry};
  }

 private:
  void move() { lanes_.move(scheme_, weights_.hb, step_, 0, step_.y.size(), changes_.data()); }

  std::shared_ptr<const Field> field_;
  const GaussScheme& scheme_;
  NumberLanes lanes_;
  NumberStep step_{0};
  StepWeights weights_;
  double h_ = 0.0;
  std::array<DoubleDouble, most_stages> t_{};
  Values at_, rates_, changes_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
