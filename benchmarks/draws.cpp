// SPDX-License-Identifier: MIT
// Numbers drawn for the members of an ensemble: time per draw, one member after the other, and the
// error beside 50 digits at the same uniform numbers. Beside them Boost's quantile of the normal
// distribution, and the generator and distributions of the standard library, which go from number
// to number and have no member of their own.
//
// error: of one number the largest in ulp; of truncated normal ones in eps of max(1, |z|); of
// directions and attitudes that of their length in eps; of several normal numbers that of the
// covariance in eps of its correlations, by F F^T.
#include "polhode/ensemble/draws.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::larger;
using polhode::test::Worst;
namespace bm = boost::math;
using Exact = boost::multiprecision::cpp_bin_float_50;
// double computed in double; the default computes in long double.
using NoPromotion = bm::policies::policy<bm::policies::promote_double<false>>;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr std::uint64_t seed = 18, checked = 4096;

double ulps(double got, const Exact& want) {
  const double size = std::abs(static_cast<double>(want));
  const double ulp = std::nextafter(size, 2.0 * size) - size;
  return static_cast<double>(Exact(abs(Exact(got) - want) / ulp));
}
Exact exact_quantile(const Exact& u) { return -sqrt(Exact(2)) * bm::erfc_inv(Exact(2 * u)); }

// Times call(member) for one member after the other.
template <class Call>
void each_member(benchmark::State& state, const Call& call, double numbers = 1.0) {
  std::uint64_t member = 0;
  for (auto _ : state) benchmark::DoNotOptimize(call(member++));
  state.counters["time/number"] = benchmark::Counter(
      numbers, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

const ensemble::CounterRandom& random_numbers() {
  static const ensemble::CounterRandom random(seed, ensemble::key_of("x"));
  return random;
}

void uniform(benchmark::State& state) {
  each_member(state, [](std::uint64_t m) { return random_numbers().uniform(m, 0); });
}

// As many at a time as the argument says.
void uniforms(benchmark::State& state) {
  std::vector<double> u(static_cast<std::size_t>(state.range(0)));
  each_member(
      state,
      [&](std::uint64_t m) {
        random_numbers().uniforms(m, u);
        return u.back();
      },
      static_cast<double>(u.size()));
}

void uniform_of_mt19937_64(benchmark::State& state) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> of;
  each_member(state, [&](std::uint64_t) { return of(engine); });
}

void normal_of_mt19937_64(benchmark::State& state) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> of;
  each_member(state, [&](std::uint64_t) { return of(engine); });
}

// Of uniform numbers that lie there.
template <class Quantile>
void quantile(benchmark::State& state, const Quantile& of) {
  std::vector<double> u(checked);
  for (std::uint64_t m = 0; m < checked; ++m) u[m] = random_numbers().uniform(m, 0);
  each_member(state, [&](std::uint64_t m) { return of(u[m % checked]); });
  for (int e = 3; e <= 53; ++e) u.push_back(std::ldexp(1.3, -e));
  Worst<> worst;
  for (const double one : u) worst.add(ulps(of(one), exact_quantile(one)));
  state.counters["error"] = worst.value();
}
void quantile_polhode(benchmark::State& state) {
  quantile(state, [](double u) { return ensemble::normal_quantile(u); });
}
void quantile_boost(benchmark::State& state) {
  quantile(state, [](double u) { return -std::sqrt(2.0) * bm::erfc_inv(2.0 * u, NoPromotion()); });
}
void quantile_boost_in_long_double(benchmark::State& state) {
  quantile(state, [](double u) { return -std::sqrt(2.0) * bm::erfc_inv(2.0 * u); });
}

// What the driver of an ensemble asks for: the numbers of a member and a key.
ensemble::Draws draws_of(const ensemble::Distribution& distribution,
                         const benchmark::State& state) {
  const ensemble::DrawSource source =
      state.range(0) == 0 ? ensemble::DrawSource::random : ensemble::DrawSource::sobol;
  return {{{"x", distribution}}, seed, source};
}

template <class Error>
void draws(benchmark::State& state, const ensemble::Distribution& distribution,
           const Error& error) {
  const ensemble::Draws of = draws_of(distribution, state);
  std::vector<double> x(ensemble::numbers_of(distribution));
  each_member(
      state,
      [&](std::uint64_t m) {
        of.values(m, 0, x);
        return x[0];
      },
      static_cast<double>(x.size()));
  Worst<> worst;
  for (std::uint64_t m = 0; m < checked; ++m) {
    of.values(m, 0, x);
    worst.add(error(m, x));
  }
  state.counters["error"] = worst.value();
  state.SetLabel(state.range(0) == 0 ? "random" : "Sobol");
}

