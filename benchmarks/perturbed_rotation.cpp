// SPDX-License-Identifier: MIT
// W1, a thousand orbits of a tumbling body under the gravity gradient (moments 0.9, 1, 1.1; e =
// 0.1; 9.9 turns an orbit): CPU seconds next to `error`, the angle (rad) from the end of an 80-bit
// Taylor integration, for every method; and Boost.Odeint on the state (q, omega, position,
// velocity). One run each: what spreads is the error of neighbouring tolerances.
#include <benchmark/benchmark.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::smaller;

constexpr double stop = 6283.185307179586;
// From the very doubles of `run`: 1.1 * 7.5 is rounded, which alone turns the end by 1e-11 rad.
const Quaternion end_q{-0.945141005523173718, 0.146971342463893511, -0.006995745105534269,
                       -0.291648699162920035};

double error_of(const Quaternion& q) {
  const Quaternion d = conj(end_q) * normalized(q);
  return 2.0 * std::asin(smaller(1.0, norm(Vec3{d.x, d.y, d.z})));
}

void run(benchmark::State& state, const Method& method) {
  const KeplerOrbit orbit(
      {.gm = 1.0, .pericentre = pericentre_distance(1.0, 0.1), .eccentricity = 0.1});
  const Problem problem{System(Body(0.9, 1.0, 1.1), Frame::inertial(),
                               {AnyPerturbation("gravity gradient", GravityGradient(1.0, orbit))}),
                        {{1.0, 0.0, 0.0, 0.0}, {0.9 * 5.0, 4.0, 1.1 * 7.5}},
                        0.0,
                        stop,
                        method};
  for (auto _ : state) {
    RotorState end = problem.initial;
    const Trajectory t = integrate(problem, SaveAt::times({stop}),
                                   [&](std::span<const Sample> rows) { end = rows.back().s; });
    if (!t.outcome().ok()) state.SkipWithError(t.outcome().advice.c_str());
    state.counters["error"] = error_of(end.q);
    state.counters["steps"] = static_cast<double>(t.statistics().steps);
    state.counters["evaluations"] = static_cast<double>(t.statistics().evaluations);
  }
}

// q, omega, position and velocity of the orbit in its plane.
using Eleven = std::array<double, 11>;

std::int64_t calls = 0;

void eleven_rates(const Eleven& y, Eleven& r, double) {
  ++calls;
  const Quaternion q{y[0], y[1], y[2], y[3]};
  const Vec3 w{y[4], y[5], y[6]}, I{0.9, 1.0, 1.1};
  const Quaternion dq = q * Quaternion{0.0, 0.5 * w.x, 0.5 * w.y, 0.5 * w.z};
  const double r2 = y[7] * y[7] + y[8] * y[8], ir2 = 1.0 / r2, ir3 = ir2 * std::sqrt(ir2);
  const Vec3 n = rotate(conj(q), Vec3{y[7], y[8], 0.0});
  const double k = 3.0 * ir2 * ir3;
  r = {dq.w,
       dq.x,
       dq.y,
       dq.z,
       ((I.y - I.z) * (w.y * w.z - k * n.y * n.z)) / I.x,
       ((I.z - I.x) * (w.z * w.x - k * n.z * n.x)) / I.y,
       ((I.x - I.y) * (w.x * w.y - k * n.x * n.y)) / I.z,
       y[9],
       y[10],
       -ir3 * y[7],
       -ir3 * y[8]};
}

template <class Stepper>
void run_odeint(benchmark::State& state, Stepper stepper) {
  for (auto _ : state) {
    Eleven y{1.0, 0.0, 0.0, 0.0, 5.0, 4.0, 7.5, 0.9, 0.0, 0.0, std::sqrt(1.1 / 0.9)};
    calls = 0;
    const std::size_t steps =
        boost::numeric::odeint::integrate_adaptive(stepper, eleven_rates, y, 0.0, stop, 0.01);
    state.counters["error"] = error_of({y[0], y[1], y[2], y[3]});
    state.counters["steps"] = static_cast<double>(steps);
    state.counters["evaluations"] = static_cast<double>(calls);
  }
}

struct Row {
  std::string name;
  Method method;
};

std::vector<Row> rows() {
  std::vector<Row> list;
  const auto adaptive = [&](const std::string& tolerance) {
    list.push_back({"Adaptive/" + tolerance, Adaptive{std::stod(tolerance)}});
  };
  for (const char* t : {"1e-10", "1e-11", "1e-12", "1e-13", "1e-14", "3e-15", "1e-15"}) adaptive(t);
  // The floor of rounding: eight fixed steps.
  for (const double h : {0.0104, 0.0107, 0.011, 0.0113, 0.0116, 0.0119, 0.0122, 0.0125})
    list.push_back({"Adaptive fixed step/" + std::to_string(h).substr(0, 6),
                    Adaptive{1e-2, Precision::compensated, h, h}});
  list.push_back({"Adaptive double-double/1e-19", Adaptive{1e-19, Precision::double_double}});
  for (const char* t : {"1e-10", "1e-11", "1e-12", "1e-13", "1e-14", "1e-15"})
    list.push_back({"VariationOfConstants/" + std::string(t), VariationOfConstants{std::stod(t)}});
  for (const char* t : {"1e-8", "1e-9", "1e-10", "1e-11", "1e-12", "1e-13", "1e-14"})
    list.push_back({"Collocation/" + std::string(t), Collocation{std::stod(t)}});
  const std::vector<std::pair<std::string, SplittingScheme>> schemes{
      {"order2", SplittingScheme::order2}, {"order4", SplittingScheme::order4},
      {"order6", SplittingScheme::order6}, {"order8", SplittingScheme::order8},
      {"ABA864", SplittingScheme::ABA864}, {"ABA1064", SplittingScheme::ABA1064}};
  for (const auto& [name, scheme] : schemes)
    for (const double h : {0.1, 0.05, 0.025})
      list.push_back(
          {"Splitting " + name + "/" + std::to_string(h).substr(0, 5), Splitting{h, scheme}});
  return list;
}

// Odeint copies arrays before they are filled; clang does not mind, and does not know the name.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

const bool registered = [] {
  const auto once = [](benchmark::internal::Benchmark* b) {
    b->Iterations(1)->Unit(benchmark::kSecond);
  };
  for (const Row& row : rows())
    once(benchmark::RegisterBenchmark(
        ("W1/" + row.name).c_str(),
        [method = row.method](benchmark::State& s) { run(s, method); }));
  namespace oi = boost::numeric::odeint;
  for (const std::string t : {"1e-9", "1e-11", "1e-13"}) {
    const double tolerance = std::stod(t);
    once(benchmark::RegisterBenchmark(
        ("W1/Boost.Odeint RKF78/" + t).c_str(), [tolerance](benchmark::State& s) {
          run_odeint(
              s, oi::make_controlled(tolerance, tolerance, oi::runge_kutta_fehlberg78<Eleven>()));
        }));
    once(benchmark::RegisterBenchmark(
        ("W1/Boost.Odeint Bulirsch-Stoer/" + t).c_str(), [tolerance](benchmark::State& s) {
          run_odeint(s, oi::bulirsch_stoer<Eleven>(tolerance, tolerance));
        }));
  }
  return true;
}();

}  // namespace
