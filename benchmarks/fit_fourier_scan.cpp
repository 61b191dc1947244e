// SPDX-License-Identifier: MIT
// The two-dimensional Fourier scan by each set of instructions: us a pair on one thread, and the
// largest error of chi-square against fourier_fit, over that of no harmonics; beside fourier_fit
// itself. `range(0)` is the set, `range(1)` the order, `range(2)` the sessions of 350 points;
// "again" is the part of the pairs that fourier_fit computed.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "polhode/fit/fourier_fit.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

// A night of two lines and their sum, of 14 and 22 turns.
fit::ScanPoints night(std::size_t sessions) {
  std::mt19937_64 engine(7);
  const auto uniform = [&] { return std::ldexp(static_cast<double>(engine() >> 11U), -53); };
  std::vector<light::LightCurve> curves(sessions);
  for (std::size_t i = 0; i < 350; ++i) {
    const double t = (static_cast<double>(i) + uniform()) / 350.0, turn = 6.283185307179586 * t;
    const double flux = 5.0 + std::cos(28.0 * turn) + 0.6 * std::sin(36.0 * turn + 1.0) +
                        0.3 * std::sin(44.0 * turn) + 0.1 * (uniform() - 0.5);
    curves[i * sessions / 350].points.push_back({t, flux, 0.03, {}, {}});
  }
  return fit::ScanPoints(curves);
}

const fit::FrequencyGrid first{6.0, 0.61, 64}, second{4.0, 0.67, 64};

void pairs(benchmark::State& state) {
  const auto set = static_cast<InstructionSet>(state.range(0));
  if (!supports(set)) return state.SkipWithError("this processor has no such instructions");
  const fit::ScanPoints points = night(static_cast<std::size_t>(state.range(2)));
  const fit::ScanOptions options{static_cast<std::size_t>(state.range(1)), 1, set};
  fit::Landscape found = fit::scan_pairs(points, first, second, options);
  for (auto _ : state) found = fit::scan_pairs(points, first, second, options);
  const double count = static_cast<double>(found.chi_square.size());
  state.SetLabel(std::string(instruction_set_name(set)));
  state.counters["us_per_pair"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * count * 1e-6,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["again"] = static_cast<double>(found.again) / count;
  Worst worst;
  for (std::size_t i = 0; i < found.chi_square.size(); i += 29) {
    const fit::FourierFit fit = fit::fourier_fit(points, first.at(i / second.count),
                                                 second.at(i % second.count), found.orders);
    worst.add(std::abs(found.chi_square[i] - fit.chi_square) / points.total());
  }
  state.counters["max_error"] = worst.value();
}

void one_pair(benchmark::State& state) {
  const fit::ScanPoints points = night(1);
  const fit::FourierOrders orders =
      fit::FourierOrders::pair(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(fit::fourier_fit(points, 14.0, 22.3, orders));
}

BENCHMARK(pairs)->ArgsProduct({{0, 1, 2}, {2, 3, 4}, {1, 5}})->Unit(benchmark::kMillisecond);
BENCHMARK(one_pair)->Arg(2)->Arg(3)->Arg(4)->Unit(benchmark::kMicrosecond);

}  // namespace
