// SPDX-License-Identifier: MIT
#include "polhode/dynamics/satellite_path.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <string_view>

#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace satellites {
namespace {

struct SatelliteMotion {
  using State = SatelliteState;
  using Values = std::array<double, 6>;
  static constexpr std::string_view name = "a satellite";

  SatelliteSystem system;

  template <std::same_as<double> T>
  Values values(const SatelliteState& s) const {
    return {s.r.x, s.r.y, s.r.z, s.p.x, s.p.y, s.p.z};
  }
  SatelliteState state(const Values& y) const { return {{y[0], y[1], y[2]}, {y[3], y[4], y[5]}}; }
  Values rates(const DoubleDouble& t, const Values& y) const {
    return values<double>(satellite_rates(system, to_double(t), state(y)));
  }
  // With the increment, since a satellite may be released at rest.
  double error_size(const Values& error, const Values& y, const Values& increment) const {
    const SatelliteState e = state(error), s = state(y), d = state(increment);
    return std::max(norm(e.r) / (norm(s.r) + norm(d.r)), norm(e.p) / (norm(s.p) + norm(d.p)));
  }
};

}  // namespace

BasicTrajectory<SatelliteState> satellite_path(const SatelliteSystem& system,
                                               const SatelliteState& state, double start,
                                               double stop, const Method& method,
                                               const Progress& progress) {
  return integrate(BasicProblem<SatelliteMotion>{{system}, state, start, stop, method}, Keep{},
                   progress);
}

}  // namespace satellites
}  // namespace v0
}  // namespace polhode
