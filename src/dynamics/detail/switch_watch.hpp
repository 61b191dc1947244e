// SPDX-License-Identifier: MIT
// SwitchWatch: on which side of every switching function of a system a run is.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dynamics/detail/adaptive_field.hpp"
#include "dynamics/detail/state_bytes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class SwitchWatch {
 public:
  explicit SwitchWatch(const System& system);

  // Whether any term may name a switching function.
  bool is_needed() const { return needed_; }
  // Before the first step: the sides are those of the values. Nothing later.
  void begin(const DoubleDouble& t, const RotorState& s);
  // Of the step to come; nullptr where no term has a switching function.
  const std::shared_ptr<const SwitchSides>& sides() const { return sides_; }
  std::size_t size() const { return sides_ ? sides_->values.size() : 0; }

  // The values times their sides: negative where a function has changed its sign. q is a unit
  // quaternion. DomainError when a term does not have as many as before.
  std::vector<double> values(const DoubleDouble& t, const RotorState& s) const;

  // A step has ended where function `which` is zero: its other side holds.
  void cross(std::size_t which);
  // The same without a step between. False when that is said again and again: the motion is held
  // at the zero.
  bool cross_at_once(std::size_t which);
  void stepped() { crossed_at_once_ = 0; }
  // Values at the end of a step: how large each function is, and so what of it is rounding.
  void see(const std::vector<double>& values);
  // Below minus this a function has changed its sign; nearer to zero it may stay.
  double rounding(std::size_t which) const;
  // The term of a function and its number in it.
  std::string text(std::size_t which) const;

  void transfer(StateBytes& bytes);
  // Sides that the dense output of a step keeps.
  void transfer(StateBytes& bytes, std::shared_ptr<const SwitchSides>& sides) const;

 private:
  System system_;
  bool needed_;
  bool begun_ = false;
  std::shared_ptr<const SwitchSides> sides_;
  int crossed_at_once_ = 0;
  std::vector<double> largest_;  // of each function, so far
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
