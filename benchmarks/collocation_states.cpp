// SPDX-License-Identifier: MIT
// Collocation beside Adaptive for other states than a rotor: with a damper, with derivatives, with
// deviations, a model of its own (the table of docs/design/0035-collocation.md). The rotor, damped
// and with derivatives, is that of W1 for a hundred orbits. `error` is that of the last state, in
// rad and over |g|, of a transition matrix over its largest entry; references are Adaptive in
// double-double, where that is not slow; else Collocation of 16 stages at 1e-15.
#include <benchmark/benchmark.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "gyrostat.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/kane_damper.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Gyrostat;
using polhode::test::GyrostatState;
using polhode::test::Worst;

const double orbits = 628.3185307179586;
const Adaptive exactly{.tolerance = 1e-19, .precision = Precision::double_double};
const Collocation finely{.tolerance = 1e-15, .stages = 16};

System tumbling(std::optional<KaneDamper> damper = std::nullopt) {
  const KeplerOrbit orbit(
      {.gm = 1.0, .pericentre = pericentre_distance(1.0, 0.1), .eccentricity = 0.1});
  return System(Body(0.9, 1.0, 1.1), Frame::inertial(),
                {AnyPerturbation("gravity gradient", GravityGradient(1.0, orbit))}, damper);
}
const RotorState start{{1.0, 0.0, 0.0, 0.0}, {0.9 * 5.0, 4.0, 1.1 * 7.5}};

double apart(const Quaternion& p, const Vec3& g, const Quaternion& q, const Vec3& h) {
  const Quaternion d = conj(normalized(q)) * normalized(p);
  return 2.0 * norm(Vec3{d.x, d.y, d.z}) + norm(g - h) / norm(h);
}
double apart(const RotorState& a, const RotorState& b) { return apart(a.q, a.g, b.q, b.g); }
double apart(const GyrostatState& a, const GyrostatState& b) { return apart(a.q, a.g, b.q, b.g); }

// The end of a problem of any state.
template <class P>
auto end_of(P problem, const Method& method) {
  problem.method = method;
  const auto run = integrate(problem, {SaveAt::times({problem.stop}), false});
  return run.samples().back().s;
}

// `exact` is the end, found once for all methods.
template <class P, class S>
void run(benchmark::State& state, const P& problem, const Method& method, const S& exact) {
  auto end = end_of(problem, method);
  for (auto _ : state) end = end_of(problem, method);
  state.counters["error"] = apart(end, exact);
}

void rotor(benchmark::State& state, const Method& method) {
  const Problem problem{tumbling(), start, 0.0, orbits};
  static const auto exact = end_of(problem, exactly);
  run(state, problem, method, exact);
}
void with_a_damper(benchmark::State& state, const Method& method) {
  const Problem problem{tumbling(KaneDamper(0.3, 0.003)), start, 0.0, orbits};
  static const auto exact = end_of(problem, exactly);
  run(state, problem, method, exact);
}
void free_with_a_stiff_damper(benchmark::State& state, const Method& method) {
  const System system(Body(0.9, 1.0, 1.1), Frame::inertial(), {}, KaneDamper(0.3, 400.0));
  const Problem problem{system, start, 0.0, 100.0};
  static const auto exact = end_of(problem, finely);
  run(state, problem, method, exact);
}
void gyrostat(benchmark::State& state, const Method& method) {
  const Gyrostat satellite({1.0, 1.7, 2.2}, {0.15, -0.4, 0.9}, 0.05);
  const GyrostatState begin{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}, 0.25};
  const BasicProblem<Gyrostat> problem{satellite, begin, 0.0, 2000.0};
  static const auto exact = end_of(problem, finely);
  run(state, problem, method, exact);
}

Matrix6 transition_of(const Method& method) {
  return state_transitions({tumbling(), start, 0.0, orbits, method}, SaveAt::times({orbits}))
      .back()
      .transition;
}
void transition_matrix(benchmark::State& state, const Method& method) {
  Matrix6 found = transition_of(method);
  for (auto _ : state) found = transition_of(method);
  static const Matrix6 exact = transition_of(finely);
  Worst<> off, size;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      off.add(std::abs(found(i, j) - exact(i, j)));
      size.add(std::abs(exact(i, j)));
    }
  state.counters["error"] = off.value() / size.value();
}

void megno(benchmark::State& state, const Method& method, bool neighbour) {
  for (auto _ : state) {
    const analysis::ChaosIndicator found =
        analysis::chaos_indicator({tumbling(), start, 0.0, orbits, method}, SaveAt::times({orbits}),
                                  {.neighbour = neighbour});
    state.counters["megno"] = found.mean_megno();
  }
}

using Row = void (*)(benchmark::State&, const Method&);

const bool registered = [] {
  const std::pair<const char*, Row> rows[] = {
      {"rotor", rotor},
      {"with a damper, c/J = 0.01", with_a_damper},
      {"free with a damper, c/J = 1333", free_with_a_stiff_damper},
      {"gyrostat", gyrostat},
      {"transition matrix", transition_matrix},
      {"MEGNO, variational",
       [](benchmark::State& s, const Method& m) { return megno(s, m, false); }},
      {"MEGNO, by a neighbour",
       [](benchmark::State& s, const Method& m) { return megno(s, m, true); }}};
  const std::pair<const char*, Method> methods[] = {{"Adaptive/1e-12", Adaptive{1e-12}},
                                                    {"Adaptive/1e-14", Adaptive{1e-14}},
                                                    {"Collocation/1e-10", Collocation{1e-10}},
                                                    {"Collocation/1e-12", Collocation{1e-12}}};
  for (const auto& [what, row] : rows)
    for (const auto& [who, method] : methods)
      benchmark::RegisterBenchmark(
          (std::string(what) + "/" + who).c_str(),
          [row = row, method = method](benchmark::State& s) { row(s, method); })
          ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
