// SPDX-License-Identifier: MIT
// [ensemble]: what a file asks for is what is drawn, in the units of the file.
#include <gmock/gmock.h>

#include <cmath>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string body = R"(schema = 1
units = { time = "h", angle = "deg" }
body.moments = [1, 1.7, 2.2]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [3, 4, "0.07 rad/h"] }
time = { stop = 20, step = 0.5 }
)";

io::EnsemblePlan plan_of(const std::string& ensemble) {
  return *io::scenario_from_text(body + "[ensemble]\n" + ensemble, "e.toml").ensemble;
}
std::string refusal_of(const std::string& ensemble) {
  return test::message_of<io::ScenarioError>([&] { static_cast<void>(plan_of(ensemble)); });
}
std::string vary(const std::string& keys) { return "\n[[ensemble.vary]]\n" + keys; }
const std::string w = "state.attitude-rate.omega_body";

TEST(EnsemblePlan, TheMeanIsThatOfTheFileInItsUnit) {
  const io::EnsemblePlan plan =
      plan_of("size = 10" + vary("kind = \"normal\"\nkey = \"" + w + "[2]\"\nsigma = 0.01") +
              vary("kind = \"normal\"\nkey = \"" + w + "[0]\"\nsigma = 0"));
  EXPECT_THAT(plan.keys(), ElementsAre(w + "[2]", w + "[0]"));
  EXPECT_THAT(plan.units(), ElementsAre("rad/h", "deg/h"));
  const auto& normal = std::get<ensemble::Normal>(plan.draws.varied()[0].distribution);
  EXPECT_NEAR(normal.mean(), 0.07, budget::ensemble_rounding);
  EXPECT_NEAR(plan.numbers(7)[1], 3.0, budget::ensemble_rounding);
  EXPECT_EQ(plan.numbers(7)[0], plan.draws.value(7, 0));
}

TEST(EnsemblePlan, WhatIsLeftOut) {
  const std::string one = vary("kind = \"uniform\"\nkey = \"" + w + "[0]\"\nlow = 0\nhigh = 1");
  const io::EnsemblePlan plan = plan_of("size = 1000" + one);
  EXPECT_EQ(plan.seed, 1U);
  EXPECT_EQ(plan.keep, io::EnsembleKeep::statistics);
  EXPECT_THAT(plan.quantiles, ElementsAre(0.05, 0.5, 0.95));
  EXPECT_EQ(plan.chunk, 16);
  EXPECT_EQ(plan_of("size = 1" + one).chunk, 1);
  EXPECT_EQ(plan_of("size = 1000000" + one).chunk, 1024);
  EXPECT_EQ(plan_of("size = 9\nchunk = 5" + one).chunk, 5);
}

TEST(EnsemblePlan, AKeyIsDrawnTheSameWhateverElseVaries) {
  const std::string one = vary("kind = \"uniform\"\nkey = \"" + w + "[0]\"\nlow = 0\nhigh = 1");
  const std::string two = vary("kind = \"attitude\"\nkeys = [\"state.attitude-rate.quaternion\"]");
  const io::EnsemblePlan alone = plan_of("size = 10" + one),
                         both = plan_of("size = 10" + two + one);
  EXPECT_EQ(alone.numbers(3)[0], both.numbers(3)[4]);
  EXPECT_NE(alone.numbers(3)[0], plan_of("size = 10\nseed = 2" + one).numbers(3)[0]);
}

TEST(EnsemblePlan, SeveralGridsAreOne) {
  const auto grid = [](const std::string& key, const char* count) {
    return vary("kind = \"grid\"\nkey = \"" + key + "\"\nfrom = 1\nto = 2\ncount = " + count);
  };
  const io::EnsemblePlan plan =
      plan_of("size = 9" + grid(w + "[0]", "2") +
              vary("kind = \"log-uniform\"\nkey = \"body.moments[1]\"\nlow = 1\nhigh = 2") +
              grid(w + "[1]", "3"));
  EXPECT_THAT(plan.keys(), ElementsAre(w + "[0]", w + "[1]", "body.moments[1]"));
  const auto point = [&](std::int64_t k) {
    const std::vector<double> x = plan.numbers(k);
    return std::vector<double>{x[0], x[1]};
  };
  EXPECT_THAT(point(0), ElementsAre(1.0, 1.0));
  EXPECT_THAT(point(1), ElementsAre(1.0, 1.5));
  EXPECT_THAT(point(5), ElementsAre(2.0, 2.0));
  EXPECT_THAT(point(6), ElementsAre(1.0, 1.0));
}

TEST(EnsemblePlan, DirectionsKeepTheLengthOfTheFile) {
  std::string text = body;
  text.replace(text.find("\"0.07 rad/h\""), 12, "12");
  const io::EnsemblePlan plan =
      *io::scenario_from_text(
           text + "[ensemble]\nsize = 3" + vary("kind = \"direction\"\nkeys = [\"" + w + "\"]"),
           "e.toml")
           .ensemble;
  for (std::int64_t k = 0; k < 3; ++k) {
    const std::vector<double> x = plan.numbers(k);
    EXPECT_NEAR(std::hypot(x[0], x[1], x[2]), 13.0, budget::ensemble_rounding);
  }
  EXPECT_THAT(refusal_of("size = 3" + vary("kind = \"direction\"\nkeys = [\"" + w + "\"]")),
              HasSubstr("expected keys whose numbers have one unit in this file"));
}

TEST(EnsemblePlan, WrapsWhatHasRows) {
  std::string text = body;
  text.erase(text.find("time = {"));
  const std::string one = vary("kind = \"uniform\"\nkey = \"" + w + "[0]\"\nlow = 0\nhigh = 1");
  EXPECT_THAT(
      test::message_of<io::ScenarioError>([&] {
        static_cast<void>(io::scenario_from_text(text + "[ensemble]\nsize = 3" + one, "e.toml"));
      }),
      HasSubstr("ensemble: expected a table [time] as well"));
}

}  // namespace
}  // namespace polhode
