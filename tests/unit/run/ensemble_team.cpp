// SPDX-License-Identifier: MIT
// Ensembles whose chunks are computed by processes: bytes go to and fro, and rows are those of
// threads to the last bit, whoever computes a chunk.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <map>
#include <random>
#include <utility>

#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "polhode/run/ensemble_work.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using ::testing::HasSubstr;

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

struct Collected : Sink {
  explicit Collected(std::vector<double>& to) : rows(to) {}
  void push(std::span<const double> more) override {
    rows.insert(rows.end(), more.begin(), more.end());
  }
  void finish() override {}
  std::vector<double>& rows;
};

struct Process {
  explicit Process(const std::string& text)
      : ensemble(text, "e.toml"), work(ensemble_work(ensemble)) {}
  ScenarioEnsemble ensemble;
  std::unique_ptr<TeamWork> work;
};

// Processes that read the text for themselves, and answer in any order.
class ShuffledTeam : public Team {
 public:
  ShuffledTeam(const std::string& text, int processes, unsigned seed) : random_(seed) {
    for (int k = 0; k < processes; ++k) all_.push_back(std::make_unique<Process>(text));
  }
  int processes() const override { return static_cast<int>(all_.size()); }
  void run(TeamWork&, const TeamStage& stage, const Take& take,
           const std::function<void()>& look) override {
    for (const auto& process : all_) process->work->begin(stage.bytes);
    std::vector<std::int64_t> order;
    for (std::int64_t cell = stage.first; cell < stage.count; ++cell) order.push_back(cell);
    std::shuffle(order.begin(), order.end(), random_);
    std::map<std::int64_t, std::string> answers;
    for (const std::int64_t cell : order)
      answers[cell] = all_[random_() % all_.size()]->work->cell(cell, look);
    for (const auto& [cell, bytes] : answers) take(cell, bytes);
  }

 private:
  std::vector<std::unique_ptr<Process>> all_;
  std::mt19937 random_;
};

std::vector<double> rows_of(const std::string& text, Team* team) {
  const ScenarioEnsemble ensemble(text, "e.toml");
  std::vector<double> rows;
  EnsembleOptions options;
  options.threads = 2;
  options.team = team;
  options.extra_sink = std::make_unique<Collected>(rows);
  const EnsembleReport report = EnsembleRun(ensemble, {}, std::move(options)).run();
  EXPECT_EQ(report.members, ensemble.size());
  EXPECT_GT(report.failed, 0);  // I3 > I1 + I2
  EXPECT_LT(report.failed, ensemble.size());
  return rows;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

const std::string impossible = R"(
[[ensemble.vary]]
kind = "uniform"
key = "body.moments[2]"
low = 2.2
high = 2.7
)";

TEST(EnsembleTeam, GivesTheRowsOfThreads) {
  for (const char* const keep : {"statistics", "final", "rows"}) {
    const std::string text =
        scenario("size = 60\nchunk = 7\nkeep = \"" + std::string(keep) + "\"") + impossible;
    ShuffledTeam team(text, 3, 5);
    const std::vector<double> rows = rows_of(text, &team);
    EXPECT_FALSE(rows.empty());
    EXPECT_TRUE(same_bits(rows, rows_of(text, nullptr))) << keep;
  }
}

// Of more numbers than are all kept: bins need the first members.
TEST(EnsembleTeam, GivesTheQuantilesOfThreadsFromBins) {
  std::string text = scenario("size = 7000\nchunk = 900\nbins = 20\n") + impossible;
  text = replaced(text, "step = 0.5", "count = 400");
  text = replaced(text, "\"q\", \"omega\", \"tumbler\"", "\"omega\"");
  const std::vector<ColumnGroup> groups = ensemble_groups(ScenarioEnsemble(text, "e.toml"));
  EXPECT_EQ(groups.back().columns.back().name, "w3_p_error");
  ShuffledTeam team(text, 2, 3);
  EXPECT_TRUE(same_bits(rows_of(text, &team), rows_of(text, nullptr)));
}

// Stopped by turns with a team and with threads.
TEST(EnsembleTeam, GoesOnWhereThreadsStopped) {
  for (const char* const keep : {"statistics", "final", "rows"}) {
    const std::string text =
        scenario("size = 90\nchunk = 8\nkeep = \"" + std::string(keep) + "\"") + impossible;
    const test::TempFolder folder;
    const ScenarioEnsemble ensemble(text, "e.toml");
    const std::string whole = folder.path("whole.csv"), parts = folder.path("parts.csv");
    EnsembleRun(ensemble, {whole}, {}).run();
    int stops = 0;
    for (bool done = false; !done; ++stops) {
      ShuffledTeam team(text, 1 + stops % 3, 7);
      std::atomic<bool> enough = false;
      EnsembleOptions options;
      options.begin = RunBegin::resume;
      options.checkpoint_seconds = 0.0;
      if (stops % 2 == 0) options.team = &team;
      options.progress = [&](std::int64_t) { enough = true; };
      options.stop = [&] { return enough.load(); };
      try {
        EnsembleRun(ensemble, {parts}, std::move(options)).run();
        done = true;
      } catch (const EnsembleInterrupted& stopped) {
        EXPECT_TRUE(stopped.can_resume);
      }
    }
    EXPECT_GT(stops, 3);
    EXPECT_EQ(folder.text("parts.csv"), folder.text("whole.csv")) << keep;
  }
}

TEST(EnsembleTeam, AnotherEnsembleIsRefused) {
  const std::string text = scenario("size = 60\nchunk = 7\n");
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"size = 60", "size = 61"}, {"1.7, 2.2", "1.7, 2.1"}}) {
    ShuffledTeam team(replaced(text, from, to), 2, 1);
    const ScenarioEnsemble ensemble(text, "e.toml");
    EnsembleOptions options;
    options.team = &team;
    EnsembleRun run(ensemble, {}, std::move(options));
    EXPECT_REJECTED(run.run(), "e.toml: is not the ensemble that is run: scenario was");
  }
}

TEST(EnsembleTeam, MoreProcessesThanChunksAreRefused) {
  const std::string text = scenario("size = 60\nchunk = 20\n");
  ShuffledTeam team(text, 4, 1);
  const ScenarioEnsemble ensemble(text, "e.toml");
  EnsembleOptions options;
  options.team = &team;
  EXPECT_REJECTED(EnsembleRun(ensemble, {}, std::move(options)),
                  "4 processes for 3 chunks of members; expected a chunk for each at least: "
                  "fewer processes, or a smaller ensemble.chunk");
}

}  // namespace
}  // namespace polhode
