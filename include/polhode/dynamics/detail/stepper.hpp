// SPDX-License-Identifier: MIT
// What every method is to the loop: one step of any state at a time. A stepper owns no samples,
// events or files.
#pragma once

#include <memory>
#include <string>

#include "polhode/detail/trajectory/archive.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <MotionState S>
class BasicStepper {
 public:
  virtual ~BasicStepper() = default;
  // One step towards `stop`, ending at it or before it (not beyond). An empty string when it was
  // made; otherwise why not and what to try, and the stepper stays where it was.
  virtual std::string advance(double stop) = 0;
  virtual double time() const = 0;
  virtual S state() const = 0;  // at time(), normalised
  // The step just made. Valid until the next advance when `keep` is false, for good otherwise.
  virtual std::shared_ptr<const BasicDenseStep<S>> dense(bool keep) = 0;
  // The same for many looks inside it, and how many intervals between them the step needs whatever
  // the body does: where its own error lets it be long.
  virtual std::shared_ptr<const BasicDenseStep<S>> inside() { return dense(false); }
  virtual int intervals() const { return 1; }
  virtual Statistics statistics() const = 0;
  // Every number that the steps to come and the dense output of the last one depend on: kept, or
  // put back into a stepper of the same problem.
  virtual void serialize(Archive& bytes) = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
