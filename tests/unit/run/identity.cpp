// SPDX-License-Identifier: MIT
// What a checkpoint must agree in: a run does not go on with another method than it began with,
// though its file names none and the default is another one now.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "run/detail/checkpoint.hpp"

namespace polhode {
namespace {

using detail::Identity;
using detail::IdentityPart;
using testing::HasSubstr;

Identity identity_of_torque() {
  const Scenario scenario = scenario_from_text(
      "schema = 1\n[body]\nmoments = [1, 2, 2.5]\n[state.attitude-rate]\n"
      "quaternion = [1, 0, 0, 0]\nomega_body = [0.1, 0.2, 0.3]\n"
      "[[perturbation]]\nkind = \"constant-torque\"\ntorque = [0.01, 0, 0]\n"
      "[time]\nstop = 10\ncount = 11\n",
      "f.toml");
  return detail::identity_of(scenario, {{"f.csv"}, {}, {"q"}});
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

}  // namespace
}  // namespace polhode
