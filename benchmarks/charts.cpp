// SPDX-License-Identifier: MIT
// Every chart to the hub and back: time of one conversion, and its largest error against the same
// formulas in double-double, in units of eps (angles modulo 2 pi; |g| = 1).
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "polhode/math/double_double.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using Wide = DoubleDouble;
using WideState = BasicRotorState<Wide>;
using polhode::test::Worst;

constexpr std::size_t count = 1024;
constexpr double eps = std::numeric_limits<double>::epsilon();

const std::vector<RotorState>& states() {
  static const std::vector<RotorState> sample = [] {
    std::mt19937_64 engine(20250101);
    std::normal_distribution<double> n;
    std::vector<RotorState> s(count);
    for (RotorState& state : s) {
      const Vec3 v{n(engine), n(engine), n(engine)};
      const double size = norm(v);
      state = {normalized(Quaternion{n(engine), n(engine), n(engine), n(engine)}),
               {v.x / size, v.y / size, v.z / size}};
    }
    return s;
  }();
  return sample;
}

WideState wide(const RotorState& s) {
  return {{s.q.w, s.q.x, s.q.y, s.q.z}, {s.g.x, s.g.y, s.g.z}};
}
BasicAndoyerState<Wide> wide(const AndoyerState& a) { return {a.l, a.g, a.h, a.L, a.G, a.H}; }
BasicEulerState<Wide> wide(const EulerState& e) {
  return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
}
BasicPoincareState<Wide> wide(const PoincareState& p) {
  return {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2, p.pole_J, p.pole_I};
}

template <class T>
std::array<T, 6> numbers(const BasicAndoyerState<T>& a) {
  return {a.l, a.g, a.h, a.L, a.G, a.H};
}
template <class T>
std::array<T, 6> numbers(const BasicEulerState<T>& e) {
  return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
}
template <class T>
std::array<T, 6> numbers(const BasicPoincareState<T>& p) {
  return {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2};
}
template <class T>
std::array<T, 7> numbers(const BasicRotorState<T>& s) {
  const BasicQuaternion<T> q = normalized(s.q);
  return {q.w, q.x, q.y, q.z, s.g.x, s.g.y, s.g.z};
}

template <class A, class B>
double error(const A& value, const B& exact) {
  const auto v = numbers(value);
  const auto e = numbers(exact);
  Worst worst;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double d = (Wide(v[i]) - e[i]).hi;
    worst.add(std::abs(std::remainder(d, 2.0 * pi<double>())));
  }
  return worst.value() / eps;
}

// Runs convert over the inputs, and reports the largest difference from convert over wide inputs.
template <class Input, class Convert>
void measure(benchmark::State& state, const std::vector<Input>& inputs, Convert convert) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(convert(inputs[i]));
    i = (i + 1) % count;
  }
  Worst worst;
  for (const Input& s : inputs) worst.add(error(convert(s), convert(wide(s))));
  state.counters["max_error_eps"] = worst.value();
}

template <class Convert>
auto converted(Convert convert) {
  std::vector<decltype(convert(RotorState{}))> result;
  for (const RotorState& s : states()) result.push_back(convert(s));
  return result;
}

const auto andoyer = [](const auto& s) { return to_andoyer(s); };
const auto euler = [](const auto& s) { return to_euler(s); };
const auto poincare = [](const auto& s) { return nearest_poincare(s); };
const auto hub = [](const auto& s) { return to_rotor(s); };

void hub_to_andoyer(benchmark::State& state) { measure(state, states(), andoyer); }
void andoyer_to_hub(benchmark::State& state) { measure(state, converted(andoyer), hub); }
void hub_to_euler(benchmark::State& state) { measure(state, states(), euler); }
void euler_to_hub(benchmark::State& state) { measure(state, converted(euler), hub); }
void hub_to_poincare(benchmark::State& state) { measure(state, states(), poincare); }
void poincare_to_hub(benchmark::State& state) { measure(state, converted(poincare), hub); }

void andoyer_jacobian(benchmark::State& state) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(chart_jacobian(CanonicalChart{CanonicalSet::andoyer}, states()[i]));
    i = (i + 1) % count;
  }
}
void euler_to_poincare_jacobian(benchmark::State& state) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(canonical_transformation(
        {CanonicalSet::euler}, {CanonicalSet::poincare, Pole::zero, Pole::zero}, states()[i]));
    i = (i + 1) % count;
  }
}

BENCHMARK(hub_to_andoyer);
BENCHMARK(andoyer_to_hub);
BENCHMARK(hub_to_euler);
BENCHMARK(euler_to_hub);
BENCHMARK(hub_to_poincare);
BENCHMARK(poincare_to_hub);
BENCHMARK(andoyer_jacobian);
BENCHMARK(euler_to_poincare_jacobian);

}  // namespace
