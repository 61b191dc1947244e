// SPDX-License-Identifier: MIT
// Sunlight on facets: time per facet, and error against double-double relative to area times size;
// mass properties and YORP of a mesh, per facet.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "polhode/perturb/yorp.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace {

using namespace polhode;

// A globe of rows and columns, its radius uneven.
FacetShape globe(int rows) {
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
  std::vector<FacetShape::Triangle> t;
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
  for (auto _ : state) benchmark::DoNotOptimize(yorp_torque(facets, 0.7));
  per_facet(state, facets.facets().size());
}

void mass(benchmark::State& state) {
  const FacetShape shape = globe(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(mass_properties(shape, 1.0));
  per_facet(state, shape.triangles().size());
}

}  // namespace

BENCHMARK(light_torque)->Arg(4)->Arg(40);
BENCHMARK(yorp)->Arg(8)->Unit(benchmark::kMicrosecond);
BENCHMARK(mass)->Arg(40)->Unit(benchmark::kMicrosecond);
