// SPDX-License-Identifier: MIT
// Three theories of one spin axis: averaged over rotation and orbit, over the rotation alone, and
// the rotor itself. Oracles: each other, Kepler's orbit, and the amplitude of the nutation of half
// a year.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

constexpr double turn = 2.0 * std::numbers::pi;

secular::OrbitHistory staying(const secular::OrbitElements& o) {
  const std::vector<secular::OrbitElements> rows(12, o);
  std::vector<double> times;
  for (int k = -1; k <= 10; ++k) times.push_back(1e5 * k);
  return secular::OrbitHistory(secular::ElementTable(times, rows));
}

TEST(HistoryOrbit, AnOrbitThatStaysIsKeplers) {
  const double e = 0.3, i = 0.4, node = 1.1, argument = 2.0, n = turn, mean = 0.7;
  // longitudes from axis 1 of the equinoctial axes: node + argument + mean anomaly
  const secular::HistoryOrbit orbit(staying(secular::orbit_elements(e, i, node, argument)), n * n,
                                    1.0, node + argument + mean);
  const KeplerOrbit kepler({.gm = n * n,
                            .pericentre = 1.0 - e,
                            .eccentricity = e,
                            .inclination = i,
                            .node = node,
                            .argument = argument,
                            .mean_anomaly = mean});
  Worst worst, of_double_double;
  for (const double t : {0.0, 0.3, 17.77, 99.9, -1234.5}) {
    worst.add(norm(orbit.position(t) - kepler.position(t)));
    const auto x = orbit.position(DoubleDouble(t)) - kepler.position(DoubleDouble(t));
    of_double_double.add(std::hypot(x.x.hi, x.y.hi, x.z.hi));
  }
  EXPECT_LT(worst.value(), budget::history_orbit);
  EXPECT_LT(of_double_double.value(), budget::history_orbit);
  EXPECT_NEAR(orbit.time_scale(), kepler.time_scale(), budget::history_orbit);
  EXPECT_TRUE(std::isnan(orbit.position(2e6).x));
}

TEST(HistoryOrbit, ACircleInThePlaneOfReference) {
  const secular::HistoryOrbit orbit(staying({0.0, 0.0, 0.0, 0.0}), turn * turn, 2.0, 0.5);
  const double angle = 0.5 + turn / std::sqrt(8.0) * 0.25;
  EXPECT_LT(norm(orbit.position(0.25) - Vec3{2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.0}),
            budget::history_orbit);
}

TEST(HistoryOrbit, WhatIsNone) {
  const secular::OrbitHistory circle = staying({0.0, 0.0, 0.0, 0.0});
  EXPECT_MESSAGE(secular::HistoryOrbit(circle, -1.0, 1.0), "HistoryOrbit: gm -1 must be positive");
  EXPECT_MESSAGE(secular::HistoryOrbit(circle, 1.0, 0.0),
                 "HistoryOrbit: semi-major axis 0 must be positive");
  EXPECT_REJECTED(secular::HistoryOrbit(circle, 1.0, 1.0, NAN), "longitude nan must be finite");
}

// A planet whose year is 1, and whose star turns its axis by 2e-3 rad a year.
constexpr double star = 2e-3, obliquity = 0.5;
const secular::SpinAxis start{{0.0, std::sin(obliquity), std::cos(obliquity)}};
const secular::OrbitElements ellipse{0.1, 0.05, 0.0, 0.0};

template <class M>
std::vector<BasicSample<secular::SpinAxis>> moved(const M& model, const secular::SpinAxis& from,
                                                  const SaveAt& at,
                                                  const Method& method = Adaptive{1e-13}) {
  const double stop = at[at.size() - 1];
  const auto run = integrate(BasicProblem<M>{model, from, 0.0, stop, method},
                             Keep{.samples = at, .dense = false});
  return {run.samples().begin(), run.samples().end()};
}

