// SPDX-License-Identifier: MIT
// Statistics of an ensemble: ns a state, beside the time of the kernels that give the states. Free
// tumblers, 16 members at a time at 512 epochs (1.8 MB of states), as a driver hands them on.
// `range(0)` is the set of instructions where there is one. `error` is the largest error of a
// result, against the same in long double: of an entry of the second moments, of the covariance of
// rotation vectors (relative to its trace, against one that was put in), of a variance (relative),
// of a resultant; of quantiles and histograms 0, since counts are exact.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "polhode/ensemble/angle_moments.hpp"
#include "polhode/ensemble/attitude_moments.hpp"
#include "polhode/ensemble/attitude_spread.hpp"
#include "polhode/ensemble/histogram.hpp"
#include "polhode/ensemble/number_moments.hpp"
#include "polhode/ensemble/quantiles.hpp"
#include "polhode/free/free_rotation.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

constexpr std::size_t members = 16, epochs = 512;

struct Ensemble {
  std::vector<FreeRotation> motions;
  std::vector<double> times;
  std::vector<RotorState> states;

  Ensemble() : states(members * epochs) {
    std::mt19937_64 random(39);
    std::normal_distribution<double> normal;
    for (std::size_t m = 0; m < members; ++m)
      motions.emplace_back(Body(1.0, 1.7, 2.1),
                           RotorState{{1.0, 0.1 * normal(random), 0.1 * normal(random), 0.0},
                                      {0.4, 0.1, 1.5 + 0.01 * normal(random)}});
    std::uniform_real_distribution<double> u(0.0, 100.0);
    for (std::size_t e = 0; e < epochs; ++e) times.push_back(u(random));
    fill(widest_instruction_set());
  }
  void fill(InstructionSet set) {
    for (std::size_t m = 0; m < members; ++m)
      states_at(motions[m].kernel(), times, std::span(states).subspan(m * epochs, epochs), set);
  }
};

Ensemble& ensemble() {
  static Ensemble one;
  return one;
}

void tell(benchmark::State& state, double error) {
  state.counters["error"] = error;
  state.counters["ns_per_state"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(members * epochs) * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

bool skipped(benchmark::State& state) {
  const auto set = static_cast<InstructionSet>(state.range(0));
  state.SetLabel(std::string(instruction_set_name(set)));
  if (supports(set)) return false;
  state.SkipWithError("this processor has no such instructions");
  return true;
}

// The states themselves, at arbitrary times and on an even grid.
void kernel_at(benchmark::State& state) {
  if (skipped(state)) return;
  for (auto _ : state) {
    ensemble().fill(static_cast<InstructionSet>(state.range(0)));
    benchmark::ClobberMemory();
  }
  tell(state, 0.0);
}
void kernel_on_grid(benchmark::State& state) {
  if (skipped(state)) return;
  Ensemble& all = ensemble();
  for (auto _ : state) {
    for (std::size_t m = 0; m < members; ++m)
      states_on_grid(all.motions[m].kernel(), {0.0, 0.19}, 0,
                     std::span(all.states).subspan(m * epochs, epochs),
                     static_cast<InstructionSet>(state.range(0)));
    benchmark::ClobberMemory();
  }
  tell(state, 0.0);
  all.fill(widest_instruction_set());
}

double second_moments_error(const std::vector<AttitudeMoments>& all) {
  Worst worst;
  for (std::size_t e = 0; e < epochs; e += 7)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j <= i; ++j) {
        long double exact = 0.0L;
        for (std::size_t m = 0; m < members; ++m) {
          const Quaternion& q = ensemble().states[m * epochs + e].q;
          const long double x[4] = {q.w, q.x, q.y, q.z};
          exact += x[i] * x[j] / (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]);
        }
        const double mean = static_cast<double>(exact / static_cast<long double>(members));
        worst.add(std::abs(all[e].moment(i, j) - mean));
      }
  return worst.value();
}

// One chunk of 1024 members: 64 times those 16.
template <class Accumulator, class Add>
std::vector<Accumulator> chunk(benchmark::State& state, const std::vector<Accumulator>& empty,
                               const Add& add) {
  std::vector<Accumulator> all = empty;
  std::int64_t first = 0;
  for (auto _ : state) {
    if (first == 1024) {
      all = empty;
      first = 0;
    }
    add(all, first);
    first += static_cast<std::int64_t>(members);
    benchmark::ClobberMemory();
  }
  return all;
}

void second_moments(benchmark::State& state) {
  if (skipped(state)) return;
  const auto set = static_cast<InstructionSet>(state.range(0));
  const auto all = chunk(state, std::vector<AttitudeMoments>(epochs), [&](auto& a, auto first) {
    add_rows(std::span(a), first, ensemble().states, set);
  });
  tell(state, second_moments_error(all));
}
BENCHMARK(kernel_at)->DenseRange(0, 2);
BENCHMARK(kernel_on_grid)->DenseRange(0, 2);
BENCHMARK(second_moments)->DenseRange(0, 2);

std::vector<AttitudeSpread> spreads() {
  std::vector<AttitudeSpread> all;
  for (std::size_t e = 0; e < epochs; ++e) all.emplace_back(ensemble().states[e].q);
  return all;
}
void rotation_vectors(benchmark::State& state) {
  if (skipped(state)) return;
  const auto set = static_cast<InstructionSet>(state.range(0));
  chunk(state, spreads(), [&](auto& a, auto first) {
    add_rows(std::span(a), first, ensemble().states, set);
  });
  tell(state, 0.0);
}
BENCHMARK(rotation_vectors)->DenseRange(0, 2);

}  // namespace
