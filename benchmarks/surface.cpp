// SPDX-License-Identifier: MIT
// Sunlight on facets: time per facet, and error against double-double relative to area times size;
// mass properties and YORP of a mesh, per facet; ten orbits of a satellite in sunlight with each
// shadow, the error being the angle from a run at tolerance 1e-13.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/secular/yorp.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace {

using namespace polhode;

// A globe of rows and columns, its radius uneven.
shape::FacetShape globe(int rows) {
  const int columns = 2 * rows;
  std::vector<Vec3> v;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double theta = 3.141592653589793 * i / rows, phi = 3.141592653589793 * j / rows;
      const double r = 1.0 + 0.1 * std::sin(3.0 * theta) * std::cos(2.0 * phi + theta);
      v.push_back({r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi),
                   r * std::cos(theta)});
    }
  }
  std::vector<shape::FacetShape::Triangle> t;
  const auto at = [&](int i, int j) {
    const int pole = i == 0 || i == rows ? 0 : j % columns;
    return static_cast<std::uint32_t>(i * columns + pole);
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (i + 1 < rows) t.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) t.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {v, t};
}

Surface surface(const benchmark::State& state) {
  return Surface::of_shape(globe(static_cast<int>(state.range(0))), {},
                           {.specular = 0.1, .diffuse = 0.3});
}
void per_facet(benchmark::State& state, std::size_t count) {
  state.counters["facets"] = static_cast<double>(count);
  state.counters["per facet"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

void light_torque(benchmark::State& state) {
  const Surface facets = surface(state);
  const FacetStream stream(facets, light_law);
  double angle = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(stream.torque(Vec3{std::cos(angle), std::sin(angle), 0.0}));
    angle += 0.01;
  }
  using DD = DoubleDouble;
  const Vec3 e{0.48, 0.6, 0.64}, got = stream.torque(e);
  const BasicVec3<DD> exact = stream.torque(BasicVec3<DD>{DD(e.x), DD(e.y), DD(e.z)});
  const Vec3 error{(got.x - exact.x).hi, (got.y - exact.y).hi, (got.z - exact.z).hi};
  state.counters["error"] = norm(error) / 12.6;
  per_facet(state, facets.facets().size());
}

void yorp(benchmark::State& state) {
  const Surface facets = surface(state);
  for (auto _ : state) benchmark::DoNotOptimize(secular::yorp_torque(facets, 0.7));
  per_facet(state, facets.facets().size());
}

void mass(benchmark::State& state) {
  const shape::FacetShape shape = globe(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(shape::mass_properties(shape, 1.0));
  per_facet(state, shape.triangles().size());
}

System satellite(std::int64_t shadow_kind) {
  const KeplerOrbit orbit({3.986004418e14, 6.878e6, 0.0, 0.9});
  const KeplerOrbit sun({1.32712440018e20, 1.496e11, 0.0, 0.409});
  const Surface parts[] = {
      Surface::of_plate({0, 3, 0}, {1, 0, 0}, 10.0, {.specular = 0.2}, true),
      Surface::of_plate({1, 0, 0.2}, {1, 0, 0}, 4.0, {.specular = 0.1, .diffuse = 0.3})};
  std::optional<Shadow> shadow;
  if (shadow_kind == 1) shadow = Shadow::cylinder(6.378e6);
  if (shadow_kind == 2) shadow = Shadow::cone(6.378e6, 6.957e8);
  const SolarPressure term(joined(parts), {4.54e-6, 1.495978707e11}, {AnyOrbit("orbit", orbit)},
                           {AnyOrbit("sun", sun)}, shadow);
  return System(Body(900, 400, 1000), Frame::inertial(), {AnyPerturbation("light", term)});
}

// Arguments: no shadow, cylinder, cone; minus the power of ten of the tolerance.
void shadow_borders(benchmark::State& state) {
  const System system = satellite(state.range(0));
  const RotorState start{normalized(Quaternion{0.9, 0.1, 0.2, 0.3}), {0.5, 0.8, 2.0}};
  const auto run = [&](double tolerance) {
    return integrate(Problem{system, start, 0.0, 56770.0, Adaptive{.tolerance = tolerance}},
                     Keep{.dense = false});
  };
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(run(tolerance).stop());
  const Trajectory got = run(tolerance), near = run(1e-13);
  const Quaternion d = conj(near.samples().back().s.q) * got.samples().back().s.q;
  state.counters["error"] = 2.0 * norm(Vec3{d.x, d.y, d.z});
  state.counters["steps"] = static_cast<double>(got.statistics().steps);
  state.counters["repeated"] = static_cast<double>(got.statistics().rejected);
  state.counters["evaluations"] = static_cast<double>(got.statistics().evaluations);
}

}  // namespace

BENCHMARK(shadow_borders)->ArgsProduct({{0, 1, 2}, {8, 10, 12}})->Unit(benchmark::kMillisecond);
BENCHMARK(light_torque)->Arg(4)->Arg(40);
BENCHMARK(yorp)->Arg(8)->Unit(benchmark::kMicrosecond);
BENCHMARK(mass)->Arg(40)->Unit(benchmark::kMicrosecond);
