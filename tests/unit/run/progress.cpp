// SPDX-License-Identifier: MIT
// A scenario's run reports how far it has come, and can be stopped from outside.
#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "polhode/run/run.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::smaller;

struct Interrupt {};

// Counts what comes, and whether anybody said that it was all.
struct Counted {
  std::size_t numbers = 0;
  bool finished = false;
};
class CountingSink final : public Sink {
 public:
  explicit CountingSink(Counted& counted) : counted_(counted) {}
  void push(std::span<const double> rows) override { counted_.numbers += rows.size(); }
  void finish() override { counted_.finished = true; }

 private:
  Counted& counted_;
};

Scenario scenario(const std::string& rest) {
  return scenario_from_text(
      "schema = 1\n[body]\nmoments = [1, 2, 2.5]\n[state.attitude-rate]\n"
      "quaternion = [0.5, 0.5, 0.5, 0.5]\nomega_body = [0.1, 0.2, 1]\n"
      "[output]\ncolumns = [\"q\"]\n" +
          rest,
      "f.toml");
}

RunReport run_into(const Scenario& s, Counted& counted, const Progress& progress) {
  std::vector<std::unique_ptr<Sink>> sinks;
  sinks.push_back(std::make_unique<CountingSink>(counted));
  return run(s, sinks, progress);
}

const std::string torque = "[[perturbation]]\nkind = \"constant-torque\"\ntorque = [0.1, 0, 0]\n";
const std::string turning = "[frame.precessing]\naxis = [1, 0, 0]\nrate = 1\n";

TEST(ScenarioProgress, FreeRotationTellsAfterEveryBlockOfRows) {
  for (const std::string& frame : {std::string(), turning}) {
    Counted counted;
    std::vector<double> reported;
    run_into(scenario(frame + "[time]\nstop = 2999\ncount = 3000\n"), counted,
             [&](double t) { reported.push_back(t); });
    EXPECT_THAT(reported, testing::ElementsAre(1023.0, 2047.0, 2999.0));
  }
}

TEST(ScenarioProgress, WhatItThrowsLeavesTheRowsSoFarAndNoFinishedSink) {
  for (const std::string& motion : {std::string(), turning, torque}) {
    Counted counted;
    const Scenario s = scenario(motion + "[time]\nstop = 1e7\nstep = 0.5\n");
    const Progress stops = [](double t) {
      if (t > 600.0) throw Interrupt{};
    };
    EXPECT_THROW(run_into(s, counted, stops), Interrupt);
    EXPECT_FALSE(counted.finished);
    const std::size_t width = row_layout(s).width();
    EXPECT_GE(counted.numbers, 1200 * width);
    EXPECT_LE(counted.numbers, 2048 * width);
  }
}

// The way from t = 0 to the first row may be the longest part of a run.
TEST(ScenarioProgress, TheWayToTheFirstRowIsToldToo) {
  Counted counted;
  double earliest = 1e9;
  run_into(scenario(torque + "[time]\nstart = 100\nstop = 110\nstep = 1\n"), counted,
           [&](double t) { earliest = smaller(earliest, t); });
  EXPECT_LT(earliest, 10.0);
  EXPECT_TRUE(counted.finished);
}

}  // namespace
}  // namespace polhode
