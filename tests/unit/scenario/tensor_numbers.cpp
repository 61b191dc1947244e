// SPDX-License-Identifier: MIT
// Elements of an inertia tensor as numbers of a file: an element off the diagonal stands twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "polhode/run/map_run.hpp"
#include "polhode/scenario/scenario.hpp"

namespace {

namespace budget = polhode::budget;

using polhode::Mat3;
using polhode::io::Scenario;
using polhode::io::ScenarioEnsemble;
using testing::ElementsAre;

const std::string body = R"(schema = 1
[body]
tensor = [[1, 0.1, -0.02], [0.1, 1.7, 0.03], [-0.02, 0.03, 2.2]]
[state.attitude-rate]
quaternion = [1, 0, 0, 0]
omega_body = [0.1, 0.2, 1]
[time]
stop = 2
step = 1
)";

std::string ensemble(const std::string& vary) {
  return body + "[ensemble]\nsize = 8\nkeep = \"final\"\n[[ensemble.vary]]\n" + vary;
}

// The tensor that principal moments and axes come from.
Mat3 tensor_of(const polhode::Body& b) {
  const Mat3 R = polhode::rotation_matrix(b.q_FB());
  Mat3 diagonal;
  for (int i = 0; i < 3; ++i) diagonal(i, i) = b.moments()[i];
  return R * diagonal * transpose(R);
}

TEST(TensorNumbers, AnElementVariesWithItsMirror) {
  for (const std::string key : {"body.tensor[0][1]", "body.tensor[1][0]", "body.tensor[3]"}) {
    const ScenarioEnsemble of(
        ensemble("kind = \"uniform\"\nkey = \"" + key + "\"\nlow = 0\nhigh = 0.3\n"), "t.toml");
    EXPECT_THAT(of.plan().keys(), ElementsAre("body.tensor[0][1]"));
    for (std::int64_t k = 0; k < 8; ++k) {
      const Scenario member = of.member_scenario(k);
      const double drawn = of.plan().numbers(k)[0];
      const Mat3 T = tensor_of(member.rotation().body);
      EXPECT_NEAR(T(0, 1), drawn, budget::io_convert);
      EXPECT_NEAR(T(1, 2), 0.03, budget::io_convert);
      // the text of the member is the same body, to the last bit
      const Scenario read = polhode::io::scenario_from_text(of.member_text(k), "t.toml");
      EXPECT_EQ(read.rotation().body.moments(), member.rotation().body.moments());
      EXPECT_EQ(read.rotation().body.q_FB(), member.rotation().body.q_FB());
      EXPECT_EQ(of.member(k).failure, "");
    }
  }
}

TEST(TensorNumbers, AWholeTensorIsItsUpperHalf) {
  const ScenarioEnsemble of(ensemble(R"(kind = "joint-normal"
keys = ["body.tensor"]
covariance = [[1e-4, 0, 0, 2e-5, 0, 0], [0, 1e-4, 0, 0, 0, 0], [0, 0, 1e-4, 0, 0, 0],
              [2e-5, 0, 0, 1e-4, 0, 0], [0, 0, 0, 0, 1e-4, 0], [0, 0, 0, 0, 0, 1e-4]]
)"),
                            "t.toml");
  EXPECT_THAT(of.plan().keys(),
              ElementsAre("body.tensor[0][0]", "body.tensor[0][1]", "body.tensor[0][2]",
                          "body.tensor[1][1]", "body.tensor[1][2]", "body.tensor[2][2]"));
  for (std::int64_t k = 0; k < 8; ++k) {
    const std::vector<double> x = of.plan().numbers(k);
    const Mat3 T = tensor_of(of.member_scenario(k).rotation().body);
    const double expected[6] = {T(0, 0), T(0, 1), T(0, 2), T(1, 1), T(1, 2), T(2, 2)};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(x[i], expected[i], budget::io_convert);
  }
}

TEST(TensorNumbers, ATensorThatNoBodyHasIsAMemberThatFailed) {
  const ScenarioEnsemble of(
      ensemble("kind = \"uniform\"\nkey = \"body.tensor[0][1]\"\nlow = 1.5\nhigh = 2\n"), "t.toml");
  EXPECT_THAT(of.member(0).failure, testing::HasSubstr("body.tensor: got"));
  EXPECT_FALSE(of.member_text(0).empty());
}

TEST(TensorNumbers, AMapHasThemOnItsAxes) {
  const polhode::io::ScenarioMap map(body + R"([map]
kind = "column"
column = "w1"
[[map.axis]]
key = "body.tensor[0][1]"
from = 0
to = 0.2
count = 3
)",
                                     "t.toml");
  for (std::int64_t k = 0; k < 3; ++k) EXPECT_EQ(map.cell(k).failure, "");
}

TEST(TensorNumbers, OtherIndicesAreRejected) {
  for (const std::string key : {"body.tensor[0][3]", "body.tensor[3][0]", "body.tensor[9]",
                                "body.tensor[0][0][0]", "state.attitude-rate.omega_body[0][0]"})
    EXPECT_THAT(polhode::test::message_of([&] {
                  polhode::io::ScenarioEnsemble(
                      ensemble("kind = \"uniform\"\nkey = \"" + key + "\"\nlow = 0\nhigh = 0.3\n"),
                      "t.toml");
                }),
                testing::HasSubstr("expected a key that holds a number"))
        << key;
  // the same number twice
  EXPECT_THAT(polhode::test::message_of([&] {
                polhode::io::ScenarioEnsemble(
                    ensemble("kind = \"uniform\"\nkey = \"body.tensor[0][1]\"\nlow = 0\n"
                             "high = 0.1\n[[ensemble.vary]]\nkind = \"uniform\"\n"
                             "key = \"body.tensor[1][0]\"\nlow = 0\nhigh = 0.1\n"),
                    "t.toml");
              }),
              testing::HasSubstr("comes twice"));
}

// Two numbers of an array that the file leaves to its default.
TEST(MemberText, WritesADefaultOnceForAllOfItsNumbers) {
  const std::string file = body + R"([[perturbation]]
kind = "gravity-gradient"
orbit = "it"
J2 = 0.001
primary_radius = 1
[orbit.it]
gm = 1
semi_major_axis = 3
)";
  const std::string vary = R"([ensemble]
size = 4
keep = "final"
[[ensemble.vary]]
kind = "uniform"
key = "perturbation[0].pole[0]"
low = 0.1
high = 0.2
[[ensemble.vary]]
kind = "uniform"
key = "perturbation[0].pole[1]"
low = 0.3
high = 0.4
)";
  const ScenarioEnsemble of(file + vary, "t.toml");
  for (std::int64_t k = 0; k < 4; ++k) {
    const std::vector<double> x = of.plan().numbers(k);
    const std::string text = of.member_text(k);
    const Scenario read = polhode::io::scenario_from_text(text, "t.toml");
    const auto same = [](const Scenario& s) {
      return polhode::effect(rotor_system(s), 0.3, initial_state(s)).u;
    };
    EXPECT_EQ(same(read), same(of.member_scenario(k))) << text;
  }
}

}  // namespace
