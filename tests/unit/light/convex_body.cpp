// SPDX-License-Identifier: MIT
// Convex bodies from the areas of their facets: boxes, bodies of a Gaussian image, and what is
// none.
#include "polhode/light/convex_body.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/math/real.hpp"
#include "polhode/shape/mass_properties.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using testing::HasSubstr;

const std::vector<Vec3> six{{1.0, 0.0, 0.0},  {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0},
                            {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0},  {0.0, 0.0, -2.0}};

// The area of the facets on each normal, over the area asked for.
double worst_area(const shape::FacetShape& mesh, std::span<const Vec3> normals,
                  std::span<const double> areas) {
  std::vector<double> found(areas.size(), 0.0);
  for (const shape::Facet& f : mesh.facets()) {
    std::size_t nearest = 0;
    for (std::size_t j = 1; j < normals.size(); ++j)
      if (dot(normals[j], f.normal) > dot(normals[nearest], f.normal)) nearest = j;
    found[nearest] += f.area;
  }
  test::Worst<> worst;
  for (std::size_t j = 0; j < areas.size(); ++j)
    worst.add(std::abs(found[j] - areas[j]) / mesh.area());
  return worst.value();
}

TEST(LightConvexBody, IsABox) {
  const std::vector<double> areas{6.0, 6.0, 3.0, 3.0, 2.0, 2.0};  // 1 by 2 by 3
  const shape::FacetShape box = light::convex_body(six, areas);
  EXPECT_EQ(box.vertices().size(), 8u);
  EXPECT_EQ(box.triangles().size(), 12u);
  for (const Vec3& v : box.vertices()) {
    EXPECT_NEAR(std::abs(v.x), 0.5, budget::convex_areas);
    EXPECT_NEAR(std::abs(v.y), 1.0, budget::convex_areas);
    EXPECT_NEAR(std::abs(v.z), 1.5, budget::convex_areas);
  }
  EXPECT_TRUE(light::is_convex(box));
}

// Areas of ellipsoids and of a body without symmetry come back, whatever the sizes of facets.
TEST(LightConvexBody, HasTheAreasOfAGaussianImage) {
  const light::GaussianImage image(6, 6);
  const light::Ellipsoid e{1.6, 1.0, 0.7};
  std::vector<double> c = image.coefficients(e);
  for (const bool is_ellipsoid : {true, false}) {
    if (!is_ellipsoid) {
      for (std::size_t k = 9; k < c.size(); ++k)
        c[k] += 0.05 * std::sin(7.0 * static_cast<double>(k));
    }
    std::vector<double> A = image.areas(c);
    // no share in closure: each with that of its opposite
    if (!is_ellipsoid) {
      const Vec3 off = image.closure(A);
      EXPECT_GT(norm(off), 0.0);
    }
    const shape::FacetShape mesh = light::convex_body(image.normals(), A);
    EXPECT_TRUE(mesh.is_closed());
    const double closure = norm(image.closure(A)) / mesh.area();
    EXPECT_LE(worst_area(mesh, image.normals(), A), budget::convex_areas + closure);
    const shape::MassProperties m = shape::mass_properties(mesh, 1.0);
    EXPECT_LE(norm(m.centre), budget::convex_areas);
    if (!is_ellipsoid) continue;
    EXPECT_NEAR(m.volume / (4.0 / 3.0 * pi<double>() * e.a * e.b * e.c), 1.0,
                budget::convex_volume);
    const Vec3 I = light::homogeneous_moments(e, 1.0);
    EXPECT_NEAR(m.inertia(0, 0) / m.inertia(2, 2), I.x / I.z, budget::convex_volume);
    EXPECT_NEAR(m.inertia(1, 1) / m.inertia(2, 2), I.y / I.z, budget::convex_volume);
  }
}

