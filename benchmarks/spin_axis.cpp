// SPDX-License-Identifier: MIT
// The spin axis of an Earth-like planet over 100 Myr, on a table of 1 kyr: time for each million
// years (and each body, of many at once), and the distance of the last axis from that of the
// adaptive method at 1e-14.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/secular/spin_precession.hpp"

namespace {

using namespace polhode;

constexpr double arcsec_per_kyr = std::numbers::pi / 180.0 / 3600.0;
constexpr double span = 1e5;  // kyr

// The largest terms of the Earth's e and i (Laskar 1988).
secular::ElementTable orbit() {
  const secular::ElementSeries series({{4248.976 * arcsec_per_kyr, 0.0189701, 0.5343},
                                       {7455.487 * arcsec_per_kyr, 0.0163190, 3.4874},
                                       {17922.491 * arcsec_per_kyr, 0.0129891, 2.6529}},
                                      {{0.0, 0.0137722, 1.8777},
                                       {-18850.133 * arcsec_per_kyr, 0.0079888, 4.2802},
                                       {-5604.358 * arcsec_per_kyr, 0.0051545, 0.2983}});
  std::vector<double> times;
  std::vector<secular::OrbitElements> rows;
  for (int k = -20; k <= static_cast<int>(span) + 20; ++k) {
    times.push_back(k);
    rows.push_back(series.at(times.back()));
  }
  return {std::move(times), rows};
}

constexpr secular::PrecessionRates rates{.star = 17370.0 * arcsec_per_kyr,
                                         .satellites = 37500.0 * arcsec_per_kyr};
secular::SpinAxis start() { return secular::spin_axis({0.0, std::sin(0.4), std::cos(0.4)}); }

secular::SpinAxis moved(const Method& method) {
  static const secular::SpinPrecession model(orbit(), rates);
  const BasicProblem<secular::SpinPrecession<secular::ElementTable>> problem{model, start(), 0.0,
                                                                             span, method};
  return integrate(problem, Keep{.samples = SaveAt::times({span}), .dense = false})
      .samples()
      .back()
      .s;
}

const secular::SpinAxis& exact() {
  static const secular::SpinAxis axis = moved(Adaptive{1e-14});
  return axis;
}

void run(benchmark::State& state, const Method& method) {
  secular::SpinAxis last{};
  for (auto _ : state) last = moved(method);
  state.counters["error"] = norm(last.s - exact().s);
  state.counters["time/Myr"] = benchmark::Counter(
      span / 1e3, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Argument: the step in kyr.
void order8(benchmark::State& state) {
  run(state, Splitting{static_cast<double>(state.range(0)), SplittingScheme::order8});
}
void adaptive(benchmark::State& state) { run(state, Adaptive{1e-10}); }

// As many bodies at once as the first argument says, of constants that differ by up to 1 %, the
// first of which is that of the others; the step in kyr; the set of instructions.
void lanes(benchmark::State& state) {
  static const secular::OrbitHistory table{orbit()};
  const auto set = static_cast<InstructionSet>(state.range(2));
  if (!supports(set)) return state.SkipWithError("not on this processor");
  std::vector<secular::PrecessionRates> all(static_cast<std::size_t>(state.range(0)), rates);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].star *= 1.0 + 0.01 * static_cast<double>(i) / static_cast<double>(all.size());
  const std::vector<secular::SpinAxis> starts(all.size(), start());
  std::vector<secular::SpinAxis> ends(all.size());
  const Splitting method{static_cast<double>(state.range(1)), SplittingScheme::order8};
  for (auto _ : state)
    secular::spin_histories(table, all, starts, 0.0, SaveAt::times({span}), method, ends, {}, set);
  state.counters["error"] = norm(ends[0].s - exact().s);
  state.counters["time/Myr"] = benchmark::Counter(
      static_cast<double>(all.size()) * span / 1e3,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetLabel(std::string(instruction_set_name(set)));
}
void lanes_of_each_set(benchmark::internal::Benchmark* of) {
  constexpr auto avx512 = static_cast<int>(InstructionSet::avx512);
  for (const int bodies : {1, 8, 32, 256, 1024}) of->Args({bodies, 7, avx512});
  of->Args({1024, 5, avx512});
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2})
    of->Args({1024, 7, static_cast<int>(set)});
}

}  // namespace

BENCHMARK(order8)->Arg(10)->Arg(7)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(adaptive)->Unit(benchmark::kMillisecond);
BENCHMARK(lanes)->Apply(lanes_of_each_set)->Unit(benchmark::kMillisecond);
