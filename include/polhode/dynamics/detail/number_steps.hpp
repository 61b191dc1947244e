// SPDX-License-Identifier: MIT
// Steps of any numbers by a method that is compiled once: what it asks of a field, and what a
// stepper asks of it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/detail/ode/adaptive_runge_kutta.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Rates of as many numbers as a state has, and the measure of an error in them.
class NumberField {
 public:
  virtual ~NumberField() = default;
  virtual void rates(const DoubleDouble& t, std::span<const double> y,
                     std::span<double> to) const = 0;
  virtual double error_size(std::span<const double> error, std::span<const double> y,
                            std::span<const double> increment) const = 0;
};

// The numbers inside one step.
class NumberCurve {
 public:
  virtual ~NumberCurve() = default;
  virtual double begin() const = 0;
  virtual std::vector<double> at(double t) const = 0;
  virtual std::size_t bytes() const = 0;  // of memory
};

class NumberSteps {
 public:
  virtual ~NumberSteps() = default;
  // One step towards `stop`, ending there or before.
  virtual StepOutcome advance(double stop) = 0;
  // From the next step on, none under control is longer.
  virtual void limit_steps(double largest) = 0;
  // Why a step was not made, where it is the method that cannot make it; else empty.
  virtual std::string refusal(StepOutcome outcome) const = 0;
  virtual const DoubleDouble& time() const = 0;
  // The step tried last, with its sign.
  virtual double trial() const = 0;
  // And what they lost to rounding; for invariants that the owner restores between steps.
  virtual std::span<double> numbers() = 0;
  virtual std::span<double> carry() = 0;
  // Of the step made last.
  virtual std::shared_ptr<const NumberCurve> curve() = 0;
  // Looks that one step needs, whatever moves.
  virtual int intervals() const = 0;
  virtual Statistics statistics() const = 0;
  virtual void serialize(Archive& bytes) = 0;
};

std::unique_ptr<NumberSteps> collocation_steps(std::shared_ptr<const NumberField> field,
                                               double start, std::vector<double> y,
                                               const Collocation& method);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
