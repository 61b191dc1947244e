// SPDX-License-Identifier: MIT
// What a checkpoint must agree in: a run does not go on with another method than it began with,
// though its file names none and the default is another one now.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "run/detail/attitude_errors.hpp"
#include "run/detail/checkpointed_outputs.hpp"
#include "scenario_text.hpp"

namespace polhode {
namespace {

using io::detail::Identity;
using io::detail::IdentityPart;
using testing::HasSubstr;

Identity identity_of_torque() {
  const io::Scenario scenario = io::scenario_from_text(
      test::scenario_text("[[perturbation]]\nkind = \"constant-torque\"\ntorque = [0.01, 0, 0]\n"
                          "[time]\nstop = 10\ncount = 11\n",
                          {.rate = "omega_body = [0.1, 0.2, 0.3]\n"}),
      "f.toml");
  return io::detail::identity_of(scenario, {{"f.csv"}, {}, {"q"}});
}

Identity::iterator method_in(Identity& all) {
  return std::find_if(all.begin(), all.end(),
                      [](const IdentityPart& part) { return part.name == "method"; });
}

TEST(IdentityOfRuns, HoldsTheDefaultMethod) {
  Identity ours = identity_of_torque();
  ASSERT_NE(method_in(ours), ours.end());
  EXPECT_EQ(method_in(ours)->text,
            "collocation, tolerance 1e-12 (chosen: the file names no method)");
  EXPECT_EQ(difference(ours, ours), "");
  Identity theirs = ours;
  method_in(theirs)->text = "adaptive, tolerance 1e-12 (chosen: the file names no method)";
  EXPECT_THAT(difference(theirs, ours), HasSubstr("method was \"adaptive, tolerance 1e-12 "));
}

TEST(IdentityOfRuns, SaysWhatAnOlderCheckpointDidNotKeep) {
  const Identity ours = identity_of_torque();
  Identity theirs = ours;
  theirs.erase(method_in(theirs));
  EXPECT_EQ(difference(theirs, ours),
            "method was not kept, is \"collocation, tolerance 1e-12 (chosen: the file names no "
            "method)\"");
}

// Errors of an attitude about the axes, of covariances that are rounded or not known.

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Mat3 diagonal(double x, double y, double z) {
  Mat3 c;
  c(0, 0) = x;
  c(1, 1) = y;
  c(2, 2) = z;
  return c;
}

TEST(AttitudeErrors, AVarianceThatIsRoundedBelowZeroIsZero) {
  const Mat3 c = diagonal(0.25, -1e-20, nan);
  EXPECT_EQ(io::detail::error_about(c, 0), 0.5);
  EXPECT_EQ(io::detail::error_about(c, 1), 0.0);
  EXPECT_TRUE(std::isnan(io::detail::error_about(c, 2)));
}

TEST(AttitudeErrors, AnErrorThatIsNotKnownIsOpenAboutAnyAxis) {
  EXPECT_FALSE(io::detail::is_open(diagonal(1.0, 0.5, -1e-20)));
  for (const double open : {1.5, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(io::detail::is_open(diagonal(open, 0.5, 0.5))) << open;
    EXPECT_TRUE(io::detail::is_open(diagonal(0.5, open, 0.5))) << open;
    EXPECT_TRUE(io::detail::is_open(diagonal(0.5, 0.5, open))) << open;
  }
}

}  // namespace
}  // namespace polhode
