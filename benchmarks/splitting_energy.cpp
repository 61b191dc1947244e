// SPDX-License-Identifier: MIT
// The Jacobi integral E - n G_z of a triaxial body in the gravity gradient of a circular orbit,
// by splittings and by collocation, over a million turns of the body (ten turns per orbit).
// `oscillation` is half of its range within the first thousand turns, `drift` the change of its
// mean from the first hundredth of the run to the last, both over |E|; `steps_per_turn` says how
// long a step is.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "dynamics/steppers.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::larger;
using polhode::test::smaller;

// The mean and the range of a number that is seen many times, free of its own size.
struct Seen {
  double reference = 0.0;
  double sum = 0.0, least = 0.0, largest = 0.0;
  int count = 0;
  void see(double x) {
    const double d = x - reference;
    sum += d;
    least = count == 0 ? d : smaller(least, d);
    largest = count == 0 ? d : larger(largest, d);
    ++count;
  }
  double mean() const { return sum / count; }
};

// `method` makes one of steps of a length.
template <class MethodOfStep>
void jacobi_integral(benchmark::State& run, MethodOfStep method_of, double steps_per_turn) {
  const double turns = static_cast<double>(run.range(0));
  const Body body(0.9, 1.0, 1.1);
  const System system(
      body, Frame::inertial(),
      {AnyPerturbation("gravity gradient", GravityGradient(1.0, KeplerOrbit({1.0, 1.0, 0.0})))});
  const RotorState start{{1, 0, 0, 0}, {4.5, 4.0, 8.25}};
  const auto jacobi = [&](double t, const RotorState& s) {
    return energy(system, t, s) - rotate(s.q, s.g).z;
  };
  const double turn = 2.0 * std::numbers::pi / norm(angular_velocity(body, start));
  const Method method = method_of(turn / steps_per_turn);
  const double J0 = jacobi(0.0, start), E = std::abs(energy(system, 0.0, start));
  for (auto _ : run) {
    Seen whole{J0}, first{J0}, last{J0};
    const auto stepper =
        detail::make_stepper(Problem{system, start, 0.0, turns * turn, method, {}});
    const double stop = turns * turn;
    for (int i = 0; stepper->time() != stop; ++i) {
      if (!stepper->advance(stop).empty()) break;
      const double t = stepper->time() / turn;
      const bool early = t < 1000.0, begin = t<0.01 * turns, end = t> 0.99 * turns;
      if (!((early || begin || end) && i % 7 == 0)) continue;  // 7: at all phases of the motion
      const double J = jacobi(stepper->time(), stepper->state());
      if (early) whole.see(J);
      if (begin) first.see(J);
      if (end) last.see(J);
    }
    run.counters["oscillation"] = 0.5 * (whole.largest - whole.least) / E;
    run.counters["drift"] = (last.mean() - first.mean()) / E;
    run.counters["steps_per_turn"] = steps_per_turn;
  }
}

template <SplittingScheme scheme>
constexpr auto splitting = [](double step) -> Method {
  return Splitting{step, scheme};
};
constexpr auto collocation = [](double step) -> Method { return Collocation{.step = step}; };

#define MILLION_TURNS(name, method, steps_per_turn)                \
  BENCHMARK_CAPTURE(jacobi_integral, name, method, steps_per_turn) \
      ->Arg(1000000)                                               \
      ->Iterations(1)                                              \
      ->Unit(benchmark::kSecond)
MILLION_TURNS(order2, splitting<SplittingScheme::order2>, 40.0);
MILLION_TURNS(order4, splitting<SplittingScheme::order4>, 10.0);
MILLION_TURNS(ABA864, splitting<SplittingScheme::ABA864>, 10.0);
MILLION_TURNS(ABA1064, splitting<SplittingScheme::ABA1064>, 20.0);
MILLION_TURNS(collocation, collocation, 5.0);
#undef MILLION_TURNS

}  // namespace
