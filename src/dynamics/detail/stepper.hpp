// SPDX-License-Identifier: MIT
// Stepper: what every method is to the loop of integrate. One step at a time; it owns no samples,
// events or files.
#pragma once

#include <memory>
#include <string>

#include "dynamics/detail/state_bytes.hpp"
#include "polhode/dynamics/integrate.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class Stepper {
 public:
  virtual ~Stepper() = default;
  // One step towards `stop`, ending at it or before it (not beyond). An empty string when it was
  // made; otherwise why not and what to try, and the stepper stays where it was.
  virtual std::string advance(double stop) = 0;
  virtual double time() const = 0;
  virtual RotorState state() const = 0;  // at time(), q normalised
  virtual Vec3 damper_rate() const { return {}; }
  // The step just made. Valid until the next advance when `keep` is false, for good otherwise.
  virtual std::shared_ptr<const DenseStep> dense(bool keep) = 0;
  // The same for many looks inside it, and how many intervals between them the step needs whatever
  // the body does: where its own error lets it be long.
  virtual std::shared_ptr<const DenseStep> inside() { return dense(false); }
  virtual int intervals() const { return 1; }
  virtual Statistics statistics() const = 0;
  // Every number that the steps to come and the dense output of the last one depend on: kept, or
  // put back into a stepper of the same problem.
  virtual void transfer(StateBytes& bytes) = 0;
};

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Adaptive& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Splitting& method);
std::unique_ptr<Stepper> make_stepper(const Problem& problem, const VariationOfConstants& method);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
