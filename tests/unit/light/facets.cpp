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
#include "polhode/light/convex_body.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/light/lommel_seeliger.hpp"
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
    const std::vector<double> Y = light::spherical_harmonics(degree, n);
    const std::vector<double> Z = light::spherical_harmonics(degree, m);
    for (int l = 0; l <= degree; ++l) {
      double sum = 0.0;
      for (int k = l * l; k < (l + 1) * (l + 1); ++k)
        sum += Y[static_cast<std::size_t>(k)] * Z[static_cast<std::size_t>(k)];
      const double P = std::legendre(static_cast<unsigned>(l), dot(n, m));
      worst.add(std::fabs(sum - (2.0 * l + 1.0) * P) / (2.0 * l + 1.0));
    }
  }
  EXPECT_LE(worst.value(), budget::light_harmonics);
  const std::vector<double> first = light::spherical_harmonics(1, {0.48, 0.6, 0.64});
  EXPECT_DOUBLE_EQ(first[0], 1.0);
  EXPECT_DOUBLE_EQ(first[1], std::sqrt(3.0) * 0.6);   // m = -1
  EXPECT_DOUBLE_EQ(first[2], std::sqrt(3.0) * 0.64);  // m = 0
  EXPECT_DOUBLE_EQ(first[3], std::sqrt(3.0) * 0.48);  // m = 1
}

TEST(LightGaussianImage, NormalsCoverTheSphere) {
  const light::GaussianImage image(2, 5);
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
  const light::GaussianImage image(8, 20);
  const Vec3 s{1.0, 0.5, -0.25}, o{0.5, 1.0, 0.5};
  std::vector<double> c(image.coefficient_count(), 0.0);
  c[0] = 2.0 * std::log(3.0);
  const light::Scattering law = light::Scattering::mixed(0.1);
  const auto error = [&](const std::vector<double>& coefficients, const light::Ellipsoid& body) {
    const std::vector<double> A = image.areas(coefficients);
    const double got = light::facet_brightness<double>(image.normals(), A, law, s, o);
    return got / light::brightness<32>(body, law, s, o) - 1.0;
  };
  EXPECT_NEAR(error(c, {3.0, 3.0, 3.0}), 0.0, budget::light_facets);
  const light::Ellipsoid body{1.5, 1.25, 1.0};
  const std::vector<double> near = image.coefficients(body);
  EXPECT_NEAR(error(near, body), 0.0, budget::light_facets);
  const Vec3 open = image.closure(image.areas(near));
  EXPECT_LE(norm(open), budget::light_closure);
}

