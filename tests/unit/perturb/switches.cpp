// SPDX-License-Identifier: MIT
// Switching functions and time scales of terms: where they change their sign, and what holds on
// given sides.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "budgets.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "unit/perturb/support.hpp"
#include "unit/perturb/surfaces.hpp"

namespace perturb_test {
namespace {

using namespace polhode;

TEST(ShadowBorders, AreWhereTheLightChanges) {
  const Shadow cylinder = Shadow::cylinder(1.0), cone = Shadow::cone(1.0, 3.0);
  Draw draw(11, 0);
  int dark = 0, partly = 0, within = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 to_sun{draw.uniform(-1.0, 1.0), draw.uniform(-1.0, 1.0), 40.0};
    const double far = i % 2 == 0 ? 8.0 : 30.0;  // total, and annular beyond 13
    const Vec3 to_body{draw.uniform(-3.0, 3.0), draw.uniform(-3.0, 3.0), draw.uniform(-2.0, far)};
    if (norm(to_body) <= 1.0) continue;
    const double light = cylinder.visible(to_sun, to_body);
    EXPECT_EQ(light == 0.0, cylinder.borders(to_sun, to_body)[0] < 0.0);
    dark += light == 0.0;
    const double of_cone = cone.visible(to_sun, to_body);
    const std::vector<double> borders = cone.borders(to_sun, to_body);
    ASSERT_EQ(borders.size(), 2U);
    EXPECT_EQ(of_cone == 1.0, borders[0] > 0.0);
    const double sun = std::asin(3.0 / norm(to_sun)), body = std::asin(1.0 / norm(to_body));
    const double whole = body < sun ? 1.0 - (body / sun) * (body / sun) : 0.0;
    EXPECT_EQ(std::fabs(of_cone - whole) < budget::border_light, borders[1] < 0.0);
    partly += borders[0] < 0.0 && borders[1] > 0.0;
    within += borders[1] < 0.0;
    // the sides of its own values change nothing
    const std::vector<double> sides{side_of(borders[0]), side_of(borders[1])};
    EXPECT_EQ(cone.visible(to_sun, to_body, sides), of_cone);
  }
  EXPECT_GT(dark, 200);
  EXPECT_GT(partly, 200);
  EXPECT_GT(within, 100);
}

TEST(ShadowBorders, GivenSidesHoldBeyondThem) {
  const Vec3 sun{0.0, 0.0, 40.0};
  const std::vector<double> lit{1.0, 1.0}, part{-1.0, 1.0}, umbra{-1.0, -1.0};
  const Shadow cylinder = Shadow::cylinder(1.0), cone = Shadow::cone(1.0, 3.0);
  const auto off_axis = [](double x) { return Vec3{x, 0.0, 5.0}; };
  EXPECT_EQ(cylinder.visible(sun, off_axis(0.99), std::vector{1.0}), 1.0);
  EXPECT_EQ(cylinder.visible(sun, off_axis(1.01), std::vector{-1.0}), 0.0);
  // past the borders of the cone: 1 and 0 go on, and what lies between ends at them
  EXPECT_EQ(cone.visible(sun, off_axis(1.3), lit), 1.0);
  EXPECT_LT(cone.visible(sun, off_axis(1.3)), 1.0);
  EXPECT_EQ(cone.visible(sun, off_axis(1.5), part), 1.0);
  EXPECT_EQ(cone.visible(sun, off_axis(0.5), part), 0.0);
  EXPECT_EQ(cone.visible(sun, off_axis(0.7), umbra), 0.0);
  EXPECT_GT(cone.visible(sun, off_axis(0.7)), 0.0);
}

TEST(FacetEdges, OneForADirectionAndItsOpposite) {
  const Surface plates[] = {Surface::of_plate({0, 3, 0}, {1, 0, 0}, 10.0, {}, true),
                            Surface::of_plate({1, 0, 0.2}, {1, 0, 0}, 4.0, {}),
                            Surface::of_plate({0, 0, 1}, {0, 1, 1}, 4.0, {})};
  const FacetStream stream(joined(plates), light_law);
  std::vector<double> edges{7.0};
  stream.add_edges({0.6, 0.8, 0.0}, edges);
  ASSERT_EQ(edges.size(), 3U);
  EXPECT_EQ(edges[0], 7.0);
  EXPECT_EQ(edges[1], 0.6);
  EXPECT_NEAR(edges[2], 0.8 / std::numbers::sqrt2, budget::border_light);
}

TEST(FacetEdges, SidesOfTheValuesChangeNothingAndOthersGoOn) {
  const Surface surface = drawn_surface(3, 20);
  const FacetStream stream(surface, molecule_law);
  Draw draw(5, 0);
  for (int i = 0; i < 50; ++i) {
    const Vec3 x = drawn_vector(draw), e = (1.0 / norm(x)) * x;
    std::vector<double> sides;
    stream.add_edges(e, sides);
    ASSERT_EQ(sides.size(), 20U);
    for (double& side : sides) side = side_of(side);
    const Vec3 own = stream.torque(e, 0.3);
    EXPECT_EQ(stream.torque(e, 0.3, sides), own);
    // a facet taken for lit: odd in its cosine but for what grows with its square
    const SurfaceFacet& facet = surface.facets()[0];
    const StreamLaw law = molecule_law(facet.finish);
    const double c = dot(facet.normal, e);
    const Vec3 force =
        -facet.area * c * (law.along * e + (law.mirrored * c + law.normal * 0.3) * facet.normal);
    const Vec3 part = cross(facet.centre, force);
    sides[0] = -sides[0];
    const Vec3 other = stream.torque(e, 0.3, sides);
    EXPECT_LE(norm(other - (c < 0.0 ? own + part : own - part)), budget::border_light * 20.0);
  }
}

TEST(FacetEdges, NoneForMany) {
  std::vector<double> edges;
  FacetStream(drawn_surface(3, 32), light_law).add_edges({1.0, 0.0, 0.0}, edges);
  EXPECT_EQ(edges.size(), 32U);
  FacetStream(drawn_surface(3, 33), light_law).add_edges({1.0, 0.0, 0.0}, edges);
  EXPECT_EQ(edges.size(), 32U);
}

TEST(TimeScale, AQuarterOfATurnAtThePericentre) {
  const KeplerElements circle{.gm = 4.0, .pericentre = 2.0, .eccentricity = 0.0};
  const double quarter = 0.5 * std::numbers::pi * std::sqrt(2.0);  // a^3 / gm = 2
  const double e = budget::time_scale;
  EXPECT_NEAR(KeplerOrbit(circle).time_scale(), quarter, e);
  const PrecessingKeplerOrbit turning(circle, {1e-3, 0.0, 0.0});
  EXPECT_NEAR(turning.time_scale(), quarter, e);
  EXPECT_NEAR(TurnedKeplerOrbit(turning, 0.4).time_scale(), quarter, e);
  // h / q^2 = sqrt(gm q (1 + e)) / q^2 for an ellipse and a hyperbola
  for (const double eccentricity : {0.9, 3.0}) {
    const double rate = std::sqrt(4.0 * 2.0 * (1.0 + eccentricity)) / 4.0;
    EXPECT_NEAR(KeplerOrbit({4.0, 2.0, eccentricity}).time_scale(), 0.5 * std::numbers::pi / rate,
                e);
  }
  PositionTable rows;
  for (int i = 0; i < 40; ++i) {
    rows.times.push_back(0.1 * i);
    rows.positions.push_back(KeplerOrbit(circle).position(0.1 * i));
  }
  EXPECT_NEAR(TableOrbit(rows).time_scale(), quarter, e);
}

TEST(TimeScale, OfTerms) {
  const KeplerOrbit orbit({.gm = 4.0, .pericentre = 2.0, .eccentricity = 0.3});
  const double own = orbit.time_scale();
  EXPECT_EQ(AnyPerturbation("gravity", GravityGradient(1.0, orbit)).time_scale(), own);
  EXPECT_EQ(AnyPerturbation("gravity", GravityGradient(1.0, AnyOrbit("o", orbit))).time_scale(),
            own);
  const DipoleField earth({0.0, 0.1, 1.0}, {.rate = 40.0});
  const AnyPerturbation magnet("magnet",
                               ResidualDipole({1.0, 0.0, 0.0}, FieldAlongOrbit(orbit, earth)));
  EXPECT_NEAR(magnet.time_scale(), 0.5 * std::numbers::pi / 40.0, budget::time_scale);
  const auto push = [](const double&, const RotorState&) { return Vec3{}; };
  EXPECT_EQ(AnyPerturbation("push", TorqueTerm(push)).time_scale(),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(AnyPerturbation("push", TorqueTerm(push, 3.0)).time_scale(), 3.0);
  EXPECT_FALSE(AnyPerturbation("push", TorqueTerm(push)).supports_switches());
}

TEST(Terms, LightFadesInAPenumbraAlone) {
  const auto fades = [](Shadow shadow) {
    const KeplerOrbit orbit({1.0, 2.0, 0.1}), sun({1.0, 200.0, 0.0});
    return AnyPerturbation(
               "light",
               SolarPressure(Surface::of_plate({0.5, 0.3, 0.4}, {0.3, 0.0, 0.95}, 0.5, {}, true),
                             {0.05, 200.0}, {AnyOrbit("o", orbit)}, {AnyOrbit("s", sun)}, shadow))
        .fades_at_switches();
  };
  EXPECT_TRUE(fades(Shadow::cone(0.7, 10.0)));
  EXPECT_FALSE(fades(Shadow::cylinder(0.7)));
  const auto push = [](const double&, const RotorState&) { return Vec3{}; };
  EXPECT_FALSE(AnyPerturbation("push", TorqueTerm(push)).fades_at_switches());
}

// Its effect is that of the signs of its functions, and that of other sides where they are given.
TEST(SwitchedTorque, TakesTheSidesOfItsFunctions) {
  const SwitchedTorqueTerm jet(
      [](const auto&, const auto& s, std::span<const double> sides) {
        using T = std::decay_t<decltype(s.g.x)>;
        return BasicVec3<T>{T(sides[0]), T(sides[1]), s.g.z};
      },
      [](double t, const RotorState& s) {
        return std::vector{t - 1.0, s.g.z};
      },
      5.0);
  const AnyPerturbation term("jet", jet);
  ASSERT_TRUE(term.supports_switches());
  EXPECT_TRUE(term.supports_any_real());
  EXPECT_EQ(term.time_scale(), 5.0);
  const Body body(1.0, 2.0, 2.5);
  Setting at{body, 0.5, {{}, {0.0, 0.0, 2.0}}, {}};
  EXPECT_EQ(term.switches(at), (std::vector{-0.5, 2.0}));
  EXPECT_EQ(term.effect(at).u, (Vec3{-1.0, 1.0, 2.0}));
  const std::vector<double> sides{1.0, -1.0};
  at.sides = sides;
  EXPECT_EQ(term.effect(at).u, (Vec3{1.0, -1.0, 2.0}));
}

}  // namespace
}  // namespace perturb_test
