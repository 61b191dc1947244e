// SPDX-License-Identifier: MIT
// Statistics of an ensemble: ns a state, beside the time of the kernels that give the states. Free
// tumblers, 64 members at a time at 128 epochs (0.46 MB of states), as a driver hands them on, in
// chunks of 1024 members: 16 times those 64. `range(0)` is the set of instructions where there is
// one. `error` is the largest error of a result of a chunk, over the epochs, against the same in
// long double: of an entry of the second moments and of the covariance of rotation vectors
// (relative to its trace), of a variance (relative), of a resultant; of a median from bins against
// that of the numbers (of logarithmic bins relative). Counts are exact.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "ensemble/angle_moments.hpp"
#include "ensemble/attitude_moments.hpp"
#include "ensemble/attitude_spread.hpp"
#include "ensemble/histogram.hpp"
#include "ensemble/number_moments.hpp"
#include "polhode/ensemble/bins.hpp"
#include "polhode/free/free_rotation.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

constexpr std::size_t members = 64, epochs = 128, of_chunk = 1024;
constexpr long double repeated = static_cast<long double>(of_chunk) / members;

long double wide(double x) { return static_cast<long double>(x); }

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

double second_moments_error(const std::vector<ensemble::AttitudeMoments>& all) {
  Worst worst;
  for (std::size_t e = 0; e < epochs; e += 7)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j <= i; ++j) {
        long double exact = 0.0L;
        for (std::size_t m = 0; m < members; ++m) {
          const Quaternion& q = ensemble().states[m * epochs + e].q;
          const long double x[4] = {wide(q.w), wide(q.x), wide(q.y), wide(q.z)};
          exact += x[i] * x[j] / (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]);
        }
        const double mean = static_cast<double>(exact / static_cast<long double>(members));
        worst.add(std::abs(all[e].moment(i, j) - mean));
      }
  return worst.value();
}

// Until a chunk is full, then the next one.
template <class Accumulator, class Add>
std::vector<Accumulator> chunk(benchmark::State& state, const std::vector<Accumulator>& empty,
                               const Add& add) {
  std::vector<Accumulator> all = empty;
  std::size_t first = 0;
  for (auto _ : state) {
    if (first == of_chunk) {
      all = empty;
      first = 0;
    }
    add(all, static_cast<std::int64_t>(first));
    first += members;
    benchmark::ClobberMemory();
  }
  // a whole one, to look at
  all = empty;
  for (first = 0; first < of_chunk; first += members) add(all, static_cast<std::int64_t>(first));
  return all;
}
// of(epoch, member) added to each epoch.
template <class Accumulator, class Of>
std::vector<Accumulator> chunk_of(benchmark::State& state, const Accumulator& empty, const Of& of) {
  return chunk(state, std::vector<Accumulator>(epochs, empty), [&](auto& all, std::int64_t first) {
    for (std::size_t m = 0; m < members; ++m)
      for (std::size_t e = 0; e < epochs; ++e)
        of(all[e], first + static_cast<std::int64_t>(m), ensemble().states[m * epochs + e]);
  });
}

void second_moments(benchmark::State& state) {
  if (skipped(state)) return;
  const auto set = static_cast<InstructionSet>(state.range(0));
  const auto all =
      chunk(state, std::vector<ensemble::AttitudeMoments>(epochs), [&](auto& a, auto first) {
        ensemble::add_rows(std::span(a), first, ensemble().states, set);
      });
  tell(state, second_moments_error(all));
}
void second_moments_one_by_one(benchmark::State& state) {
  const auto all = chunk_of(state, ensemble::AttitudeMoments(),
                            [](auto& a, auto member, const auto& s) { a.add(member, s.q); });
  tell(state, second_moments_error(all));
}
// All states of one epoch.
void second_moments_of_a_block(benchmark::State& state) {
  ensemble::AttitudeMoments all;
  for (auto _ : state) {
    all = {};
    all.add(0, ensemble().states);
    benchmark::ClobberMemory();
  }
  tell(state,
       std::abs(all.moment(0, 0) + all.moment(1, 1) + all.moment(2, 2) + all.moment(3, 3) - 1.0));
}

