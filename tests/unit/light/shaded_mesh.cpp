// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "budgets.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "unit/light/meshes.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using oracle::Draw;
using test::floor;
using test::globe;
using test::joined;

constexpr double pi_ = 3.141592653589793;

shape::FacetShape ball(int rows, double radius, const Vec3& centre) {
  return globe(rows, [&](const Vec3& n) { return centre + radius * n; });
}

TEST(LightMesh, ConvexOnesHaveNoShadowsAndGiveTheEllipsoid) {
  const light::Ellipsoid body{1.5, 1.25, 1.0};
  const shape::FacetShape shape = globe(24, [&](const Vec3& n) {
    return Vec3{body.a * n.x, body.b * n.y, body.c * n.z};
  });
  const light::ShadedMesh mesh(shape);
  EXPECT_TRUE(light::is_convex(shape));
  EXPECT_TRUE(mesh.is_shadowless());
  std::vector<Vec3> normals;
  std::vector<double> areas;
  for (const shape::Facet& f : shape.facets()) {
    normals.push_back(f.normal);
    areas.push_back(f.area);
  }
  Draw draw(5, 1);
  for (int trial = 0; trial < 10; ++trial) {
    const Vec3 s{draw.normal(), draw.normal(), draw.normal()};
    const Vec3 o{draw.normal(), draw.normal(), draw.normal()};
    const light::Scattering law = light::Scattering::mixed(0.1 * trial);
    const double got = mesh.brightness(law, s, o);
    EXPECT_NEAR(got, light::brightness<32>(body, law, s, o), budget::light_mesh);
    EXPECT_NEAR(got, light::facet_brightness<double>(normals, areas, law, s, o),
                budget::light_facet_gradient);
  }
}

// A small ball before a large one, Sun and observer behind the small one: what it hides of the
// other by Lambert's law is 2 pi/3 R^2 (1 - (1 - r^2/R^2)^(3/2)), by that of Lommel and Seeliger
// its own disc.
TEST(LightMesh, OneBallBeforeAnother) {
  const double r = 0.5;
  const Vec3 s{1.0, 0.2, 0.1}, way = (3.0 / norm(s)) * s;
  const light::ShadedMesh mesh(joined(ball(24, 1.0, {}), ball(12, r, way)));
  EXPECT_FALSE(mesh.is_shadowless());
  EXPECT_FALSE(light::is_convex(mesh.shape()));
  const double lambert = 2.0 / 3.0 * pi_ * (r * r + std::pow(1.0 - r * r, 1.5));
  EXPECT_NEAR(mesh.brightness(light::Scattering::lambert(), s, s), lambert,
              budget::light_two_balls);
  EXPECT_NEAR(mesh.brightness(light::Scattering::lommel_seeliger(), s, 2.0 * s), 0.5 * pi_,
              budget::light_two_balls);
  // Seen and lit from the side they do not touch each other's light.
  const Vec3 side = cross(s, {0.0, 0.0, 1.0});
  EXPECT_NEAR(mesh.brightness(light::Scattering::lambert(), side, side),
              2.0 / 3.0 * pi_ * (1.0 + r * r), budget::light_two_balls);
}

// A wall of height 0.2 at the border of a floor, the Sun behind it at an elevation of tangent 1/2:
// its shadow is 0.4 wide, and ends between the triangles. Sun and observer change places.
TEST(LightMesh, ShadowOfAWall) {
  const shape::FacetShape wall({{0, -5, 0}, {0, 5, 0}, {0, 5, 0.2}, {0, -5, 0.2}},
                               {{0, 1, 2}, {0, 2, 3}});
  const light::ShadedMesh mesh(joined(floor(10), wall));
  const Vec3 s{-2.0, 0.0, 1.0}, up{0.0, 0.0, 1.0};
  const double mu0 = 1.0 / std::sqrt(5.0);
  EXPECT_NEAR(mesh.brightness(light::Scattering::lambert(), s, up), 0.6 * mu0, budget::light_wall);
  EXPECT_NEAR(mesh.brightness(light::Scattering::lambert(), up, s), 0.6 * mu0, budget::light_wall);
  // In shadow and hidden: from both sides at once, what is left lies between.
  const light::ShadedMesh both(joined(mesh.shape(), wall.moved({-1.0, 0.0, 0.0})));
  EXPECT_NEAR(both.brightness(light::Scattering::lambert(), s, {2.0, 0.0, 1.0}), 0.2 * mu0 * mu0,
              budget::light_wall);
  EXPECT_FALSE(light::is_convex(floor(2)));  // not closed
}

// Every ray against every facet, by solving for where it meets the plane.
TEST(LightMesh, RaysMeetWhatStandsInTheirWay) {
  const shape::FacetShape shape = globe(9, [](const Vec3& n) {
    return (1.0 + 0.5 * n.x * n.y - 0.4 * n.z * n.z + 0.3 * std::sin(5.0 * n.x)) * n;
  });
  ASSERT_TRUE(shape.is_closed());
  const light::ShadedMesh mesh(shape);
  Draw draw(5, 2);
  int shaded = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 v{draw.normal(), draw.normal(), draw.normal()}, d = (1.0 / norm(v)) * v;
    for (std::size_t i = 0; i < shape.facets().size(); ++i) {
      const shape::Facet& own = shape.facets()[i];
      if (dot(own.normal, d) <= 0.0) continue;
      bool is_free = true;
      for (std::size_t j = 0; j < shape.facets().size(); ++j) {
        const shape::Facet& f = shape.facets()[j];
        const double t = dot(f.normal, f.centre - own.centre) / dot(f.normal, d);
        if (j == i || t <= 0.0) continue;
        const Vec3 at = own.centre + t * d;
        bool is_inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3& a = shape.vertices()[shape.triangles()[j][k]];
          const Vec3& b = shape.vertices()[shape.triangles()[j][(k + 1) % 3]];
          is_inside = is_inside && dot(cross(b - a, at - a), f.normal) >= 0.0;
        }
        is_free = is_free && !is_inside;
      }
      EXPECT_EQ(mesh.is_free(i, d), is_free) << i;
      shaded += is_free ? 0 : 1;
    }
  }
  EXPECT_GT(shaded, 50);
}

}  // namespace
