// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "light/harmonics.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/light/gaussian_image.hpp"
#include "polhode/light/lambert.hpp"
#include "polhode/math/dual.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using oracle::Draw;
using test::Worst;

constexpr double pi_ = 3.141592653589793;

Vec3 drawn_direction(Draw& draw) {
  const Vec3 v{draw.normal(), draw.normal(), draw.normal()};
  return (1.0 / norm(v)) * v;
}

// sum over m of Y_lm(n) Y_lm(n') = (2 l + 1) P_l(n . n')
TEST(LightHarmonics, AddUpToLegendrePolynomials) {
  Draw draw(7, 1);
  Worst<> worst;
  constexpr int degree = 12;
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 n = trial == 0 ? Vec3{0.0, 0.0, 1.0} : drawn_direction(draw);
    const Vec3 m = drawn_direction(draw);
    const std::vector<double> Y = spherical_harmonics(degree, n);
    const std::vector<double> Z = spherical_harmonics(degree, m);
    for (int l = 0; l <= degree; ++l) {
      double sum = 0.0;
      for (int k = l * l; k < (l + 1) * (l + 1); ++k)
        sum += Y[static_cast<std::size_t>(k)] * Z[static_cast<std::size_t>(k)];
      const double P = std::legendre(static_cast<unsigned>(l), dot(n, m));
      worst.add(std::fabs(sum - (2.0 * l + 1.0) * P) / (2.0 * l + 1.0));
    }
  }
  EXPECT_LE(worst.value(), budget::light_harmonics);
  const std::vector<double> first = spherical_harmonics(1, {0.48, 0.6, 0.64});
  EXPECT_DOUBLE_EQ(first[0], 1.0);
  EXPECT_DOUBLE_EQ(first[1], std::sqrt(3.0) * 0.6);   // m = -1
  EXPECT_DOUBLE_EQ(first[2], std::sqrt(3.0) * 0.64);  // m = 0
  EXPECT_DOUBLE_EQ(first[3], std::sqrt(3.0) * 0.48);  // m = 1
}

TEST(LightGaussianImage, NormalsCoverTheSphere) {
  const GaussianImage image(2, 5);
  ASSERT_EQ(image.normals().size(), 200U);
  EXPECT_EQ(image.coefficient_count(), 9U);
  double sum = 0.0;
  Worst<> length;
  for (const double w : image.solid_angles()) {
    EXPECT_GT(w, 0.0);
    sum += w;
  }
  for (const Vec3& n : image.normals()) length.add(std::fabs(norm(n) - 1.0));
  EXPECT_NEAR(sum, 4.0 * pi_, budget::light_solid_angle);
  EXPECT_LE(length.value(), budget::light_solid_angle);
}

// A sphere and an ellipsoid in many facets against quadrature and closed form.
TEST(LightGaussianImage, BodiesOfKnownBrightness) {
  const GaussianImage image(8, 20);
  const Vec3 s{1.0, 0.5, -0.25}, o{0.5, 1.0, 0.5};
  std::vector<double> c(image.coefficient_count(), 0.0);
  c[0] = 2.0 * std::log(3.0);
  const Scattering law = Scattering::mixed(0.1);
  const auto error = [&](const std::vector<double>& coefficients, const Ellipsoid& body) {
    const std::vector<double> A = image.areas(coefficients);
    const double got = facet_brightness<double>(image.normals(), A, law, s, o);
    return got / brightness<32>(body, law, s, o) - 1.0;
  };
  EXPECT_NEAR(error(c, {3.0, 3.0, 3.0}), 0.0, budget::light_facets);
  const Ellipsoid body{1.5, 1.25, 1.0};
  const std::vector<double> near = image.coefficients(body);
  EXPECT_NEAR(error(near, body), 0.0, budget::light_facets);
  const Vec3 open = image.closure(image.areas(near));
  EXPECT_LE(norm(open), budget::light_closure);
}

TEST(LightGaussianImage, CoefficientsOfAreasThatHaveThem) {
  const GaussianImage image(3, 4);
  Draw draw(7, 2);
  std::vector<double> c(image.coefficient_count());
  for (double& x : c) x = 0.3 * draw.normal();
  const std::vector<double> back = image.coefficients(image.areas(c));
  for (std::size_t k = 0; k < c.size(); ++k) EXPECT_NEAR(back[k], c[k], budget::light_series_back);
}

// By coefficients, directions and weights: dual numbers through the template.
// Eight-fold symmetry: as many normals as coefficients do not always determine them.
TEST(LightGaussianImage, NormalsThatDoNotDetermineTheCoefficients) {
  for (const auto [degree, rows] : {std::array{4, 2}, std::array{6, 3}, std::array{7, 3},
                                    std::array{10, 4}, std::array{12, 5}, std::array{14, 6}}) {
    const GaussianImage few(degree, rows), enough(degree, rows + 1);
    EXPECT_THAT(test::message_of([&] { return few.coefficients(few.solid_angles()); }),
                testing::AllOf(testing::HasSubstr(" coefficients of degree " +
                                                  std::to_string(degree) + "; expected more rows"),
                               testing::HasSubstr(" normals of rows " + std::to_string(rows) +
                                                  " determine ")));
    std::vector<double> c(enough.coefficient_count());
    Draw draw(7, 4);
    for (double& x : c) x = 0.1 * draw.normal();
    const std::vector<double> back = enough.coefficients(enough.areas(c));
    for (std::size_t k = 0; k < c.size(); ++k)
      EXPECT_NEAR(back[k], c[k], budget::light_series_back);
  }
}

