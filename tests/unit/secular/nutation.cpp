// SPDX-License-Identifier: MIT
// Nutation of rigid planets. Oracles: the closed form of a circular orbit, the axis averaged over
// the rotation (slopes of the error for the first and the second order), the rotor itself under
// gravity gradient (Oppolzer terms, triaxial bodies too), and the geometry of the three axes.
#include "polhode/secular/nutation.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "orbit/mean_ellipse.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
using polhode::test::Worst;
using ::testing::HasSubstr;

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double I0 = 0.4;

// Pericentre at longitude 0.3, mean anomaly 0.7 at t = 0.
constexpr double pericentre = 0.3, anomaly = 0.7;

// A star on an ellipse of semi-major axis 1, seen from the planet; a year is 2 pi.
secular::NutationProblem planet(const Body& body, double spin, double e, double precession,
                                int order) {
  return {body,
          spin,
          I0,
          {{"M", anomaly, 1.0, 25}, {"Ls", pericentre + anomaly, 1.0 + precession, 7}},
          {{1.0, [e](std::span<const double> x) { return on_ellipse(1.0, e, x[0], x[1] - x[0]); }}},
          {0.0, 0.0, 0.0},
          order,
          1e-14,
          0.1};
}
// The equinox moves back by the precession, and longitudes grow by it.
secular::NutationTheory theory(const Body& body, double spin, double e, int order) {
  double precession = 0.0;
  for (int i = 0; i < 4; ++i)
    precession =
        secular::NutationTheory(planet(body, spin, e, precession, 2)).precession().longitude;
  return secular::NutationTheory(planet(body, spin, e, precession, order));
}

// The unit vector of an axis: psi from the mean equinox of t = 0.
Vec3 direction(double psi, double I) {
  return {std::sin(I) * std::sin(psi), std::sin(I) * std::cos(psi), std::cos(I)};
}
Vec3 direction(const secular::NutationTheory& of, secular::PlanetAxis axis, double t) {
  const secular::NutationOffset now = of.at(axis, t), rate = of.precession();
  return direction(rate.longitude * t + now.longitude, I0 + rate.obliquity * t + now.obliquity);
}

const secular::NutationTerm& term(const secular::NutationTheory& of, secular::PlanetAxis axis,
                                  const std::vector<int>& k) {
  const auto& terms = of.terms(axis);
  return *std::ranges::find(terms, k, &secular::NutationTerm::multipliers);
}

TEST(Nutation, OfACircularOrbitIsTheClosedForm) {
  const double H = 1e-3, spin = 400.0, K = 1.5 * H / spin;
  const secular::NutationTheory of = theory(Body(1.0 - H, 1.0 - H, 1.0), spin, 0.0, 1);
  EXPECT_NEAR(of.precession().longitude / (K * std::cos(I0)), 1.0, budget::nutation_closed);
  EXPECT_EQ(of.precession().obliquity, 0.0);
  const secular::NutationTerm& half = term(of, secular::PlanetAxis::momentum, {0, 2});
  const double rate = half.rate;
  EXPECT_NEAR(half.wave.longitude_sine / (-K * std::cos(I0) / rate), 1.0, budget::nutation_closed);
  EXPECT_NEAR(half.wave.obliquity_cosine / (K * std::sin(I0) / rate), 1.0, budget::nutation_closed);
  EXPECT_EQ(of.terms(secular::PlanetAxis::momentum).size(), 1U);
}

double largest_error(double H, double e, int order) {
  const double spin = 1e3, star = 1.5 * H / spin;
  const secular::NutationTheory of = theory(Body(1.0 - H, 1.0 - H, 1.0), spin, e, order);
  const std::vector<secular::OrbitElements> rows(
      12, secular::orbit_elements(e, 0.0, 0.0, pericentre + std::numbers::pi));
  std::vector<double> times;
  for (int k = -1; k <= 10; ++k) times.push_back(1e3 * k);
  // The planet is where the star is not.
  const secular::SpinOnOrbit model(
      secular::HistoryOrbit(secular::OrbitHistory(secular::ElementTable(times, rows)), 1.0, 1.0,
                            pericentre + anomaly + std::numbers::pi),
      star);
  const SaveAt at = SaveAt::count(0.0, 3.0 * turn, 100);
  const auto run = integrate(
      BasicProblem<secular::SpinOnOrbit>{
          model, secular::SpinAxis{direction(of, secular::PlanetAxis::momentum, 0.0)}, 0.0,
          3.0 * turn, Adaptive{1e-14}},
      Keep{.samples = at, .dense = false});
  Worst worst;
  for (const auto& sample : run.samples())
    worst.add(norm(sample.s.s - direction(of, secular::PlanetAxis::momentum, sample.t)));
  return worst.value();
}

