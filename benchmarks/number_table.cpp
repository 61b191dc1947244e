// SPDX-License-Identifier: MIT
// Tables of numbers as text: time per field that is asked for, of seven in a row, plain and packed.
// The error counts the fields that do not come back to the bit.
#include "tables/number_table.hpp"

#include <benchmark/benchmark.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace polhode;

constexpr int rows = 20000, columns = 7;

double number(int row, int column) {
  return column == 0 ? 60.0 * row : 7e3 * std::sin(0.001 * row + column);
}

// Argument: packed.
void read_table(benchmark::State& state) {
  const bool packed = state.range(0) != 0;
  const std::string path = std::filesystem::temp_directory_path() /
                           (packed ? "polhode-bench.csv.gz" : "polhode-bench.csv");
  std::string text;
  for (int i = 0; i < rows; ++i) {
    char field[40];
    for (int k = 0; k < columns; ++k) {
      std::snprintf(field, sizeof field, "%.17g%c", number(i, k), k + 1 < columns ? ',' : '\n');
      text += field;
    }
  }
  const gzFile file = gzopen(path.c_str(), packed ? "wb" : "wbT");  // T: as it is
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  const std::vector<std::string> all{"1", "2", "3", "4", "5", "6", "7"};
  for (auto _ : state) benchmark::DoNotOptimize(io::read_number_table(path, all).rows());
  const io::NumberTable table = io::read_number_table(path, all);
  int wrong = 0;
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < columns; ++k)
      wrong +=
          table.columns[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] != number(i, k);
  std::filesystem::remove(path);
  state.counters["error"] = wrong;
  state.counters["per field"] = benchmark::Counter(
      rows * columns, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(read_table)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
