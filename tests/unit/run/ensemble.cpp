// SPDX-License-Identifier: MIT
// Ensembles: a member is the scenario that its text is, alone and among others; rows and statistics
// come whatever the threads.
#include <gmock/gmock.h>

#include <atomic>
#include <bit>
#include <stdexcept>
#include <utility>

#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "polhode/run/run.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using ::testing::HasSubstr;

const std::string body = R"(schema = 1
units = { time = "h", angle = "deg", moment = "kg m2" }
body.moments = { value = [1000, 1700, 2200], unit = "kg m2" }
[state.euler]
phi = 10
theta = "60 deg"
psi = "0.5 rad"
Phi = 800
Theta = 100
Psi = 900
[time]
stop = 20
step = 0.5
)";
const std::string varied = R"(
[ensemble]
size = 20
chunk = 6
[[ensemble.vary]]
kind = "uniform"
key = "body.moments[1]"
low = 1500
high = 1900
[[ensemble.vary]]
kind = "normal"
key = "state.euler.psi"
sigma = 0.1
)";
const std::string torque = R"(
[[perturbation]]
kind = "constant-torque"
torque = [1, 0, 2]
)";

// Rows in memory.
class Rows : public Sink {
 public:
  explicit Rows(std::vector<double>& rows) : rows_(rows) {}
  void push(std::span<const double> rows) override {
    rows_.insert(rows_.end(), rows.begin(), rows.end());
  }
  void finish() override {}

 private:
  std::vector<double>& rows_;
};

std::vector<double> rows_of(const Scenario& scenario) {
  std::vector<double> rows;
  std::unique_ptr<Sink> sink = std::make_unique<Rows>(rows);
  run(scenario, {&sink, 1});
  return rows;
}

