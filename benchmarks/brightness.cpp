// SPDX-License-Identifier: MIT
// Brightness: time per point of a light curve, with its error relative to the brightness: of the
// closed form against double-double, of quadrature against 64^2 points, of facets and meshes of an
// ellipsoid against the ellipsoid.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "polhode/light/convex_body.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "unit/light/meshes.hpp"

namespace {

using namespace polhode;

const light::Ellipsoid body{2.0, 1.5, 1.0};
constexpr Vec3 sun{1.0, 2.0, -0.5};

Vec3 observer(int i) { return {1.5, 1.0 + 0.01 * (i % 64), 0.5}; }

template <class F>
void each_point(benchmark::State& state, const F& f) {
  int i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(f(observer(++i)));
}

void ellipsoid_value(benchmark::State& state) {
  each_point(state, [](const Vec3& o) { return light::lommel_seeliger_brightness(body, sun, o); });
  using DD = DoubleDouble;
  const Vec3 o = observer(7);
  const DD exact = light::lommel_seeliger_brightness(
      light::BasicEllipsoid<DD>{DD(body.a), DD(body.b), DD(body.c)},
      BasicVec3<DD>{DD(sun.x), DD(sun.y), DD(sun.z)}, BasicVec3<DD>{DD(o.x), DD(o.y), DD(o.z)});
  state.counters["error"] =
      std::fabs(light::lommel_seeliger_brightness(body, sun, o) / exact.hi - 1.0);
}
void ellipsoid_gradient(benchmark::State& state) {
  each_point(state, [](const Vec3& o) { return light::lommel_seeliger_gradient(body, sun, o); });
}
void ellipsoid_dual(benchmark::State& state) {
  using D = Dual<double, 9>;
  each_point(state, [](const Vec3& o) {
    return light::lommel_seeliger_brightness(
        light::BasicEllipsoid<D>{D::variable(body.a, 0), D::variable(body.b, 1),
                                 D::variable(body.c, 2)},
        BasicVec3<D>{D::variable(sun.x, 3), D::variable(sun.y, 4), D::variable(sun.z, 5)},
        BasicVec3<D>{D::variable(o.x, 6), D::variable(o.y, 7), D::variable(o.z, 8)});
  });
}

template <int points>
void lambert_value(benchmark::State& state) {
  each_point(state, [](const Vec3& o) { return light::lambert_brightness<points>(body, sun, o); });
  const Vec3 o = observer(7);
  state.counters["error"] = std::fabs(light::lambert_brightness<points>(body, sun, o) /
                                          light::lambert_brightness<64>(body, sun, o) -
                                      1.0);
}
template <int points>
void lambert_with_gradient(benchmark::State& state) {
  each_point(state, [](const Vec3& o) { return light::lambert_gradient<points>(body, sun, o); });
}

// Arguments: degree, rows.
void facets_with_gradient(benchmark::State& state) {
  const light::GaussianImage image(static_cast<int>(state.range(0)),
                                   static_cast<int>(state.range(1)));
  const std::vector<double> A = image.areas(image.coefficients(body));
  const light::Scattering law = light::Scattering::mixed(0.1);
  each_point(state, [&](const Vec3& o) {
    return image.by_coefficients(light::facet_gradient(image.normals(), A, law, sun, o).by_areas,
                                 A);
  });
  const Vec3 o = observer(7);
  state.counters["error"] = std::fabs(light::facet_gradient(image.normals(), A, law, sun, o).value /
                                          light::brightness<64>(body, law, sun, o) -
                                      1.0);
  state.counters["facets"] = static_cast<double>(A.size());
}

// The same of facets that stand for patches, as fits have them.
void patches_with_gradient(benchmark::State& state) {
  const light::GaussianImage image(static_cast<int>(state.range(0)),
                                   static_cast<int>(state.range(1)));
  const std::vector<double> A = image.areas(image.coefficients(body));
  const light::Scattering law = light::Scattering::mixed(0.1);
  const auto gradient = [&](const Vec3& o) {
    return light::patch_gradient(image.normals(), image.widths(), A, law, sun, o);
  };
  each_point(state, [&](const Vec3& o) { return image.by_coefficients(gradient(o).by_areas, A); });
  const Vec3 o = observer(7);
  state.counters["error"] =
      std::fabs(gradient(o).value / light::brightness<64>(body, law, sun, o) - 1.0);
  state.counters["facets"] = static_cast<double>(A.size());
}

shape::FacetShape mesh(int rows, double bumps) {
  return test::globe(rows, [bumps](const Vec3& n) {
    const double r = 1.0 + bumps * std::sin(6.0 * n.x) * std::cos(5.0 * n.y);
    return Vec3{r * body.a * n.x, r * body.b * n.y, r * body.c * n.z};
  });
}
// Arguments: rows, bumps in hundredths.
void mesh_value(benchmark::State& state) {
  const light::ShadedMesh shaded(
      mesh(static_cast<int>(state.range(0)), 0.01 * static_cast<double>(state.range(1))));
  const light::Scattering law = light::Scattering::mixed(0.1);
  each_point(state, [&](const Vec3& o) { return shaded.brightness(law, sun, o); });
  const Vec3 o = observer(7);
  if (state.range(1) == 0)
    state.counters["error"] =
        std::fabs(shaded.brightness(law, sun, o) / light::brightness<64>(body, law, sun, o) - 1.0);
  state.counters["facets"] = static_cast<double>(shaded.shape().facets().size());
}
void mesh_made(benchmark::State& state) {
  const shape::FacetShape shape = mesh(static_cast<int>(state.range(0)), 0.1);
  for (auto _ : state) benchmark::DoNotOptimize(light::ShadedMesh(shape));
  state.counters["facets"] = static_cast<double>(shape.facets().size());
}

}  // namespace

BENCHMARK(ellipsoid_value);
BENCHMARK(ellipsoid_gradient);
BENCHMARK(ellipsoid_dual);
BENCHMARK(lambert_value<8>);
BENCHMARK(lambert_value<16>);
BENCHMARK(lambert_value<32>);
BENCHMARK(lambert_with_gradient<16>);
BENCHMARK(facets_with_gradient)->Args({6, 12})->Unit(benchmark::kMicrosecond);
BENCHMARK(patches_with_gradient)->Args({6, 8})->Args({6, 12})->Unit(benchmark::kMicrosecond);
BENCHMARK(mesh_value)->ArgsProduct({{24}, {0, 10}})->Unit(benchmark::kMicrosecond);
BENCHMARK(mesh_made)->Arg(24)->Unit(benchmark::kMillisecond);