std::vector<ensemble::AttitudeSpread> spreads() {
  std::vector<ensemble::AttitudeSpread> all;
  for (std::size_t e = 0; e < epochs; ++e) all.emplace_back(ensemble().states[e].q);
  return all;
}
// Of v from conj(r) q in long double.
double spread_error(const std::vector<ensemble::AttitudeSpread>& all) {
  using Wide = long double;
  Worst worst;
  for (std::size_t e = 0; e < epochs; e += 7) {
    const Quaternion& r = all[e].reference();
    Wide v[members][3], mean[3] = {};
    for (std::size_t m = 0; m < members; ++m) {
      const Quaternion& q = ensemble().states[m * epochs + e].q;
      const Wide a[4] = {wide(r.w), -wide(r.x), -wide(r.y), -wide(r.z)};
      const Wide b[4] = {wide(q.w), wide(q.x), wide(q.y), wide(q.z)};
      const Wide w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
      const Wide u[3] = {a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                         a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3],
                         a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1]};
      const Wide s = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
      const Wide turned = 2.0L * std::atan2(s, std::abs(w)) * (w < 0.0L ? -1.0L : 1.0L);
      for (int i = 0; i < 3; ++i) {
        v[m][i] = s == 0.0L ? 0.0L : turned / s * u[i];
        mean[i] += v[m][i] / members;
      }
    }
    const Mat3 found = all[e].covariance();
    const double trace = found(0, 0) + found(1, 1) + found(2, 2);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Wide exact = 0.0L;
        for (const auto& x : v)
          exact += (x[i] - mean[i]) * (x[j] - mean[j]) * repeated / (of_chunk - 1);
        worst.add(std::abs(found(i, j) - static_cast<double>(exact)) / trace);
      }
  }
  return worst.value();
}
void rotation_vectors(benchmark::State& state) {
  if (skipped(state)) return;
  const auto set = static_cast<InstructionSet>(state.range(0));
  tell(state, spread_error(chunk(state, spreads(), [&](auto& a, auto first) {
         ensemble::add_rows(std::span(a), first, ensemble().states, set);
       })));
}

template <class Find>
double worst_variance(const Find& found) {
  Worst worst;
  for (std::size_t e = 0; e < epochs; e += 7) {
    long double mean = 0.0L, sum = 0.0L;
    const auto x = [&](std::size_t m) -> long double {
      return wide(ensemble().states[m * epochs + e].g.x);
    };
    for (std::size_t m = 0; m < members; ++m) mean += x(m) / members;
    for (std::size_t m = 0; m < members; ++m) sum += (x(m) - mean) * (x(m) - mean);
    worst.add(std::abs(found(e) / static_cast<double>(sum * repeated / (of_chunk - 1)) - 1.0));
  }
  return worst.value();
}
void moments_of_three_numbers(benchmark::State& state) {
  const auto all =
      chunk_of(state, ensemble::NumberMoments(3),
               [](auto& a, auto member, const auto& s) { a.add(member, std::span(&s.g.x, 3)); });
  tell(state, worst_variance([&](std::size_t e) { return all[e].covariance(0, 0); }));
}
void moments_of_one_number(benchmark::State& state) {
  const auto all =
      chunk_of(state, ensemble::NumberMoments(1),
               [](auto& a, auto member, const auto& s) { a.add(member, std::span(&s.g.x, 1)); });
  tell(state, worst_variance([&](std::size_t e) { return all[e].covariance(0, 0); }));
}
void circular_moments(benchmark::State& state) {
  const auto all =
      chunk_of(state, ensemble::AngleMoments(),
               [](auto& a, auto member, const auto& s) { a.add(member, 6.0 * s.g.x); });
  Worst worst;
  for (std::size_t e = 0; e < epochs; e += 7) {
    long double c = 0.0L, s = 0.0L;
    for (std::size_t m = 0; m < members; ++m) {
      const long double a = wide(6.0 * ensemble().states[m * epochs + e].g.x);
      c += std::cos(a) / members;
      s += std::sin(a) / members;
    }
    worst.add(std::abs(all[e].resultant() - static_cast<double>(std::hypot(c, s))));
  }
  tell(state, worst.value());
}

