// SPDX-License-Identifier: MIT
// A scenario's run reports how far it has come, and can be stopped from outside.
#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "polhode/run/detail/run_state.hpp"
#include "polhode/run/run.hpp"
#include "scenario_text.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::smaller;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct Interrupt {};

// Counts what comes, and whether anybody said that it was all.
struct Counted {
  std::size_t numbers = 0;
  bool finished = false;
};
class CountingSink final : public io::Sink {
 public:
  explicit CountingSink(Counted& counted) : counted_(counted) {}
  void push(std::span<const double> rows) override { counted_.numbers += rows.size(); }
  void finish() override { counted_.finished = true; }

 private:
  Counted& counted_;
};

io::Scenario scenario(const std::string& rest) {
  return io::scenario_from_text(test::scenario_text("[output]\ncolumns = [\"q\"]\n" + rest,
                                                    {.quaternion = "[0.5, 0.5, 0.5, 0.5]"}),
                                "f.toml");
}

io::RunReport run_into(const io::Scenario& s, Counted& counted, const Progress& progress) {
  std::vector<std::unique_ptr<io::Sink>> sinks;
  sinks.push_back(std::make_unique<CountingSink>(counted));
  return io::run(s, sinks, progress);
}

const std::string torque = "[[perturbation]]\nkind = \"constant-torque\"\ntorque = [0.1, 0, 0]\n";
const std::string turning = "[frame.precessing]\naxis = [1, 0, 0]\nrate = 1\n";

TEST(ScenarioProgress, FreeRotationTellsAlongItsRows) {
  for (const std::string& frame : {std::string(), turning}) {
    Counted counted;
    std::vector<double> reported;
    run_into(scenario(frame + "[time]\nstop = 2999\ncount = 3000\n"), counted,
             [&](double t) { reported.push_back(t); });
    reported.insert(reported.begin(), 0.0);
    for (std::size_t k = 1; k < reported.size(); ++k) {
      EXPECT_GT(reported[k], reported[k - 1]);
      EXPECT_LE(reported[k] - reported[k - 1], 1024.0);
    }
    EXPECT_EQ(reported.back(), 2999.0);
  }
}

