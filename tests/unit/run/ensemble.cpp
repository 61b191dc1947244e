// SPDX-License-Identifier: MIT
// Ensembles: a member is the scenario that its text is, alone and among others; rows and statistics
// come whatever the threads.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <stdexcept>
#include <utility>

#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "polhode/run/run.hpp"
#include "temp_folder.hpp"
#include "unit/run/shuffled_executor.hpp"

namespace polhode {
namespace {

using test::ShuffledExecutor;
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
class Rows : public io::Sink {
 public:
  explicit Rows(std::vector<double>& rows) : rows_(rows) {}
  void push(std::span<const double> rows) override {
    rows_.insert(rows_.end(), rows.begin(), rows.end());
  }
  void finish() override {}

 private:
  std::vector<double>& rows_;
};

std::vector<double> rows_of(const io::Scenario& scenario) {
  std::vector<double> rows;
  std::unique_ptr<io::Sink> sink = std::make_unique<Rows>(rows);
  io::run(scenario, {&sink, 1});
  return rows;
}

std::vector<double> ensemble_rows(const std::string& text, int threads) {
  const io::ScenarioEnsemble ensemble(text, "e.toml");
  std::vector<double> rows;
  io::RunOptions options;
  options.threads = threads;
  options.extra_sink = std::make_unique<Rows>(rows);
  io::EnsembleRun(ensemble, {}, std::move(options)).run();
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
    const io::ScenarioEnsemble ensemble(body + extra + varied, "e.toml");
    const std::vector<io::EnsembleMember> members = ensemble.members(0, 9);
    for (const std::int64_t k : {0, 5, 8}) {
      const std::string text = ensemble.member_text(k);
      EXPECT_THAT(text, HasSubstr(" rad\""));
      const std::vector<double> rows = rows_of(io::scenario_from_text(text, "m.toml"));
      EXPECT_EQ(rows.size(), 41 * io::row_width(ensemble.row_groups()));
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
    const io::ScenarioEnsemble ensemble(body + extra + wanted, "e.toml");
    const std::size_t width = io::row_width(ensemble.row_groups());
    EXPECT_EQ(ensemble.events().size(), extra.ends_with(event) ? 1U : 0U);
    EXPECT_EQ(ensemble.row_groups().back().name, "chaos");
    const std::vector<io::EnsembleMember> members = ensemble.members(0, 5);
    for (const std::int64_t k : {0, 4}) {
      const io::EnsembleMember& member = members[static_cast<std::size_t>(k)];
      EXPECT_EQ(member.failure, "");
      EXPECT_EQ(member.rows.size() % width, 0U);
      EXPECT_TRUE(same_bits(member.rows, ensemble.member(k).rows)) << extra;
      EXPECT_EQ(member.rows[width - 1], 0.0);
      EXPECT_NE(member.rows.back(), 0.0);
    }
  }
}

TEST(ScenarioEnsemble, WhatIsNoMember) {
  const io::ScenarioEnsemble ensemble(body + varied, "e.toml");
  EXPECT_THROW(static_cast<void>(ensemble.member(20)), DomainError);
  EXPECT_THROW(static_cast<void>(ensemble.member_text(-1)), DomainError);
  EXPECT_THROW(io::ScenarioEnsemble(body, "e.toml"), io::ScenarioError);
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

// Stops after every chunk, more than `least` times, and ends in the file of a run without a stop.
void expect_resumable(const std::string& text, int least, const auto& set_up) {
  const test::TempFolder folder;
  const io::ScenarioEnsemble ensemble(text, "e.toml");
  const std::string whole = folder.path("whole.csv"), parts = folder.path("parts.csv");
  io::EnsembleRun(ensemble, {whole}, {}).run();
  int stops = 0;
  for (bool done = false; !done; ++stops) {
    std::atomic<bool> enough = false;
    io::RunOptions options;
    options.begin = io::RunBegin::resume;
    options.checkpoint_seconds = 0.0;
    set_up(options, stops);
    options.progress = [&](const io::RunProgress&) { enough = true; };
    options.stop = [&] { return enough.load(); };
    try {
      io::EnsembleRun(ensemble, {parts}, std::move(options)).run();
      done = true;
    } catch (const io::RunInterrupted& stopped) {
      EXPECT_TRUE(stopped.can_resume);
      EXPECT_LT(stopped.reached, static_cast<double>(ensemble.size()));
    }
  }
  EXPECT_GT(stops, least);
  EXPECT_EQ(folder.text("parts.csv"), folder.text("whole.csv")) << text;
}

TEST(EnsembleRun, WhatIsStoppedGoesOn) {
  for (const char* const keep : {"statistics", "final", "rows"}) {
    std::string text = body + torque + varied;
    text.replace(text.find("size = 20"), 9, "size = 60\nkeep = \"" + std::string(keep) + "\"");
    expect_resumable(text, 2,
                     [](io::RunOptions& options, int stops) { options.threads = 1 + stops % 2; });
  }
}

TEST(EnsembleRun, WhatProgressThrowsPassesThrough) {
  const io::ScenarioEnsemble ensemble(body + varied, "e.toml");
  io::RunOptions options;
  options.progress = [](const io::RunProgress&) { throw std::runtime_error("enough"); };
  io::EnsembleRun run(ensemble, {}, std::move(options));
  EXPECT_THROW(run.run(), std::runtime_error);
}

// The part of the time that has passed is known after every chunk.
TEST(EnsembleRun, PartsOfTheTimeEndAtOne) {
  const io::ScenarioEnsemble ensemble(body + varied, "e.toml");
  std::vector<double> parts;
  io::RunOptions options;
  options.threads = 1;
  options.progress = [&](const io::RunProgress& at) { parts.push_back(at.part); };
  io::EnsembleRun(ensemble, {}, std::move(options)).run();
  ASSERT_EQ(parts.size(), 4U);  // 20 members in chunks of 6
  for (const double part : parts) EXPECT_TRUE(part > 0.0 && part <= 1.0) << part;
  EXPECT_EQ(parts.back(), 1.0);
}

TEST(EnsembleRun, StatisticsThatDoNotFitAreRefused) {
  std::string text = body + varied;
  text.replace(text.find("step = 0.5"), 10, "count = 100000000");
  const io::ScenarioEnsemble ensemble(text, "e.toml");
  EXPECT_REJECTED(io::EnsembleRun(ensemble, {}, {}),
                  "expected 2 GB at most: fewer rows, columns or bins");
}

// Ensembles whose chunks are computed by processes: bytes go to and fro, and rows are those of
// threads to the last bit, whoever computes a chunk.

std::string scenario(const std::string& head, const std::string& extra = "") {
  return R"(schema = 1
[body]
moments = [1, 1.7, 2.2]
[state.attitude-rate]
quaternion = [1, 0, 0, 0]
omega_body = [0.1, 0.2, 1]
[time]
stop = 10
step = 0.5
[output]
columns = ["q", "omega", "tumbler"]
)" + extra +
         "[ensemble]\n" + head +
         R"(
[[ensemble.vary]]
kind = "uniform"
key = "body.moments[1]"
low = 1.4
high = 1.9
)";
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

ShuffledExecutor shuffled(const std::string& text, int processes, unsigned seed) {
  return {[&] { return io::ensemble_work(io::scenario_from_text(text, "e.toml")); }, processes,
          seed};
}

std::vector<double> rows_of(const std::string& text, ensemble::Executor* executor) {
  const io::ScenarioEnsemble ensemble(text, "e.toml");
  std::vector<double> rows;
  io::RunOptions options;
  options.threads = 2;
  options.executor = executor;
  options.extra_sink = std::make_unique<Rows>(rows);
  const io::EnsembleReport report = io::EnsembleRun(ensemble, {}, std::move(options)).run();
  EXPECT_EQ(report.members, ensemble.size());
  EXPECT_GT(report.failed, 0);  // I3 > I1 + I2
  EXPECT_LT(report.failed, ensemble.size());
  return rows;
}

const std::string impossible = R"(
[[ensemble.vary]]
kind = "uniform"
key = "body.moments[2]"
low = 2.2
high = 2.7
)";

TEST(EnsembleExecutor, GivesTheRowsOfThreads) {
  for (const char* const keep : {"statistics", "final", "rows"}) {
    const std::string text =
        scenario("size = 60\nchunk = 7\nkeep = \"" + std::string(keep) + "\"") + impossible;
    ShuffledExecutor executor = shuffled(text, 3, 5);
    const std::vector<double> rows = rows_of(text, &executor);
    EXPECT_FALSE(rows.empty());
    EXPECT_TRUE(same_bits(rows, rows_of(text, nullptr))) << keep;
  }
}

// Of more numbers than are all kept: bins need the first members.
TEST(EnsembleExecutor, GivesTheQuantilesOfThreadsFromBins) {
  std::string text = scenario("size = 7000\nchunk = 900\nbins = 20\n") + impossible;
  text = replaced(text, "step = 0.5", "count = 400");
  text = replaced(text, "\"q\", \"omega\", \"tumbler\"", "\"omega\"");
  const std::vector<io::ColumnGroup> groups =
      io::ensemble_groups(io::ScenarioEnsemble(text, "e.toml"));
  EXPECT_EQ(groups.back().columns.back().name, "w3_p_error");
  ShuffledExecutor executor = shuffled(text, 2, 3);
  EXPECT_TRUE(same_bits(rows_of(text, &executor), rows_of(text, nullptr)));
}

// Stopped by turns with an executor and with threads.
TEST(EnsembleExecutor, GoesOnWhereThreadsStopped) {
  for (const char* const keep : {"statistics", "final", "rows"}) {
    const std::string text =
        scenario("size = 90\nchunk = 8\nkeep = \"" + std::string(keep) + "\"") + impossible;
    std::unique_ptr<ShuffledExecutor> executor;
    expect_resumable(text, 3, [&](io::RunOptions& options, int stops) {
      executor = std::make_unique<ShuffledExecutor>(shuffled(text, 1 + stops % 3, 7));
      if (stops % 2 == 0) options.executor = executor.get();
    });
  }
}

TEST(EnsembleExecutor, AnotherEnsembleIsRejected) {
  const std::string text = scenario("size = 60\nchunk = 7\n");
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"size = 60", "size = 61"}, {"1.7, 2.2", "1.7, 2.1"}}) {
    ShuffledExecutor executor = shuffled(replaced(text, from, to), 2, 1);
    const io::ScenarioEnsemble ensemble(text, "e.toml");
    io::RunOptions options;
    options.executor = &executor;
    io::EnsembleRun run(ensemble, {}, std::move(options));
    EXPECT_REJECTED(run.run(), "e.toml: is not the ensemble that is run: scenario was");
  }
}

TEST(EnsembleExecutor, MoreProcessesThanChunksAreRejected) {
  const std::string text = scenario("size = 60\nchunk = 20\n");
  ShuffledExecutor executor = shuffled(text, 4, 1);
  const io::ScenarioEnsemble ensemble(text, "e.toml");
  io::RunOptions options;
  options.executor = &executor;
  EXPECT_REJECTED(io::EnsembleRun(ensemble, {}, std::move(options)),
                  "4 processes for 3 chunks of members; expected a chunk for each at least: "
                  "fewer processes, or a smaller ensemble.chunk");
}

}  // namespace
}  // namespace polhode
