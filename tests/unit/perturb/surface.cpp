// SPDX-License-Identifier: MIT
// Light and air on facets: closed forms, 76 digits, and quadrature over attitudes.
#include <gmock/gmock.h>

#include <limits>
#include <numbers>
#include <type_traits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "unit/perturb/support.hpp"
#include "unit/perturb/surfaces.hpp"
#include "unit/shape/solids.hpp"
#include "worst.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using polhode::test::larger;
using polhode::test::smaller;
using polhode::test::Worst;

constexpr double pi = std::numbers::pi;

struct Line {
  Vec3 from;
  Vec3 speed;
  template <Real T>
  BasicVec3<T> position(const T& t) const {
    return {T(from.x) + T(speed.x) * t, T(from.y) + T(speed.y) * t, T(from.z) + T(speed.z) * t};
  }
};
DirectedPath still(const Vec3& at) { return {AnyOrbit("still", Line{at, {}})}; }
DirectedPath line(const Vec3& at, const Vec3& speed) { return {AnyOrbit("line", Line{at, speed})}; }

// Photon by photon: what arrives has momentum -e; the mirrored leaves along e - 2 (e.n) n turned
// back, the scattered and the emitted carry 2/3 along n.
WideVec3 light_force(const SurfaceFacet& f, const WideVec3& e) {
  const WideVec3 n = wide(f.normal);
  const Wide c = dot(n, e);
  if (c <= 0) return {};
  const Wide rate = Wide(f.area) * c;
  const WideVec3 mirrored = Wide(2 * c) * n - e;  // direction in which it leaves
  const Wide lambert = Wide(2) / 3 *
                       (Wide(f.finish.diffuse) +
                        Wide(f.finish.emitted) * (1 - Wide(f.finish.specular) - f.finish.diffuse));
  return Wide(-rate) * (e + Wide(f.finish.specular) * mirrored + lambert * n);
}
// Accommodation by its definition: sigma = (incident - reflected) / (incident - wall) of the
// momentum along the wall, where the wall gives none, and across it.
WideVec3 molecule_force(const SurfaceFacet& f, const WideVec3& e, const Wide& k) {
  const WideVec3 n = wide(f.normal);
  const Wide c = dot(n, e);
  if (c <= 0) return {};
  const Wide rate = Wide(f.area) * c;
  const WideVec3 tangent = e - c * n;
  const Wide sn = f.finish.normal_accommodation, st = f.finish.tangential_accommodation;
  const Wide pressure = c + ((1 - sn) * c + sn * k), shear = 1 - (1 - st);
  return Wide(-rate) * (pressure * n + shear * tangent);
}

TEST(FacetStream, IsTheBalanceOfMomentum) {
  const Surface surface = drawn_surface(911, 12);
  const FacetStream light(surface, light_law), gas(surface, molecule_law);
  Worst worst;
  for (std::uint64_t i = 0; i < 200; ++i) {
    Draw draw(912, i);
    const Vec3 x = drawn_vector(draw);
    const Vec3 e = (1.0 / norm(x)) * x;
    const double k = draw.uniform(0.0, 0.3);
    WideVec3 force[2], torque[2];
    double scale = 0.0;
    for (const SurfaceFacet& f : surface.facets()) {
      const WideVec3 parts[2] = {light_force(f, wide(e)), molecule_force(f, wide(e), k)};
      for (int j = 0; j < 2; ++j) {
        force[j] = force[j] + parts[j];
        torque[j] = torque[j] + cross(wide(f.centre), parts[j]);
      }
      scale += f.area * (1.0 + norm(f.centre));
    }
    for (const double error :
         {largest(wide(light.force(e)) - force[0]), largest(wide(gas.force(e, k)) - force[1]),
          largest(wide(light.torque(e)) - torque[0]), largest(wide(gas.torque(e, k)) - torque[1])})
      worst.add(error / scale);
  }
  EXPECT_LE(worst.value(), budget::perturb_eps * eps);
}

