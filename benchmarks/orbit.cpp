// SPDX-License-Identifier: MIT
// Positions on orbits, and the torque that they make: time per call, and error against
// double-double.
//
// Times advance by a fixed step, as in an integrator; error is the largest over 4096 of them,
// relative to the distance. Tables hold 400 rows a turn of e = 0.3; their error is that against the
// ellipse itself, and their times follow no order.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::larger;
using polhode::test::Worst;

constexpr double step = 0.0371;

// Argument: e in hundredths.
KeplerElements elements(const benchmark::State& state) {
  const double e = static_cast<double>(state.range(0)) / 100.0;
  return {1.0, std::abs(1.0 - e), e, 0.3, 1.0, 2.0, 0.1, 0.0};
}

template <class O>
double largest_error(const O& orbit) {
  Worst worst;
  for (int i = 0; i < 4096; ++i) {
    const double t = 0.1 + step * i;
    const Vec3 x = orbit.position(t);
    const BasicVec3<DoubleDouble> exact = orbit.position(DoubleDouble(t));
    const Vec3 error{(x.x - exact.x).hi, (x.y - exact.y).hi, (x.z - exact.z).hi};
    worst.add(norm(error) / norm(x));
  }
  return worst.value();
}

template <class O>
void positions(benchmark::State& state, const O& orbit) {
  double t = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(orbit.position(t));
    t += step;
  }
  state.counters["error"] = largest_error(orbit);
}

void kepler_position(benchmark::State& state) { positions(state, KeplerOrbit(elements(state))); }
void precessing_position(benchmark::State& state) {
  positions(state, PrecessingKeplerOrbit(elements(state), {0.01, 0.02, 0.003}));
}

// Each time waits for the last position, as in an integrator: two more operations in the chain.
void kepler_position_latency(benchmark::State& state) {
  const KeplerOrbit orbit(elements(state));
  double t = 0.1, next = t + step;
  for (auto _ : state) {
    t = next + 1e-300 * orbit.position(t).x;
    next = t + step;
  }
  benchmark::DoNotOptimize(t);
}

void kepler_velocity(benchmark::State& state) {
  const KeplerOrbit orbit(elements(state));
  double t = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(orbit.velocity(t));
    t += step;
  }
}

void kepler_double_double(benchmark::State& state) {
  const KeplerOrbit orbit(elements(state));
  double t = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(orbit.position(DoubleDouble(t)));
    t += step;
  }
}

void kepler_constructor(benchmark::State& state) {
  for (auto _ : state) {
    const KeplerOrbit orbit(elements(state));
    benchmark::DoNotOptimize(&orbit);
  }
}

// Arguments: with velocities; evenly spaced; rows.
void table_position(benchmark::State& state) {
  const KeplerOrbit orbit({1.0, 0.7, 0.3, 0.3, 1.0, 2.0, 0.1, 0.0});
  const double spacing = 2.0 * std::numbers::pi / 400.0;
  PositionTable rows;
  for (std::int64_t k = 0; k < state.range(2); ++k) {
    const double shift = state.range(1) != 0 ? 0.0 : 0.3 * std::sin(static_cast<double>(k));
    rows.times.push_back(spacing * (static_cast<double>(k) + shift));
    rows.positions.push_back(orbit.position(rows.times.back()));
    if (state.range(0) != 0) rows.velocities.push_back(orbit.velocity(rows.times.back()));
  }
  const TableOrbit table(rows);
  // from place to place, so that rows are not at hand because their neighbours were
  const double span = table.last_time() - table.first_time();
  const auto time = [&](double turn) {
    return table.first_time() + span * (turn - std::floor(turn));
  };
  double turn = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(table.position(time(turn)));
    turn += std::numbers::phi;
  }
  Worst worst;
  for (int i = 0; i < 4096; ++i) {
    const double t = time(std::numbers::phi * i);
    const Vec3 x = orbit.position(t);
    worst.add(norm(table.position(t) - x) / norm(x));
  }
  state.counters["error"] = worst.value();
}

// The error is that against the angle formed and reduced in double-double.
void uniform_angle(benchmark::State& state) {
  const UniformAngle angle(0.3, 0.977, 0.1);
  double t = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(angle.at(t));
    t += step;
  }
  Worst worst;
  for (int i = 0; i < 4096; ++i) {
    const double at = 0.1 + step * i;
    const SinCos<DoubleDouble> exact = angle.at(DoubleDouble(at));
    const SinCos<double> got = angle.at(at);
    worst.add(larger(std::fabs((got.sin - exact.sin).hi), std::fabs((got.cos - exact.cos).hi)));
  }
  state.counters["error"] = worst.value();
}

void gravity_gradient(benchmark::State& state) {
  const AnyPerturbation term("planet", GravityGradient(1.0, KeplerOrbit(elements(state))));
  const Body body(1.0, 2.0, 2.5);
  Setting at{body, 0.1, {{0.5, 0.5, 0.5, 0.5}, {0.1, 0.2, 1.0}}, {}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(term.effect(at));
    at.t += step;
  }
}

BENCHMARK(kepler_position)->Arg(0)->Arg(10)->Arg(50)->Arg(70)->Arg(99)->Arg(150);
BENCHMARK(kepler_position_latency)->Arg(0)->Arg(10)->Arg(50)->Arg(70);
BENCHMARK(kepler_velocity)->Arg(10)->Arg(70)->Arg(150);
BENCHMARK(kepler_double_double)->Arg(10)->Arg(150);
BENCHMARK(kepler_constructor)->Arg(10)->Arg(70);
BENCHMARK(precessing_position)->Arg(10)->Arg(70);
BENCHMARK(table_position)->ArgsProduct({{0, 1}, {1, 0}, {4000, 400000}});
BENCHMARK(uniform_angle);
BENCHMARK(gravity_gradient)->Arg(10)->Arg(70);

}  // namespace
