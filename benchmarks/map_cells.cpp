// SPDX-License-Identifier: MIT
// Cells of maps: a cheap one, and one along an orbit table of many rows, on one thread and on two.
// The error counts the numbers that a map of one cell, with its numbers in the text, does not give
// to the bit.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "polhode/run/map_run.hpp"

namespace {

using namespace polhode;

constexpr int cells = 200;

std::string folder() { return std::filesystem::temp_directory_path() / "polhode-bench-map"; }

// A circle of 7 in 62.8 h, over 100 h.
void write_table(int rows) {
  std::filesystem::create_directories(folder());
  std::ofstream file(folder() + "/way.csv");
  file << "t,x,y,z\n";
  file.precision(17);
  for (int k = 0; k <= rows; ++k) {
    const double t = 100.0 * k / rows;
    file << t << "," << 7.0 * std::cos(0.1 * t) << "," << 7.0 * std::sin(0.1 * t) << ","
         << 0.2 * std::sin(0.2 * t) << "\n";
  }
}

// Without rows: no table, and damping alone.
std::string scenario(int rows, double first, double last, int count) {
  std::string text = R"(schema = 1
units = { time = "h", angle = "deg" }
body.moments = [1, 1.7, 2.2]
state.euler = { phi = 10, theta = 60, psi = 30, Phi = 0.8, Theta = 0.1, Psi = 0.9 }
)";
  text += rows == 0 ? R"(time = { stop = 5, count = 2 }
method = { kind = "adaptive", tolerance = 1e-6 }
perturbation = [{ kind = "damping", coefficients = [1e-3, 1e-3, 1e-3] }]
)"
                    : R"(time = { stop = 30, count = 2 }
method = { kind = "adaptive", tolerance = 1e-9 }
orbit.way = { kind = "table", file = "way.csv", gm = 30 }
perturbation = [{ kind = "gravity-gradient", orbit = "way" }]
)";
  return text + "[map]\nkind = \"chaos\"\n[[map.axis]]\nkey = \"state.euler.theta\"\nfrom = " +
         std::to_string(first) + "\nto = " + std::to_string(last) +
         "\ncount = " + std::to_string(count) + "\n";
}

int differences(const std::vector<double>& a, const std::vector<double>& b) {
  int wrong = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min<std::size_t>(a.size(), b.size()); ++i)
    wrong += std::bit_cast<std::int64_t>(a[i]) != std::bit_cast<std::int64_t>(b[i]);
  return wrong;
}

// Arguments: rows of the table, threads.
void map_cells(benchmark::State& state) {
  const int rows = static_cast<int>(state.range(0));
  write_table(rows);
  const std::string name = folder() + "/map.toml";
  const io::ScenarioMap map(scenario(rows, 60.0, 90.0, cells), name);
  for (auto _ : state) {
    io::RunOptions options;
    options.threads = static_cast<int>(state.range(1));
    benchmark::DoNotOptimize(io::MapRun(map, {}, std::move(options)).run().points);
  }
  const io::ScenarioMap last(scenario(rows, 90.0, 90.0, 1), name);
  state.counters["error"] = differences(map.cell(cells - 1).numbers, last.cell(0).numbers);
  state.counters["per second"] =
      benchmark::Counter(cells, benchmark::Counter::kIsIterationInvariantRate);
  std::filesystem::remove_all(folder());
}

BENCHMARK(map_cells)
    ->ArgsProduct({{0, 2000, 20000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
