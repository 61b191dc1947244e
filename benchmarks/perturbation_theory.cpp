// SPDX-License-Identifier: MIT
// Theories: Lie transforms, the normal form of the triaxial rotor by order, the nutation of a
// planet, and the mean rotation of a satellite. Counters: "terms" of the mean Hamiltonian, of the
// table or of the gravity gradient, "error" against Sadov's frequency at a triaxiality of 0.05
// (relative), of the closed form of a circular orbit (relative), or in attitude after a month
// (rad). Of Lie transforms: "terms" of the last order of mean Hamiltonian and generator, "MB" on
// the heap at most, both beside the estimates made before.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <numbers>
#include <vector>

#include "orbit/mean_ellipse.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/secular/gravity_gradient_theory.hpp"
#include "polhode/secular/lie_transform.hpp"
#include "polhode/secular/nutation.hpp"
#include "polhode/secular/triaxial_normal_form.hpp"
#include "polhode/series/series_text.hpp"

namespace {

std::atomic<std::size_t> on_heap{0}, most_on_heap{0};

}  // namespace

void* operator new(std::size_t size) {
  void* const p = std::malloc(size == 0 ? 1 : size);
  if (p == nullptr) throw std::bad_alloc();
  on_heap += malloc_usable_size(p);
  most_on_heap = std::max<std::size_t>(most_on_heap.load(), on_heap.load());
  return p;
}
void operator delete(void* p) noexcept {
  on_heap -= malloc_usable_size(p);
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept { operator delete(p); }

namespace {

using namespace polhode;

// Two or three degrees of freedom; frequencies are numbers.
template <class T>
secular::Elimination<T> coupled(int pairs, int order) {
  if (pairs == 2) {
    const series::Symbols two({"L", "G", "k"}, {"l", "g"}, {{"l", "L"}, {"g", "G"}});
    return {series::series_from_text<T>(two,
                                        "2*L + 7/5*G + k*(L^2 + L*G + G^2)*(cos(l) + cos(l - g))"
                                        " + k*G^2*cos(g)"),
            {{{"k", 1}}, order},
            {"l", "g"}};
  }
  const series::Symbols three({"L", "G", "H", "k"}, {"l", "g", "h"},
                              {{"l", "L"}, {"g", "G"}, {"h", "H"}});
  return {series::series_from_text<T>(three,
                                      "2*L + 7/5*G + 11/13*H + k*G^2 + k*(L + G + H)"
                                      "*(cos(l) + cos(g + h) + cos(l - g) + cos(2*h))"),
          {{{"k", 1}}, order},
          {"l", "g", "h"}};
}

template <class T>
void transform(benchmark::State& state, int pairs) {
  const int order = static_cast<int>(state.range(0));
  const secular::Elimination<T> problem = coupled<T>(pairs, order);
  const auto terms_of = [&](const series::Series<T>& a) {
    return static_cast<double>(series::part_of_order(a, problem.keep, order).size());
  };
  for (auto _ : state) {
    const std::size_t before = on_heap;
    most_on_heap = before;
    const secular::LieTransform<T> made(problem);
    state.counters["MB"] = static_cast<double>(most_on_heap - before) / 1e6;
    state.counters["terms"] = terms_of(made.mean_hamiltonian()) + terms_of(made.generator());
  }
  const secular::TransformSize size = secular::transform_size(problem);
  state.counters["terms_before"] = size.terms.back();
  state.counters["MB_before"] = size.bytes.back() / 1e6;
}
void transform_in_doubles(benchmark::State& state, int pairs) { transform<double>(state, pairs); }
void exact_transform(benchmark::State& state, int pairs) {
  transform<series::Rational>(state, pairs);
}
BENCHMARK_CAPTURE(transform_in_doubles, two_pairs, 2)
    ->DenseRange(2, 12, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exact_transform, two_pairs, 2)
    ->DenseRange(2, 8, 2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(transform_in_doubles, three_pairs, 3)
    ->DenseRange(2, 7)
    ->Unit(benchmark::kMillisecond);

void size_of_transform(benchmark::State& state, int pairs) {
  const secular::Elimination<double> problem =
      coupled<double>(pairs, static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(secular::transform_size(problem));
  state.counters["counted"] = secular::transform_size(problem).counted;
}
BENCHMARK_CAPTURE(size_of_transform, two_pairs, 2)
    ->Arg(8)
    ->Arg(12)
    ->Arg(30)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(size_of_transform, three_pairs, 3)
    ->Arg(4)
    ->Arg(7)
    ->Arg(12)
    ->Unit(benchmark::kMillisecond);

// With the triaxiality 0.05: a = 1, b = 1/4.
const Body body(1.0 / 1.0125, 1.0 / 0.9875, 4.0 / 3.0);

void NormalForm(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(secular::TriaxialNormalForm(body, order));
  const secular::TriaxialNormalForm form(body, order);
  const AndoyerState at{.l = 1.0, .g = 0.7, .h = 0.3, .L = std::cos(0.5), .G = 1.0, .H = 0.5};
  const FreeRotation motion(body, to_rotor(at));
  const SadovState exact = to_sadov(motion, 0.0);
  const double n = form.frequencies(exact.I_l, exact.I_g).n_l;
  state.counters["terms"] = static_cast<double>(form.series().size());
  state.counters["error"] = std::abs(n / sadov_frequencies(motion).n_l - 1.0);
}
BENCHMARK(NormalForm)->DenseRange(1, 10)->Unit(benchmark::kMillisecond);

secular::NutationProblem planet(double e, int order) {
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
  for (auto _ : state) benchmark::DoNotOptimize(secular::NutationTheory(planet(0.1, order)));
  state.counters["terms"] = static_cast<double>(
      secular::NutationTheory(planet(0.1, order)).terms(secular::PlanetAxis::figure).size());
  const double K = 1.5e-3 / 400.0;
  const secular::NutationTheory circular(planet(0.0, order));
  state.counters["error"] =
      std::abs(circular.terms(secular::PlanetAxis::momentum)[0].wave.longitude_sine /
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

  secular::GravityGradientTheory theory(int order, bool averages = true) const {
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
  const secular::GravityGradientTheory theory = of.theory(static_cast<int>(state.range(2)));
  double t = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(theory.mean(t, of.start));
    t += 1.0;
  }
}
void OsculatingState(benchmark::State& state) {
  const Satellite of(state);
  const secular::GravityGradientTheory theory = of.theory(static_cast<int>(state.range(2)));
  const secular::MeanRotation mean = theory.mean(0.0, of.start);
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
    const secular::GravityGradientTheory theory =
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
