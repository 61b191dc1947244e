// SPDX-License-Identifier: MIT
// Theories: the normal form of the triaxial rotor by order, and the nutation of a planet. Counters:
// "terms" of the mean Hamiltonian or of the table, "error" against Sadov's frequency at a
// triaxiality of 0.05 (relative), or of the closed form of a circular orbit (relative).
#include <benchmark/benchmark.h>

#include <cmath>

#include "polhode/free/sadov.hpp"
#include "polhode/orbit/mean_ellipse.hpp"
#include "polhode/secular/nutation.hpp"
#include "polhode/secular/triaxial_normal_form.hpp"

namespace {

using namespace polhode;

// With the triaxiality 0.05: a = 1, b = 1/4.
const Body body(1.0 / 1.0125, 1.0 / 0.9875, 4.0 / 3.0);

void NormalForm(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(TriaxialNormalForm(body, order));
  const TriaxialNormalForm form(body, order);
  const AndoyerState at{.l = 1.0, .g = 0.7, .h = 0.3, .L = std::cos(0.5), .G = 1.0, .H = 0.5};
  const FreeRotation motion(body, to_rotor(at));
  const SadovState exact = to_sadov(motion, 0.0);
  const double n = form.frequencies(exact.I_l, exact.I_g).n_l;
  state.counters["terms"] = static_cast<double>(form.series().size());
  state.counters["error"] = std::abs(n / sadov_frequencies(motion).n_l - 1.0);
}
BENCHMARK(NormalForm)->DenseRange(1, 10)->Unit(benchmark::kMillisecond);

NutationProblem planet(double e, int order) {
  return {Body(1.0 - 1e-3, 1.0 - 1e-3, 1.0),
          400.0,
          0.4,
          {{"M", 0.7, 1.0, 25}, {"Ls", 1.0, 1.0, 7}},
          {{1.0, [e](std::span<const double> x) { return on_ellipse(1.0, e, x[0], x[1] - x[0]); }}},
          {0.0, 0.0, 0.0},
          order,
          1e-14,
          0.1};
}

void Nutation(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(NutationTheory(planet(0.1, order)));
  state.counters["terms"] =
      static_cast<double>(NutationTheory(planet(0.1, order)).terms(PlanetAxis::figure).size());
  const double K = 1.5e-3 / 400.0;
  const NutationTheory circular(planet(0.0, order));
  state.counters["error"] = std::abs(circular.terms(PlanetAxis::momentum)[0].wave.longitude_sine /
                                         (-0.5 * K * std::cos(0.4)) -
                                     1.0);
}
BENCHMARK(Nutation)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

}  // namespace
