// SPDX-License-Identifier: MIT
// A state of each of many new bodies: propagate, by each set of instructions, next to FreeRotation
// body by body. Random ellipsoids, isotropic momenta, one time each within 100 turns; or within 1e9
// turns, a tenth of the bodies within 1e-6 of the separatrix. `error` is the largest difference
// from FreeRotation, of a component of q or of g/G, over 4096 bodies.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "polhode/ensemble/batches.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/propagate.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

struct Bodies {
  std::vector<Body> bodies;
  std::vector<RotorState> states;
  std::vector<double> times;
};

// The momentum about the greatest moment that puts the state so far from the separatrix, relative.
void move_to_separatrix(const Vec3& I, Vec3& g, double distance) {
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int a, int b) { return I[a] < I[b]; });
  const double I1 = I[order[0]], I2 = I[order[1]], I3 = I[order[2]];
  g[order[2]] = g[order[0]] * std::sqrt(I3 * (I2 - I1) / (I1 * (I3 - I2))) * (1.0 + 0.5 * distance);
}

Bodies drawn(std::size_t count, double turns, double next_to_separatrix) {
  std::mt19937_64 random(32);
  std::uniform_real_distribution<double> axis(0.3, 1.0), part(0.0, 1.0);
  std::normal_distribution<double> normal;
  Bodies b;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = axis(random), y = axis(random), z = axis(random);
    b.bodies.emplace_back(y * y + z * z, x * x + z * z, x * x + y * y);
    RotorState s{{normal(random), normal(random), normal(random), normal(random)},
                 {normal(random), normal(random), normal(random)}};
    if (part(random) < next_to_separatrix)
      move_to_separatrix(b.bodies[i].moments(), s.g, 1e-6 * (2.0 * part(random) - 1.0));
    b.states.push_back(s);
    const double turn = 6.283185307179586 / norm(angular_velocity(b.bodies[i], s));
    b.times.push_back(turns * part(random) * turn);
  }
  return b;
}

void add_difference(Worst<>& worst, const RotorState& a, const RotorState& b) {
  const double G = norm(b.g);
  for (const double d : {a.q.w - b.q.w, a.q.x - b.q.x, a.q.y - b.q.y, a.q.z - b.q.z,
                         (a.g.x - b.g.x) / G, (a.g.y - b.g.y) / G, (a.g.z - b.g.z) / G})
    worst.add(std::abs(d));
}

double largest_difference(const Bodies& b, const std::vector<RotorState>& found) {
  Worst<> worst;
  for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), 4096); ++i)
    add_difference(worst, found[i], FreeRotation(b.bodies[i], b.states[i]).at(b.times[i]));
  return worst.value();
}

// Arguments: bodies, turns, per cent next to the separatrix, set of instructions.
void propagate_many(benchmark::State& state) {
  const auto set = static_cast<InstructionSet>(state.range(3));
  if (!supports(set)) return state.SkipWithError("not on this processor");
  const Bodies b = drawn(static_cast<std::size_t>(state.range(0)),
                         static_cast<double>(state.range(1)), 0.01 * double(state.range(2)));
  std::vector<RotorState> found(b.times.size());
  for (auto _ : state) {
    propagate(b.bodies, b.states, b.times, 0.0, found, set);
    benchmark::DoNotOptimize(found.data());
  }
  state.SetLabel(std::string(instruction_set_name(set)));
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["ns"] = benchmark::Counter(
      static_cast<double>(state.range(0)) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["error"] = largest_difference(b, found);
}
BENCHMARK(propagate_many)
    ->ArgNames({"bodies", "turns", "near", "set"})
    ->ArgsProduct({{1, 4000, 1'000'000}, {100}, {0}, {0, 1, 2}})
    ->ArgsProduct({{4000, 1'000'000}, {1'000'000'000}, {10}, {0, 1, 2}});

// The same on threads: `real_time` is what a user waits, `CPU` that of all threads together.
void propagate_on_threads(benchmark::State& state) {
  const Bodies b = drawn(static_cast<std::size_t>(state.range(0)), 100.0, 0.0);
  std::vector<RotorState> found(b.times.size());
  for (auto _ : state) {
    ensemble::propagate(b.bodies, b.states, b.times, 0.0, found, static_cast<int>(state.range(1)));
    benchmark::DoNotOptimize(found.data());
  }
  state.counters["error"] = largest_difference(b, found);
}
BENCHMARK(propagate_on_threads)
    ->ArgNames({"bodies", "threads"})
    ->ArgsProduct({{100'000, 1'000'000}, {1, 2}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void free_rotation_each(benchmark::State& state) {
  const Bodies b = drawn(1000, 100.0, 0.0);
  for (auto _ : state)
    for (std::size_t i = 0; i < b.times.size(); ++i)
      benchmark::DoNotOptimize(FreeRotation(b.bodies[i], b.states[i]).at(b.times[i]));
  state.counters["ns"] = benchmark::Counter(
      1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(free_rotation_each);

}  // namespace
