// SPDX-License-Identifier: MIT
// Residuals of convex bodies and of given meshes as functions of the unknowns: derivatives against
// differences in double-double, priors, and what a fit comes to.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/fit/least_squares.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "unit/light/meshes.hpp"
#include "wide_motion.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using DD = DoubleDouble;

// How far each unknown is from where it begins.
using Offsets = std::function<DD(std::size_t)>;
using Light = std::function<DD(const light::BasicScattering<DD>& law, const BasicVec3<DD>& s,
                               const BasicVec3<DD>& o)>;

// (flux - f B) / sigma of one session: unknowns are the turn, to second order, w, ratios of moments
// and the weight of Lambert's law.
std::vector<DD> wide_light(const fit::SpinState& spin, const light::Scattering& weights,
                           const light::LightCurve& curve, const Offsets& off, const Light& light) {
  const DD half(0.5), one(1.0);
  const Quaternion& q0 = spin.q;
  BasicQuaternion<DD> q{DD(q0.w), DD(q0.x), DD(q0.y), DD(q0.z)};
  q = q * BasicQuaternion<DD>{one, half * off(0), half * off(1), half * off(2)};
  const DD size = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  q = {q.w / size, q.x / size, q.y / size, q.z / size};
  const Mat3& T = spin.inertia_F;
  const BasicVec3<DD> I{DD(T(0, 0)) + off(6), DD(T(1, 1)) + off(7), one};
  WideMotion motion{
      q,
      {I.x * (DD(spin.w_F.x) + off(3)), I.y * (DD(spin.w_F.y) + off(4)), DD(spin.w_F.z) + off(5)},
      I};
  const light::BasicScattering<DD> law{DD(weights.single), DD(weights.multiple) + off(8)};
  DD now(spin.t0), up(0.0), down(0.0);
  std::vector<DD> B, r;
  for (const light::LightPoint& p : curve.points) {
    motion.advance(DD(p.t) - now);
    now = DD(p.t);
    const auto back = conj(motion.q);
    const auto wide = [](const Vec3& v) { return BasicVec3<DD>{DD(v.x), DD(v.y), DD(v.z)}; };
    B.push_back(light(law, rotate(back, wide(p.to_sun)), rotate(back, wide(p.to_observer))));
    const DD w = one / (DD(p.sigma) * DD(p.sigma));
    up += w * DD(p.flux) * B.back();
    down += w * B.back() * B.back();
  }
  for (std::size_t i = 0; i < B.size(); ++i) {
    const light::LightPoint& p = curve.points[i];
    r.push_back((DD(p.flux) - up / down * B[i]) / DD(p.sigma));
  }
  return r;
}

// Numbers and derivatives of a function at its start, these of the largest of their column, against
// `numbers`, all of them with those of priors, and central differences of these.
void expect_derivatives(const fit::LeastSquares& problem,
                        const std::function<std::vector<DD>(const Offsets&)>& numbers) {
  const fit::ResidualFunction f(problem);
  const std::size_t n = f.unknowns(), m = f.size();
  std::vector<double> x, r(m), J(m * n);
  for (const fit::Unknown& u : problem.unknowns) x.push_back(u.start);
  EXPECT_TRUE(f.at(x, r, J));
  const DD h(0x1p-30);
  const auto at = [&](std::size_t k, const DD& by) {
    return numbers([&](std::size_t j) { return j == k ? by : DD(0.0); });
  };
  const std::vector<DD> middle = at(n, DD(0.0));
  EXPECT_EQ(middle.size(), m);
  Worst<> worst;
  for (std::size_t i = 0; i < m; ++i)
    worst.add(std::abs(static_cast<double>(middle[i]) - r[i]) / larger(1.0, std::abs(r[i])));
  for (std::size_t k = 0; k < n; ++k) {
    const std::vector<DD> above = at(k, h), below = at(k, -h);
    double largest = 0.0;
    Worst<> off;
    for (std::size_t i = 0; i < m; ++i) {
      const double slope = static_cast<double>((above[i] - below[i]) / (DD(2.0) * h));
      largest = larger(largest, std::abs(slope));
      off.add(std::abs(J[i * n + k] - slope));
    }
    worst.add(off.value() / largest, problem.unknowns[k].name);
  }
  EXPECT_LE(worst.value(), budget::light_derivatives) << worst.where();
}

