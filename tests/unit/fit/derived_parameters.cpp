// SPDX-License-Identifier: MIT
// Errors of periods and pole against differences of the periods of motions nearby.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/free/free_rotation.hpp"

namespace {
using namespace polhode;

Mat3 tensor(double xx, double yy, double xy, double yz, double xz) {
  Mat3 T = Mat3::identity();
  T(0, 0) = xx;
  T(1, 1) = yy;
  T(0, 1) = T(1, 0) = xy;
  T(1, 2) = T(2, 1) = yz;
  T(0, 2) = T(2, 0) = xz;
  return T;
}

const std::vector<std::string> names = {"turn_x",  "turn_y",  "turn_z",  "w_x",     "w_y",    "w_z",
                                        "Ixx/Izz", "Iyy/Izz", "Ixy/Izz", "Iyz/Izz", "Ixz/Izz"};

// One unknown with the error 1: errors are derivatives.
fit::UnknownsCovariance of_one(const std::string& name) { return {{name}, {1.0}, {}}; }

fit::SpinState changed(const fit::SpinState& s, std::size_t k, double h) {
  fit::SpinState c = s;
  if (k < 3) {
    Quaternion turn{1.0, 0.0, 0.0, 0.0};
    (k == 0 ? turn.x : k == 1 ? turn.y : turn.z) = 0.5 * h;
    c.q = normalized(s.q * turn);
    return c;
  }
  if (k < 6) {
    c.w_F[static_cast<int>(k) - 3] += h;
    return c;
  }
  constexpr int places[5][2] = {{0, 0}, {1, 1}, {0, 1}, {1, 2}, {0, 2}};
  const int i = places[k - 6][0], j = places[k - 6][1];
  c.inertia_F(i, j) += h;
  if (i != j) c.inertia_F(j, i) += h;
  return c;
}

void expect_differences(const fit::SpinState& s, std::size_t unknowns) {
  constexpr double h = 1e-5;
  for (std::size_t k = 0; k < unknowns; ++k) {
    const fit::DerivedParameters f = fit::derived_parameters(s, of_one(names[k]));
    const fit::DerivedParameters up = fit::derived_parameters(changed(s, k, h), of_one(names[k]));
    const fit::DerivedParameters down =
        fit::derived_parameters(changed(s, k, -h), of_one(names[k]));
    const double by_phi =
        std::fabs(up.periods.precession_period - down.periods.precession_period) / (2.0 * h);
    const double by_psi =
        std::fabs(up.periods.rotation_period - down.periods.rotation_period) / (2.0 * h);
    const double by_pole = norm(up.pole_I - down.pole_I) / (2.0 * h);
    EXPECT_NEAR(f.precession_error, by_phi,
                budget::derived_parameters * (by_phi + f.periods.precession_period))
        << names[k];
    EXPECT_NEAR(f.rotation_error, by_psi,
                budget::derived_parameters * (by_psi + f.periods.rotation_period))
        << names[k];
    const double by_short = std::fabs(up.short_period - down.short_period) / (2.0 * h);
    EXPECT_NEAR(f.short_error, by_short, budget::derived_parameters * (by_short + f.short_period))
        << names[k];
    EXPECT_NEAR(1.0 / f.short_period,
                1.0 / f.periods.precession_period + 1.0 / f.periods.rotation_period,
                budget::derived_parameters);
    EXPECT_NEAR(f.pole_major, by_pole, budget::derived_parameters) << names[k];
    EXPECT_NEAR(f.pole_minor, 0.0, budget::derived_parameters) << names[k];
  }
}

const Quaternion attitude_of_all = normalized(Quaternion{0.6, 0.3, -0.5, 0.2});

TEST(DerivedParameters, ErrorsAreDerivativesInBothModes) {
  for (const Vec3& w : {Vec3{2.4, 0.9, 0.3}, Vec3{0.6, 0.5, 1.0}}) {
    const fit::SpinState s{0.0, attitude_of_all, w, tensor(0.4, 0.88, 0.0, 0.0, 0.0)};
    const fit::DerivedParameters f = fit::derived_parameters(s, of_one("w_x"));
    EXPECT_NE(f.periods.precession_period, 0.0);
    expect_differences(s, 8);
  }
}

TEST(DerivedParameters, ErrorsAreDerivativesOfTensors) {
  expect_differences({0.0, attitude_of_all, {2.4, 0.9, 0.3}, tensor(0.5, 0.9, 0.06, -0.04, 0.05)},
                     11);
}

// As covariance() has it of unknowns of which one is undetermined.
fit::UnknownsCovariance open_in(std::size_t open) {
  fit::UnknownsCovariance c;
  c.names.assign(names.begin(), names.begin() + 6);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      const bool any = i == open || j == open;
      const double undefined = i == j ? std::numeric_limits<double>::infinity()
                                      : std::numeric_limits<double>::quiet_NaN();
      c.matrix.push_back(any ? undefined : i == j ? 1e-4 : 1e-6);
    }
  }
  return c;
}

