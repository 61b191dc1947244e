// SPDX-License-Identifier: MIT
#include "polhode/shape/mass_properties.hpp"

#include <gmock/gmock.h>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "oracle/wide_real.hpp"
#include "unit/shape/solids.hpp"
#include "worst.hpp"

namespace shape_test {
namespace {

using namespace oracle;
using namespace polhode;
using polhode::test::larger;
using polhode::test::Worst;
using ::testing::HasSubstr;

constexpr double eps = 0x1p-52;

Mat3 drawn_map(Draw& draw) {
  for (;;) {
    Mat3 A;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) A(i, j) = draw.normal();
    if (dot(A.row[0], cross(A.row[1], A.row[2])) > 0.1) return A;
  }
}
double determinant(const Mat3& A) { return dot(A.row[0], cross(A.row[1], A.row[2])); }

// What a uniform tetrahedron of density 1 has about its own centre, exact: the mean of a product of
// barycentric coordinates is that of a Dirichlet distribution, 3! n1! n2! n3! n4! / (3 + d)!.
template <int degree>
shape::BasicMoments<Wide, degree> exact_moments(const std::array<WideVec3, 4>& v,
                                                const Wide& volume) {
  shape::BasicMoments<Wide, degree> out{};
  const auto factorial = [](int n) {
    double f = 1.0;
    for (int i = 2; i <= n; ++i) f *= i;
    return f;
  };
  int tuples = 1;
  for (int i = 0; i < degree; ++i) tuples *= 4;
  for (int c = 0; c <= degree; ++c) {
    for (int b = 0; b + c <= degree; ++b) {
      Wide sum = 0;
      for (int tuple = 0; tuple < tuples; ++tuple) {
        std::array<int, 4> count{};
        Wide product = 1;
        for (int place = 0, rest = tuple; place < degree; ++place, rest /= 4) {
          const auto corner = static_cast<std::size_t>(rest % 4);
          ++count[corner];
          product *= v[corner][place < degree - b - c ? 0 : (place < degree - c ? 1 : 2)];
        }
        double weight = 6.0;
        for (const int n : count) weight *= factorial(n);
        sum += Wide(weight) / factorial(3 + degree) * product;
      }
      out[shape::moment_place(b, c)] = volume * sum;
    }
  }
  return out;
}

template <std::size_t size>
double worst_of(const std::array<double, size>& got, const std::array<Wide, size>& want,
                double scale) {
  Worst worst;
  for (std::size_t i = 0; i < size; ++i)
    worst.add(std::abs(static_cast<double>(got[i] - want[i])) / scale);
  return worst.value();
}

// Far from the origin too: coordinates are then rounded, but to numbers that both sides have.
TEST(MassProperties, OfATetrahedron) {
  Worst worst;
  for (std::uint64_t i = 0; i < 200; ++i) {
    Draw draw(901, i);
    const Mat3 A = drawn_map(draw);
    const Vec3 far = i % 2 == 0 ? Vec3{} : Vec3{30.0, -50.0, 20.0};
    const std::array<Vec3, 4> v{far, far + A * Vec3{1, 0, 0}, far + A * Vec3{0, 1, 0},
                                far + A * Vec3{0, 0, 1}};
    const shape::MassProperties got = shape::mass_properties(tetrahedron(v), 2.0);
    std::array<WideVec3, 4> w;
    WideVec3 centre;
    for (std::size_t k = 0; k < 4; ++k) w[k] = widened(v[k]);
    for (const WideVec3& x : w) centre = centre + Wide(0.25) * x;
    const Wide volume = dot(w[1] - w[0], cross(w[2] - w[0], w[3] - w[0])) / 6;
    double size = 0.0;
    for (WideVec3& x : w) {
      x = x - centre;
      size = larger(size, static_cast<double>(sqrt(dot(x, x))));
    }
    // volumes of thin ones cancel
    const double bulk = size * size * size, mass = 2.0 * bulk;
    EXPECT_LE(std::abs(static_cast<double>(got.volume - volume)) / bulk, budget::shape_mass * eps);
    EXPECT_EQ(got.mass, 2.0 * got.volume);
    const auto two = exact_moments<2>(w, 2 * volume);
    const Wide xx = two[shape::moment_place(0, 0)], yy = two[shape::moment_place(2, 0)],
               zz = two[shape::moment_place(0, 2)];
    const Wide inertia[] = {yy + zz, xx + zz, xx + yy};
    for (int k = 0; k < 3; ++k)
      worst.add(std::abs(static_cast<double>(got.inertia(k, k) - inertia[k])) /
                (mass * size * size));
    worst.add(std::abs(static_cast<double>(got.inertia(0, 1) + two[1])) / (mass * size * size));
    const auto third = exact_moments<3>(w, 2 * volume);
    const auto fourth = exact_moments<4>(w, 2 * volume);
    worst.add(worst_of(got.moments.third, third, mass * std::pow(size, 3)));
    worst.add(worst_of(got.moments.fourth, fourth, mass * std::pow(size, 4)));
  }
  EXPECT_LE(worst.value(), budget::shape_mass * eps);
}

// A box in closed form, and its affine image through the rule of change of variables.
TEST(MassProperties, OfABoxAndItsImages) {
  const double a = 1.5, b = 1.0, c = 0.25, m = 3.0 * 8.0 * a * b * c;
  shape::BasicMassMoments<double> want;
  want.fourth[shape::moment_place(0, 0)] = m * a * a * a * a / 5.0;
  want.fourth[shape::moment_place(4, 0)] = m * b * b * b * b / 5.0;
  want.fourth[shape::moment_place(0, 4)] = m * c * c * c * c / 5.0;
  want.fourth[shape::moment_place(2, 0)] = m * a * a * b * b / 9.0;
  want.fourth[shape::moment_place(0, 2)] = m * a * a * c * c / 9.0;
  want.fourth[shape::moment_place(2, 2)] = m * b * b * c * c / 9.0;
  const shape::FacetShape shape = box(a, b, c);
  const shape::MassProperties got = shape::mass_properties(shape, 3.0);
  EXPECT_NEAR(got.mass, m, budget::shape_mass * eps * m);
  EXPECT_NEAR(shape.area(), 8.0 * (a * b + b * c + c * a), budget::shape_mass * eps);
  const Vec3 I{m * (b * b + c * c) / 3.0, m * (a * a + c * c) / 3.0, m * (a * a + b * b) / 3.0};
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(got.inertia(k, k), I[k], budget::shape_mass * eps * I.z) << k;
  for (std::size_t k = 0; k < want.fourth.size(); ++k)
    EXPECT_NEAR(got.moments.fourth[k], want.fourth[k], budget::shape_mass * eps * m) << k;
  for (const double third : got.moments.third)
    EXPECT_NEAR(third, 0.0, budget::shape_mass * eps * m);
  for (std::uint64_t i = 0; i < 50; ++i) {
    Draw draw(902, i);
    const Mat3 A = drawn_map(draw);
    const Vec3 to{draw.normal(), draw.normal(), draw.normal()};
    const shape::MassProperties at = shape::mass_properties(image(shape, A, to), 3.0);
    const double stretch = determinant(A);
    double size = 0.0;
    for (const Vec3& row : A.row) size = larger(size, 2.0 * norm(row));
    const double bulk = 3.0 * std::pow(size, 3), scale = budget::shape_mass * eps * bulk;
    EXPECT_LE(norm(at.centre - to) * at.mass, scale * (size + norm(to)));
    const auto fourth = shape::rotated_moments<4>(want.fourth, A);
    for (std::size_t k = 0; k < fourth.size(); ++k)
      EXPECT_NEAR(at.moments.fourth[k], stretch * fourth[k], scale * std::pow(size, 4)) << k;
    // the tensor of second moments is A S A^T
    const Mat3 S{{{m * a * a / 3.0, 0, 0}, {0, m * b * b / 3.0, 0}, {0, 0, m * c * c / 3.0}}};
    const Mat3 two = A * S * transpose(A);
    EXPECT_NEAR(at.inertia(0, 0), stretch * (two(1, 1) + two(2, 2)), scale * size * size);
    EXPECT_NEAR(at.inertia(0, 1), -stretch * two(0, 1), scale * size * size);
  }
}

// The mesh is inside: errors fall as the fourth power of two per division, and what is left after
// two steps of extrapolation is the ellipsoid.
TEST(MassProperties, OfAnEllipsoidInTheLimit) {
  const double a = 3.0, b = 2.0, c = 1.0;
  const auto numbers = [&](int level) -> std::array<double, 4> {
    const shape::MassProperties p = shape::mass_properties(ellipsoid(a, b, c, level), 1.0);
    return {p.mass, p.inertia(0, 0), p.moments.fourth[shape::moment_place(0, 0)],
            p.moments.fourth[shape::moment_place(2, 2)]};
  };
  const double m = 4.0 / 3.0 * 3.141592653589793 * a * b * c;
  const std::array<double, 4> want{m, m * (b * b + c * c) / 5.0, 3.0 * m * a * a * a * a / 35.0,
                                   m * b * b * c * c / 35.0};
  const auto coarse = numbers(4), fine = numbers(5), finest = numbers(6);
  for (std::size_t k = 0; k < 4; ++k) {
    const double one = (4.0 * fine[k] - coarse[k]) / 3.0, two = (4.0 * finest[k] - fine[k]) / 3.0;
    EXPECT_NEAR((16.0 * two - one) / 15.0 / want[k], 1.0, budget::shape_limit) << k;
    EXPECT_GT(1.0 - coarse[k] / want[k], 100.0 * budget::shape_limit) << k;
  }
}

TEST(MassProperties, PrincipalAxes) {
  Draw draw(903, 0);
  const shape::MassProperties p =
      shape::mass_properties(image(box(1.5, 1.0, 0.5), drawn_map(draw), {}), 2.0);
  const Body principal = shape::body(p);
  const Mat3 R = rotation_matrix(conj(principal.q_FB()));
  const Mat3 I = R * p.inertia * transpose(R);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(I(k, k), principal.moments()[k], budget::body_tensor * norm(principal.moments()));
  const shape::MassMoments along = shape::principal_moments(p, principal);
  // traces do not turn
  const auto square = [](const shape::MassMoments& m) {
    const auto& f = m.fourth;
    return f[shape::moment_place(0, 0)] + f[shape::moment_place(4, 0)] +
           f[shape::moment_place(0, 4)] +
           2.0 * (f[shape::moment_place(2, 0)] + f[shape::moment_place(0, 2)] +
                  f[shape::moment_place(2, 2)]);
  };
  EXPECT_NEAR(square(along), square(p.moments), budget::shape_mass * eps * square(p.moments));
}

TEST(FacetShape, FacetsByHand) {
  const shape::FacetShape shape({{0, 0, 1}, {3, 0, 1}, {0, 4, 1}}, {{0, 1, 2}});
  const shape::Facet& f = shape.facets()[0];
  EXPECT_EQ(f.area, 6.0);
  EXPECT_EQ(f.normal, (Vec3{0, 0, 1}));
  EXPECT_NEAR(norm(f.centre - Vec3{1, 4.0 / 3.0, 1}), 0.0, budget::shape_mass * eps);
  const shape::FacetShape twice = shape.moved({0, 0, 1}, 2.0);
  EXPECT_EQ(twice.vertices()[1], (Vec3{6, 0, 0}));
  EXPECT_EQ(twice.area(), 24.0);
}

TEST(FacetShape, RefusesWithTheNumberOfTheFacet) {
  const std::vector<Vec3> v{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  EXPECT_REJECTED(shape::FacetShape(v, {}), "no facets");
  EXPECT_REJECTED(shape::FacetShape(v, {{0, 1, 3}, {0, 1, 2}}),
                  "facet 2, corners (0, 0, 0), (1, 0, 0), (2, 0, 0), has no area");
  EXPECT_REJECTED(shape::FacetShape(v, {{0, 1, 1}}), "facet 1");
  EXPECT_REJECTED(shape::FacetShape(v, {{0, 1, 4}}), "vertex 5 of 4");
  EXPECT_REJECTED(shape::FacetShape({{0, 0, 0}, {1, NAN, 0}, {0, 1, 0}}, {{0, 1, 2}}),
                  "vertex 2 (1, nan, 0) must be finite");
  // a sliver next to the rounding of coordinates at 1e6
  EXPECT_REJECTED(
      shape::FacetShape({{1e6, 0, 0}, {1e6 + 1, 0, 0}, {1e6 + 2, 1e-11, 0}}, {{0, 1, 2}}),
      "has no area");
}

TEST(FacetShape, SaysWhichEdgeIsOpen) {
  const shape::FacetShape whole = box(1, 1, 1);
  EXPECT_TRUE(whole.is_closed());
  std::vector<Vec3> v(whole.vertices().begin(), whole.vertices().end());
  std::vector<shape::FacetShape::Triangle> t(whole.triangles().begin(), whole.triangles().end());
  auto open = t;
  open.pop_back();
  EXPECT_EQ(shape::FacetShape(v, open).open_edge(),
            "edge 2-6 of facet 5 has no facet on its other side");
  auto turned = t;
  std::swap(turned[4][0], turned[4][1]);
  EXPECT_THAT(shape::FacetShape(v, turned).open_edge(), HasSubstr("one of them is inside out"));
  EXPECT_REJECTED(shape::mass_properties(shape::FacetShape(v, open), 1.0),
                  "mass_properties: the mesh is not closed: edge 2-6");
  for (auto& f : t) std::swap(f[0], f[1]);
  EXPECT_REJECTED(shape::mass_properties(shape::FacetShape(v, t), 1.0),
                  "volume -8 must be positive");
  EXPECT_REJECTED(shape::mass_properties(whole, -1.0), "density -1");
}

// Two boxes that share an edge: four facets meet there, and the volume is that of both.
TEST(FacetShape, FourFacetsAtAnEdgeAreClosed) {
  const shape::FacetShape one = box(1, 1, 1);
  std::vector<Vec3> v(one.vertices().begin(), one.vertices().end());
  std::vector<shape::FacetShape::Triangle> t(one.triangles().begin(), one.triangles().end());
  // the second is moved by (2, 2, 0): its vertices 0 and 4 are 3 and 7 of the first
  std::array<std::uint32_t, 8> place{};
  for (std::uint32_t i = 0; i < 8; ++i) {
    place[i] = i == 0 ? 3 : (i == 4 ? 7 : static_cast<std::uint32_t>(v.size()));
    if (i != 0 && i != 4) v.push_back(one.vertices()[i] + Vec3{2, 2, 0});
  }
  for (const auto& [a, b, c] : one.triangles()) t.push_back({place[a], place[b], place[c]});
  const shape::MassProperties p = shape::mass_properties(shape::FacetShape(v, t), 1.0);
  EXPECT_NEAR(p.volume, 16.0, budget::shape_mass * eps * 16.0);
  EXPECT_NEAR(norm(p.centre - Vec3{1, 1, 0}), 0.0, budget::shape_mass * eps);
}

}  // namespace
}  // namespace shape_test
