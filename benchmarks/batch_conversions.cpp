// SPDX-License-Identifier: MIT
// A million states at once, each call allocating what it returns: what Python's conversions are
// measured against (benchmarks/python_conversions.py). The error is that of the round trip to the
// hub, in eps (|g| = 1): the conversions are those of charts.cpp.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "polhode/free/free_rotation.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/many_states.hpp"
#include "polhode/rotor/poincare.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

constexpr std::size_t count = 1'000'000;

struct Free {
  void operator()(void* p) const { std::free(p); }
};
template <class T>
using Room = std::unique_ptr<T[], Free>;
template <class T>
Room<T> room() {
  return Room<T>(static_cast<T*>(std::malloc(count * sizeof(T))));
}

template <class From, class F>
auto mapped(const From* in, F f) {
  using To = decltype(f(*in));
  Room<To> out = room<To>();
  for (std::size_t k = 0; k < count; ++k) out[k] = f(in[k]);
  return out;
}

const FreeRotation& motion() {
  static const FreeRotation m(Body(1.0, 1.7, 2.1), {{0.9, 0.1, -0.3, 0.2}, {0.2, 0.4, 0.89}});
  return m;
}
const double* times() {
  static const Room<double> t = [] {
    Room<double> all = room<double>();
    for (std::size_t k = 0; k < count; ++k) all[k] = 1e4 * static_cast<double>(k) / (count - 1.0);
    return all;
  }();
  return t.get();
}
const RotorState* states() {
  static const Room<RotorState> s = mapped(times(), [](double t) { return motion().at(t); });
  return s.get();
}

double distance(const RotorState& a, const RotorState& b) {
  const Vec3 d{a.g.x - b.g.x, a.g.y - b.g.y, a.g.z - b.g.z};
  return norm(d) / std::numeric_limits<double>::epsilon();
}

template <class From, class F>
void timed(benchmark::State& run, const From* in, F f) {
  for (auto _ : run) benchmark::DoNotOptimize(mapped(in, f).get());
  run.counters["rows"] = count;
}

// f(from, to) of all of them together.
template <class To, class From, class F>
Room<To> together(const From* in, F f) {
  Room<To> out = room<To>();
  f(std::span(in, count), std::span(out.get(), count));
  return out;
}
template <class To, class From, class F>
void timed_together(benchmark::State& run, const From* in, F f) {
  for (auto _ : run) benchmark::DoNotOptimize(together<To>(in, f).get());
  run.counters["rows"] = count;
}

void at(benchmark::State& run) {
  timed_together<RotorState>(run, times(), [](auto t, auto out) { motion().at(t, out); });
}
void at_grid(benchmark::State& run) {
  timed_together<RotorState>(run, times(), [](auto, auto out) {
    motion().at(TimeGrid{0.0, 0.01}, out);
  });
}
void sadov(benchmark::State& run) {
  timed_together<SadovState>(run, states(),
                             [](auto s, auto out) { to_sadov(motion().body(), s, out); });
}
void kinetic(benchmark::State& run) {
  timed(run, states(), [](const RotorState& s) { return kinetic_energy(motion().body(), s); });
}

template <auto To>
void chart(benchmark::State& run) {
  timed(run, states(), To);
  Worst worst;
  for (std::size_t k = 0; k < count; k += 997)
    worst.add(distance(to_rotor(To(states()[k])), states()[k]));
  run.counters["error_eps"] = worst.value();
}

template <class Chart, auto To>
void chart_together(benchmark::State& run) {
  timed_together<Chart>(run, states(), To);
  const Room<Chart> found = together<Chart>(states(), To);
  Worst worst;
  for (std::size_t k = 0; k < count; k += 997) worst.add(distance(to_rotor(found[k]), states()[k]));
  run.counters["error_eps"] = worst.value();
}

template <class Chart, auto To>
void hub(benchmark::State& run) {
  const Room<Chart> from = together<Chart>(states(), To);
  timed_together<RotorState>(run, static_cast<const Chart*>(from.get()),
                             [](auto s, auto out) { to_rotor(s, out); });
}

constexpr auto andoyer = [](auto... s) { return to_andoyer(s...); };
constexpr auto euler = [](auto... s) { return to_euler(s...); };
constexpr auto poincare = [](const RotorState& s) { return nearest_poincare(s); };

BENCHMARK(at)->Name("FreeRotation.at")->Unit(benchmark::kMillisecond);
BENCHMARK(chart_together<AndoyerState, andoyer>)->Name("to_andoyer")->Unit(benchmark::kMillisecond);
BENCHMARK(hub<AndoyerState, andoyer>)
    ->Name("to_rotor(AndoyerState)")
    ->Unit(benchmark::kMillisecond);
BENCHMARK(chart_together<EulerState, euler>)->Name("to_euler")->Unit(benchmark::kMillisecond);
BENCHMARK(hub<EulerState, euler>)->Name("to_rotor(EulerState)")->Unit(benchmark::kMillisecond);
BENCHMARK(at_grid)->Name("FreeRotation.at_grid")->Unit(benchmark::kMillisecond);
BENCHMARK(sadov)->Name("to_sadov")->Unit(benchmark::kMillisecond);
BENCHMARK(chart<poincare>)->Name("nearest_poincare")->Unit(benchmark::kMillisecond);
BENCHMARK(kinetic)->Name("kinetic_energy")->Unit(benchmark::kMillisecond);

}  // namespace