TEST(DerivedParameters, WhatDependsOnAnOpenUnknownHasNoError) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const fit::SpinState s{0.0, attitude_of_all, {2.4, 0.9, 0.3}, tensor(0.4, 0.88, 0.0, 0.0, 0.0)};
  const fit::DerivedParameters of_rate = fit::derived_parameters(s, open_in(3));
  EXPECT_EQ(of_rate.precession_error, infinite);
  EXPECT_EQ(of_rate.rotation_error, infinite);
  EXPECT_TRUE(std::isnan(of_rate.correlation));
  const fit::DerivedParameters of_turn = fit::derived_parameters(s, open_in(2));
  for (const fit::DerivedParameters& f : {of_rate, of_turn}) {
    EXPECT_EQ(f.pole_major, infinite);
    EXPECT_EQ(f.pole_minor, infinite);
    EXPECT_NEAR(norm(f.major_I), 1.0, budget::derived_parameters);
  }
  // periods do not depend on turns: as if there were no such unknown
  fit::UnknownsCovariance rest;
  rest.names.assign(names.begin() + 3, names.begin() + 6);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rest.matrix.push_back(i == j ? 1e-4 : 1e-6);
  const fit::DerivedParameters known = fit::derived_parameters(s, rest);
  EXPECT_EQ(of_turn.precession_error, known.precession_error);
  EXPECT_EQ(of_turn.rotation_error, known.rotation_error);
  EXPECT_EQ(of_turn.correlation, known.correlation);
}

TEST(DerivedParameters, WithoutACovarianceNoErrorIsZero) {
  const fit::SpinState s{0.0, attitude_of_all, {2.4, 0.9, 0.3}, tensor(0.4, 0.88, 0.0, 0.0, 0.0)};
  const fit::DerivedParameters f =
      fit::derived_parameters(s, {{"w_x"}, {std::numeric_limits<double>::quiet_NaN()}, {}});
  for (const double x : {f.precession_error, f.rotation_error, f.pole_major, f.pole_minor})
    EXPECT_TRUE(std::isnan(x)) << x;
}

TEST(DerivedParameters, MomentsFollowTheShape) {
  const fit::LightModel body =
      fit::LightModel::homogeneous(0.0, attitude_of_all, {2.4, 0.9, 0.3}, {1.0, 0.6, 0.45});
  const auto at = [&](double b, double ratio) {
    fit::LightSolution s;
    s.body = fit::LightModel::homogeneous(0.0, body.spin.q, body.spin.w_F, {1.0, b, b * ratio});
    return s;
  };
  constexpr double h = 1e-5;
  for (const bool first : {true, false}) {
    fit::LightSolution s = at(0.6, 0.75);
    s.covariance = of_one(first ? "b/a" : "c/b");
    const fit::DerivedParameters f = fit::derived_parameters(s, fit::LightUnknowns{});
    fit::LightSolution more = first ? at(0.6 + h, 0.75) : at(0.6, 0.75 + h);
    fit::LightSolution less = first ? at(0.6 - h, 0.75) : at(0.6, 0.75 - h);
    more.covariance = less.covariance = s.covariance;
    const fit::DerivedParameters up = fit::derived_parameters(more, fit::LightUnknowns{}),
                                 down = fit::derived_parameters(less, fit::LightUnknowns{});
    const double by =
        std::fabs(up.periods.rotation_period - down.periods.rotation_period) / (2.0 * h);
    EXPECT_NEAR(f.rotation_error, by,
                budget::derived_parameters * (by + f.periods.rotation_period));
    EXPECT_NEAR(f.pole_major, norm(up.pole_I - down.pole_I) / (2.0 * h),
                budget::derived_parameters);
  }
}

}  // namespace
