// SPDX-License-Identifier: MIT
// What a step makes of one deviation is the step's derivative times that deviation: every column of
// the one is the other, two derivations that share the kicks' duals alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "budgets.hpp"
#include "dynamics/splitting/splitting_map.hpp"
#include "unit/dynamics/splitting_support.hpp"

namespace polhode::splitting_test {
namespace {

TEST(SplittingDeviation, IsAColumnOfTheTransition) {
  const System system(Body(1.0, 1.7, 2.1), precessing_frame(),
                      {AnyPerturbation("gravity", PointMassTorque{0.8, 0.2})});
  const Vec3 moving{0.7, -1.1, 0.4}, rest{};
  for (const auto& [scheme, g] : {std::pair{SplittingScheme::order2, moving},
                                  {SplittingScheme::ABA864, moving},
                                  {SplittingScheme::order2, rest},
                                  {SplittingScheme::ABA864, rest}}) {
    const detail::SplittingMap map(system, scheme);
    const detail::SplittingState s =
        map.start(0.4, {normalized(Quaternion{0.3, -0.4, 0.5, 0.6}), g});
    const Matrix6 M = map.step_transition(s, 0.3);
    for (int j = 0; j < 6; ++j) {
      std::array<double, 6> x{};
      x[static_cast<std::size_t>(j)] = 1.0;
      const std::array<double, 6> y = map.step_deviation(s, x, 0.3).x;
      for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(y[static_cast<std::size_t>(i)], M(i, j), budget::splitting_deviation)
            << "entry " << i << ", " << j;
    }
  }
}

}  // namespace
}  // namespace polhode::splitting_test