// A ball: force of light pi R^2 (1 + 4/9 diffuse), of mirrored light pi R^2, of gas 2 x 1/2 rho v^2
// pi R^2; torque of that force at the centre of the ball.
TEST(FacetStream, OfABallInTheLimit) {
  const Vec3 aside{0.3, -0.2, 0.5};
  const Vec3 e{0.48, 0.6, 0.64};
  const auto drag = [&](const Finish& finish, double k, auto law) {
    double d[3];
    for (int level = 3; level < 6; ++level) {
      const FacetStream ball(
          Surface::of_shape(shape_test::ellipsoid(1, 1, 1, level), -aside, finish), law);
      const Vec3 F = ball.force(e, k);
      EXPECT_LE(norm(ball.torque(e, k) - cross(aside, F)), budget::surface_ball) << level;
      EXPECT_LE(norm(F - dot(F, e) * e), budget::surface_mesh);
      d[level - 3] = -dot(F, e);
    }
    const double one = (4.0 * d[1] - d[0]) / 3.0, two = (4.0 * d[2] - d[1]) / 3.0;
    return (16.0 * two - one) / 15.0 / pi;
  };
  EXPECT_NEAR(drag({.diffuse = 1.0}, 1.0, light_law), 1.0 + 4.0 / 9.0, budget::surface_ball);
  EXPECT_NEAR(drag({.diffuse = 0.3, .emitted = 1.0}, 1.0, light_law), 1.0 + 4.0 / 9.0,
              budget::surface_ball);
  EXPECT_NEAR(drag({.specular = 1.0}, 1.0, light_law), 1.0, budget::surface_ball);
  EXPECT_NEAR(drag({}, 1.0, light_law), 1.0, budget::surface_ball);
  EXPECT_NEAR(drag({}, 0.0, molecule_law), 1.0, budget::surface_ball);
  EXPECT_NEAR(drag({}, 0.1, molecule_law), 1.0 + 0.1 * 2.0 / 3.0, budget::surface_ball);
  EXPECT_NEAR(
      drag({.normal_accommodation = 0.0, .tangential_accommodation = 0.0}, 0.0, molecule_law), 1.0,
      budget::surface_ball);
}

TEST(SolarPressure, PlateByHand) {
  // A mirror that faces the Sun, 2 d away: 2 P / 4 on it, arm 3 along y.
  const Surface plate = Surface::of_plate({0, 3, 0}, {1, 0, 0}, 5.0, {.specular = 1.0});
  const SolarPressure term(plate, {8.0, 1.0}, still({-2, 0, 0}));
  const Body body(1.0, 1.0, 1.0);
  const Effect e = term.effect(Setting{body, 0.0, {{}, {}}, {}});
  EXPECT_EQ(e.u, (Vec3{0, 0, 60.0}));
  EXPECT_EQ(e.v, Vec3{});
  // from behind it gets nothing, unless it has two sides
  EXPECT_EQ(SolarPressure(plate, {8.0, 1.0}, still({2, 0, 0})).effect(Setting{body, 0.0, {}, {}}).u,
            Vec3{});
  const Surface both = Surface::of_plate({0, 3, 0}, {1, 0, 0}, 5.0, {.specular = 1.0}, true);
  EXPECT_EQ(SolarPressure(both, {8.0, 1.0}, still({2, 0, 0})).effect(Setting{body, 0.0, {}, {}}).u,
            (Vec3{0, 0, -60.0}));
}

// The Sun as seen from the planet, reversed or not; turned frames and bodies.
TEST(SolarPressure, FollowsSunAndAxes) {
  const Surface surface = drawn_surface(913, 5);
  const FacetStream light(surface, light_law);
  const Vec3 to_sun{10.0, 4.0, -3.0}, from_planet{1.0, -1.0, 0.5};
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Case c = drawn_case(914, i);
    const Vec3 to = to_sun - from_planet;
    const double r = norm(to);
    const Vec3 e = rotate(conj(c.s.q), rotate(conj(c.q_IS), (1.0 / r) * to));
    const Vec3 want = (2.0 * 9.0 / (r * r)) * light.torque(e);
    const SolarPressure one(surface, {2.0, 3.0}, still(from_planet), still(to_sun));
    DirectedPath back = still(-to_sun);
    back.reversed = true;
    const SolarPressure two(surface, {2.0, 3.0}, still(from_planet), back);
    EXPECT_LE(norm(one.effect(c.on<double>()).u - want), budget::surface_eps * eps);
    EXPECT_EQ(one.effect(c.on<double>()), two.effect(c.on<double>()));
    EXPECT_LE(norm(Vec3{to_double(one.effect(c.on<DoubleDouble>()).u.x - want.x),
                        to_double(one.effect(c.on<DoubleDouble>()).u.y - want.y), 0.0}),
              budget::surface_eps * eps);
  }
  EXPECT_TRUE(AnyPerturbation("sun", SolarPressure(surface, {2, 3}, still({1, 1, 1}))).is_kick());
}

