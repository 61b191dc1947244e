// SPDX-License-Identifier: MIT
// What a chunk of an ensemble costs whoever computes it, and whoever takes it from bytes and merges
// it: the constants of docs/guide/clusters.md, which tools/cluster_cost.py has. Free tumblers of
// even times and bodies with a torque, statistics alone, quantiles exact or from bins. The error
// counts the numbers of the rows that chunks from bytes do not give as chunks in memory do.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "ensemble/number_moments.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "polhode/run/run.hpp"
#include "run/ensemble/ensemble_cells.hpp"

namespace {

using namespace polhode;
using io::detail::EnsembleCells, io::detail::EnsembleChunk, io::detail::RowStatistics;

constexpr int chunks = 4, of_scatter = 16;

enum What { quaternions, andoyer, with_torque };

// Of a size at which quantiles are exact, or beyond.
std::string scenario(int what, int rows, int chunk, int bins) {
  std::string text = R"(schema = 1
body.moments = [1, 1.7, 2.2]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [0.1, 0.2, 1] }
)";
  text += "time = { stop = 1000, count = " + std::to_string(rows) + " }\n";
  text += std::string("output.columns = [\"") + (what == andoyer ? "andoyer" : "q") + "\"]\n";
  if (what == with_torque)
    text += "perturbation = [{ kind = \"constant-torque\", torque = [1e-5, 0, 2e-5] }]\n";
  text += "[ensemble]\nchunk = " + std::to_string(chunk) + "\n";
  if (bins > 0) text += "bins = " + std::to_string(bins) + "\n";
  return text + "size = " + std::to_string(bins > 0 ? 100000000 : of_scatter * chunk) + R"(
[[ensemble.vary]]
kind = "normal"
key = "state.attitude-rate.omega_body[2]"
sigma = 0.001
)";
}

// The first chunks of an ensemble, as bytes.
class Chunks {
 public:
  explicit Chunks(const benchmark::State& state)
      : ensemble_(scenario(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                           static_cast<int>(state.range(2)), static_cast<int>(state.range(3))),
                  "ensemble.toml"),
        cells_(ensemble_, false) {
    const Progress look = [](double) {};
    cells_.frame()->set_base(ensemble_.base(look));
    const io::detail::Source<io::detail::Pilots> some = cells_.pilots();
    for (std::int64_t k = some.range.first_cell(); k < some.range.end_cell(); ++k) {
      const io::detail::Pilots done = some.cell(k, look);
      for (std::size_t m = 0; m < done.size(); ++m)
        cells_.frame()->add_pilot(some.range.begin_of(k) + static_cast<std::int64_t>(m), done[m]);
    }
    cells_.frame()->finish_pilots();
    empty_.emplace(*cells_.frame());
    const io::detail::Source<io::detail::EnsembleChunk> members = cells_.members(0);
    cells_.begin(cells_.stage(members.range, members.stage));
    for (int k = 0; k < chunks; ++k) bytes_.push_back(computed(k));
  }

  std::string computed(int k) const {
    return cells_.cell(k, [] {});
  }
  const std::vector<std::string>& bytes() const { return bytes_; }
  // What the leader does with those that come.
  io::detail::RowStatistics taken() const {
    io::detail::RowStatistics all(*empty_);
    for (const std::string& from : bytes_) {
      Archive bytes(from);
      io::detail::EnsembleChunk chunk;
      chunk.serialize(bytes, cells_.frame());
      all.merge(*chunk.statistics);
    }
    return all;
  }
  // How much the times of chunks differ, over their mean.
  double scatter() const {
    ensemble::NumberMoments seconds(1);
    for (int k = 0; k < of_scatter; ++k) {
      const std::clock_t begin = std::clock();
      benchmark::DoNotOptimize(computed(k).data());
      const double took = static_cast<double>(std::clock() - begin);
      seconds.add(k, {&took, 1});
    }
    return seconds.deviation(0) / seconds.mean(0);
  }
  double error() {
    io::detail::RowStatistics all(*cells_.frame());
    const io::detail::Source<io::detail::EnsembleChunk> members = cells_.members(0);
    for (int k = 0; k < chunks; ++k) all.merge(*members.cell(k, [](double) {}).statistics);
    const std::vector<double> a = all.rows(), b = taken().rows();
    int wrong = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < std::min<std::size_t>(a.size(), b.size()); ++i)
      wrong += std::bit_cast<std::int64_t>(a[i]) != std::bit_cast<std::int64_t>(b[i]);
    return wrong;
  }

 private:
  io::ScenarioEnsemble ensemble_;
  io::detail::EnsembleCells cells_;
  // As that of the leader, from before it told the others.
  std::optional<io::detail::RowStatistics> empty_;
  std::vector<std::string> bytes_;
};

void report(benchmark::State& state, Chunks& all, int chunks_each) {
  state.counters["error"] = all.error();
  state.counters["numbers"] = static_cast<double>(all.bytes()[0].size()) / 8.0;
  state.counters["s_a_chunk"] = benchmark::Counter(
      chunks_each, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Arguments of all: what, rows, members of a chunk, bins (0: quantiles are exact).
void chunk_computed(benchmark::State& state) {
  Chunks all(state);
  for (auto _ : state) benchmark::DoNotOptimize(all.computed(1).data());
  report(state, all, 1);
  state.counters["scatter"] = all.scatter();
}

void chunk_taken(benchmark::State& state) {
  Chunks all(state);
  for (auto _ : state) {
    const io::detail::RowStatistics done = all.taken();
    benchmark::DoNotOptimize(&done);
  }
  report(state, all, chunks);
}

// What a checkpoint writes.
void state_written(benchmark::State& state) {
  Chunks all(state);
  io::detail::RowStatistics done = all.taken();
  std::size_t size = 0;
  for (auto _ : state) {
    Archive bytes;
    done.serialize(bytes);
    size = bytes.bytes().size();
  }
  report(state, all, 1);
  state.counters["numbers"] = static_cast<double>(size) / 8.0;
}

void cases(benchmark::internal::Benchmark* of) {
  of->ArgNames({"what", "rows", "chunk", "bins"})->Unit(benchmark::kMillisecond);
  for (const int what : {quaternions, andoyer})
    for (const int rows : {10, 100, 1000})
      for (const int chunk : {16, 128}) {
        if (what == quaternions) {
          of->Args({what, rows, chunk, 256});  // no bins: attitudes alone
          continue;
        }
        of->Args({what, rows, chunk, 0});
        for (const int bins : {16, 256}) of->Args({what, rows, chunk, bins});
      }
}

BENCHMARK(chunk_computed)->Apply(cases)->Args({with_torque, 1000, 128, 256});
BENCHMARK(chunk_taken)->Apply(cases);
BENCHMARK(state_written)->Apply(cases);

}  // namespace
