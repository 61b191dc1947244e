// SPDX-License-Identifier: MIT
// The spin axis of an Earth-like planet over 100 Myr, on a table of 1 kyr: time for each million
// years, and the distance of the last axis from that of the adaptive method at 1e-14.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/secular/spin_precession.hpp"

namespace {

using namespace polhode;

constexpr double arcsec_per_kyr = std::numbers::pi / 180.0 / 3600.0;
constexpr double span = 1e5;  // kyr

// The largest terms of the Earth's e and i (Laskar 1988).
ElementTable orbit() {
  const ElementSeries series({{4248.976 * arcsec_per_kyr, 0.0189701, 0.5343},
                              {7455.487 * arcsec_per_kyr, 0.0163190, 3.4874},
                              {17922.491 * arcsec_per_kyr, 0.0129891, 2.6529}},
                             {{0.0, 0.0137722, 1.8777},
                              {-18850.133 * arcsec_per_kyr, 0.0079888, 4.2802},
                              {-5604.358 * arcsec_per_kyr, 0.0051545, 0.2983}});
  std::vector<double> times;
  std::vector<OrbitElements> rows;
  for (int k = -20; k <= static_cast<int>(span) + 20; ++k) {
    times.push_back(k);
    rows.push_back(series.at(times.back()));
  }
  return {std::move(times), rows};
}

SpinAxis moved(const Method& method) {
  static const SpinPrecession model(
      orbit(),
      PrecessionRates{.star = 17370.0 * arcsec_per_kyr, .satellites = 37500.0 * arcsec_per_kyr});
  const BasicProblem<SpinPrecession<ElementTable>> problem{
      model, spin_axis({0.0, std::sin(0.4), std::cos(0.4)}), 0.0, span, method};
  return integrate(problem, Keep{.samples = SaveAt::times({span}), .dense = false})
      .samples()
      .back()
      .s;
}

void run(benchmark::State& state, const Method& method) {
  static const SpinAxis exact = moved(Adaptive{1e-14});
  SpinAxis last{};
  for (auto _ : state) last = moved(method);
  state.counters["error"] = norm(last.s - exact.s);
  state.counters["time/Myr"] = benchmark::Counter(
      span / 1e3, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Argument: the step in kyr.
void order8(benchmark::State& state) {
  run(state, Splitting{static_cast<double>(state.range(0)), SplittingScheme::order8});
}
void adaptive(benchmark::State& state) { run(state, Adaptive{1e-10}); }

}  // namespace

BENCHMARK(order8)->Arg(10)->Arg(7)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(adaptive)->Unit(benchmark::kMillisecond);
