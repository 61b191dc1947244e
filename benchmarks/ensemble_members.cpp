// SPDX-License-Identifier: MIT
// Members of ensembles: free tumblers and bodies with a torque, 1000 rows each, statistics alone,
// on one thread and on two; beside them the states of one tumbler by FreeRotation::at. The error
// counts the numbers of a member that its own scenario, from its text, does not give to the bit.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "polhode/run/ensemble_run.hpp"
#include "polhode/run/run.hpp"

namespace {

using namespace polhode;

constexpr int members = 1024, epochs = 1000;

enum What { quaternions, andoyer, with_torque };

std::string scenario(std::int64_t what) {
  std::string text = R"(schema = 1
body.moments = [1, 1.7, 2.2]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0.1, 0.2, 1] }
time = { stop = 1000, count = 1000 }
)";
  text += std::string("output.columns = [\"") + (what == andoyer ? "andoyer" : "q") + "\"]\n";
  if (what == with_torque)
    text += "perturbation = [{ kind = \"constant-torque\", torque = [1e-5, 0, 2e-5] }]\n";
  return text + "[ensemble]\nchunk = 128\nsize = " + std::to_string(members) + R"(
[[ensemble.vary]]
kind = "normal"
key = "state.attitude-rate.omega_body[2]"
sigma = 0.001
[[ensemble.vary]]
kind = "uniform"
key = "body.moments[1]"
low = 1.6
high = 1.8
)";
}

int differences(const std::vector<double>& a, const std::vector<double>& b) {
  int wrong = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min<std::size_t>(a.size(), b.size()); ++i)
    wrong += std::bit_cast<std::int64_t>(a[i]) != std::bit_cast<std::int64_t>(b[i]);
  return wrong;
}

std::vector<double> rows_of(const std::string& text) {
  std::vector<double> rows;
  struct Rows : io::Sink {
    explicit Rows(std::vector<double>& to) : all(to) {}
    void push(std::span<const double> more) override {
      all.insert(all.end(), more.begin(), more.end());
    }
    void finish() override {}
    std::vector<double>& all;
  };
  const std::unique_ptr<io::Sink> sink = std::make_unique<Rows>(rows);
  io::run(io::scenario_from_text(text, "member.toml"), {&sink, 1});
  return rows;
}

// Arguments: what, threads.
void ensemble_members(benchmark::State& state) {
  const io::ScenarioEnsemble ensemble(scenario(state.range(0)), "ensemble.toml");
  for (auto _ : state) {
    io::RunOptions options;
    options.threads = static_cast<int>(state.range(1));
    benchmark::DoNotOptimize(io::EnsembleRun(ensemble, {}, std::move(options)).run().members);
  }
  state.counters["error"] =
      differences(ensemble.members(0, 16)[7].rows, rows_of(ensemble.member_text(7)));
  state.counters["per second"] =
      benchmark::Counter(members, benchmark::Counter::kIsIterationInvariantRate);
}

// The rows of as many members, without statistics. Argument: what.
void member_rows(benchmark::State& state) {
  const io::ScenarioEnsemble ensemble(scenario(state.range(0)), "ensemble.toml");
  for (auto _ : state)
    for (std::int64_t k = 0; k < members; ++k)
      benchmark::DoNotOptimize(ensemble.member(k).rows.data());
  state.counters["error"] = differences(ensemble.member(7).rows, rows_of(ensemble.member_text(7)));
  state.counters["per second"] =
      benchmark::Counter(members, benchmark::Counter::kIsIterationInvariantRate);
}

// The states of as many tumblers: what a member takes at least.
void states_alone(benchmark::State& state) {
  const FreeRotation motion =
      io::free_rotation(io::scenario_from_text(scenario(quaternions), "s.toml"));
  std::vector<double> times(epochs);
  for (int k = 0; k < epochs; ++k) times[static_cast<std::size_t>(k)] = k * 1000.0 / (epochs - 1);
  std::vector<RotorState> states(epochs);
  for (auto _ : state)
    for (int k = 0; k < members; ++k) {
      motion.at(times, states);
      benchmark::DoNotOptimize(states.data());
    }
  int wrong = 0;
  for (std::size_t k = 0; k < times.size(); ++k) wrong += states[k].q != motion.at(times[k]).q;
  state.counters["error"] = wrong;
  state.counters["per second"] =
      benchmark::Counter(members, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(ensemble_members)
    ->ArgsProduct({{quaternions, andoyer, with_torque}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK(member_rows)
    ->Arg(quaternions)
    ->Arg(andoyer)
    ->Arg(with_torque)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(states_alone)->Unit(benchmark::kMillisecond);

}  // namespace