// A Tangent state: the derivative of the torque by a turn, against differences.
TEST(SolarPressure, TangentOfTheTorque) {
  const SolarPressure term(drawn_surface(915, 6), {1.0, 1.0}, still({0.3, 0.5, -0.7}));
  const Case c = drawn_case(916, 3);
  const auto at = with_variables(c.on<double>());
  const auto u = term.effect(at).u;
  for (int k = 0; k < 3; ++k) {
    constexpr double h = 1e-6;
    const auto turned = [&](double angle) {
      Case moved = c;
      Vec3 axis;
      axis[k] = std::sin(0.5 * angle);
      moved.s.q = c.s.q * Quaternion{std::cos(0.5 * angle), axis.x, axis.y, axis.z};
      return term.effect(moved.on<double>()).u;
    };
    const Vec3 slope = (0.5 / h) * (turned(h) - turned(-h));
    const auto of = static_cast<std::size_t>(k);
    EXPECT_NEAR(u.x.derivative[of], slope.x, budget::surface_slope);
    EXPECT_NEAR(u.y.derivative[of], slope.y, budget::surface_slope);
    EXPECT_NEAR(u.z.derivative[of], slope.z, budget::surface_slope);
  }
}

// The fraction of a disc by counting: chords of the Sun's disc that the other disc leaves, at the
// same angles.
double counted(double a, double b, double c) {
  constexpr int chords = 20000;
  double left = 0.0, all = 0.0;
  for (int i = 0; i < chords; ++i) {
    const double y = a * ((2.0 * i + 1.0) / chords - 1.0);
    const double half = std::sqrt(a * a - y * y), reach = b * b - y * y;
    const double edge = reach > 0.0 ? std::sqrt(reach) : -1.0;
    const double low = larger(-half, c - edge), high = smaller(half, c + edge);
    all += 2.0 * half;
    left += 2.0 * half - (edge > 0.0 && high > low ? high - low : 0.0);
  }
  return left / all;
}

TEST(Shadow, FractionOfTheDisc) {
  const double R = 1.0, S = 0.3;
  for (const double away : {1.05, 1.5, 4.0, 20.0, 60.0}) {
    const Shadow cone = Shadow::cone(R, S);
    const double d = 20.0, a = std::asin(S / d), b = std::asin(R / away);
    for (int i = 0; i <= 40; ++i) {
      const double c = (a + b) * 1.1 * i / 40.0;
      const double got = cone.visible(Vec3{d, 0, 0}, away * Vec3{std::cos(c), std::sin(c), 0.0});
      EXPECT_NEAR(got, counted(a, b, c), budget::shadow_counted) << away << " " << i;
    }
  }
  // annular, and behind
  EXPECT_NEAR(Shadow::cone(1.0, 3.0).visible(Vec3{100, 0, 0}, Vec3{50, 0, 0}),
              1.0 - std::pow(std::asin(0.02) / std::asin(0.03), 2), budget::perturb_eps * eps);
  EXPECT_EQ(Shadow::cone(1.0, 3.0).visible(Vec3{100, 0, 0}, Vec3{-50, 0, 0}), 1.0);
  EXPECT_EQ(Shadow::cone(1.0, 3.0).visible(Vec3{100, 0, 0}, Vec3{0.5, 0, 0}), 0.0);
}

TEST(Shadow, CylinderByHand) {
  const Shadow shadow = Shadow::cylinder(1.0);
  const Vec3 sun{100, 0, 0};
  EXPECT_EQ(shadow.visible(sun, Vec3{5, 0.999, 0}), 0.0);
  EXPECT_EQ(shadow.visible(sun, Vec3{5, 1.001, 0}), 1.0);
  EXPECT_EQ(shadow.visible(sun, Vec3{-5, 0, 0}), 1.0);
  // the disc of a small Sun at the border of the cylinder is half covered; a cone of a small Sun is
  // the cylinder elsewhere
  const Shadow cone = Shadow::cone(1.0, 1e3);
  EXPECT_NEAR(cone.visible(Vec3{1e9, 0, 0}, Vec3{std::sqrt(24.0), 1.0, 0}), 0.5,
              budget::shadow_counted);
  EXPECT_EQ(cone.visible(Vec3{1e9, 0, 0}, Vec3{5, 0.999, 0}), 0.0);
}

