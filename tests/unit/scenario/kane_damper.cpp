// SPDX-License-Identifier: MIT
// [[perturbation]] of kind "kane-damper": its keys, its columns, and what it refuses.
#include <gmock/gmock.h>

#include <string>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

const std::string body = "[body]\nmoments = [1, 1.6, 2.1]\n";
const std::string state =
    "[state.attitude-rate]\nquaternion = [0.5, 0.5, -0.5, 0.5]\nomega_body = [0.7, 1.1, 0.2]\n";
const std::string damper =
    "[[perturbation]]\nkind = \"kane-damper\"\nsphere_moment = 0.3\nfriction = 0.4\n";
const std::string rate = "rate_relative = [0.4, -0.7, 0.2]\n";

io::Scenario read(const std::string& rest, const std::string& of_body = body) {
  return io::scenario_from_text("schema = 1\n" + of_body + state + rest, "f.toml");
}

std::string error_of(const std::string& rest) {
  return test::message_of<io::ScenarioError>([&] { read(rest); });
}

// The rows of a run, and what it reports.
struct Rows final : io::Sink {
  void push(std::span<const double> rows) override {
    numbers.insert(numbers.end(), rows.begin(), rows.end());
  }
  void finish() override {}
  std::vector<double> numbers;
};

TEST(ScenarioKaneDamper, IsThatOfTheSystem) {
  const io::Scenario s = read(damper + rate);
  EXPECT_EQ(s.rotation().damper, KaneDamper(0.3, 0.4));
  EXPECT_EQ(s.rotation().damper_rate, (Vec3{0.4, -0.7, 0.2}));
  EXPECT_EQ(io::rotor_system(s).damper(), s.rotation().damper);
  EXPECT_TRUE(s.rotation().terms.empty());
  EXPECT_EQ(io::propagation_method(s), Method(Collocation{}));
  // g = I w + J s, so that omega_body is the rate of the body
  const System at = at_damper_rate(io::rotor_system(s), s.rotation().damper_rate);
  const Vec3 w = angular_velocity(at, 0.0, io::initial_state(s)).inertial;
  EXPECT_LE(norm(w - Vec3{0.7, 1.1, 0.2}), budget::kane_rounding);
  std::vector<std::string> keys;
  for (const io::Citation& c : io::citations(s)) keys.emplace_back(c.key);
  EXPECT_THAT(keys, Contains("kane1966"));
  EXPECT_EQ(read(damper).rotation().damper_rate, Vec3{});
}

TEST(ScenarioKaneDamper, RateStandsInTheAxesOfTheTensor) {
  // moments 1, 1.6, 2.1 about axes turned by atan(3/4) about the third
  const io::Scenario s = read(
      damper + rate, "[body]\ntensor = [[1.216, -0.288, 0], [-0.288, 1.384, 0], [0, 0, 2.1]]\n");
  EXPECT_LE(norm(rotate(s.rotation().body.q_FB(), s.rotation().damper_rate) - Vec3{0.4, -0.7, 0.2}),
            budget::kane_rounding);
  EXPECT_GT(norm(s.rotation().damper_rate - Vec3{0.4, -0.7, 0.2}), 0.1);
}

TEST(ScenarioKaneDamper, RowsAreThoseOfIntegrate) {
  const io::Scenario s = read(damper + rate +
                              "[[event]]\ncolumn = \"s2\"\nvalue = 0.1\n"
                              "[time]\nstart = 1\nstop = 5\nstep = 2\n"
                              "[output]\ncolumns = [\"omega\", \"damper\", \"energy\"]\n");
  auto rows = std::make_unique<Rows>();
  const Rows& kept = *rows;
  std::vector<std::unique_ptr<io::Sink>> sinks;
  sinks.push_back(std::move(rows));
  const io::RunReport report = io::run(s, sinks);
  const System system = io::rotor_system(s);
  const RotorState& start = io::initial_state(s);
  const Trajectory straight = integrate(
      Problem{system, {start.q, start.g, s.rotation().damper_rate}, 0.0, 5.0, Adaptive{}});
  const double E0 =
      energy(at_damper_rate(system, s.rotation().damper_rate), 0.0, io::initial_state(s));
  ASSERT_EQ(kept.numbers.size(), 3U * 9U);
  for (std::size_t k = 0; k < 3; ++k) {
    const double* row = &kept.numbers[9 * k];
    const SystemState at = straight.at(row[0]);
    const System then = at_damper_rate(system, at.damper_rate);
    const Vec3 w = angular_velocity(then, row[0], at).inertial;
    EXPECT_LE(norm(Vec3{row[1], row[2], row[3]} - w), budget::adaptive_short_run);
    EXPECT_LE(norm(Vec3{row[4], row[5], row[6]} - at.damper_rate), budget::adaptive_short_run);
    EXPECT_NEAR(row[7], energy(then, row[0], at), budget::adaptive_short_run);
    EXPECT_NEAR(row[8], row[7] - E0, budget::adaptive_short_run);
  }
  EXPECT_LT(kept.numbers[26], kept.numbers[17]);
  EXPECT_EQ(report.energy_change, kept.numbers[26]);
  for (const io::RunEvent& event : report.events)
    EXPECT_NEAR(io::record_of<SystemState>(event).s.damper_rate.y, 0.1, budget::adaptive_short_run);
  EXPECT_FALSE(report.events.empty());
}

TEST(ScenarioKaneDamper, RefusesWhatHasNoPlaceForIt) {
  EXPECT_THAT(error_of(damper + damper),
              HasSubstr("perturbation[1].kind: got \"kane-damper\"; expected at most one "
                        "perturbation of this kind"));
  EXPECT_THAT(error_of(damper + "[method]\nkind = \"splitting\"\nstep = 0.1\n"),
              HasSubstr("method.kind: got \"splitting\"; expected \"adaptive\" or \"collocation\", "
                        "since a Kane damper has a state of its own"));
  EXPECT_THAT(error_of(damper + "[method]\nkind = \"variation-of-constants\"\n"),
              HasSubstr("expected \"adaptive\" or \"collocation\""));
  EXPECT_THAT(error_of("[[perturbation]]\nkind = \"kane-damper\"\nsphere_moment = 0.6\n"
                       "friction = 0.4\n"),
              HasSubstr("what is left must be a body"));
  EXPECT_THAT(error_of("[[perturbation]]\nkind = \"kane-damper\"\nsphere_moment = 0.3\n"
                       "friction = -1\n"),
              HasSubstr("friction: got -1; expected a friction that is not negative"));
  EXPECT_THAT(error_of("[time]\nstop = 1\nstep = 1\n[output]\ncolumns = [\"damper\"]\n"),
              HasSubstr("expected a perturbation of kind \"kane-damper\" for it"));
  EXPECT_THAT(error_of("[[event]]\ncolumn = \"s2\"\nvalue = 1\n"),
              HasSubstr("expected a perturbation of kind \"kane-damper\" for it"));
  EXPECT_THAT(error_of(damper + "[time]\nstop = 1\nstep = 1\n[map]\nkind = \"chaos\"\n"
                                "[[map.axis]]\nkey = \"body.moments[0]\"\nfrom = 1\nto = 2\n"
                                "count = 2\n"),
              HasSubstr("has no indicator of chaos"));
}

}  // namespace
}  // namespace polhode