// The largest distance of the theories over ten years, once the averaged axis starts from the mean
// of the first year.
double nutation(double n) {
  const secular::OrbitHistory history = staying(ellipse);
  const secular::SpinOnOrbit on_orbit(secular::HistoryOrbit(history, n * n, 1.0, 0.3), star);
  const secular::SpinPrecession<secular::OrbitHistory> averaged(history, {.star = star});
  const SaveAt year = SaveAt::count(0.0, turn / n, 201);
  const auto fine = moved(on_orbit, start, year), coarse = moved(averaged, start, year);
  Vec3 mean{0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < 200; ++k) mean = mean + (1.0 / 200) * (fine[k].s.s - coarse[k].s.s);
  const SaveAt years = SaveAt::count(0.0, 10.0, 501);
  const auto a = moved(on_orbit, start, years),
             b = moved(averaged, secular::spin_axis(start.s + mean), years);
  Worst worst;
  for (std::size_t k = 0; k < a.size(); ++k) worst.add(norm(a[k].s.s - b[k].s.s));
  return worst.value();
}

// star sin(obliquity) / (2 n) on a circle; e adds a term of a year.
TEST(Averaging, WhatTheMeanOverTheOrbitLeavesOutIsTheNutationOfHalfAYear) {
  const double amplitude = star * std::sin(obliquity) / (2.0 * turn);
  const double slow = nutation(turn), fast = nutation(4.0 * turn);
  EXPECT_GT(slow, amplitude);
  EXPECT_LT(slow, 2.0 * amplitude);
  EXPECT_NEAR(slow / fast, 4.0, budget::averaging_order);
}

// The figure axis of a triaxial body along s; C = 1.
double rotor_apart(double spin, double step) {
  const secular::HistoryOrbit orbit(staying(ellipse), turn * turn, 1.0, 0.3);
  const double E = star * spin / (1.5 * turn * turn), triaxiality = 0.2 * E;
  const Body body(1.0 - E - triaxiality, 1.0 - E + triaxiality, 1.0);
  const double half = 0.5 * obliquity;
  const RotorState from{{std::cos(half), -std::sin(half), 0.0, 0.0}, {0.0, 0.0, spin}};
  const System system(body, Frame::inertial(),
                      {AnyPerturbation("star", GravityGradient(turn * turn, orbit))});
  const SaveAt years = SaveAt::count(0.0, 10.0, 51);
  const auto rotor = integrate(Problem{system, from, 0.0, 10.0, Splitting{.step = step}},
                               Keep{.samples = years, .dense = false});
  const auto axis = moved(secular::SpinOnOrbit(orbit, star), start, years);
  Worst worst;
  for (std::size_t k = 0; k < axis.size(); ++k) {
    const RotorState& s = rotor.samples()[k].s;
    const Vec3 g = rotate(s.q, s.g);
    worst.add(norm((1.0 / norm(g)) * g - axis[k].s.s));
  }
  return worst.value();
}

// What is of the rotation goes as 1 / spin.
TEST(Averaging, TheRotorItselfComesNearerTheFasterItTurns) {
  const double slow = rotor_apart(200.0, 1e-3), fast = rotor_apart(800.0, 2.5e-4);
  EXPECT_LT(slow, budget::averaging_rotor);
  EXPECT_LT(fast, 0.3 * slow);
}

TEST(Averaging, TheSplittingIsTheAdaptiveMethod) {
  const secular::SpinOnOrbit model(secular::HistoryOrbit(staying(ellipse), turn * turn, 1.0), star);
  const SaveAt end = SaveAt::times({100.0});
  const secular::SpinAxis a = moved(model, start, end).back().s,
                          b = moved(model, start, end,
                                    Splitting{.step = 0.02, .scheme = SplittingScheme::order4})
                                  .back()
                                  .s;
  EXPECT_LT(norm(a.s - b.s), budget::averaging_methods);
  EXPECT_LT(std::fabs(norm(b.s) - 1.0), budget::secular_rounding);
}

}  // namespace
