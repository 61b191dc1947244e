// SPDX-License-Identifier: MIT
#include "dynamics/splitting/step_jumps.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "dynamics/adaptive/falling_root.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::string StepJumps::seen(const SplittingMap& map, const SplittingState& from, double h,
                            const SplittingState& to) {
  if (!switches_.is_needed()) return {};
  // A kink is distinguished from a jump where the change of torque is 1e-6 of what it is at the
  // ends.
  constexpr double close = 1e-9;
  const auto time = [](const SplittingState& s) { return DoubleDouble(s.t.hi, s.t.lo); };
  if (!has_begun_) {
    if (std::string nan = switches_.begin(time(from), map.state(from)); !nan.empty()) return nan;
    has_begun_ = true;
  }
  if (switches_.size() == 0) return {};
  const RotorState end = map.state(to);
  const std::vector<double> values = switches_.values(time(to), end);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) return switches_.nan_text(i, to.t.hi);
    if (!(values[i] < -switches_.rounding(i))) continue;
    const auto value = [&](double x) {
      const SplittingState s = map.stepped(from, x * h);
      return switches_.values(time(s), map.state(s))[i];
    };
    const double x =
        falling_root(value, 0.0, 1.0, 0.5, std::numeric_limits<double>::quiet_NaN(), close);
    const SplittingState edge = map.stepped(from, x * h);
    std::string refused =
        switches_.refused_jump(i, time(edge), map.state(edge), {map.state(from), end});
    if (!refused.empty()) return refused;
    switches_.cross(i);
  }
  switches_.see(values);
  return {};
}

std::string StepJumps::seen_in_part(const SplittingMap& map, const SplittingState& from, double h,
                                    const SplittingState& to) const {
  if (!switches_.is_needed()) return {};  // without a copy
  return StepJumps(*this).seen(map, from, h, to);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