// Exact: the numbers are kept. In bins: `bins` of them, even or logarithmic.
void quantiles_kept(benchmark::State& state) {
  chunk_of(state, ensemble::Quantiles(ensemble::Bins::linear(-2.0, 2.0, 1000), 2000),
           [](auto& a, auto member, const auto& s) { a.add(member, s.g.x); });
  tell(state, 0.0);
}
void quantiles_in_bins(benchmark::State& state) {
  const bool is_even = state.range(0) == 0;
  const ensemble::Bins bins = is_even ? ensemble::Bins::linear(-2.0, 2.0, 1000)
                                      : ensemble::Bins::signed_logarithmic(0.01, 1e-6, 10.0);
  state.SetLabel((is_even ? "even bins: " : "logarithmic bins: ") + std::to_string(bins.count()));
  const auto all = chunk_of(state, ensemble::Quantiles(bins, 0),
                            [](auto& a, auto member, const auto& s) { a.add(member, s.g.x); });
  Worst worst;
  for (std::size_t e = 0; e < epochs; e += 7) {
    ensemble::Quantiles kept(bins, 2000);
    for (std::size_t k = 0; k < of_chunk; ++k)
      kept.add(0, ensemble().states[(k % members) * epochs + e].g.x);
    const double exact = kept.ranked(511).value, found = all[e].ranked(511).value;
    worst.add(std::abs(found - exact) / (is_even ? 1.0 : std::abs(exact)));
  }
  tell(state, worst.value());
}
void histogram(benchmark::State& state) {
  chunk_of(state, ensemble::Histogram(ensemble::Bins::linear(-2.0, 2.0, 200)),
           [](auto& a, auto member, const auto& s) { a.add(member, s.g.x); });
  tell(state, 0.0);
}
void histogram_2d(benchmark::State& state) {
  const ensemble::Bins bins = ensemble::Bins::linear(-2.0, 2.0, 40);
  chunk_of(state, ensemble::Histogram2D(bins, bins),
           [](auto& a, auto member, const auto& s) { a.add(member, s.g.x, s.g.y); });
  tell(state, 0.0);
}

// Of one chunk with another; ns a state of the members of a chunk, as the others.
template <class Accumulator, class Add>
void merged(benchmark::State& state, std::vector<Accumulator> all, const Add& add) {
  std::vector<Accumulator> later = all;
  add(later);
  for (auto _ : state) {
    for (std::size_t e = 0; e < epochs; ++e) all[e].merge(later[e]);
    benchmark::ClobberMemory();
  }
  state.counters["ns_per_state"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(of_chunk) *
                             static_cast<double>(epochs) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
void merge_of_second_moments(benchmark::State& state) {
  merged(state, std::vector<ensemble::AttitudeMoments>(epochs),
         [](auto& a) { ensemble::add_rows(std::span(a), 0, ensemble().states); });
}
void merge_of_rotation_vectors(benchmark::State& state) {
  merged(state, spreads(), [](auto& a) { ensemble::add_rows(std::span(a), 0, ensemble().states); });
}
void merge_of_quantiles_in_bins(benchmark::State& state) {
  merged(state,
         std::vector(epochs, ensemble::Quantiles(ensemble::Bins::linear(-2.0, 2.0, 1000), 0)),
         [](auto& a) {
           for (std::size_t e = 0; e < epochs; ++e) a[e].add(0, ensemble().states[e].g.x);
         });
}

BENCHMARK(kernel_at)->DenseRange(0, 2);
BENCHMARK(kernel_on_grid)->DenseRange(0, 2);
BENCHMARK(second_moments)->DenseRange(0, 2);
BENCHMARK(second_moments_one_by_one);
BENCHMARK(second_moments_of_a_block);
BENCHMARK(rotation_vectors)->DenseRange(0, 2);
BENCHMARK(moments_of_one_number);
BENCHMARK(moments_of_three_numbers);
BENCHMARK(circular_moments);
BENCHMARK(quantiles_kept);
BENCHMARK(quantiles_in_bins)->DenseRange(0, 1);
BENCHMARK(histogram);
BENCHMARK(histogram_2d);
BENCHMARK(merge_of_second_moments);
BENCHMARK(merge_of_rotation_vectors);
BENCHMARK(merge_of_quantiles_in_bins);

}  // namespace
