// SPDX-License-Identifier: MIT
// Secular rates and mean elements about an oblate body, against motion by its force.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "budgets.hpp"
#include "oracle/oblate_motion.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using oracle::Ellipse;
using oracle::OblateMotion;
using oracle::PointState;

constexpr double pi = std::numbers::pi;

PointState state_of(const KeplerElements& k) {
  const KeplerOrbit orbit(k);
  return {orbit.position(k.epoch), orbit.velocity(k.epoch)};
}

// Means over one turn from t on: the axis, the angles, and the mean anomaly less n t, n that of
// `axis` or of the mean axis of this turn.
struct Turn {
  double axis = 0.0, node = 0.0, argument = 0.0, phase = 0.0;
};
Turn mean_over_turn(const OblateMotion& motion, PointState& s, double t, double h, int steps,
                    double gm, double axis) {
  Turn mean;
  const auto near = [](double angle) { return std::remainder(angle, 2.0 * pi); };
  for (int i = 0; i < steps; ++i) {
    const Ellipse e = motion.ellipse(s);
    mean.axis += e.axis / steps;
    mean.node += near(e.node) / steps;
    mean.argument += near(e.argument) / steps;
    mean.phase += near(e.mean_anomaly - std::sqrt(gm / (axis * axis * axis)) * (t + i * h)) / steps;
    s = motion.after(s, h);
  }
  return mean;
}

// How far node, argument and mean anomaly go in 60 turns: their means over the first and over the
// last, which hold no term of short period.
TEST(OblateOrbit, RatesAreThoseOfTheForce) {
  const double gm = 1.0, J2 = 1e-4, R = 1.0;
  constexpr int steps = 2000, turns = 60;
  for (const double inclination : {0.3, 0.9, 1.4, 2.2}) {
    for (const double e : {0.1, 0.4}) {
      const KeplerElements k{gm, 1.6 * (1.0 - e), e, inclination, 0.2, 0.4, 0.0};
      const OblateMotion motion(gm, J2, R);
      const double turn = 2.0 * pi * std::pow(1.6, 1.5), h = turn / steps;
      PointState s = state_of(k);
      PointState trial = s;
      const double axis = mean_over_turn(motion, trial, 0.0, h, steps, gm, 1.6).axis;
      const Turn first = mean_over_turn(motion, s, 0.0, h, steps, gm, axis);
      for (int i = 0; i < (turns - 1) * steps; ++i) s = motion.after(s, h);
      const Turn last = mean_over_turn(motion, s, turns * turn, h, steps, gm, axis);
      const KeplerElements mean{gm, axis * (1.0 - e), e, inclination};
      const SecularRates rates = j2_rates(mean, J2, R);
      const double far = turns * turn, scale = 1.5 * J2 * mean_motion(mean) * far;
      const double budget = budget::j2_rates_relative * J2 * scale;
      EXPECT_NEAR(last.node - first.node, rates.node * far, budget) << inclination << " " << e;
      EXPECT_NEAR(last.argument - first.argument, rates.argument * far, budget);
      EXPECT_NEAR(last.phase - first.phase, rates.mean_anomaly * far, budget);
    }
  }
}

// Whatever the place in the orbit, the mean axis is the mean of those of a turn.
TEST(OblateOrbit, MeanAxisIsThatOfATurn) {
  const double gm = 1.0, R = 1.0;
  constexpr int steps = 1000;
  Worst most_moved;
  for (const double J2 : {1e-3, 1e-4}) {
    for (const double e : {1e-5, 0.05, 0.4}) {
      for (const double inclination : {0.1, 1.0, 1.7}) {
        for (int place = 0; place < 5; ++place) {
          const KeplerElements k{gm, 1.3, e, inclination, 0.2, 1.1, 1.3 * place, 0.5};
          const double own = semi_major_axis(k), turn = 2.0 * pi * std::pow(own, 1.5);
          PointState s = state_of(k);
          const double want =
              mean_over_turn(OblateMotion(gm, J2, R), s, 0.0, turn / steps, steps, gm, own).axis;
          const KeplerElements mean = mean_elements(k, J2, R);
          const double got = semi_major_axis(mean);
          EXPECT_NEAR(got / want, 1.0, budget::j2_mean_axis * J2 * J2) << e << " " << inclination;
          most_moved.add(std::abs(own / want - 1.0) / J2);
          EXPECT_EQ(mean.eccentricity, e);
          EXPECT_EQ(mean.mean_anomaly, k.mean_anomaly);
        }
      }
    }
  }
  EXPECT_GT(most_moved.value(), 1.0);  // what the osculating axis is off by, in J2
}

// The farthest in ten days about the Earth from where the force takes it.
double farthest(const KeplerElements& osculating, double J2, bool mean) {
  const double gm = osculating.gm, R = 6378.137, h = 10.0;
  const KeplerElements k = mean ? mean_elements(osculating, J2, R) : osculating;
  const PrecessingKeplerOrbit orbit(k, j2_rates(k, J2, R));
  const OblateMotion motion(gm, J2, R);
  PointState s = state_of(osculating);
  Worst most;
  for (int i = 0; i <= 86400; ++i) {
    most.add(norm(orbit.position(h * i) - s.x));
    s = motion.after(s, h);
  }
  return most.value();
}

TEST(OblateOrbit, StaysWhereTheForceTakesIt) {
  const double gm = 398600.4418, J2 = 1.0826e-3, deg = pi / 180.0;
  struct Shape {
    double axis, e, inclination, budget;
  };
  for (const Shape& o : {Shape{7144.5, 1e-4, 98.0, budget::j2_low_orbit_km},
                         Shape{7144.5, 0.02, 98.0, budget::j2_low_orbit_km},
                         Shape{7144.5, 1e-3, 51.6, budget::j2_low_orbit_km},
                         Shape{10000.0, 0.3, 50.0, budget::j2_low_orbit_km},
                         Shape{26560.0, 0.7, 63.4, budget::j2_eccentric_orbit_km},
                         Shape{26560.0, 0.7, 30.0, budget::j2_eccentric_orbit_km}}) {
    for (const double place : {0.0, 0.8, 1.6, 3.5}) {
      const KeplerElements k{
          gm, pericentre_distance(o.axis, o.e), o.e, o.inclination * deg, 0.3, 0.7, place};
      EXPECT_LE(farthest(k, J2, true), o.budget) << o.axis << " " << o.inclination << " " << place;
    }
  }
  // the ellipse through the state, taken for a mean one
  const KeplerElements on_node{gm, 7144.5, 0.0, 98.0 * deg};
  EXPECT_GT(farthest(on_node, J2, false), 100.0 * farthest(on_node, J2, true));
}

TEST(OblateOrbit, WhatHasNoMeanEllipse) {
  const KeplerElements hyperbola{1.0, 1.0, 2.0}, low{1.0, 1.0, 0.3, 1.5};
  EXPECT_THROW((void)mean_elements(hyperbola, 1e-3, 1.0), DomainError);
  EXPECT_THROW((void)mean_elements(low, 1e-3, -1.0), DomainError);
  EXPECT_THROW((void)mean_elements(low, -9.0, 1.0), DomainError);
  EXPECT_EQ(mean_elements(low, 0.0, 1.0), low);
}

}  // namespace
}  // namespace polhode::test