// Moments beside those of the mesh, and their derivatives beside differences.
void expect_moments_follow(const light::GaussianImage& image, const std::vector<double>& A) {
  const light::ConvexMoments at = light::convex_moments(image.normals(), A);
  const Mat3 T = shape::mass_properties(light::convex_body(image.normals(), A), 1.0).inertia;
  EXPECT_NEAR(at.Ixx, T(0, 0) / T(2, 2), budget::convex_areas);
  EXPECT_NEAR(at.Iyy, T(1, 1) / T(2, 2), budget::convex_areas);
  test::Worst<> worst, near;
  for (std::size_t trial = 0; trial < 6; ++trial) {
    double by_Ixx = 0.0, by_Iyy = 0.0, size = 0.0;
    const double h = 1e-4;
    std::vector<double> up = A, down = A;
    for (std::size_t j = 0; j < A.size(); ++j) {
      const double d = h * std::sin(3.0 * static_cast<double>(j * (trial + 1)));
      up[j] += d * A[j];
      down[j] -= d * A[j];
      by_Ixx += 2.0 * d * A[j] * at.Ixx_by_areas[j];
      by_Iyy += 2.0 * d * A[j] * at.Iyy_by_areas[j];
      size += std::abs(d * A[j] * at.Ixx_by_areas[j]);
    }
    const light::ConvexMoments above = light::convex_moments(image.normals(), up, at.distances);
    const light::ConvexMoments below = light::convex_moments(image.normals(), down, at.distances);
    worst.add(std::abs(above.Ixx - below.Ixx - by_Ixx) / size);
    worst.add(std::abs(above.Iyy - below.Iyy - by_Iyy) / size);
    near.add(std::abs(light::convex_moments(image.normals(), up).Ixx - above.Ixx));
  }
  EXPECT_LE(worst.value(), budget::convex_moments_by_areas);
  EXPECT_LE(near.value(), budget::convex_areas);  // from whatever start
}

TEST(LightConvexBody, MomentsFollowTheAreas) {
  const light::GaussianImage image(4, 5);
  std::vector<double> c = image.coefficients(light::Ellipsoid{1.3, 1.0, 0.7});
  for (std::size_t k = 9; k < c.size(); ++k) c[k] += 0.05 * std::sin(7.0 * static_cast<double>(k));
  // closed to roundings
  std::vector<double> A = image.areas(c);
  for (int round = 0; round < 60; ++round) {
    const Vec3 off = image.closure(A);
    for (std::size_t j = 0; j < A.size(); ++j)
      A[j] -= 3.0 / static_cast<double>(A.size()) * dot(off, image.normals()[j]);
  }
  ASSERT_LE(norm(image.closure(A)), budget::convex_areas);
  expect_moments_follow(image, A);
}

// Where closure takes tenths of an area from some facets and gives as much to others.
TEST(LightConvexBody, MomentsFollowAreasThatAreNotClosed) {
  const light::GaussianImage image(4, 5);
  std::vector<double> A = image.areas(image.coefficients(light::Ellipsoid{1.3, 1.0, 0.7}));
  for (std::size_t j = 0; j < A.size(); ++j)
    A[j] *= 1.0 + dot(Vec3{0.2, -0.1, 0.15}, image.normals()[j]);
  ASSERT_GT(norm(image.closure(A)), 0.1);
  expect_moments_follow(image, A);
}

TEST(LightConvexBody, SaysWhatIsNone) {
  const auto refusal = [](std::vector<Vec3> n, std::vector<double> A) {
    return test::message_of([&] { static_cast<void>(light::convex_body(n, A)); });
  };
  EXPECT_EQ(refusal(six, {1.0}), "convex_body: 1 areas for 6 normals; expected one for each");
  EXPECT_EQ(refusal({six[0], six[1], six[2]}, {1.0, 1.0, 1.0}),
            "convex_body: 3 facets; expected 4 or more");
  EXPECT_EQ(refusal(six, {1.0, 1.0, 1.0, 1.0, 1.0, -1.0}),
            "convex_body: area 6, -1, must be positive and finite");
  EXPECT_THAT(refusal(six, {9.0, 1.0, 1.0, 1.0, 1.0, 1.0}), HasSubstr("too far from 0"));
  EXPECT_THAT(refusal({six[0], six[1], six[2], six[3], six[0]}, {1.0, 2.0, 1.0, 1.0, 1.0}),
              HasSubstr("leave a side of the body open"));
  std::vector<Vec3> zero = six;
  zero[2] = {};
  EXPECT_THAT(refusal(zero, {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}), HasSubstr("normal 3 must be finite"));
}

}  // namespace