TEST(LightGaussianImage, GradientsAgreeWithDualNumbers) {
  constexpr std::size_t count = 9;
  using D = Dual<double, 17>;
  const GaussianImage image(2, 6);
  Draw draw(7, 3);
  Worst<> worst, closure;
  for (int trial = 0; trial < 5; ++trial) {
    std::array<D, 17> x;
    std::vector<double> c(count);
    for (int i = 0; i < 17; ++i) {
      const double value =
          i < 9 ? 0.3 * draw.normal() : (i < 15 ? draw.normal() : draw.uniform(0.1, 1.0));
      x[static_cast<std::size_t>(i)] = D::variable(value, i);
      if (i < 9) c[static_cast<std::size_t>(i)] = value;
    }
    std::vector<D> areas;
    BasicVec3<D> open;
    for (std::size_t j = 0; j < image.normals().size(); ++j) {
      D sum(0.0);
      for (std::size_t k = 0; k < count; ++k) sum += x[k] * image.harmonics(j)[k];
      areas.push_back(image.solid_angles()[j] * exp(sum));
      const Vec3& n = image.normals()[j];
      open = open + areas.back() * BasicVec3<D>{D(n.x), D(n.y), D(n.z)};
    }
    const BasicScattering<D> law{x[15], x[16]};
    const D dual = facet_brightness<D>(image.normals(), areas, law, {x[9], x[10], x[11]},
                                       {x[12], x[13], x[14]});
    const std::vector<double> A = image.areas(c);
    const FacetGradient got = facet_gradient(image.normals(), A, {x[15].value, x[16].value},
                                             {x[9].value, x[10].value, x[11].value},
                                             {x[12].value, x[13].value, x[14].value});
    std::vector<double> all = image.by_coefficients(got.by_areas, A);
    for (const double d : {got.by_sun.x, got.by_sun.y, got.by_sun.z, got.by_observer.x,
                           got.by_observer.y, got.by_observer.z, got.by_single, got.by_multiple})
      all.push_back(d);
    worst.add(std::fabs(got.value - dual.value));
    for (std::size_t i = 0; i < 17; ++i) worst.add(std::fabs(all[i] - dual.derivative[i]));
    const std::vector<Vec3> by = image.closure_gradient(A);
    for (std::size_t k = 0; k < count; ++k)
      for (int i = 0; i < 3; ++i) closure.add(std::fabs(by[k][i] - open[i].derivative[k]));
    EXPECT_NEAR(image.closure(A).x, open.x.value, budget::light_facet_gradient);
  }
  EXPECT_LE(worst.value(), budget::light_facet_gradient);
  EXPECT_LE(closure.value(), budget::light_facet_gradient);
}

// The Laplacian of Y_lm is -l (l + 1) Y_lm.
TEST(LightGaussianImage, RoughnessIsTheLaplacian) {
  EXPECT_THAT(GaussianImage(2, 2).roughness(),
              testing::ElementsAre(0.0, 2.0, 2.0, 2.0, 6.0, 6.0, 6.0, 6.0, 6.0));
}

TEST(LightGaussianImage, ErrorsNameWhatIsWrong) {
  EXPECT_MESSAGE(GaussianImage(41, 5), "GaussianImage: degree 41 must be from 0 to 40");
  EXPECT_MESSAGE(GaussianImage(2, 0), "GaussianImage: rows 0 must be from 1 to 200");
  EXPECT_MESSAGE(GaussianImage(3, 1),
                 "GaussianImage: 8 normals for 16 coefficients of degree 3; expected more rows");
  EXPECT_MESSAGE(GaussianImage(40, 200),
                 "GaussianImage: degree 40 with rows 200 has 537920000 harmonics; expected at most "
                 "16777216, of a lower degree or fewer rows");
  const GaussianImage image(1, 1);
  const std::vector<double> three(3, 1.0);
  EXPECT_MESSAGE(image.areas(three), "GaussianImage: got 3 coefficients; expected 4");
  EXPECT_MESSAGE(image.closure(three), "GaussianImage: got 3 areas; expected 8");
  std::vector<double> areas(8, 1.0);
  areas[2] = 0.0;
  EXPECT_MESSAGE(image.coefficients(areas),
                 "GaussianImage: area 3, 0, must be positive and finite");
  EXPECT_MESSAGE(facet_brightness<double>(image.normals(), three, {}, {1, 0, 0}, {1, 0, 0}),
                 "facet_brightness: 3 areas for 8 normals; expected one for each");
}

}  // namespace