TEST(AtmosphericDrag, PlateByHand) {
  const Body body(1.0, 1.0, 1.0);
  const Setting at{body, 0.0, {}, {}};
  const Surface plate = Surface::of_plate({0, 0, 2}, {1, 0, 0}, 3.0, {});
  // 5 along x at (0, 10, 0), the air turns with 0.2 about -z: it comes with 5 - (0.2 x 10) = 3
  const Atmosphere air{
      .density = 0.5, .radius = 9.0, .scale_height = 2.0, .rotation = {0, 0, -0.2}};
  const AtmosphericDrag term(plate, air, line({0, 10, 0}, {5, 0, 0}));
  const double pressure = 0.5 * std::exp(-0.5) * 9.0;
  const Vec3 u = term.effect(at).u;
  EXPECT_NEAR(u.y, -6.0 * pressure, budget::surface_eps * eps * 6.0);
  EXPECT_EQ(u.x, 0.0);
  // an exit speed of 1 adds 1/3 along the normal
  const AtmosphericDrag warm(plate, air, line({0, 10, 0}, {5, 0, 0}), 1.0);
  EXPECT_NEAR(warm.effect(at).u.y, -6.0 * pressure * 4.0 / 3.0, budget::surface_eps * eps * 8.0);
  // everywhere the same
  const AtmosphericDrag even(plate, {.density = 0.5}, line({0, 10, 0}, {5, 0, 0}));
  EXPECT_NEAR(even.effect(at).u.y, -6.0 * 0.5 * 25.0, budget::surface_eps * eps * 80.0);
}

// The velocity against the air is that in inertial axes, whatever frame the state is in: along
// axes that turn it would lack their turning.
static_assert(!std::is_constructible_v<AtmosphericDrag, Surface, Atmosphere, DirectedPath, double,
                                       SpaceAxes>);

// A body that stands still in space meets no air, in a frame that turns as well; nor does one that
// the air carries along.
TEST(AtmosphericDrag, NothingWhereTheAirStands) {
  const Case c = drawn_case(923, 0);
  const Surface surface = drawn_surface(924, 4);
  const Vec3 x{3.0, 1.0, -2.0}, turning{0.1, 0.2, -0.3};
  const Atmosphere carried{.density = 2.0, .rotation = turning};
  EXPECT_EQ(AtmosphericDrag(surface, {.density = 2.0}, still(x)).effect(c.on<double>()), Effect{});
  const Vec3 v = cross(turning, x);
  const DirectedPath along = line(x - c.t * v, v);
  const Effect e = AtmosphericDrag(surface, carried, along).effect(c.on<double>());
  EXPECT_LE(norm(e.u), budget::surface_eps * eps);
}

// The velocity is that of the orbit.
TEST(AtmosphericDrag, TakesTheVelocityOfTheOrbit) {
  const KeplerOrbit orbit({1.0, 0.9, 0.1, 0.4, 0.2, 0.3});
  const Surface surface = drawn_surface(917, 4);
  const AtmosphericDrag term(surface, {.density = 1.0}, {AnyOrbit("o", orbit)});
  const Case c = drawn_case(918, 0);
  constexpr double h = 1e-5;
  const Vec3 v = (0.5 / h) * (orbit.position(c.t + h) - orbit.position(c.t - h));
  const Vec3 e = rotate(conj(c.s.q), rotate(conj(c.q_IS), (1.0 / norm(v)) * v));
  const Vec3 want = dot(v, v) * FacetStream(surface, molecule_law).torque(e, 0.0);
  EXPECT_LE(norm(term.effect(c.on<double>()).u - want), budget::surface_slope * norm(want));
}

// As a pickle makes it: normals of length 1 to rounding are not divided again.
TEST(SurfaceTerms, SurfaceOfItsOwnFacetsIsTheSame) {
  const Surface surface = drawn_surface(922, 200);
  EXPECT_EQ(Surface({surface.facets().begin(), surface.facets().end()}), surface);
}

TEST(SurfaceTerms, Refuse) {
  const Surface plate = Surface::of_plate({}, {1, 0, 0}, 1.0, {});
  const DirectedPath path = still({1, 0, 0});
  EXPECT_REJECTED(Surface::of_plate({}, {1, 0, 0}, -1.0, {}), "facet 1: area -1");
  EXPECT_REJECTED(Surface::of_plate({}, {}, 1.0, {}), "normal (0, 0, 0)");
  EXPECT_REJECTED(Surface::of_plate({}, {1, 0, 0}, 1.0, {.specular = 0.6, .diffuse = 0.6}),
                  "specular + diffuse 1.2 must be from 0 to 1");
  EXPECT_REJECTED(SolarPressure(plate, {0.0, 1.0}, path), "pressure 0");
  EXPECT_REJECTED(Shadow::cone(1.0, -1.0), "sun_radius -1");
  EXPECT_REJECTED(AtmosphericDrag(plate, {.density = -1e-12}, path),
                  "density -1e-12 must be at least 0");
  EXPECT_REJECTED(AtmosphericDrag(plate, {.density = 1, .scale_height = 0.0}, path),
                  "scale_height 0");
}

}  // namespace
}  // namespace perturb_test