// The uniform number of a member, whichever the source: what Uniform on (0, 1) draws, rounded once.
double uniform_of(const benchmark::State& state, std::uint64_t member) {
  if (state.range(0) == 0) return random_numbers().uniform(member, 0);
  static const ensemble::SobolPoints points(1);
  return ensemble::open_uniform(points.bits(member, 0) ^ random_numbers().shared_bits(0));
}

void draws_uniform(benchmark::State& state) {
  draws(state, ensemble::Uniform(1.0, 3.0), [&](std::uint64_t m, const std::vector<double>& x) {
    return ulps(x[0], Exact(2) * uniform_of(state, m) + 1);
  });
}
void draws_log_uniform(benchmark::State& state) {
  draws(state, ensemble::LogUniform(0.5, 8.0), [&](std::uint64_t m, const std::vector<double>& x) {
    return ulps(x[0], Exact(0.5) * pow(Exact(16), Exact(uniform_of(state, m))));
  });
}
void draws_normal(benchmark::State& state) {
  draws(state, ensemble::Normal(0.0, 1.0), [&](std::uint64_t m, const std::vector<double>& x) {
    return ulps(x[0], exact_quantile(uniform_of(state, m)));
  });
}
void draws_truncated_normal(benchmark::State& state) {
  const auto below = [](double z) { return Exact(bm::erfc(Exact(-z / sqrt(Exact(2)))) / 2); };
  const Exact from = below(-1.0), all = below(3.0) - from;
  draws(state, ensemble::TruncatedNormal(0.0, 1.0, -1.0, 3.0),
        [&](std::uint64_t m, const std::vector<double>& x) {
          const Exact want = exact_quantile(from + all * uniform_of(state, m));
          const double size = larger(1.0, std::abs(static_cast<double>(want)));
          return static_cast<double>(Exact(abs(x[0] - want))) / (size * eps);
        });
}
void draws_direction(benchmark::State& state) {
  draws(state, ensemble::IsotropicDirection{}, [](std::uint64_t, const std::vector<double>& x) {
    return std::abs(std::hypot(x[0], x[1], x[2]) - 1.0) / eps;
  });
}
void draws_attitude(benchmark::State& state) {
  draws(state, ensemble::UniformAttitude{}, [](std::uint64_t, const std::vector<double>& q) {
    return std::abs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1.0) / eps;
  });
}

// Second argument: how many numbers. Their covariance is 1 / (1 + |i - j|).
void draws_joint_normal(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(1));
  std::vector<double> c(n * n), found(n * n), x(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      c[i * n + j] = 1.0 / (1.0 + std::abs(static_cast<double>(i) - static_cast<double>(j)));
  const ensemble::JointNormal of(std::vector<double>(n), c);
  const double z = ensemble::normal_quantile(0.3);
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> u(n, 0.5);
    u[k] = 0.3;
    of.from_uniform(u, x);
    for (std::size_t i = 0; i < n * n; ++i) found[i] += x[i / n] * x[i % n] / (z * z);
  }
  Worst<> worst;
  for (std::size_t i = 0; i < n * n; ++i) worst.add(std::abs(found[i] - c[i]) / eps);
  draws(state, of, [&](std::uint64_t, const std::vector<double>&) { return worst.value(); });
}

// One number of Sobol's points, the members counted from that of the argument on.
void sobol_point(benchmark::State& state) {
  const ensemble::SobolPoints points(8);
  const auto first = static_cast<std::uint64_t>(state.range(0));
  each_member(state,
              [&](std::uint64_t m) { return ensemble::open_uniform(points.bits(first + m, 7)); });
}

void random_and_sobol(benchmark::internal::Benchmark* of) { of->Arg(0)->Arg(1); }

}  // namespace

BENCHMARK(uniform);
BENCHMARK(uniforms)->Arg(1)->Arg(4)->Arg(64);
BENCHMARK(uniform_of_mt19937_64);
BENCHMARK(quantile_polhode);
BENCHMARK(quantile_boost);
BENCHMARK(quantile_boost_in_long_double);
BENCHMARK(normal_of_mt19937_64);
BENCHMARK(sobol_point)->Arg(0)->Arg(1'000'000)->Arg(1LL << 40);
BENCHMARK(draws_uniform)->Apply(random_and_sobol);
BENCHMARK(draws_log_uniform)->Apply(random_and_sobol);
BENCHMARK(draws_normal)->Apply(random_and_sobol);
BENCHMARK(draws_truncated_normal)->Apply(random_and_sobol);
BENCHMARK(draws_direction)->Apply(random_and_sobol);
BENCHMARK(draws_attitude)->Apply(random_and_sobol);
BENCHMARK(draws_joint_normal)->Args({0, 3})->Args({0, 8})->Args({1, 3})->Args({1, 8});
