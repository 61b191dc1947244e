// SPDX-License-Identifier: MIT
// SwitchWatch: on which side of every switching function of a system a run is.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "polhode/system/rotor_equations.hpp"
#include "polhode/trajectory/state_bytes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class SwitchWatch {
 public:
  // `jumps`, where it is not null, says why no torque may jump at an edge that the state decides:
  // the end of the sentence that refuses it.
  explicit SwitchWatch(const System& system, const char* jumps = nullptr);

  // Whether any term may name a switching function.
  bool is_needed() const { return needed_; }
  // Before the first step: the sides are those of the values. Nothing later. Empty, or which
  // function is NaN.
  std::string begin(const DoubleDouble& t, const RotorState& s);
  // Of the step to come; nullptr where no term has a switching function.
  const std::shared_ptr<const SwitchSides>& sides() const { return sides_; }
  std::size_t size() const { return sides_ ? sides_->values.size() : 0; }

  // The values times their sides: negative where a function has changed its sign. q is a unit
  // quaternion. DomainError when a term does not have as many as before.
  std::vector<double> values(const DoubleDouble& t, const RotorState& s) const;

  // In which the body turns little enough that a facet that turns away and back is seen: within a
  // step the sides are frozen, and light or air would go on from behind.
  double longest_step(const RotorState& s) const;

  // A step has ended where function `which` is zero: its other side holds.
  void cross(std::size_t which);
  // The same without a step between. False when that is said repeatedly: the motion is held
  // at the zero.
  bool cross_at_once(std::size_t which);
  void stepped() { crossed_at_once_ = 0; }
  // Values at the end of a step: how large each function is, and so what of it is rounding.
  void see(const std::vector<double>& values);
  // Below minus this a function has changed its sign; nearer to zero it may stay.
  double rounding(std::size_t which) const;
  // The term of a function and its number in it.
  std::string text(std::size_t which) const;
  std::string nan_text(std::size_t which, double t) const;
  // Why a step may not end at the zero of function `which` at t, in state s; empty when it may, and
  // always without `jumps`. `before` are states of the step: what a kink does to the torque grows
  // away from the zero, and what a jump does is there already.
  std::string refused_jump(std::size_t which, const DoubleDouble& t, const RotorState& s,
                           std::initializer_list<RotorState> before) const;
  // Whether function `which` is the border of a penumbra: one of time alone, at which the torque
  // begins like a fractional power.
  bool is_fading(std::size_t which, const DoubleDouble& t, const RotorState& s) const;

  // By how much the effect of its term is off a straight line in the time from t to t + h, on the
  // sides that hold, per momentum: the largest of a body as it is and turned. Of a fractional power
  // that begins at t.
  double bend(std::size_t which, const DoubleDouble& t, const RotorState& s, double h) const;

  void transfer(StateBytes& bytes);
  // Sides that the dense output of a step keeps.
  void transfer(StateBytes& bytes, std::shared_ptr<const SwitchSides>& sides) const;

 private:
  std::size_t term_of(std::size_t which) const;
  bool depends_on_state(std::size_t which, const DoubleDouble& t, const RotorState& s) const;
  // What the change of side adds to the torque and the rate of its term.
  Effect change(std::size_t which, const DoubleDouble& t, const RotorState& s) const;

  System system_;
  const char* jumps_;
  bool needed_;
  bool begun_ = false;
  std::shared_ptr<const SwitchSides> sides_;
  int crossed_at_once_ = 0;
  std::vector<double> largest_;  // of each function, so far
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