TEST(ScenarioProgress, WhatItThrowsLeavesTheRowsSoFarAndNoFinishedSink) {
  for (const std::string& motion : {std::string(), turning, torque}) {
    Counted counted;
    const io::Scenario s = scenario(motion + "[time]\nstop = 1e7\nstep = 0.5\n");
    const Progress stops = [](double t) {
      if (t > 600.0) throw Interrupt{};
    };
    EXPECT_THROW(run_into(s, counted, stops), Interrupt);
    EXPECT_FALSE(counted.finished);
    const std::size_t width = io::row_layout(s).width();
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

// A run goes to `stop`, also where that is no whole number of steps behind the first row.

class Kept final : public io::Sink {
 public:
  explicit Kept(std::vector<double>& numbers) : numbers_(numbers) {}
  void push(std::span<const double> block) override {
    numbers_.insert(numbers_.end(), block.begin(), block.end());
  }
  void finish() override {}

 private:
  std::vector<double>& numbers_;
};

// A steady spin: qw is zero at t = pi, and qz at 2 pi.
io::Scenario scenario(const std::string& time, const std::string& rest) {
  return io::scenario_from_text(
      test::scenario_text("[output]\ncolumns = [\"q\"]\n[time]\n" + time + rest,
                          {.rate = "omega_body = [0, 0, 1]\n"}),
      "f.toml");
}
const std::string half = "[[event]]\nname = \"half\"\ncolumn = \"qw\"\nvalue = 0\n";
const std::string methods[] = {"", "[method]\nkind = \"collocation\"\n",
                               "[method]\nkind = \"adaptive\"\n",
                               "[method]\nkind = \"splitting\"\nstep = 0.4\n",
                               "[frame.precessing]\naxis = [0, 0, 1]\nrate = 0\n"};

struct Ran {
  std::vector<double> numbers;
  io::RunReport report;
  std::vector<std::pair<io::detail::RunState, std::string>> states;  // with what moves
};
Ran ran(const io::Scenario& s, const std::pair<io::detail::RunState, std::string>* from = nullptr) {
  Ran all;
  std::vector<std::unique_ptr<io::Sink>> sinks;
  sinks.push_back(std::make_unique<Kept>(all.numbers));
  io::detail::RunControl control;
  control.due = [](double) { return true; };
  control.keep = [&](const io::detail::RunState& state, const io::detail::WriteMotion& motion) {
    Archive bytes;
    motion(bytes);
    all.states.emplace_back(state, bytes.bytes());
  };
  Archive motion(from != nullptr ? std::string_view(from->second) : std::string_view());
  if (from != nullptr) {
    control.rows = from->first.rows;
    control.motion = &motion;
  }
  all.report = io::detail::run_rows(s, sinks, control);
  return all;
}

TEST(ToStop, EventsBehindTheLastRowAreMet) {
  for (const std::string& method : methods) {
    const Ran whole = ran(scenario("stop = 3\nstep = 1\n", method + half));
    EXPECT_TRUE(whole.report.events.empty()) << method;
    const Ran run = ran(scenario("stop = 3.9\nstep = 1\n", method + half));
    EXPECT_EQ(run.numbers, whole.numbers) << method;
    EXPECT_EQ(run.report.outcome.t, 3.9) << method;
    ASSERT_EQ(run.report.events.size(), 1U) << method;
    EXPECT_NEAR(run.report.events[0].t, std::numbers::pi, budget::event_time_of_line) << method;
    if (run.report.end) {
      EXPECT_EQ(run.report.end->t, 3.9);
    }
    // backwards, and without any row but the first
    for (const char* const time : {"stop = -3.9\nstep = -1\n", "stop = -3.9\nstep = -5\n"})
      EXPECT_EQ(ran(scenario(time, method + half)).report.events.size(), 1U) << method << time;
  }
}

TEST(ToStop, AnEventBehindTheLastRowStopsTheRun) {
  for (const std::string& method : methods) {
    const Ran run = ran(scenario("stop = 3.9\nstep = 1\n", method + half + "stops = true\n"));
    EXPECT_EQ(run.report.outcome.status, Outcome::Status::stopped_by_event) << method;
    ASSERT_EQ(run.numbers.size() % 5, 0U);
    EXPECT_EQ(run.numbers.size() / 5, 5U) << method;  // rows at 0, 1, 2, 3 and the event
    EXPECT_EQ(run.numbers[20], run.report.outcome.t) << method;
  }
}

// From every state that a run offers, behind the last row too.
TEST(ToStop, AContinuedRunIsTheStraightOne) {
  for (const std::string& method : methods) {
    const io::Scenario s = scenario("stop = 7\nstep = 4\n", method + half);
    const Ran straight = ran(s);
    ASSERT_EQ(straight.report.events.size(), 1U) << method;
    for (const auto& kept : straight.states) {
      const io::detail::RunState& state = kept.first;
      const Ran rest = ran(s, &kept);
      const std::size_t before = static_cast<std::size_t>(state.rows) * 5;
      EXPECT_EQ(before + rest.numbers.size(), straight.numbers.size()) << method << state.t;
      EXPECT_TRUE(std::equal(rest.numbers.begin(), rest.numbers.end(),
                             straight.numbers.end() - static_cast<int>(rest.numbers.size())));
      EXPECT_EQ(rest.report.outcome.t, 7.0);
      EXPECT_EQ(rest.report.end, straight.report.end) << method << state.t;
    }
  }
}

// An ephemeris is tabulated over the run, behind the last row too.
TEST(ToStop, OrbitsCoverTheWholeRun) {
  const Ran run = ran(io::scenario_from_text(
      test::scenario_text(
          "[orbit.moon]\nkind = \"ephemeris\"\ntarget = \"moon\"\n"
          "centre = \"earth\"\n[[perturbation]]\nkind = \"gravity-gradient\"\norbit = \"moon\"\n"
          "[time]\nstop = 3.9\nstep = 1\n",
          {.units = "[units]\ntime = \"d\"\nlength = \"km\"\nmoment = \"kg m2\"\n",
           .state = "[state]\nepoch = \"2013-01-05T00:00:00 UTC\"\naxes = \"equator-J2000\"\n",
           .rate = "omega_body = [0, 0, 1]\n"}),
      "f.toml"));
  EXPECT_TRUE(run.report.outcome.ok()) << run.report.outcome.advice;
  EXPECT_EQ(run.numbers.size() % 4, 0U);
}

TEST(ToStop, ANoteSaysWhereTheRowsEnd) {
  EXPECT_THAT(io::provenance(scenario("stop = 3.9\nstep = 1\n", "")).notes,
              Contains(HasSubstr("t = 3 s, lies before stop = 3.9 s")));
  for (const char* const time : {"stop = 3\nstep = 1\n", "stop = 3.9\ncount = 3\n", "at = [1, 3]\n",
                                 "stop = 0.3\nstep = 0.1\n", "stop = 2.1\nstep = 0.7\n"})
    EXPECT_THAT(io::provenance(scenario(time, "")).notes,
                Not(Contains(HasSubstr("lies before stop"))));
}

}  // namespace
}  // namespace polhode