// One end of it thicker and its sides flattened.
fit::LightFit egg_fit() {
  fit::LightFit fit{{}, {}, {true, fit::MomentSource::fit, true}, {}, 100};
  const light::GaussianImage image(3, 4);
  std::vector<double> c = image.coefficients(polhode::light::Ellipsoid{1.2, 1.0, 0.6});
  for (std::size_t k = 9; k < 16; ++k) c[k] += 0.1 * std::cos(3.0 * static_cast<double>(k));
  fit.start = {in_short_axis_mode.spin, fit::ConvexShape{image, c}, light::Scattering::mixed(0.2)};
  fit.start.spin.w_F.x *= 1.01;
  fit.start.spin.inertia_F(0, 0) *= 1.05;
  fit.regularisation.about = in_short_axis_mode;
  fit.curves = {night(in_short_axis_mode, 2.0, 40, 0.02, 3)};
  return fit;
}

TEST(SurfaceFunctions, ConvexDerivativesAreThoseOfDifferencesInDoubleDouble) {
  const fit::LightFit fit = egg_fit();
  const fit::LightModel& from = fit.start;
  const fit::LightModel& about = *fit.regularisation.about;
  const light::GaussianImage& image = from.convex().image;
  const polhode::light::Ellipsoid& e = about.ellipsoid();
  const std::vector<double> usual =
      image.coefficients(polhode::light::Ellipsoid{e.a / e.b, 1.0, e.c / e.b});
  std::vector<double> whole = from.convex().coefficients;
  whole[0] = usual[0];
  const std::vector<double> A0 = image.areas(whole);
  constexpr std::size_t own = 9;  // after the turn, w, moments and the weight
  const auto numbers = [&](const Offsets& off) {
    std::vector<DD> A;
    for (std::size_t j = 0; j < A0.size(); ++j) {
      DD sum(0.0);
      for (std::size_t k = 1; k < whole.size(); ++k)
        sum += DD(image.harmonics(j)[k]) * off(own + k - 1);
      A.push_back(DD(A0[j]) * (DD(1.0) + sum + DD(0.5) * sum * sum));  // exp(sum)
    }
    std::vector<DD> all = wide_light(
        from.spin, from.law, fit.curves[0], off,
        [&](const light::BasicScattering<DD>& law, const BasicVec3<DD>& s, const BasicVec3<DD>& o) {
          return light::patch_brightness<DD>(image.normals(), image.widths(), A, law, s, o);
        });
    DD total(0.0);
    for (const DD& a : A) total += a;
    for (int k = 0; k < 6; ++k) {
      DD sum(0.0);
      for (std::size_t j = 0; j < A.size(); ++j) {
        const Vec3& n = image.normals()[j];
        const int next = (k + 1) % 3;
        sum += A[j] * (k < 3 ? DD(n[k]) : DD(n[k - 3]) * DD(n[next]));
      }
      all.push_back(sum / total /
                    DD(k < 3 ? fit.regularisation.closure_error : fit.regularisation.axes_error));
    }
    for (std::size_t k = 1; k < whole.size(); ++k) {
      const double l = std::floor(std::sqrt(static_cast<double>(k)));
      all.push_back(DD(l * (l + 1.0) / fit.regularisation.roughness_error) *
                    (DD(whole[k]) - DD(usual[k]) + off(own + k - 1)));
    }
    for (int k = 0; k < 2; ++k)
      all.push_back((DD(from.spin.inertia_F(k, k)) - DD(about.spin.inertia_F(k, k)) +
                     off(6 + static_cast<std::size_t>(k))) /
                    DD(fit.regularisation.moments_error));
    return all;
  };
  expect_derivatives(fit::least_squares_of(fit), numbers);
}

