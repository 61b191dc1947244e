// SPDX-License-Identifier: MIT
// The motion of a driven body over a thousand radians at twenty times, alone and with derivatives
// by six unknowns of its state, or by two ratios of moments and a number of its torque; beside the
// time the greatest difference from columns at a tolerance of 1e-14, of a column.
#include <benchmark/benchmark.h>

#include <cmath>

#include "fit/driven/driven_motion.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using fit::detail::DrivenColumn;

fit::SpinDrive drive_of(bool flyby, double tolerance) {
  fit::SpinDrive drive;
  drive.tolerance = tolerance;
  drive.parameters = {{"number", 1e-6}};
  if (flyby) {
    drive.terms = [](std::span<const double> p) {
      const KeplerElements orbit{
          .gm = 40.0, .pericentre = 6.0, .eccentricity = 1.6, .epoch = 500.0};
      return std::vector<AnyPerturbation>{{"gravity", GravityGradient(p[0], KeplerOrbit(orbit))}};
    };
  } else {
    drive.terms = [](std::span<const double> p) {
      return std::vector<AnyPerturbation>{{"torque", ConstantTorque::in_space({p[0], 0.0, 0.0})}};
    };
  }
  return drive;
}

std::vector<DrivenColumn> columns_of(int which) {
  using enum fit::detail::DrivenColumn::Of;
  if (which == 0) return {};
  if (which == 2) return {{ratio, 0, {}}, {ratio, 1, {}}, {torque, 0, {}}};
  std::vector<DrivenColumn> found;
  for (const Vec3& e : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    found.push_back({turn, 0, e});
    found.push_back({rate, 0, e});
  }
  return found;
}

std::vector<fit::detail::MovedPoint> points_of(const fit::SpinDrive& drive, int which) {
  fit::SpinState start{0.0, {0.5, 0.1, -0.7, 0.5}, {0.3, 0.2, 0.9}, Mat3::identity()};
  start.inertia_F(0, 0) = 0.6;
  start.inertia_F(1, 1) = 0.8;
  std::vector<double> times;
  for (int i = 1; i <= 20; ++i) times.push_back(50.0 * i);
  const std::vector<double> parameters{1e-6};
  const fit::detail::DrivenMotion motion(drive, start, parameters, {});
  return motion.at(times, columns_of(which)).value();
}

// Arguments: flyby; 0 the motion alone, 1 columns of the state, 2 those of moments and torque.
void driven_motion(benchmark::State& state) {
  const bool flyby = state.range(0) != 0;
  const int which = static_cast<int>(state.range(1));
  const fit::SpinDrive drive = drive_of(flyby, 1e-12);
  std::vector<fit::detail::MovedPoint> points;
  for (auto _ : state) {
    points = points_of(drive, which);
    benchmark::DoNotOptimize(points);
  }
  const std::vector<fit::detail::MovedPoint> exact = points_of(drive_of(flyby, 1e-14), which);
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    worst = test::larger(worst, norm(fit::attitude_residual(points[i].q, exact[i].q)));
    for (std::size_t c = 0; c < points[i].turn.size(); ++c) {
      worst = test::larger(worst, norm(points[i].turn[c] - exact[i].turn[c]) /
                                      (norm(exact[i].turn[c]) + norm(exact[i].rate[c])));
    }
  }
  state.counters["error"] = worst;
}
BENCHMARK(driven_motion)->ArgsProduct({{0, 1}, {0, 1, 2}})->Unit(benchmark::kMillisecond);

}  // namespace