TEST(LightGaussianImage, CoefficientsOfAreasThatHaveThem) {
  const light::GaussianImage image(3, 4);
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
    const light::GaussianImage few(degree, rows), enough(degree, rows + 1);
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
  const light::GaussianImage image(2, 6);
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
    const light::BasicScattering<D> law{x[15], x[16]};
    const D dual = light::facet_brightness<D>(image.normals(), areas, law, {x[9], x[10], x[11]},
                                              {x[12], x[13], x[14]});
    const std::vector<double> A = image.areas(c);
    const light::FacetGradient got = light::facet_gradient(
        image.normals(), A, {x[15].value, x[16].value}, {x[9].value, x[10].value, x[11].value},
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
  EXPECT_THAT(light::GaussianImage(2, 2).roughness(),
              testing::ElementsAre(0.0, 2.0, 2.0, 2.0, 6.0, 6.0, 6.0, 6.0, 6.0));
}

TEST(LightGaussianImage, ErrorsNameWhatIsWrong) {
  EXPECT_MESSAGE(light::GaussianImage(41, 5), "GaussianImage: degree 41 must be from 0 to 40");
  EXPECT_MESSAGE(light::GaussianImage(2, 0), "GaussianImage: rows 0 must be from 1 to 200");
  EXPECT_MESSAGE(light::GaussianImage(3, 1),
                 "GaussianImage: 8 normals for 16 coefficients of degree 3; expected more rows");
  EXPECT_MESSAGE(light::GaussianImage(40, 200),
                 "GaussianImage: degree 40 with rows 200 has 537920000 harmonics; expected at most "
                 "16777216, of a lower degree or fewer rows");
  const light::GaussianImage image(1, 1);
  const std::vector<double> three(3, 1.0);
  EXPECT_MESSAGE(image.areas(three), "GaussianImage: got 3 coefficients; expected 4");
  EXPECT_MESSAGE(image.closure(three), "GaussianImage: got 3 areas; expected 8");
  std::vector<double> areas(8, 1.0);
  areas[2] = 0.0;
  EXPECT_MESSAGE(image.coefficients(areas),
                 "GaussianImage: area 3, 0, must be positive and finite");
  EXPECT_MESSAGE(light::facet_brightness<double>(image.normals(), three, {}, {1, 0, 0}, {1, 0, 0}),
                 "facet_brightness: 3 areas for 8 normals; expected one for each");
}

// Facets that stand for patches: smooth at terminators, and nearer to a smooth body than flat ones.

// The means over a kernel: m has the area below it of max(u, 0), M more; both join it with three
// derivatives.
TEST(LightPatch, CosinesAreMeansOverKernels) {
  using D = Dual<Dual<double, 1>, 1>;
  const auto at = [](double u) {
    const D x(Dual<double, 1>::variable(u, 0), {Dual<double, 1>(1.0)});
    return light::BasicSoftCosine<D>::at(x, 1.0);
  };
  double even = 0.0, positive = 0.0, lowest = 1.0;
  constexpr int steps = 4000;  // polynomials of degree 8, by the rule of the middle
  for (int i = 0; i < steps; ++i) {
    const double u = -1.0 + (2.0 * i + 1.0) / steps;
    const auto m = light::BasicSoftCosine<double>::at(u, 1.0);
    even += (m.even - test::larger(u, 0.0)) * 2.0 / steps;
    positive += (m.positive - test::larger(u, 0.0)) * 2.0 / steps;
    lowest = test::smaller(lowest, m.even);
    EXPECT_GT(m.positive, 0.0);
  }
  EXPECT_NEAR(even, 0.0, budget::light_patch_mean);
  EXPECT_NEAR(positive, 1.0 / 14.0, budget::light_patch_mean);  // half of the mean square, 1 / 7
  EXPECT_NEAR(lowest, -0.01639, budget::light_patch_lowest);
  for (const double end : {-1.0, 1.0}) {
    const auto m = at(end * (1.0 - 1e-9));
    for (const D& x : {m.even, m.positive}) {
      EXPECT_NEAR(x.value.value, end > 0.0 ? 1.0 : 0.0, budget::light_patch_joint);
      EXPECT_NEAR(x.derivative[0].value, end > 0.0 ? 1.0 : 0.0, budget::light_patch_joint);
      EXPECT_NEAR(x.derivative[0].derivative[0], 0.0, budget::light_patch_joint);
    }
  }
}

// Of one factor for all directions, as fits have it: the scatter about it, flat facets beside
// patches.
TEST(LightPatch, IsNearerToSmoothBodiesThanFlatFacets) {
  for (const light::Ellipsoid& body :
       {light::Ellipsoid{1.0, 1.0, 1.0}, light::Ellipsoid{1.0, 0.8, 0.6},
        light::Ellipsoid{1.0, 0.5, 0.35}}) {
    for (const int rows : {5, 8, 12}) {
      const light::GaussianImage image(0, rows);
      std::vector<double> areas;  // as they are, not of a series
      for (std::size_t j = 0; j < image.normals().size(); ++j) {
        const Vec3& n = image.normals()[j];
        const Vec3 stretched{body.a * n.x, body.b * n.y, body.c * n.z};
        const double curvature = body.a * body.b * body.c / dot(stretched, stretched);
        areas.push_back(image.solid_angles()[j] * curvature * curvature);
      }
      Draw draw(7, 5);
      const light::Scattering law = light::Scattering::mixed(0.1);
      double flat[2] = {}, patch[2] = {};
      constexpr int count = 300;
      for (int k = 0; k < count; ++k) {
        const Vec3 s = drawn_direction(draw);
        Vec3 o = drawn_direction(draw);
        o = o + 2.0 * s;  // phase angles of 30 deg at most
        const double truth = light::brightness<32>(body, law, s, o);
        const double f = light::facet_brightness<double>(image.normals(), areas, law, s, o) / truth;
        const double p =
            light::patch_brightness<double>(image.normals(), image.widths(), areas, law, s, o) /
            truth;
        flat[0] += f / count;
        flat[1] += f * f / count;
        patch[0] += p / count;
        patch[1] += p * p / count;
      }
      const double of_flat = std::sqrt(flat[1] - flat[0] * flat[0]);
      const double of_patch = std::sqrt(patch[1] - patch[0] * patch[0]);
      EXPECT_LE(of_patch, budget::light_patch_scatter * of_flat) << rows << ' ' << body.b;
      EXPECT_NEAR(patch[0], 1.0, budget::light_patch_bias / (rows * rows)) << rows << ' ' << body.b;
    }
  }
}

// By areas, directions and weights: dual numbers through the template.
TEST(LightPatch, GradientsAgreeWithDualNumbers) {
  using D = Dual<double, 8>;
  const light::GaussianImage image(0, 6);
  Draw draw(7, 6);
  Worst<> worst;
  for (int trial = 0; trial < 20; ++trial) {
    std::array<D, 8> x;
    for (int i = 0; i < 8; ++i)
      x[static_cast<std::size_t>(i)] =
          D::variable(i < 6 ? draw.normal() : draw.uniform(0.1, 1.0), i);
    std::vector<double> areas;
    for (const double w : image.solid_angles()) areas.push_back(w * draw.uniform(0.5, 2.0));
    const std::vector<D> dual_areas(areas.begin(), areas.end());
    const D dual = light::patch_brightness<D>(image.normals(), image.widths(), dual_areas,
                                              {x[6], x[7]}, {x[0], x[1], x[2]}, {x[3], x[4], x[5]});
    const Vec3 s{x[0].value, x[1].value, x[2].value}, o{x[3].value, x[4].value, x[5].value};
    const light::Scattering law{x[6].value, x[7].value};
    const light::FacetGradient got =
        light::patch_gradient(image.normals(), image.widths(), areas, law, s, o);
    const double all[] = {got.by_sun.x,      got.by_sun.y,      got.by_sun.z,  got.by_observer.x,
                          got.by_observer.y, got.by_observer.z, got.by_single, got.by_multiple};
    worst.add(std::fabs(got.value - dual.value));
    for (std::size_t i = 0; i < 8; ++i) worst.add(std::fabs(all[i] - dual.derivative[i]));
    double sum = 0.0;
    for (std::size_t j = 0; j < areas.size(); ++j) sum += areas[j] * got.by_areas[j];
    worst.add(std::fabs(sum - got.value));
  }
  EXPECT_LE(worst.value(), budget::light_facet_gradient);
}

// The slopes that the struct gives beside its values are theirs, within the width and beyond.
TEST(LightPatch, SlopesAreThoseOfTheValues) {
  using D = Dual<double, 1>;
  Worst<> worst;
  for (const double h : {0.07, 1.0}) {
    for (int i = -1200; i <= 1200; ++i) {
      const D mu = D::variable(h * i / 1000.0, 0);
      const auto m = light::BasicSoftCosine<D>::at(mu, h);
      worst.add(std::fabs(m.even.derivative[0] - m.even_slope.value));
      worst.add(std::fabs(m.positive.derivative[0] - m.positive_slope.value));
      EXPECT_EQ(m.positive.value == 0.0, mu.value <= -h);
    }
  }
  EXPECT_LE(worst.value(), budget::light_patch_slope);
}

// Just above -h, where m and M are e^4 of h, with the Sun and the observer in one direction and in
// two that are near: value and gradient are finite, and one is the derivative of the other.
TEST(LightPatch, BeginsWithoutNaN) {
  using D = Dual<double, 6>;
  const std::vector<Vec3> normal{{0.0, 0.0, 1.0}};
  const std::vector<double> area{1.0}, width{0.17};
  const std::vector<D> dual_area{D(1.0)};
  const light::Scattering law{0.7, 0.2};
  const light::BasicScattering<D> dual_law{D(0.7), D(0.2)};
  const auto at = [&](double e) {
    const double mu = width[0] * (e - 1.0);
    return Vec3{std::sqrt(1.0 - mu * mu), 0.0, mu};
  };
  Worst<> worst;
  const auto look = [&](const Vec3& s, const Vec3& o) {
    const light::FacetGradient got = light::patch_gradient(normal, width, area, law, s, o);
    std::array<D, 6> x;
    for (int i = 0; i < 3; ++i) {
      x[static_cast<std::size_t>(i)] = D::variable(s[i], i);
      x[static_cast<std::size_t>(i + 3)] = D::variable(o[i], i + 3);
    }
    const D dual = light::patch_brightness<D>(normal, width, dual_area, dual_law,
                                              {x[0], x[1], x[2]}, {x[3], x[4], x[5]});
    const double all[] = {got.by_sun.x,      got.by_sun.y,      got.by_sun.z,
                          got.by_observer.x, got.by_observer.y, got.by_observer.z};
    Worst<> size, off;
    for (std::size_t i = 0; i < 6; ++i) {
      size.add(std::fabs(all[i]));
      off.add(std::fabs(all[i] - dual.derivative[i]));
    }
    EXPECT_GT(got.value, 0.0);
    EXPECT_TRUE(std::isfinite(got.by_single) && std::isfinite(got.by_multiple));
    EXPECT_TRUE(std::isfinite(size.value()));
    worst.add(std::fabs(got.value - dual.value) / got.value);
    worst.add(off.value() / size.value());
  };
  look(at(1e-6), at(1e-6));
  constexpr int count = 100000;
  for (int k = 0; k <= count; ++k) {
    const double e = std::pow(10.0, -8.0 + 5.0 * k / count);
    look(at(e), at(e));
    look(at(e * (1.0 + 0.3 * std::sin(k))), at(e));
    look(at(e) + Vec3{0.0, 1e-9, 0.0}, at(e));
  }
  EXPECT_LE(worst.value(), budget::light_patch_begin);
}

TEST(LightPatch, ErrorsNameWhatIsWrong) {
  const light::GaussianImage image(0, 1);
  const std::vector<double> eight(8, 1.0), three(3, 1.0);
  const auto refusal = [&](const std::vector<double>& widths, const std::vector<double>& areas) {
    return test::message_of([&] {
      return light::patch_brightness<double>(image.normals(), widths, areas, {}, {1, 0, 0},
                                             {1, 0, 0});
    });
  };
  EXPECT_EQ(refusal(three, eight),
            "patch_brightness: 3 widths for 8 normals; expected one for each");
  EXPECT_EQ(refusal(eight, three),
            "facet_brightness: 3 areas for 8 normals; expected one for each");
  EXPECT_MESSAGE(light::patch_gradient(image.normals(), three, eight, {}, {1, 0, 0}, {1, 0, 0}),
                 "patch_brightness: 3 widths for 8 normals; expected one for each");
}

}  // namespace