// Halved, the flattening makes the error of the order n smaller by 2^(n + 1).
TEST(Nutation, ErrorOfTheMomentumFallsWithTheOrder) {
  for (const double e : {0.0, 0.1})
    for (const int order : {1, 2}) {
      const double one = largest_error(0.4, e, order), half = largest_error(0.2, e, order);
      EXPECT_NEAR(std::log2(one / half), order + 1.0, budget::nutation_slope)
          << "e " << e << ", order " << order << ": " << one << ", " << half;
    }
}

// Axes of figure and rotation of the rotor less those of the theory.
struct Errors {
  double figure, rotation, oppolzer;
};
Errors rotor_errors(double H, double triaxiality) {
  const double spin = 30.0, e = 0.1;
  const Body body(1.0 - H - 0.5 * triaxiality, 1.0 - H + 0.5 * triaxiality, 1.0);
  const secular::NutationTheory of = theory(body, spin, e, 2);
  const Vec3 Z = direction(of, secular::PlanetAxis::momentum, 0.0);
  const Vec3 z = direction(of, secular::PlanetAxis::figure, 0.0);
  // Phi = 0 at t = 0: axis 1 along the node of the momentum.
  const Vec3 node = (1.0 / std::hypot(Z.x, Z.y)) * Vec3{-Z.y, Z.x, 0.0};
  const Vec3 across = cross(z, node), y = (1.0 / norm(across)) * across, x = cross(y, z);
  const Quaternion q_IB = attitude(Mat3{{x, y, z}});
  const RotorState start{q_IB, rotate(conj(q_IB), spin * Z)};
  const KeplerOrbit orbit({.gm = 1.0,
                           .pericentre = 1.0 - e,
                           .eccentricity = e,
                           .argument = pericentre + std::numbers::pi,
                           .mean_anomaly = anomaly});
  const System system(body, Frame::inertial(),
                      {AnyPerturbation("star", GravityGradient(1.0, orbit))});
  const auto run = integrate(Problem{system, start, 0.0, 2.0 * turn, Adaptive{1e-13}},
                             Keep{.samples = SaveAt::count(0.0, 2.0 * turn, 400), .dense = false});
  Worst figure, rotation, oppolzer;
  for (const Sample& sample : run.samples()) {
    const Vec3 e3 = rotate(sample.s.q, Vec3{0.0, 0.0, 1.0});
    const Vec3 w = rotate(sample.s.q, angular_velocity(body, sample.s));
    const Vec3 by_theory = direction(of, secular::PlanetAxis::figure, sample.t);
    figure.add(norm(e3 - by_theory));
    rotation.add(
        norm((1.0 / norm(w)) * w - direction(of, secular::PlanetAxis::rotation, sample.t)));
    oppolzer.add(norm(by_theory - direction(of, secular::PlanetAxis::momentum, sample.t)));
  }
  return {figure.value(), rotation.value(), oppolzer.value()};
}

TEST(Nutation, IsThatOfTheRotor) {
  for (const double triaxiality : {0.0, 0.5}) {
    const Errors one = rotor_errors(4e-3, 4e-3 * triaxiality),
                 half = rotor_errors(2e-3, 2e-3 * triaxiality);
    EXPECT_LT(one.figure, budget::nutation_rotor * one.oppolzer) << one.oppolzer;
    EXPECT_LT(one.rotation, budget::nutation_rotor * one.oppolzer);
    EXPECT_NEAR(std::log2(one.figure / half.figure), 2.0, budget::nutation_slope);
    EXPECT_NEAR(std::log2(one.rotation / half.rotation), 2.0, budget::nutation_slope);
  }
}

// In the plane of momentum and figure axis, at angles J (C - A) / A beyond the momentum.
TEST(Nutation, TheMomentumIsBetweenFigureAndRotation) {
  const double H = 3e-3;
  const secular::NutationTheory of = theory(Body(1.0 - H, 1.0 - H, 1.0), 30.0, 0.1, 2);
  for (const double t : {0.0, 1.3, 40.0}) {
    const secular::NutationOffset momentum = of.at(secular::PlanetAxis::momentum, t),
                                  figure = of.at(secular::PlanetAxis::figure, t),
                                  rotation = of.at(secular::PlanetAxis::rotation, t);
    const double beyond = -H / (1.0 - H);  // 1 - C / A
    const double J =
        std::hypot(figure.longitude - momentum.longitude, figure.obliquity - momentum.obliquity);
    EXPECT_NEAR(rotation.longitude - momentum.longitude,
                beyond * (figure.longitude - momentum.longitude), budget::nutation_axes * J);
    EXPECT_NEAR(rotation.obliquity - momentum.obliquity,
                beyond * (figure.obliquity - momentum.obliquity), budget::nutation_axes * J);
  }
  for (const secular::NutationTerm& one : of.oppolzer_terms(secular::PlanetAxis::figure))
    EXPECT_NEAR(term(of, secular::PlanetAxis::figure, one.multipliers).wave.longitude_sine,
                term(of, secular::PlanetAxis::momentum, one.multipliers).wave.longitude_sine +
                    one.wave.longitude_sine,
                budget::nutation_closed);
}

