// SPDX-License-Identifier: MIT
// The drive of a fit whose scenario is gone.
#include "polhode/detail/scenario/fit_drive.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string_view>
#include <vector>

#include "polhode/scenario/scenario.hpp"

namespace {
using namespace polhode;

constexpr std::string_view pushed = R"(schema = 1
kind = "fit"
[units]
time = "h"
angle = "deg"
[body]
moments = [1, 2.2, 2.6]
[state.attitude-rate]
euler = { phi = 20, theta = 60, psi = 110 }
omega_body = [3, 4, 12]
[free]
unknowns = ["attitude", "rate"]
[[free.parameter]]
key = "perturbation[0].torque[2]"
[[perturbation]]
kind = "constant-torque"
torque = [0.1, 0, 0.3]
[[observation]]
kind = "attitude"
file = "none.csv"
times = "at-body"
sigma = 1
)";

TEST(SpinDrive, OutlivesItsScenario) {
  auto scenario = std::make_unique<io::Scenario>(io::scenario_from_text(pushed, "pushed.toml"));
  const fit::SpinDrive drive = io::spin_drive(*scenario);
  scenario.reset();
  ASSERT_EQ(drive.parameters.size(), 1u);
  EXPECT_EQ(drive.parameters[0].start, 0.3);
  EXPECT_EQ(drive.terms(std::vector<double>{0.5}).size(), 1u);
}

}  // namespace
