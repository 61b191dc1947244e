// SPDX-License-Identifier: MIT
// A fit of 17 attitudes, those of Toutatis in 1992, from one start; beside the time by how much the
// axial ratios differ from those of an independent fit, 2.98 and 3.22 (to half of their last
// digit).
#include <benchmark/benchmark.h>

#include <cmath>

#include "unit/fit/toutatis.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;

void fit_of_17_attitudes(benchmark::State& state) {
  fit::SpinFit fit;
  fit.start = test::toutatis_start();
  fit.seen = test::toutatis_seen();
  fit::SpinSolution s;
  for (auto _ : state) {
    s = fit::fit_spin(fit);
    benchmark::DoNotOptimize(s);
  }
  state.counters["iterations"] = s.result.iterations;
  state.counters["error"] =
      test::larger(std::abs(s.result.x[6] - 2.98), std::abs(s.result.x[7] - 3.22));
}
BENCHMARK(fit_of_17_attitudes)->Unit(benchmark::kMillisecond);

}  // namespace
