// SPDX-License-Identifier: MIT
// Products and values of Poisson series in doubles. Counters: "terms" of the result, "pairs" a
// second, and "error": the largest difference of the value of a product from the product of the
// values at some points, over sum |C a^n| of the result.
//
// sparse: exponents and multipliers drawn far apart, so that hardly two pairs have one key; dense:
// where every second pair has that of another; full: as in theories of motion, where terms have
// nearly all keys between bounds, and twenty pairs go into one.
#include <benchmark/benchmark.h>

#ifdef POLHODE_GINAC
#include <ginac/ginac.h>
#endif

#include <cmath>
#include <random>
#include <vector>

#include "polhode/series/compiled_series.hpp"
#include "polhode/series/product.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;

series::Symbols symbols() { return series::Symbols({"e", "s", "a"}, {"l", "g", "h"}); }

// Exponents from 0 to `spread`, multipliers from -spread to spread. Some keys are drawn twice.
series::Series<double> drawn(unsigned seed, std::size_t terms, int spread) {
  std::mt19937 engine(seed);
  const auto integer = [&](int first, int last) {
    return first + static_cast<int>(engine() % static_cast<unsigned>(last - first + 1));
  };
  series::Series<double> sum(symbols());
  while (sum.size() < terms) {
    const series::Powers powers{
        {"e", integer(0, spread)}, {"s", integer(0, spread)}, {"a", integer(0, spread)}};
    const series::Multiples angle{{"l", integer(-spread, spread)},
                                  {"g", integer(-spread, spread)},
                                  {"h", integer(-spread, spread)}};
    const double c = integer(1, 1000) / 1000.0;
    sum += integer(0, 1) == 0 ? series::cosine(symbols(), c, powers, angle)
                              : series::sine(symbols(), c, powers, angle);
  }
  return sum;
}

double error(const series::Series<double>& a, const series::Series<double>& b,
             const series::Series<double>& ab) {
  const series::CompiledSeries of_a(a), of_b(b), of_ab(ab);
  test::Worst worst;
  for (int i = 0; i < 10; ++i) {
    const std::vector<double> at{0.7, 0.8, 0.9, 0.3 + i, 1.1 * i, 0.2 * i * i};
    double size = 0.0;
    for (const series::Term<double>& term : ab.terms()) size += std::abs(term.c);
    worst.add(std::abs(of_ab.at(at) - of_a.at(at) * of_b.at(at)) / size);
  }
  return worst.value();
}

void product_of(benchmark::State& state, int spread) {
  const auto terms = static_cast<std::size_t>(state.range(0));
  const series::Series<double> a = drawn(1, terms, spread), b = drawn(2, terms, spread);
  series::Series<double> ab(symbols());
  for (auto _ : state) ab = series::product(a, b);
  state.counters["terms"] = static_cast<double>(ab.size());
  state.counters["pairs"] = benchmark::Counter(static_cast<double>(a.size() * b.size()),
                                               benchmark::Counter::kIsIterationInvariantRate);
  state.counters["error"] = error(a, b, ab);
}
BENCHMARK_CAPTURE(product_of, sparse, 60)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(product_of, dense, 4)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(product_of, full, 2)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

#ifdef POLHODE_GINAC
// The same in general computer algebra: cos x = (z + 1/z) / 2 with z = exp(i x) as a symbol.
GiNaC::ex of_ginac(const Series<double>& series, const std::vector<GiNaC::symbol>& names) {
  using namespace GiNaC;
  const Symbols& by = series.symbols();
  exvector sum;
  for (const Term<double>& term : series.terms()) {
    ex monomial = numeric(term.c / 2.0), wave = 1;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      monomial *= pow(names[k], exponent(by, term.key, i));
      wave *= pow(names[3 + k], multiplier(by, term.key, i));
    }
    const bool is_sine = term.key.function() == Trigonometric::sine;
    const ex turned = pow(wave, -1);
    sum.push_back(monomial * (is_sine ? ex(-I) : ex(1)) * wave);
    sum.push_back(monomial * (is_sine ? ex(I) : ex(1)) * turned);
  }
  return add(sum);
}

void product_by_ginac(benchmark::State& state, int spread) {
  const auto terms = static_cast<std::size_t>(state.range(0));
  const std::vector<GiNaC::symbol> names(6);
  const GiNaC::ex a = of_ginac(drawn(1, terms, spread), names),
                  b = of_ginac(drawn(2, terms, spread), names);
  GiNaC::ex ab;
  for (auto _ : state) ab = (a * b).expand();
  state.counters["waves"] = static_cast<double>(ab.nops());
}
BENCHMARK_CAPTURE(product_by_ginac, full, 2)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
#endif

void truncated_product(benchmark::State& state) {
  const series::Series<double> a = drawn(1, 1000, 4), b = drawn(2, 1000, 4);
  const series::Truncation keep{{{"e", 1}, {"s", 1}, {"a", 1}}, static_cast<int>(state.range(0))};
  series::Series<double> ab(symbols());
  for (auto _ : state) ab = series::product(a, b, keep);
  state.counters["terms"] = static_cast<double>(ab.size());
  state.counters["pairs"] = series::product_size(a, b, keep).pairs;
}
BENCHMARK(truncated_product)->Arg(6)->Arg(12)->Unit(benchmark::kMillisecond);

void values(benchmark::State& state) {
  const series::CompiledSeries compiled(drawn(1, 1000, 4));
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<double> points;
  for (std::size_t i = 0; i < count * compiled.dimension(); ++i)
    points.push_back(0.5 + 0.001 * static_cast<double>(i % 997));
  for (auto _ : state) benchmark::DoNotOptimize(compiled.at_each(points));
  state.counters["term_points"] = benchmark::Counter(static_cast<double>(count * compiled.size()),
                                                     benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(values)->Arg(1)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
