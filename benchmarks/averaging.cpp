// SPDX-License-Identifier: MIT
// Mars by three theories on one orbit: the triaxial rotor, averaged over the rotation, averaged
// over the orbit too. Counter "apart": the largest distance (rad) at 40 times from the theory
// before. Argument: years.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/secular/planet.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;

// Days and semi-major axes; moments per C.
constexpr double day = 86400.0, year = 365.25;
constexpr double triaxiality = 2.0 * 6.3e-5 / 0.3644;  // (B - A) / 2C (Konopliv et al. 2016)

struct Mars {
  double n, spin, ellipticity, star;
  secular::OrbitHistory elements;
  secular::HistoryOrbit orbit;
  secular::SpinAxis pole;
};
Mars made() {
  const secular::PlanetSpin& of = secular::known_planet("mars");
  const double n = 2.0 * std::numbers::pi / (of.orbital_period / day), spin = of.spin_rate * day;
  const secular::OrbitHistory elements(secular::shipped_orbit("mars", year));
  return {n,
          spin,
          of.ellipticity,
          secular::star_precession(of.ellipticity, spin, n * n, 1.0),
          elements,
          secular::HistoryOrbit(elements, n * n, 1.0, 0.3),
          secular::spin_axis(secular::planet_pole(of))};
}

const Mars& mars() {
  static const Mars of = made();
  return of;
}

SaveAt times(double years) { return SaveAt::count(0.0, years * year, 41); }

template <class M>
std::vector<Vec3> axes(const M& model, double years, double step) {
  const SaveAt at = times(years);
  const Splitting method{.step = step, .scheme = SplittingScheme::order4};
  const BasicProblem<M> problem{model, mars().pole, 0.0, at[40], method};
  std::vector<Vec3> all;
  const auto run = integrate(problem, Keep{.samples = at, .dense = false});
  for (const BasicSample<secular::SpinAxis>& one : run.samples()) all.push_back(one.s.s);
  return all;
}
std::vector<Vec3> averaged(double years) {
  const Mars& of = mars();
  return axes(secular::SpinPrecession<secular::OrbitHistory>(of.elements, {.star = of.star}), years,
              500.0 * year);
}
std::vector<Vec3> without_rotation(double years) {
  const Mars& of = mars();
  return axes(secular::SpinOnOrbit(of.orbit, of.star), years, 10.0);
}
// The figure axis is along the pole at the start.
std::vector<Vec3> rotor_by(double years, const Method& method) {
  const Mars& of = mars();
  const Body body(1.0 - of.ellipticity - triaxiality, 1.0 - of.ellipticity + triaxiality, 1.0);
  const Vec3& s = of.pole.s;
  const double tilt = 0.5 * std::acos(s.z), across = std::hypot(s.x, s.y);
  const Quaternion q{std::cos(tilt), -std::sin(tilt) * s.y / across, std::sin(tilt) * s.x / across,
                     0.0};
  const System system(body, Frame::inertial(),
                      {AnyPerturbation("sun", GravityGradient(of.n * of.n, of.orbit))});
  const SaveAt at = times(years);
  const Problem problem{system, {q, {0.0, 0.0, of.spin}}, 0.0, at[40], method};
  std::vector<Vec3> all;
  const auto run = integrate(problem, Keep{.samples = at, .dense = false});
  for (const Sample& one : run.samples()) {
    const Vec3 g = rotate(one.s.q, one.s.g);
    all.push_back((1.0 / norm(g)) * g);
  }
  return all;
}

std::vector<Vec3> rotor(double years) {
  return rotor_by(years, Splitting{.step = 0.37, .scheme = SplittingScheme::order2});
}
// Several turns a step, and away from half turns.
std::vector<Vec3> rotor_in_long_steps(double years) {
  return rotor_by(years, Splitting{.step = 3.37, .scheme = SplittingScheme::order2});
}
std::vector<Vec3> rotor_by_collocation(double years) {
  return rotor_by(years, Collocation{.step = 0.6});
}

double apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  test::Worst worst;
  for (std::size_t k = 0; k < a.size(); ++k) worst.add(norm(a[k] - b[k]));
  return worst.value();
}

using Theory = std::vector<Vec3> (*)(double);

void compared(benchmark::State& state, Theory theory, Theory before) {
  const auto years = static_cast<double>(state.range(0));
  std::vector<Vec3> found;
  for (auto _ : state) found = theory(years);
  if (before != nullptr) state.counters["apart"] = apart(found, before(years));
}
#define POLHODE_YEARS Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond)
BENCHMARK_CAPTURE(compared, rotor, rotor, nullptr)->POLHODE_YEARS;
BENCHMARK_CAPTURE(compared, rotor_in_long_steps, rotor_in_long_steps, rotor)->POLHODE_YEARS;
BENCHMARK_CAPTURE(compared, rotor_by_collocation, rotor_by_collocation, rotor)->POLHODE_YEARS;
BENCHMARK_CAPTURE(compared, without_rotation, without_rotation, rotor)->POLHODE_YEARS;
BENCHMARK_CAPTURE(compared, averaged, averaged, without_rotation)->POLHODE_YEARS;

}  // namespace
