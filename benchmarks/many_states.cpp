// SPDX-License-Identifier: MIT
// Charts of many states in one call, by each set of instructions: ns a state, and the largest error
// against the same formulas in double-double (Andoyer, Euler, Poincare; in eps, angles modulo 2 pi)
// or against the motion's own variables (Sadov; in eps, the action and phi_l; back: the state of
// one set). |g| = 1. `range(0)` is the set.
#include "polhode/rotor/many_states.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "chart_errors.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"

namespace {

using namespace polhode;
using namespace polhode::chart_bench;

const Body body(1.0, 1.7, 2.1);

const std::vector<RotorState>& states() {
  static const std::vector<RotorState> sample = drawn_states(4096);
  return sample;
}

template <class To, class From, class Convert>
std::vector<To> timed(benchmark::State& state, const std::vector<From>& from,
                      const Convert& convert) {
  const auto set = static_cast<InstructionSet>(state.range(0));
  std::vector<To> to(from.size());
  if (!supports(set)) {
    state.SkipWithError("this processor has no such instructions");
    return to;
  }
  for (auto _ : state) {
    convert(std::span<const From>(from), std::span<To>(to), set);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  state.SetLabel(std::string(instruction_set_name(set)));
  state.counters["ns_per_state"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(from.size()) * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  return to;
}

template <class To, class From, class Convert>
void measure(benchmark::State& state, const std::vector<From>& from, const Convert& convert) {
  const std::vector<To> to = timed<To>(state, from, convert);
  Worst worst;
  for (std::size_t i = 0; i < from.size(); i += 4) worst.add(error(to[i], convert(wide(from[i]))));
  state.counters["max_error_eps"] = worst.value();
}

const auto andoyer = [](const auto&... s) { return to_andoyer(s...); };
const auto euler = [](const auto&... s) { return to_euler(s...); };
const auto nearest = [](const auto&... s) { return nearest_poincare(s...); };
const auto hub = [](const auto&... s) { return to_rotor(s...); };

template <class Convert>
auto converted(Convert convert) {
  std::vector<decltype(convert(RotorState{}))> result;
  for (const RotorState& s : states()) result.push_back(convert(s));
  return result;
}

void many_to_andoyer(benchmark::State& state) { measure<AndoyerState>(state, states(), andoyer); }
void many_from_andoyer(benchmark::State& state) {
  measure<RotorState>(state, converted(andoyer), hub);
}
void many_to_euler(benchmark::State& state) { measure<EulerState>(state, states(), euler); }
void many_from_euler(benchmark::State& state) { measure<RotorState>(state, converted(euler), hub); }

void many_to_poincare(benchmark::State& state) { measure<PoincareState>(state, states(), nearest); }
void many_from_poincare(benchmark::State& state) {
  measure<RotorState>(state, converted(nearest), hub);
}

void many_to_sadov(benchmark::State& state) {
  const auto convert = [](std::span<const RotorState> from, std::span<SadovState> to,
                          InstructionSet set) { to_sadov(body, from, to, set); };
  const std::vector<SadovState> to = timed<SadovState>(state, states(), convert);
  Worst worst;
  for (std::size_t i = 0; i < to.size(); i += 8) {
    const SadovState s = to_sadov(FreeRotation(body, states()[i]), 0.0);
    worst.add(std::abs(to[i].I_l - s.I_l) / eps);
    worst.add(std::abs(std::remainder(to[i].phi_l - s.phi_l, 2.0 * pi<double>())) / eps);
  }
  state.counters["max_error_eps"] = worst.value();
}
void many_from_sadov(benchmark::State& state) {
  std::vector<SadovState> sadov(states().size());
  to_sadov(body, states(), sadov);
  const auto convert = [](std::span<const SadovState> from, std::span<RotorState> to,
                          InstructionSet set) { to_rotor(body, from, to, set); };
  const std::vector<RotorState> to = timed<RotorState>(state, sadov, convert);
  Worst worst;
  for (std::size_t i = 0; i < to.size(); i += 8) {
    const auto got = numbers(to[i]), one = numbers(to_rotor(body, sadov[i]));
    for (std::size_t j = 0; j < got.size(); ++j) worst.add(std::abs(got[j] - one[j]) / eps);
  }
  state.counters["max_error_eps"] = worst.value();
}
const std::vector<double>& times() {
  static const std::vector<double> all = [] {
    std::vector<double> t(states().size());
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = 0.01 * static_cast<double>(i);
    return t;
  }();
  return all;
}
// The error of Serret's elements is that of the state that one at a time makes of them.
void many_to_serret(benchmark::State& state) {
  const auto convert = [](std::span<const RotorState> from, std::span<SerretState> to,
                          InstructionSet set) { to_serret(body, from, times(), to, set); };
  const std::vector<SerretState> to = timed<SerretState>(state, states(), convert);
  Worst worst;
  for (std::size_t i = 0; i < to.size(); i += 8) {
    const RotorState one = to_rotor(body, to[i], times()[i]);
    worst.add(norm(one.g - states()[i].g) / eps);
  }
  state.counters["max_error_eps"] = worst.value();
}
void many_from_serret(benchmark::State& state) {
  std::vector<SerretState> serret(states().size());
  to_serret(body, states(), times(), serret);
  const auto convert = [](std::span<const SerretState> from, std::span<RotorState> to,
                          InstructionSet set) { to_rotor(body, from, times(), to, set); };
  const std::vector<RotorState> to = timed<RotorState>(state, serret, convert);
  Worst worst;
  for (std::size_t i = 0; i < to.size(); i += 8) {
    const auto got = numbers(to[i]), one = numbers(to_rotor(body, serret[i], times()[i]));
    for (std::size_t j = 0; j < got.size(); ++j) worst.add(std::abs(got[j] - one[j]) / eps);
  }
  state.counters["max_error_eps"] = worst.value();
}
void one_to_serret(benchmark::State& state) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(to_serret(FreeRotation(body, states()[i], times()[i]), times()[i]));
    i = (i + 1) % states().size();
  }
}
void one_to_sadov(benchmark::State& state) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(to_sadov(body, states()[i]));
    i = (i + 1) % states().size();
  }
}
void one_from_sadov(benchmark::State& state) {
  std::vector<SadovState> sadov(states().size());
  to_sadov(body, states(), sadov);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(to_rotor(body, sadov[i]));
    i = (i + 1) % sadov.size();
  }
}

BENCHMARK(many_to_andoyer)->DenseRange(0, 2);
BENCHMARK(many_from_andoyer)->DenseRange(0, 2);
BENCHMARK(many_to_euler)->DenseRange(0, 2);
BENCHMARK(many_from_euler)->DenseRange(0, 2);
BENCHMARK(many_to_poincare)->DenseRange(0, 2);
BENCHMARK(many_from_poincare)->DenseRange(0, 2);
BENCHMARK(many_to_sadov)->DenseRange(0, 2);
BENCHMARK(many_from_sadov)->DenseRange(0, 2);
BENCHMARK(many_to_serret)->DenseRange(0, 2);
BENCHMARK(many_from_serret)->DenseRange(0, 2);
BENCHMARK(one_to_serret);
BENCHMARK(one_to_sadov);
BENCHMARK(one_from_sadov);

}  // namespace
