// SPDX-License-Identifier: MIT
// Theories: the normal form of the triaxial rotor by order, the nutation of a planet, and the mean
// rotation of a satellite. Counters: "terms" of the mean Hamiltonian, of the table or of the
// gravity gradient, "error" against Sadov's frequency at a triaxiality of 0.05 (relative), of the
// closed form of a circular orbit (relative), or in attitude after a month (rad).
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/orbit/mean_ellipse.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/secular/gravity_gradient_theory.hpp"
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

// --- a satellite that turns at 3 deg/s, 700 km above the Earth (s, kg m^2) ---

constexpr double month = 30 * 86400.0;

// Its body is axisymmetric or triaxial, its orbit has the eccentricity e.
struct Satellite {
  Body body;
  KeplerOrbit orbit;
  RotorState start;

  Satellite(bool triaxial, double e)
      : body(100.0, triaxial ? 120.0 : 100.0, 150.0),
        orbit({398600.4418, 7078.0, e, 1.2, 0.3, 0.7}),
        start(rotor_state(body, normalized(Quaternion{0.6, 0.5, -0.3, 0.4}),
                          (3.0 * std::numbers::pi / 180.0) * Vec3{0.3, 0.1, 1.0})) {}
  explicit Satellite(const benchmark::State& state)
      : Satellite(state.range(0) != 0, static_cast<double>(state.range(1)) / 100.0) {}

  GravityGradientTheory theory(int order, bool averages = true) const {
    return {body, orbit.gm(), orbit, start, 0.0, {order, averages, 1e-11}};
  }
  RotorState after_a_month(double tolerance) const {
    const System system(
        body, Frame::inertial(),
        {AnyPerturbation("gravity gradient", GravityGradient<KeplerOrbit>(orbit.gm(), orbit))});
    return integrate(Problem{system, start, 0.0, month, Adaptive{tolerance}},
                     Keep{SaveAt::times({month}), false})
        .samples()
        .back()
        .s;
  }
  double error(const RotorState& found) const {
    const Quaternion d = conj(after_a_month(1e-14).q) * found.q;
    return 2.0 * std::atan2(std::hypot(d.x, d.y, d.z), std::abs(d.w));
  }
};

// Arguments: triaxial, 100 e, order.
void MakeMeanRotation(benchmark::State& state) {
  const Satellite of(state);
  const int order = static_cast<int>(state.range(2));
  for (auto _ : state) benchmark::DoNotOptimize(of.theory(order));
  state.counters["terms"] = static_cast<double>(of.theory(order).term_count());
}
void MeanState(benchmark::State& state) {
  const Satellite of(state);
  const GravityGradientTheory theory = of.theory(static_cast<int>(state.range(2)));
  double t = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(theory.mean(t, of.start));
    t += 1.0;
  }
}
void OsculatingState(benchmark::State& state) {
  const Satellite of(state);
  const GravityGradientTheory theory = of.theory(static_cast<int>(state.range(2)));
  const MeanRotation mean = theory.mean(0.0, of.start);
  double t = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(theory.osculating(t, mean));
    t += 1.0;
  }
}
void cases(benchmark::internal::Benchmark* of) {
  of->ArgsProduct({{0, 1}, {0, 5, 30}, {1, 2}})->Unit(benchmark::kMicrosecond);
}
BENCHMARK(MakeMeanRotation)->Apply(cases)->Unit(benchmark::kMillisecond);
BENCHMARK(MeanState)->Apply(cases);
BENCHMARK(OsculatingState)->Apply(cases);

// A state after a month, the theory made and its mean elements found. Arguments: triaxial, 100 e,
// order, whether the orbit is averaged.
void MonthOfMeanRotation(benchmark::State& state) {
  const Satellite of(state);
  const auto found = [&] {
    const GravityGradientTheory theory =
        of.theory(static_cast<int>(state.range(2)), state.range(3) != 0);
    return theory.states(0.0, theory.mean(0.0, of.start), std::vector{month}, 1e-13)[0];
  };
  for (auto _ : state) benchmark::DoNotOptimize(found());
  state.counters["error"] = of.error(found());
}
BENCHMARK(MonthOfMeanRotation)
    ->ArgsProduct({{0, 1}, {0, 5}, {1, 2}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
// The same by integration, with the tolerance 10^-x.
void MonthIntegrated(benchmark::State& state) {
  const Satellite of(state);
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(2)));
  for (auto _ : state) benchmark::DoNotOptimize(of.after_a_month(tolerance));
  state.counters["error"] = of.error(of.after_a_month(tolerance));
}
BENCHMARK(MonthIntegrated)
    ->ArgsProduct({{1}, {0, 5}, {4, 6, 8, 10, 12}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
