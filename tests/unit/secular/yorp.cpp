// SPDX-License-Identifier: MIT
// YORP: quadrature over attitudes, the series in Legendre's polynomials, and what symmetry says.
#include "polhode/secular/yorp.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "unit/perturb/support.hpp"
#include "unit/perturb/surfaces.hpp"
#include "unit/shape/solids.hpp"

namespace secular_test {
namespace {

using namespace perturb_test;

using namespace polhode;

constexpr double pi = std::numbers::pi;

// Averages by brute force, over turns and over the true anomaly.
secular::YorpTorque brute_force(const Surface& surface, double o, int turns, int years) {
  const FacetStream light(surface, light_law);
  secular::YorpTorque sum{};
  for (int j = 0; j < years; ++j) {
    const double f = 2.0 * pi * (j + 0.5) / years;
    const Vec3 sun{std::cos(f), std::sin(f) * std::cos(o), std::sin(f) * std::sin(o)};
    for (int i = 0; i < turns; ++i) {
      const Quaternion q = rotation_z(2.0 * pi * (i + 0.5) / turns);
      const Vec3 u = rotate(q, light.torque(rotate(conj(q), sun)));
      sum = {sum.spin + u.z, sum.obliquity + u.y, sum.precession + u.x};
    }
  }
  const double n = static_cast<double>(turns) * years;
  return {sum.spin / n, sum.obliquity / n, sum.precession / n};
}
double distance(const secular::YorpTorque& a, const secular::YorpTorque& b) {
  return norm(Vec3{a.spin - b.spin, a.obliquity - b.obliquity, a.precession - b.precession});
}

TEST(Yorp, IsTheAverage) {
  const Surface surface = drawn_surface(919, 7);
  for (const double o : {0.0, 0.3, 1.0, pi / 2.0, 2.5})
    EXPECT_LE(distance(secular::yorp_torque(surface, o), brute_force(surface, o, 600, 600)),
              budget::yorp_brute_force)
        << o;
}

// Symmetric about its centre: opposite facets undo each other over an orbit.
TEST(Yorp, VanishesForSymmetricShapes) {
  const Finish dull{.diffuse = 1.0};
  for (const auto& shape : {shape_test::ellipsoid(3, 2, 1, 3), shape_test::box(3, 2, 1)}) {
    const Surface surface = Surface::of_shape(shape, {}, dull);
    for (const double o : {0.1, 0.9, 1.4}) {
      const secular::YorpTorque y = secular::yorp_torque(surface, o);
      EXPECT_LE(std::abs(y.spin), budget::yorp_quadrature * shape.area() * 3.0);
      EXPECT_LE(std::abs(y.obliquity), budget::yorp_quadrature * shape.area() * 3.0);
    }
  }
}

// A convex body without symmetry: what it absorbs makes no torque on average (Nesvorny &
// Vokrouhlicky 2008); what it emits does.
TEST(Yorp, AbsorptionAloneMakesNone) {
  const auto shape = shape_test::tetrahedron(
      {Vec3{1.0, 0.1, -0.4}, {-0.7, 0.9, -0.3}, {-0.2, -1.1, -0.2}, {0.1, 0.1, 0.9}});
  for (const double o : {0.2, 0.8, 1.5}) {
    const secular::YorpTorque black =
        secular::yorp_torque(Surface::of_shape(shape, {0.1, 0, 0.1}, {}), o);
    EXPECT_LE(std::abs(black.spin), budget::yorp_quadrature * shape.area());
    EXPECT_LE(std::abs(black.obliquity), budget::yorp_quadrature * shape.area());
    const secular::YorpTorque warm =
        secular::yorp_torque(Surface::of_shape(shape, {}, {.emitted = 1.0}), o);
    EXPECT_GT(std::abs(warm.spin) + std::abs(warm.obliquity), budget::yorp_not_zero);
  }
}

// By symmetry of the orbit the spin torque is even and the obliquity torque odd about 90 degrees;
// another axis is another choice of axes.
TEST(Yorp, SymmetriesAndAxes) {
  const Surface surface = drawn_surface(920, 5);
  Surface emitting = surface;
  {
    std::vector<SurfaceFacet> facets(surface.facets().begin(), surface.facets().end());
    for (SurfaceFacet& f : facets) f.finish = {.diffuse = 1.0};
    emitting = Surface(facets);
  }
  const secular::YorpTorque near = secular::yorp_torque(emitting, 0.7),
                            far = secular::yorp_torque(emitting, pi - 0.7);
  EXPECT_NEAR(near.spin, far.spin, budget::yorp_quadrature * 10.0);
  EXPECT_NEAR(near.obliquity, -far.obliquity, budget::yorp_quadrature * 10.0);
  const double h = std::sqrt(0.5);  // and axis 3 to axis 1 and to axis 2
  const Quaternion drawn = drawn_case(921, 0).s.q;
  const std::pair<Quaternion, Vec3> turns[] = {{drawn, rotate(drawn, Vec3{0, 0, 2})},
                                               {{h, 0.0, h, 0.0}, {2, 0, 0}},
                                               {{h, -h, 0.0, 0.0}, {0, 2, 0}}};
  for (const auto& [q, axis] : turns) {
    EXPECT_LE(distance(secular::yorp_torque(surface.along(conj(q)), 0.7, axis),
                       secular::yorp_torque(surface, 0.7)),
              budget::yorp_quadrature * 10.0);
  }
}

// On an ellipse: time average over a Kepler orbit of the instantaneous mean over turns.
TEST(Yorp, MeanPressureOnAnEllipse) {
  const double e = 0.4, a = 2.0, P = 3.0, d = 1.0;
  const KeplerOrbit orbit({1.0, a * (1.0 - e), e});
  double sum = 0.0;
  constexpr int samples = 512;
  for (int i = 0; i < samples; ++i) {
    const Vec3 x = orbit.position(2.0 * pi * std::pow(a, 1.5) * i / samples);
    sum += P * d * d / dot(x, x) / samples;
  }
  EXPECT_NEAR(secular::mean_pressure({P, d}, a, e), sum, budget::perturb_average);
}

// P_n(x) and its derivative, n from 0.
struct Legendre {
  std::vector<double> value, slope;

