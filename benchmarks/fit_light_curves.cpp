// SPDX-License-Identifier: MIT
// Searches of a light curve of 350 points with an ellipsoid, on one thread, by the two periods of
// the truth: processor time a start, all of the search in it, beside what the best solution lacks
// in chi-square per degree of freedom; one evaluation of the residuals with their derivatives.
#include <benchmark/benchmark.h>

#include <cmath>
#include <span>
#include <vector>

#include "polhode/ensemble/draws.hpp"
#include "polhode/fit/least_squares.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/light/convex_body.hpp"

namespace {
using namespace polhode;

fit::LightModel tumbler() {
  return fit::LightModel::homogeneous(0.0, normalized(Quaternion{0.6, 0.3, -0.5, 0.2}),
                                      {0.6, 0.5, 1.0}, {1.0, 0.85, 0.5});
}

// Times of 60 units, with 2 % of noise.
std::vector<light::LightCurve> night() {
  light::LightCurve curve{.name = "night", .is_calibrated = false, .points = {}};
  for (int i = 0; i < 350; ++i)
    curve.points.push_back({0.17 * i, 1.0, 0.02, {1.0, 0.2, 0.3}, {0.8, 0.6, 0.1}});
  std::vector<light::LightCurve> curves{curve};
  const std::vector<double> flux = fit::model_fluxes(tumbler(), curves).front();
  const ensemble::CounterRandom random(1, ensemble::key_of("night"));
  for (std::size_t i = 0; i < flux.size(); ++i) {
    light::LightPoint& p = curves[0].points[i];
    p.flux = flux[i] * (1.0 + 0.02 * random.normal(i, 0));
    p.sigma = 0.02 * flux[i];
  }
  return curves;
}

void search_of_a_start(benchmark::State& state) {
  fit::LightFit fit{night(), tumbler(), {}, {}, 100};
  fit::LightSearch search;
  search.curves = fit.curves;
  search.periods = {fit::fit_light(fit).periods};
  search.starts = 100;
  fit::LightSearchResult found;
  for (auto _ : state) {
    found = fit::search_light(search);
    benchmark::DoNotOptimize(found);
  }
  const fit::LightSolution& best = found.solutions.at(0).solution;
  const double starts = static_cast<double>(search.starts);
  state.counters["s/start"] = benchmark::Counter(
      starts, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["error"] = std::abs(best.result.chi_square / best.degrees_of_freedom - 1.0);
}
BENCHMARK(search_of_a_start)->Unit(benchmark::kMillisecond);

void residuals_with_derivatives(benchmark::State& state) {
  const fit::ResidualFunction f(fit::least_squares_of({night(), tumbler(), {}, {}}));
  const std::vector<double> x = fit::light_unknowns_at({}, tumbler(), tumbler());
  std::vector<double> numbers(f.size()), jacobian(numbers.size() * x.size());
  for (auto _ : state) {
    bool has_value = f.at(x, numbers, jacobian);
    benchmark::DoNotOptimize(has_value);
  }
}
BENCHMARK(residuals_with_derivatives)->Unit(benchmark::kMicrosecond);

fit::LightFit fit_of_facets() {
  fit::LightFit fit{night(), tumbler(), {.moments = fit::MomentSource::fit}, {}, 100};
  fit.start.shape = fit::ConvexShape::of(tumbler().ellipsoid());
  return fit;
}

// The same of 512 facets that stand for patches, with 49 coefficients: 56 unknowns. Error:
// chi-square of the body that the light is of, per point.
void convex_residuals(benchmark::State& state) {
  const fit::LeastSquares problem = fit::least_squares_of(fit_of_facets());
  const fit::ResidualFunction f(problem);
  std::vector<double> x, numbers(f.size()), jacobian(f.size() * f.unknowns());
  for (const fit::Unknown& u : problem.unknowns) x.push_back(u.start);
  const std::size_t derivatives = static_cast<std::size_t>(state.range(0)) * jacobian.size();
  for (auto _ : state) {
    bool has_value = f.at(x, numbers, std::span(jacobian).first(derivatives));
    benchmark::DoNotOptimize(has_value);
  }
  double square = 0.0;
  for (std::size_t i = 0; i < f.data(); ++i) square += numbers[i] * numbers[i];
  state.counters["error"] = std::abs(square / static_cast<double>(f.data()) - 1.0);
}
BENCHMARK(convex_residuals)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

// From the ellipsoid itself to 512 facets of 49 coefficients: time a fit, beside what its
// chi-square per degree of freedom is off 1.
void convex_step(benchmark::State& state) {
  const fit::LightFit fit = fit_of_facets();
  fit::LightSolution found;
  for (auto _ : state) {
    found = fit::fit_light(fit);
    benchmark::DoNotOptimize(found);
  }
  state.counters["iterations"] = found.result.iterations;
  state.counters["error"] = std::abs(found.result.chi_square / found.degrees_of_freedom - 1.0);
}
BENCHMARK(convex_step)->Unit(benchmark::kMillisecond);

// The body of those areas as a mesh: time, beside what its area is off theirs.
void body_of_areas(benchmark::State& state) {
  const light::GaussianImage image(6, 8);
  const std::vector<double> A = image.areas(image.coefficients(tumbler().ellipsoid()));
  shape::FacetShape mesh = light::convex_body(image.normals(), A);
  for (auto _ : state) {
    mesh = light::convex_body(image.normals(), A);
    benchmark::DoNotOptimize(mesh);
  }
  double total = 0.0;
  for (const double a : A) total += a;
  state.counters["error"] = std::abs(mesh.area() / total - 1.0);
}
BENCHMARK(body_of_areas)->Unit(benchmark::kMillisecond);

}  // namespace
