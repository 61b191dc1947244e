// SPDX-License-Identifier: MIT
// Light curves that would be observed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "polhode/ensemble/counter_random.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/scenario/fit_plan.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The motion at one time.
struct Seen {
  double t;
  Quaternion q;            // body axes of the file to inertial ones
  Vec3 w;                  // along these body axes
  Quaternion q_principal;  // principal axes to inertial ones
};

// Normal numbers of the seed and the places of table and row.
class Noise {
 public:
  Noise(std::uint64_t seed, std::size_t table)
      : random_(seed, key_of("observation[" + std::to_string(table) + "]")) {}

  Vec3 at(std::size_t row, const Vec3& sigma) const {
    Vec3 x;
    for (int i = 0; i < 3; ++i)
      x[i] = sigma[i] * random_.normal(row, static_cast<std::uint64_t>(i));
    return x;
  }

 private:
  CounterRandom random_;
};

// Of a table of light curves, whose rows are those of the motion.
std::vector<LightCurve> simulated_sessions(const Scenario& scenario, std::size_t table,
                                           const std::vector<Seen>& motion);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