  Legendre(double x, std::size_t most) : value{1.0, x}, slope{0.0, 1.0} {
    for (std::size_t k = 1; k < most; ++k) {
      const auto n = static_cast<double>(k);
      value.push_back(((2.0 * n + 1.0) * x * value[k] - n * value[k - 1]) / (n + 1.0));
      slope.push_back(slope[k - 1] + (2.0 * n + 1.0) * value[k]);
    }
  }
};

// max(x, 0) = sum a_n P_n(x), from the integrals of P_n over 0 to 1; `at_zero` goes to most + 2.
std::vector<double> lit_series(const Legendre& at_zero, std::size_t most) {
  const auto integral = [&](std::size_t k) {
    if (k == 0) return 1.0;
    const double difference = at_zero.value[k - 1] - at_zero.value[k + 1];
    return difference / (2.0 * static_cast<double>(k) + 1.0);
  };
  std::vector<double> a;
  for (std::size_t k = 0; k <= most; ++k) {
    const auto n = static_cast<double>(k);
    a.push_back(0.5 * ((n + 1.0) * integral(k + 1) + (k == 0 ? 0.0 : n * integral(k - 1))));
  }
  return a;
}

// What facets emit, averaged term by term. A turn about the spin axis keeps of P_n(cos(angle from
// n to the Sun)) the product P_n(n_z) P_n(sin(latitude)), and half of P_n^1 P_n^1 2 (n-1)!/(n+1)!
// along the meridian of the Sun (addition theorem); the orbit keeps P_n(0) P_n(cos(obliquity)), and
// of the meridian's part its derivative by the obliquity.
secular::YorpTorque by_series(const Surface& surface, double obliquity, std::size_t most) {
  const Legendre zero(0.0, most + 2), tilt(std::cos(obliquity), most);
  const std::vector<double> a = lit_series(zero, most);
  secular::YorpTorque sum{};
  for (const SurfaceFacet& f : surface.facets()) {
    const Legendre place(f.normal.z, most);
    double along = 0.0, meridian = 0.0;
    for (std::size_t n = 0; n <= most; n += 2) {
      along += a[n] * place.value[n] * zero.value[n] * tilt.value[n];
      if (n > 0)
        meridian -= a[n] / static_cast<double>(n * (n + 1)) * place.slope[n] * zero.value[n] *
                    tilt.slope[n] * std::sin(obliquity);
    }
    const Vec3 arm = cross(f.centre, f.normal);
    const double push = -2.0 / 3.0 * f.area;  // of Lambert's law
    sum.spin += push * along * arm.z;
    sum.obliquity += push * meridian * (arm.x * f.normal.x + arm.y * f.normal.y);
    sum.precession -= push * meridian * (arm.y * f.normal.x - arm.x * f.normal.y);
  }
  return sum;
}

// An ellipsoid with dents that lie anywhere.
shape::FacetShape drawn_shape(std::uint64_t seed, double depth) {
  const shape::FacetShape smooth = shape_test::ellipsoid(1.2, 1.0, 0.9, 3);
  Draw draw(seed, 0);
  Vec3 where[6];
  for (Vec3& w : where) w = drawn_vector(draw);
  std::vector<Vec3> v;
  for (const Vec3& x : smooth.vertices()) {
    double r = 1.0;
    for (const Vec3& w : where) {
      const double c = dot(w, x) / (norm(w) * norm(x));
      r += depth * c * c * c * (1.0 + c);
    }
    v.push_back(r * x);
  }
  return {v, {smooth.triangles().begin(), smooth.triangles().end()}};
}

// The series of Breiter & Michalska (2008) in the cosine of the obliquity, here for facets.
TEST(Yorp, IsItsSeriesInLegendrePolynomials) {
  for (std::uint64_t i = 0; i < 4; ++i) {
    const shape::FacetShape shape = drawn_shape(930 + i, 0.05);
    const Surface warm = Surface::of_shape(shape, {0.02, -0.01, 0.03}, {.emitted = 1.0});
    const double size = shape.area();
    for (const double o : {0.1, 0.8, pi / 2.0, 2.2})
      EXPECT_LE(distance(secular::yorp_torque(warm, o), by_series(warm, o, 3000)),
                budget::yorp_series * size)
          << i << " at " << o;
  }
}

TEST(Yorp, Refuses) {
  const Surface plate = Surface::of_plate({}, {1, 0, 0}, 1.0, {});
  EXPECT_REJECTED(secular::yorp_torque(plate, 0.0, {}), "axis (0, 0, 0)");
  EXPECT_REJECTED(secular::mean_pressure({1, 1}, 1.0, 1.0), "eccentricity 1");
}

}  // namespace
}  // namespace secular_test
