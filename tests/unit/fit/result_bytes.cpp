// SPDX-License-Identifier: MIT
// Results of fits as bytes: what is read and written again has the same bytes.
#include "fit/result_bytes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>

#include "message_of.hpp"
#include "polhode/error.hpp"
#include "unit/light/meshes.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;

constexpr double infinite = std::numeric_limits<double>::infinity();

fit::LeastSquaresResult some_result() {
  return {.end = fit::LeastSquaresResult::End::iteration_limit,
          .sentence = "not converged",
          .iterations = 7,
          .evaluations = 11,
          .x = {1.5, -2.5, infinite},
          .numbers = {0.25},
          .chi_square = 3.5,
          .cost = 4.5,
          .bound = {2, 0}};
}

fit::UnknownsCovariance some_covariance() {
  fit::UnknownsCovariance c;
  c.names = {"turn_x", "b/a"};
  c.matrix = {1.0, 0.5, 0.5, infinite};
  c.weak.emplace_back();
  c.weak.back().is_determined = true;
  c.weak.back().direction = {0.6, 0.8};
  c.weak.back().sentence = "hardly";
  return c;
}

fit::SpinState some_spin() {
  fit::SpinState s{0.5, {0.1, 0.2, 0.3, 0.4}, {1.0, 2.0, 3.0}, Mat3::identity()};
  s.inertia_F(0, 1) = 0.125;
  return s;
}

fit::LightSolution solution_of(fit::LightShape shape) {
  fit::LightSolution s;
  s.body = {some_spin(), std::move(shape), light::Scattering::mixed(0.25)};
  s.result = some_result();
  s.covariance = some_covariance();
  s.factors = {2.0, 4.0};
  s.degrees_of_freedom = 80.5;
  s.periods = {Regime::long_axis, 12.0, 20.0};
  s.pole = {0.0, 0.6, 0.8};
  s.notes = {"a note", ""};
  s.loss = {fit::Loss::Kind::cauchy, 1.5};
  s.points = 90;
  s.terms = {{"data", 3.0}, {"roughness", 1.5}};
  return s;
}

// `known` is the body of the search, of results that need one.
template <class T, class... Known>
std::string bytes_of(T& x, const Known&... known) {
  Archive bytes;
  fit::detail::serialize(bytes, x, known...);
  return bytes.bytes();
}

template <class T, class... Known>
T read_again(const std::string& written, const Known&... known) {
  T x{};
  Archive bytes(written);
  fit::detail::serialize(bytes, x, known...);
  EXPECT_TRUE(bytes.is_done());
  return x;
}

template <class T, class... Known>
void expect_same(T x, const Known&... known) {
  const std::string written = bytes_of(x, known...);
  T again = read_again<T>(written, known...);
  EXPECT_EQ(bytes_of(again, known...), written);
  std::optional<T> there = std::move(again), none;
  const std::string with = bytes_of(there, known...), without = bytes_of(none, known...);
  EXPECT_EQ(with.size(), written.size() + without.size());
  there = read_again<std::optional<T>>(with, known...);
  EXPECT_EQ(bytes_of(there, known...), with);
  EXPECT_FALSE(read_again<std::optional<T>>(without, known...).has_value());
}

fit::LightModel known_mesh() {
  const shape::FacetShape globe_of_rows = globe(3, [](const Vec3& v) { return v; });
  return {some_spin(), light::ShadedMesh(globe_of_rows), {}};
}

TEST(ResultBytes, AreThoseOfWhatIsRead) {
  const fit::detail::KnownBody mesh = known_mesh();
  for (const fit::LightShape& shape :
       {fit::LightShape(light::Ellipsoid{1.0, 0.75, 0.5}),
        fit::LightShape(fit::ConvexShape::of({1.0, 0.75, 0.5}, 2, 3)), mesh->shape}) {
    const fit::LightSolution solution = solution_of(shape);
    expect_same(solution.body, mesh);
    expect_same(fit::detail::LightTrial{solution.body, 1.5}, mesh);
    expect_same(solution, mesh);
    fit::FoundLight found = fit::found_light(solution, 3);
    found.starts = 4;
    found.beside = fit::FoundLight::Beside::alias;
    found.image = fit::LightImage::bisector;
    found.of = 2;
    found.sentence = "another one";
    expect_same(found, mesh);
    found.begun = solution.body;
    expect_same(found, mesh);
  }
}

TEST(ResultBytes, KeepWhatAShapeIs) {
  fit::LightSolution convex = solution_of(fit::ConvexShape::of({1.0, 0.75, 0.5}, 2, 3));
  const fit::LightSolution again = read_again<fit::LightSolution>(bytes_of(convex));
  EXPECT_EQ(again.body.convex().coefficients, convex.body.convex().coefficients);
  EXPECT_EQ(again.body.convex().image.rows(), 3);
  EXPECT_EQ(again.terms.size(), 2u);
  const fit::detail::KnownBody mesh = known_mesh();
  fit::LightSolution of_mesh = solution_of(mesh->shape);
  const std::string written = bytes_of(of_mesh, mesh);
  EXPECT_EQ(read_again<fit::LightSolution>(written, mesh).body.mesh().shape().facets().size(),
            mesh->mesh().shape().facets().size());
  EXPECT_REJECTED(read_again<fit::LightSolution>(written), "a mesh that this search does not have");
}

TEST(ResultBytes, OfSpinsAndOfScans) {
  fit::SpinSolution spin;
  spin.state = some_spin();
  spin.result = some_result();
  spin.covariance = some_covariance();
  spin.error_factor = 1.25;
  spin.degrees_of_freedom = 40.0;
  spin.attitude_rms = 0.125;
  spin.notes = {"a note"};
  expect_same(spin);
  fit::RefinedPair pair{};
  pair.fit.f1 = 0.3;
  pair.fit.f2 = 0.2;
  pair.fit.constants = {1.0, 2.0};
  pair.fit.terms = {{1, -2, 0.5, 0.25}, {0, 1, 0.0, 1.0}};
  pair.converged = true;
  pair.sigma_f1 = 1e-3;
  pair.correlation = -0.5;
  pair.iterations = 9;
  expect_same(pair);
}

}  // namespace
