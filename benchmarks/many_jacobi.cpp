// SPDX-License-Identifier: MIT
// sn, cn and dn of many arguments in one call, by each set of instructions, each with a modulus of
// its own, though the moduli are equal (jacobi_each), or with one for all (jacobi_one): ns a value,
// and the largest error against double-double, in eps (|f| + |u f'|). `range(0)` is the set,
// `range(1)` the modulus: the last are drawn, 1 - m even in [0, 1] and in its logarithm.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

constexpr std::array<double, 6> complements{0.9999, 0.75, 0.19, 0.002, 2e-9, 2e-100};
constexpr std::int64_t even = 6, logarithmic = 7;
constexpr std::size_t count = 1024;

struct Case {
  std::vector<double> u, m, m1;
  std::vector<double> sn = std::vector<double>(count), cn = sn, dn = sn;

  explicit Case(std::int64_t index) {
    std::mt19937_64 engine(7);
    const auto uniform = [&](double lo, double hi) {
      return lo + (hi - lo) * std::ldexp(static_cast<double>(engine() >> 11U), -53);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const double drawn = index == even ? uniform(0.0, 1.0) : std::pow(10.0, uniform(-12.0, 0.0));
      m1.push_back(index < even ? complements[static_cast<std::size_t>(index)] : drawn);
      m.push_back(1.0 - m1[i]);
      u.push_back(elliptic::complete_k(elliptic::Modulus::from_pair(m[i], m1[i])) *
                  uniform(-2.0, 2.0));
    }
  }
  elliptic::JacobiSpans results() { return {sn, cn, dn}; }

  double error() const {
    Worst worst;
    for (std::size_t i = 0; i < count; ++i) {
      const DoubleDouble complement(m1[i]);
      const auto want =
          elliptic::jacobi(DoubleDouble(u[i]), elliptic::BasicModulus<DoubleDouble>::from_pair(
                                                   DoubleDouble(1.0) - complement, complement));
      const double s = std::abs(want.sn.hi), c = std::abs(want.cn.hi), d = want.dn.hi;
      const double a = std::abs(u[i]);
      worst.add(std::abs(to_double(want.sn - sn[i])) / (s + a * c * d));
      worst.add(std::abs(to_double(want.cn - cn[i])) / (c + a * s * d));
      worst.add(std::abs(to_double(want.dn - dn[i])) / (d + a * m[i] * s * c));
    }
    return worst.value() / epsilon<double>();
  }
};

template <class Call>
void measure(benchmark::State& state, Case& c, const Call& call) {
  const auto set = static_cast<InstructionSet>(state.range(0));
  if (!supports(set)) return state.SkipWithError("this processor has no such instructions");
  for (auto _ : state) {
    call(set);
    benchmark::DoNotOptimize(c.sn.data());
    benchmark::ClobberMemory();
  }
  state.SetLabel(std::string(instruction_set_name(set)));
  state.counters["ns_per_value"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(count) * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["m1"] = c.m1[0];
  state.counters["max_error_eps"] = c.error();
}

void jacobi_each(benchmark::State& state) {
  Case c(state.range(1));
  measure(state, c,
          [&c](InstructionSet set) { elliptic::jacobi(c.u, c.m, c.m1, c.results(), set); });
}
void jacobi_one(benchmark::State& state) {
  Case c(state.range(1));
  const elliptic::Modulus modulus = elliptic::Modulus::from_pair(c.m[0], c.m1[0]);
  measure(state, c, [&](InstructionSet set) { elliptic::jacobi(c.u, modulus, c.results(), set); });
}

BENCHMARK(jacobi_each)->ArgsProduct({{0, 1, 2}, {0, 1, 2, 3, 4, 5, even, logarithmic}});
BENCHMARK(jacobi_one)->ArgsProduct({{0, 1, 2}, {0, 1, 2, 3, 4, 5}});

}  // namespace
