// SPDX-License-Identifier: MIT
// Every chart to the hub and back: time of one conversion, and its largest error against the same
// formulas in double-double, in units of eps (angles modulo 2 pi; |g| = 1).
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "chart_errors.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"

namespace {

using namespace polhode;
using namespace polhode::chart_bench;

constexpr std::size_t count = 1024;

const std::vector<RotorState>& states() {
  static const std::vector<RotorState> sample = drawn_states(count);
  return sample;
}

// Runs convert over the inputs, and reports the largest difference from convert over wide inputs.
template <class Input, class Convert>
void measure(benchmark::State& state, const std::vector<Input>& inputs, Convert convert) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(convert(inputs[i]));
    i = (i + 1) % count;
  }
  Worst worst;
  for (const Input& s : inputs) worst.add(error(convert(s), convert(wide(s))));
  state.counters["max_error_eps"] = worst.value();
}

template <class Convert>
auto converted(Convert convert) {
  std::vector<decltype(convert(RotorState{}))> result;
  for (const RotorState& s : states()) result.push_back(convert(s));
  return result;
}

const auto andoyer = [](const auto& s) { return to_andoyer(s); };
const auto euler = [](const auto& s) { return to_euler(s); };
const auto poincare = [](const auto& s) { return nearest_poincare(s); };
const auto hub = [](const auto& s) { return to_rotor(s); };

void hub_to_andoyer(benchmark::State& state) { measure(state, states(), andoyer); }
void andoyer_to_hub(benchmark::State& state) { measure(state, converted(andoyer), hub); }
void hub_to_euler(benchmark::State& state) { measure(state, states(), euler); }
void euler_to_hub(benchmark::State& state) { measure(state, converted(euler), hub); }
void hub_to_poincare(benchmark::State& state) { measure(state, states(), poincare); }
void poincare_to_hub(benchmark::State& state) { measure(state, converted(poincare), hub); }

void andoyer_jacobian(benchmark::State& state) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(chart_jacobian(states()[i], CanonicalChart{CanonicalSet::andoyer}));
    i = (i + 1) % count;
  }
}
void euler_to_poincare_jacobian(benchmark::State& state) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(canonical_transformation(
        states()[i], {CanonicalSet::euler}, {CanonicalSet::poincare, Pole::zero, Pole::zero}));
    i = (i + 1) % count;
  }
}

BENCHMARK(hub_to_andoyer);
BENCHMARK(andoyer_to_hub);
BENCHMARK(hub_to_euler);
BENCHMARK(euler_to_hub);
BENCHMARK(hub_to_poincare);
BENCHMARK(poincare_to_hub);
BENCHMARK(andoyer_jacobian);
BENCHMARK(euler_to_poincare_jacobian);

}  // namespace