TEST(SurfaceFunctions, MeshDerivativesAreThoseOfDifferencesInDoubleDouble) {
  const shape::FacetShape one = globe(6, [](const Vec3& v) {
    return Vec3{1.2 * v.x, v.y, 0.6 * v.z};
  });
  const shape::FacetShape two = globe(4, [](const Vec3& v) {
    return Vec3{1.4 + 0.3 * v.x, 0.1 + 0.4 * v.y, 0.3 * v.z};
  });
  for (const shape::FacetShape& shape : {one, joined(one, two)}) {
    const light::ShadedMesh mesh(shape);
    const fit::LightFit fit{{night(in_short_axis_mode, 2.0, 30, 0.02, 3)},
                            {in_short_axis_mode.spin, mesh, light::Scattering::mixed(0.2)},
                            {true, fit::MomentSource::fit, true},
                            {}};
    EXPECT_EQ(mesh.is_shadowless(), shape.facets().size() == one.facets().size());
    std::vector<Vec3> normals;
    for (const shape::Facet& f : shape.facets()) normals.push_back(f.normal);
    const auto narrow = [](const BasicVec3<DD>& v) {
      const Vec3 d{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
      return (1.0 / norm(d)) * d;
    };
    const auto numbers = [&](const Offsets& off) {
      return wide_light(
          fit.start.spin, fit.start.law, fit.curves[0], off,
          [&](const light::BasicScattering<DD>& law, const BasicVec3<DD>& s,
              const BasicVec3<DD>& o) {
            // as lit as in double: no facet comes out of shadow within the differences
            std::vector<DD> lit;
            for (std::size_t i = 0; i < normals.size(); ++i) {
              const Vec3 sun = narrow(s), observer = narrow(o);
              const bool faces = dot(normals[i], sun) > 0.0 && dot(normals[i], observer) > 0.0;
              const bool is_lit = faces && mesh.is_free(i, sun) && mesh.is_free(i, observer);
              lit.push_back(DD(is_lit ? shape.facets()[i].area : 0.0));
            }
            return light::facet_brightness<DD>(normals, lit, law, s, o);
          });
    };
    expect_derivatives(fit::least_squares_of(fit), numbers);
  }
}

// The sum that a fit minimised, without slope there, when the function begins at what it found.
TEST(SurfaceFunctions, HaveNoSlopeAtWhatAFitFound) {
  fit::LightFit fit = egg_fit();
  fit.curves = {night(in_short_axis_mode, 5.0, 90, 0.02, 3)};
  fit.start = in_short_axis_mode;
  fit.start.shape = fit::ConvexShape::of(in_short_axis_mode.ellipsoid(), 3, 4);
  for (const fit::MomentSource moments :
       {fit::MomentSource::fit, fit::MomentSource::start, fit::MomentSource::shape}) {
    fit.unknowns.moments = moments;
    fit::LightFit at = fit;
    const fit::LightSolution found = fit::fit_light(fit);
    ASSERT_TRUE(found.is_found()) << found.result.sentence;
    at.start = found.body;
    const fit::LeastSquares problem = fit::least_squares_of(at);
    const fit::ResidualFunction f(problem);
    std::vector<double> x, r(f.size()), J(f.size() * f.unknowns());
    std::vector<std::string> names;
    for (const fit::Unknown& u : problem.unknowns) {
      x.push_back(u.start);
      names.push_back(u.name);
    }
    EXPECT_EQ(names, found.covariance.names);
    ASSERT_TRUE(f.at(x, r, J));
    double cost = 0.0;
    for (const double number : r) cost += number * number;
    EXPECT_NEAR(cost, found.result.cost, budget::surface_cost * cost);
    Worst<> slope;  // in standard errors of the unknown alone
    for (std::size_t k = 0; k < x.size(); ++k) {
      double sum = 0.0, square = 0.0;
      for (std::size_t i = 0; i < f.size(); ++i) {
        sum += r[i] * J[i * x.size() + k];
        square += J[i * x.size() + k] * J[i * x.size() + k];
      }
      slope.add(std::abs(sum) / std::sqrt(square), names[k]);
    }
    EXPECT_LE(slope.value(), budget::surface_fit_slope) << slope.where();
    const fit::LightModel same = fit::body_at(at, x);
    EXPECT_EQ(same.convex().coefficients, found.body.convex().coefficients);
    EXPECT_NEAR(same.spin.inertia_F(0, 0), found.body.spin.inertia_F(0, 0), budget::convex_moments);
    // a fit that goes on from there has nothing to do
    if (moments == fit::MomentSource::shape) continue;
    EXPECT_LE(fit::fit_light(at).result.iterations, 1);
  }
}

// Moments that follow the shape are those of the body at every x, and so are their derivatives.
TEST(SurfaceFunctions, MomentsFollowTheShapeAtEveryX) {
  fit::LightFit fit = egg_fit();
  fit.unknowns.moments = fit::MomentSource::shape;
  const fit::LeastSquares problem = fit::least_squares_of(fit);
  const fit::ResidualFunction f(problem);
  const std::size_t n = f.unknowns(), m = f.size();
  std::vector<double> x, r(m), J(m * n);
  for (const fit::Unknown& u : problem.unknowns) x.push_back(u.start);
  x[8] += 0.05;
  const fit::LightModel body = fit::body_at(fit, x);
  const fit::ShapeInertia own = fit::shape_inertia(body.convex());
  EXPECT_NEAR(body.spin.inertia_F(0, 0), own.Ixx, budget::convex_followed);
  EXPECT_NEAR(body.spin.inertia_F(1, 1), own.Iyy, budget::convex_followed);
  ASSERT_TRUE(f.at(x, r, J));
  Worst<> worst;
  for (const std::size_t k : {std::size_t{4}, std::size_t{9}, n - 1}) {
    const auto moved = [&](double by) {
      std::vector<double> at = x, found(m);
      at[k] += by;
      EXPECT_TRUE(f.at(at, found, {}));
      return found;
    };
    const double h = 1e-4;
    const auto a = moved(h), b = moved(-h), c = moved(2.0 * h), d = moved(-2.0 * h);
    double largest = 0.0;
    Worst<> off;
    for (std::size_t i = 0; i < m; ++i) {
      const double slope = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
      largest = larger(largest, std::abs(slope));
      off.add(std::abs(J[i * n + k] - slope));
    }
    worst.add(off.value() / largest, problem.unknowns[k].name);
  }
  EXPECT_LE(worst.value(), budget::surface_bend) << worst.where();
  x[7] += 40.0;  // areas that close no body
  EXPECT_FALSE(f.at(x, r, {}));
}

TEST(SurfaceFunctions, SayWhatIsWrong) {
  fit::LightFit fit = egg_fit();
  const std::vector<double> few{1.0};
  EXPECT_MESSAGE(fit::body_at(fit, few), "body_at: got 1 unknowns; expected 24");
  std::get<fit::ConvexShape>(fit.start.shape).coefficients.pop_back();
  EXPECT_MESSAGE(fit::least_squares_of(fit),
                 "fit_light: 15 coefficients of a convex body; expected 16");
  fit = egg_fit();
  fit.regularisation.about->spin.inertia_F(0, 1) = 0.1;
  EXPECT_REJECTED(fit::fit_light(fit),
                  "the axes of the body that is the usual one must be principal");
  fit = egg_fit();
  fit.regularisation.about->shape = fit::ConvexShape::of({1.2, 1.0, 0.6}, 2, 4);
  EXPECT_REJECTED(fit::fit_light(fit), "or a convex body of the degree of the start");
  fit = egg_fit();
  fit.regularisation.closure_error = -1.0;
  EXPECT_REJECTED(fit::least_squares_of(fit), "closure_error = -1");
  fit::LightFit mesh{
      fit.curves,
      {in_short_axis_mode.spin, light::ShadedMesh(globe(3, [](const Vec3& v) { return v; })), {}},
      {.moments = fit::MomentSource::start},
      {}};
  mesh.curves[0].points.resize(2);
  EXPECT_MESSAGE(fit::least_squares_of(mesh),
                 "fit_light: 2 points for 6 unknowns and 1 factor; expected as many at least");
  EXPECT_MESSAGE(fit::body_at(mesh, few), "body_at: got 1 unknowns; expected 6");
  mesh.unknowns.moments = fit::MomentSource::shape;
  EXPECT_REJECTED(fit::least_squares_of(mesh), "moments cannot follow a shape that stays");
}

}  // namespace
