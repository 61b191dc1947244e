// SPDX-License-Identifier: MIT
// The search for events along the motion of a System.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/adaptive/breakpoints.hpp"
#include "dynamics/adaptive/damper_field.hpp"
#include "dynamics/adaptive/rotor_field.hpp"
#include "polhode/dynamics/detail/event_watch.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The largest |I^-1 g| on the polhode through g: the largest rate of the free motion.
double fastest_rate(const Body& body, const Vec3& g);

// How a sample of a run of a System moves on, and how fast it turns, for the search of events.
class SystemMotion {
 public:
  using State = SystemState;

  explicit SystemMotion(const System& system);

  Sample moved(const Sample& s, double time) const;
  // No direction in the body turns faster as seen from the frame or from inertial axes, nor does
  // the momentum in the body.
  double turning_rate(const Sample& s, bool forward) const;
  static SystemState near(const SystemState& to, SystemState s) {
    const Quaternion &p = to.q, q = s.q;
    if (p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z < 0.0) s.q = {-q.w, -q.x, -q.y, -q.z};
    return s;
  }
  std::int64_t evaluations() const { return evaluations_; }
  void serialize(Archive& bytes) { bytes(evaluations_); }

 private:
  DoubleDouble time_of_rates(const Sample& s, bool forward) const;

  std::variant<RotorField<double>, DamperField<double>> field_;
  Breakpoints breakpoints_;
  mutable std::int64_t evaluations_ = 0;
};

using SystemWatch = EventWatch<SystemMotion>;
extern template class EventWatch<SystemMotion>;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
