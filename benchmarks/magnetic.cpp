// SPDX-License-Identifier: MIT
// The field of a tilted dipole where a satellite is, without and with its rate: time per call, that
// of the orbit in it. The error is that against double-double, relative to the length of the
// result.
#include <benchmark/benchmark.h>

#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/magnetic_field.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

constexpr double step = 0.0371;

using Field = FieldAlongOrbit<KeplerOrbit, DipoleField>;
// e = 0.01, the dipole of the Earth, which turns 7 times in 100 revolutions.
Field field() {
  return {KeplerOrbit({1.0, 1.0, 0.01, 1.7, 1.0, 2.0, 0.1, 0.0}),
          DipoleField::from_gauss({-29.4, -1.5, 4.8}, 0.9, {.rate = 0.07})};
}

Vec3 near(const BasicVec3<DoubleDouble>& x) { return {x.x.hi, x.y.hi, x.z.hi}; }

void orbit_alone(benchmark::State& state) {
  const Field local = field();
  double t = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(local.orbit().position(t));
    t += step;
  }
}

// `of(t, rest)` in double and in double-double.
template <class Of>
void measured(benchmark::State& state, const Of& of) {
  double t = 0.1;
  Worst worst;
  for (auto _ : state) {
    benchmark::DoNotOptimize(of(t, 0.0));
    t += step;
  }
  for (int i = 0; i < 4096; ++i) {
    const double at = 0.1 + step * i;
    const Vec3 got = of(at, 0.0);
    const BasicVec3<DoubleDouble> wide{got.x, got.y, got.z};
    worst.add(norm(near(wide - of(DoubleDouble(at), DoubleDouble()))) / norm(got));
  }
  state.counters["error"] = worst.value();
}

void dipole(benchmark::State& state) {
  measured(state, [local = field()](auto t, auto rest) { return local.field(t, rest); });
}
void dipole_rate(benchmark::State& state) {
  measured(state, [local = field()](auto t, auto rest) { return local.motion(t, rest).rate; });
}

BENCHMARK(orbit_alone);
BENCHMARK(dipole);
BENCHMARK(dipole_rate);

}  // namespace