// The body turns at its spin rate while the node moves back, against which Phi is counted.
TEST(Nutation, PhiIsCountedFromTheMovingNode) {
  const double spin = 30.0;
  const secular::NutationTheory of = theory(Body(0.994, 0.998, 1.0), spin, 0.1, 2);
  ASSERT_EQ(of.arguments().back(), "Phi");
  EXPECT_NEAR((of.rates().back() - spin) / (of.precession().longitude * std::cos(I0)), 1.0,
              budget::nutation_phi);
}

TEST(Nutation, AxesHaveNames) {
  for (const secular::PlanetAxis axis :
       {secular::PlanetAxis::momentum, secular::PlanetAxis::figure, secular::PlanetAxis::rotation})
    EXPECT_EQ(secular::planet_axis(name(axis)), axis);
  EXPECT_EQ(name(secular::PlanetAxis::rotation), "rotation");
  EXPECT_EQ(secular::planet_axis("pole"), std::nullopt);
}

TEST(Nutation, WhatIsRefused) {
  const Body oblate(0.99, 0.99, 1.0);
  const auto refused = [&](const auto& change) {
    secular::NutationProblem problem = planet(oblate, 30.0, 0.1, 0.0, 1);
    change(problem);
    return message_of([&] { secular::NutationTheory{problem}; });
  };
  EXPECT_EQ(refused([](auto&) {}), "");
  EXPECT_THAT(refused([](auto& p) { p.body = Body(1.0, 0.99, 0.99); }),
              HasSubstr("the third must be the largest"));
  EXPECT_THAT(refused([](auto& p) { p.spin_rate = -1.0; }), HasSubstr("spin_rate -1"));
  EXPECT_THAT(refused([](auto& p) { p.obliquity = 0.0; }), HasSubstr("obliquity 0 rad"));
  EXPECT_THAT(refused([](auto& p) { p.order = 3; }), HasSubstr("order 3 must be 1 or 2"));
  EXPECT_THAT(refused([](auto& p) { p.least = 0.0; }), HasSubstr("least 0"));
  EXPECT_THAT(refused([](auto& p) { p.bodies.clear(); }), HasSubstr("no bodies"));
  EXPECT_THAT(refused([](auto& p) { p.bodies[0].gm = 0.0; }), HasSubstr("gm 0"));
  EXPECT_THAT(refused([](auto& p) { p.bodies[0].gm = INFINITY; }), HasSubstr("gm inf"));
  EXPECT_THAT(refused([](auto& p) {
                p.bodies[0].position = [](std::span<const double>) { return Vec3{}; };
              }),
              HasSubstr("it must be finite everywhere"));
  EXPECT_THAT(refused([](auto& p) { p.arguments[0].rate = NAN; }), HasSubstr("argument M"));
  EXPECT_THAT(refused([](auto& p) { p.slowest = NAN; }), HasSubstr("slowest nan"));
  EXPECT_THAT(refused([](auto& p) { p.slowest = -1.0; }), HasSubstr("slowest -1"));
  EXPECT_THAT(refused([](auto& p) { p.least = INFINITY; }), HasSubstr("least inf"));
  EXPECT_THAT(refused([](auto& p) { p.ecliptic_rate.y = NAN; }), HasSubstr("ecliptic_rate nan"));
  EXPECT_THAT(refused([](auto& p) { p.arguments[1].points = 8; }), HasSubstr("must be odd"));
  EXPECT_THAT(refused([](auto& p) {
                p.arguments[1].rate = 0.0;
                p.slowest = 0.0;
              }),
              HasSubstr("a resonance"));
  // As seen from the body, 2 Ls turns with the free wobble, at (C - A)/A of the spin.
  EXPECT_THAT(refused([](auto& p) { p.arguments[1].rate = 15.0 / 0.99; }),
              HasSubstr("the free wobble turns with the torque of cos(2*Ls)"));
}

}  // namespace
