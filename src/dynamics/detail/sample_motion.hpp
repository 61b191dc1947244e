// SPDX-License-Identifier: MIT
// How a sample of a run moves on, and how fast it turns: what looks at a function of it need.
#pragma once

#include <memory>
#include <variant>

#include "dynamics/detail/adaptive_field.hpp"
#include "dynamics/detail/breakpoints.hpp"
#include "dynamics/detail/damper_field.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The largest |I^-1 g| on the polhode through g: the largest rate of the free motion.
double fastest_rate(const Body& body, const Vec3& g);

class SampleMotion {
 public:
  explicit SampleMotion(const System& system);

  // After a time so short that the rates stay what they are, on the side of it.
  Sample moved(const Sample& s, double time) const;
  // rad per unit of time: no direction in the body turns faster as seen from the frame or from
  // inertial axes, nor does the momentum in the body, before the terms have changed the motion.
  double turning_rate(const Sample& s, bool forward) const;

 private:
  DamperValues<double> rates(const Sample& s, bool forward) const;

  std::variant<RotorField<double>, DamperField<double>> field_;
  Breakpoints breakpoints_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