std::vector<double> ensemble_rows(const std::string& text, int threads) {
  const ScenarioEnsemble ensemble(text, "e.toml");
  std::vector<double> rows;
  EnsembleOptions options;
  options.threads = threads;
  options.extra_sink = std::make_unique<Rows>(rows);
  EnsembleRun(ensemble, {}, std::move(options)).run();
  return rows;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

TEST(ScenarioEnsemble, AMemberIsTheScenarioOfItsText) {
  for (const std::string& extra :
       {std::string(), torque, torque + "[method]\nkind = \"adaptive\"\n",
        std::string("[frame.precessing]\naxis = [0, 0, 1]\nrate = 1\n")}) {
    const ScenarioEnsemble ensemble(body + extra + varied, "e.toml");
    const std::vector<EnsembleMember> members = ensemble.members(0, 9);
    for (const std::int64_t k : {0, 5, 8}) {
      const std::string text = ensemble.member_text(k);
      EXPECT_THAT(text, HasSubstr(" rad\""));
      const std::vector<double> rows = rows_of(scenario_from_text(text, "m.toml"));
      EXPECT_EQ(rows.size(), 41 * row_width(ensemble.row_groups()));
      EXPECT_TRUE(same_bits(members[static_cast<std::size_t>(k)].rows, rows)) << extra << k;
      EXPECT_TRUE(same_bits(ensemble.member(k).rows, rows)) << extra << k;
    }
    EXPECT_TRUE(same_bits(ensemble.base().rows, rows_of(ensemble.scenario())));
  }
}

// Alone, and beside others in lanes.
TEST(ScenarioEnsemble, AddedColumnsAreThoseOfTheMemberAlone) {
  std::string wanted = varied;
  wanted.replace(wanted.find("size"), 4, "indicators = [\"mean_megno\", \"lyapunov\"]\nsize");
  const std::string event = "[[event]]\nname = \"e\"\ncolumn = \"w1\"\nstops = true\n";
  for (const std::string& extra : {std::string(), torque, event, torque + event}) {
    const ScenarioEnsemble ensemble(body + extra + wanted, "e.toml");
    const std::size_t width = row_width(ensemble.row_groups());
    EXPECT_EQ(ensemble.events().size(), extra.ends_with(event) ? 1U : 0U);
    EXPECT_EQ(ensemble.row_groups().back().name, "chaos");
    const std::vector<EnsembleMember> members = ensemble.members(0, 5);
    for (const std::int64_t k : {0, 4}) {
      const EnsembleMember& member = members[static_cast<std::size_t>(k)];
      EXPECT_EQ(member.failure, "");
      EXPECT_EQ(member.rows.size() % width, 0U);
      EXPECT_TRUE(same_bits(member.rows, ensemble.member(k).rows)) << extra;
      EXPECT_EQ(member.rows[width - 1], 0.0);
      EXPECT_NE(member.rows.back(), 0.0);
    }
  }
}

TEST(ScenarioEnsemble, WhatIsNoMember) {
  const ScenarioEnsemble ensemble(body + varied, "e.toml");
  EXPECT_THROW(static_cast<void>(ensemble.member(20)), DomainError);
  EXPECT_THROW(static_cast<void>(ensemble.member_text(-1)), DomainError);
  EXPECT_THROW(ScenarioEnsemble(body, "e.toml"), ScenarioError);
}

TEST(EnsembleRun, RowsDoNotDependOnThreads) {
  for (const char* const keep : {"statistics", "final", "rows"}) {
    std::string text = body + torque + varied;
    text.replace(text.find("size = 20"), 9, "size = 20\nkeep = \"" + std::string(keep) + "\"");
    const std::vector<double> one = ensemble_rows(text, 1);
    EXPECT_FALSE(one.empty());
    EXPECT_TRUE(same_bits(one, ensemble_rows(text, 3))) << keep;
  }
}

// Stops after every chunk.
TEST(EnsembleRun, WhatIsStoppedGoesOn) {
  for (const char* const keep : {"statistics", "final", "rows"}) {
    std::string text = body + torque + varied;
    text.replace(text.find("size = 20"), 9, "size = 60\nkeep = \"" + std::string(keep) + "\"");
    const test::TempFolder folder;
    const ScenarioEnsemble ensemble(text, "e.toml");
    const std::string whole = folder.path("whole.csv"), parts = folder.path("parts.csv");
    EnsembleRun(ensemble, {whole}, {}).run();
    int stops = 0;
    for (bool done = false; !done; ++stops) {
      std::atomic<bool> enough = false;
      EnsembleOptions options;
      options.begin = RunBegin::resume;
      options.checkpoint_seconds = 0.0;
      options.threads = 1 + stops % 2;
      options.progress = [&](std::int64_t) { enough = true; };
      options.stop = [&] { return enough.load(); };
      try {
        EnsembleRun(ensemble, {parts}, std::move(options)).run();
        done = true;
      } catch (const EnsembleInterrupted& stopped) {
        EXPECT_TRUE(stopped.can_resume);
        EXPECT_LT(stopped.members, 60);
      }
    }
    EXPECT_GT(stops, 2);
    EXPECT_EQ(folder.text("parts.csv"), folder.text("whole.csv")) << keep;
  }
}

TEST(EnsembleRun, WhatProgressThrowsPassesThrough) {
  const ScenarioEnsemble ensemble(body + varied, "e.toml");
  EnsembleOptions options;
  options.progress = [](std::int64_t) { throw std::runtime_error("enough"); };
  EnsembleRun run(ensemble, {}, std::move(options));
  EXPECT_THROW(run.run(), std::runtime_error);
}

TEST(EnsembleRun, StatisticsThatDoNotFitAreRefused) {
  std::string text = body + varied;
  text.replace(text.find("step = 0.5"), 10, "count = 100000000");
  const ScenarioEnsemble ensemble(text, "e.toml");
  EXPECT_REJECTED(EnsembleRun(ensemble, {}, {}),
                  "expected 2 GB at most: fewer rows, columns or bins");
}

}  // namespace
}  // namespace polhode
