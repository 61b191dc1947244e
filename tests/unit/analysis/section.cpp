// SPDX-License-Identifier: MIT
// Surfaces of section: the planar rotation of Hyperion by an independent integration, free rotation
// by its energy, symmetries, fixed points, and what fills a plane.
#include "polhode/analysis/section.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "unit/analysis/hyperion.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;
using std::numbers::pi;
using testing::HasSubstr;

constexpr int steps_per_orbit = 6000;  // of the planar equation

const Body body(1.0, 1.7, 2.2);
const RotorState tumbling{{0.8, 0.2, -0.4, 0.4}, {0.3, 0.9, 1.9}};
const KeplerOrbit saturn({.gm = 1.0, .pericentre = 1.0 - hyperion_e, .eccentricity = hyperion_e});

double folded(double angle) { return std::remainder(angle, pi); }

// The oracle's section: {angle, spin} at each pericentre.
std::vector<std::pair<double, double>> planar_section(double angle, double spin, int orbits) {
  std::vector<std::pair<double, double>> points{{angle, spin}};
  for (int k = 1; k <= orbits; ++k) {
    const auto [a, w] = points.back();
    const auto end = PlanarSpin::after({a, w, 0.0, 0.0}, hyperion_orbit, steps_per_orbit);
    points.emplace_back(end[0], end[1]);
  }
  return points;
}

TEST(SpinOrbitSection, OfHyperionIsThatOfThePlanarEquation) {
  const int orbits = 15;
  for (const auto& [angle, spin] : {std::pair{0.0, 2.3}, {0.0, 0.5}, {1.2, 2.6}}) {
    const auto expected = planar_section(angle, spin, orbits);
    for (const Method& method :
         {Method(Adaptive{1e-13}), Method(VariationOfConstants{1e-13}),
          Method(Splitting{hyperion_orbit / 512.0, SplittingScheme::ABA1064})}) {
      const analysis::SpinOrbitSection found = analysis::spin_orbit_section(
          hyperion(hyperion_state(angle, spin), orbits, method), saturn);
      ASSERT_TRUE(found.outcome.ok());
      ASSERT_EQ(found.points.size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const analysis::SpinOrbitPoint& point = found.points[k];
        EXPECT_EQ(point.t, static_cast<double>(k) * hyperion_orbit);
        EXPECT_NEAR(folded(point.angle - expected[k].first), 0.0, budget::section_planar);
        EXPECT_NEAR(point.spin, expected[k].second, budget::section_planar);
        EXPECT_NEAR(point.tilt, 0.0, budget::section_rounding);
      }
    }
  }
}

// A turn of orbit and body together changes nothing.
TEST(SpinOrbitSection, IsMeasuredFromTheOrbit) {
  const double node = 0.7, inclination = 1.9, argument = -2.2;
  const KeplerOrbit turned({.gm = 1.0,
                            .pericentre = 1.0 - hyperion_e,
                            .eccentricity = hyperion_e,
                            .inclination = inclination,
                            .node = node,
                            .argument = argument});
  const Quaternion q = rotation_z(node) * rotation_x(inclination) * rotation_z(argument);
  const RotorState s = hyperion_state(0.4, 2.3, 0.2);
  const System system(hyperion_body(), Frame::precessing({0.3, 0.1, 1.0}, 0.2),
                      {AnyPerturbation("Saturn", GravityGradient(1.0, turned))});
  const double stop = 8.0 * hyperion_orbit;
  const RotorState start = reference_state(system, 0.0, {q * s.q, s.g});
  const auto a = analysis::spin_orbit_section(hyperion(s, 8.0, Adaptive{1e-13}), saturn);
  const auto b =
      analysis::spin_orbit_section({system, start, 0.0, stop, Adaptive{1e-13}, {}}, turned);
  ASSERT_EQ(a.points.size(), 9U);
  ASSERT_EQ(b.points.size(), 9U);
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_NEAR(folded(a.points[k].angle - b.points[k].angle), 0.0, budget::section_planar);
    EXPECT_NEAR(a.points[k].spin, b.points[k].spin, budget::section_planar);
    EXPECT_NEAR(a.points[k].tilt, b.points[k].tilt, budget::section_planar);
  }
}

TEST(SpinOrbitSection, OfATiltedBodyIsAProjection) {
  const double angle = 0.6, tilt = 0.4, spin = 1.7;
  const auto found = analysis::spin_orbit_section(
      hyperion(hyperion_state(angle, spin, tilt), 0.5, Adaptive{}), saturn);
  ASSERT_EQ(found.points.size(), 1U);
  const analysis::SpinOrbitPoint& point = found.points[0];
  EXPECT_NEAR(point.tilt, tilt, budget::section_rounding);
  EXPECT_NEAR(point.spin, spin * std::cos(tilt), budget::section_rounding);
  EXPECT_NEAR(std::tan(point.angle), std::tan(angle) * std::cos(tilt), budget::section_rounding);
  // upside down: the other way round
  const auto under = analysis::spin_orbit_section(
      hyperion(hyperion_state(angle, spin, pi), 0.5, Adaptive{}), saturn);
  EXPECT_NEAR(under.points[0].spin, -spin, budget::section_rounding);
  EXPECT_NEAR(under.points[0].tilt, pi, budget::section_rounding);
}

// The nearest places of an orbit that precesses, found from its positions.
TEST(SpinOrbitSection, FollowsAnOrbitThatPrecesses) {
  const PrecessingKeplerOrbit orbit({.gm = 1.3,
                                     .pericentre = 1.1,
                                     .eccentricity = 0.2,
                                     .inclination = 0.5,
                                     .node = 1.0,
                                     .argument = 2.0,
                                     .mean_anomaly = 4.0,
                                     .epoch = 3.0},
                                    {.node = -0.01, .argument = 0.03, .mean_anomaly = 0.02});
  const System free(body);
  const Problem problem{free, tumbling, 2.0, 80.0, Adaptive{1e-12}, {}};
  const analysis::SpinOrbitSection found = analysis::spin_orbit_section(problem, orbit);
  ASSERT_GT(found.points.size(), 5U);
  for (const analysis::SpinOrbitPoint& point : found.points) {
    const Vec3 x = orbit.position(point.t);
    EXPECT_NEAR(norm(x), 1.1, budget::section_rounding);
    EXPECT_LT(norm(x), norm(orbit.position(point.t + 0.01)));
    EXPECT_LT(norm(x), norm(orbit.position(point.t - 0.01)));
    const Vec3 P = (1.0 / norm(x)) * x;
    const double node = 1.0 - 0.01 * (point.t - 3.0);
    const Vec3 N{std::sin(0.5) * std::sin(node), -std::sin(0.5) * std::cos(node), std::cos(0.5)};
    const Vec3 b1 = rotate(point.s.q, Vec3{1.0, 0.0, 0.0});
    EXPECT_NEAR(folded(point.angle - std::atan2(dot(b1, cross(N, P)), dot(b1, P))), 0.0,
                budget::section_rounding);
    const double n = std::sqrt(1.3 / std::pow(1.1 / 0.8, 3)) + 0.02;
    const Vec3 w = rotate(point.s.q, angular_velocity(free, point.t, point.s).inertial);
    EXPECT_NEAR(point.spin, dot(w, N) / n, budget::section_rounding);
  }
}

// A damper turns the body too.
TEST(SpinOrbitSection, SpinIsThatOfABodyWithADamper) {
  const System damped(body, Frame::inertial(), {}, KaneDamper(0.3, 0.05));
  const Problem problem{
      damped, {tumbling.q, tumbling.g, {0.1, -0.2, 0.4}}, 0.0, 30.0, Adaptive{1e-11}};
  const std::vector<analysis::SpinOrbitPoint> points =
      analysis::spin_orbit_section(problem, saturn).points;
  ASSERT_EQ(points.size(), 5U);
  std::vector<double> times;
  for (const analysis::SpinOrbitPoint& point : points) times.push_back(point.t);
  const auto samples = integrate(problem, Keep{.samples = SaveAt::times(times)}).samples();
  for (std::size_t k = 0; k < 5; ++k) {
    const Vec3& I = body.moments();
    const Vec3 v = damped.damper()->rate_of_body(body, samples[k].s.damper_rate);
    const RotorState& s = samples[k].s;
    const auto& [q, g] = s;
    const Vec3 w{g.x / I.x + v.x, g.y / I.y + v.y, g.z / I.z + v.z};
    EXPECT_NEAR(points[k].spin, rotate(q, w).z, budget::section_rounding);
  }
}

// At the pericentre with an axis towards Saturn: time reversed is the mirror image.
TEST(SpinOrbitSection, OfASymmetricStartIsSymmetric) {
  for (const double angle : {0.0, pi / 2.0}) {
    const RotorState s = hyperion_state(angle, 2.3);
    const auto there =
        analysis::spin_orbit_section(hyperion(s, 12.0, Adaptive{1e-13}), saturn).points;
    const auto back =
        analysis::spin_orbit_section(hyperion(s, -12.0, Adaptive{1e-13}), saturn).points;
    ASSERT_EQ(there.size(), 13U);
    ASSERT_EQ(back.size(), 13U);
    for (std::size_t k = 0; k < 13; ++k) {
      EXPECT_EQ(there[k].t, -back[k].t);
      EXPECT_NEAR(folded(there[k].angle + back[k].angle), 0.0, budget::section_planar);
      EXPECT_NEAR(there[k].spin, back[k].spin, budget::section_planar);
    }
  }
}

TEST(SpinOrbitSection, OfTheReversedRunIsTheSame) {
  const auto there = analysis::spin_orbit_section(
      hyperion(hyperion_state(0.9, 2.4, 0.1), 20.0, Adaptive{1e-13}), saturn);
  ASSERT_EQ(there.points.size(), 21U);
  const analysis::SpinOrbitPoint& last = there.points.back();
  const auto back = analysis::spin_orbit_section(
      {hyperion_system(), last.s, last.t, 0.0, Adaptive{1e-13}, {}}, saturn);
  ASSERT_EQ(back.points.size(), 21U);
  for (std::size_t k = 0; k < 21; ++k) {
    EXPECT_NEAR(folded(back.points[k].angle - there.points[20 - k].angle), 0.0,
                budget::section_planar);
    EXPECT_NEAR(back.points[k].spin, there.points[20 - k].spin, budget::section_planar);
  }
}

// The spin that brings the long axis back to the pericentre after `half_turns`, by the oracle.
double resonant_spin(double low, double high, int half_turns) {
  const auto beyond = [&](double spin) {
    return PlanarSpin::after({0.0, spin, 0.0, 0.0}, hyperion_orbit, steps_per_orbit)[0] -
           half_turns * pi;
  };
  EXPECT_LT(beyond(low) * beyond(high), 0.0);
  const bool rises = beyond(high) > 0.0;
  for (int trip = 0; trip < 60; ++trip) {
    const double middle = 0.5 * (low + high);
    ((beyond(middle) > 0.0) == rises ? high : low) = middle;
  }
  return low;
}

// By symmetry such a start is a fixed point of the section: the stable ones of 1:1 and 2:1.
TEST(SpinOrbitSection, OfAResonanceIsAPoint) {
  for (const auto& [low, high, half_turns] : {std::tuple{0.3, 0.8, 2}, std::tuple{2.2, 2.5, 4}}) {
    const double spin = resonant_spin(low, high, half_turns);
    const auto found = analysis::spin_orbit_section(
        hyperion(hyperion_state(0.0, spin), 30.0, Adaptive{1e-13}), saturn);
    ASSERT_EQ(found.points.size(), 31U);
    for (const analysis::SpinOrbitPoint& point : found.points) {
      EXPECT_NEAR(point.angle, 0.0, budget::section_planar);
      EXPECT_NEAR(point.spin, spin, budget::section_planar);
    }
  }
}

// How many boxes of a plane the points of a run are in.
std::size_t boxes(double angle, double spin, double orbits) {
  std::set<std::pair<int, int>> met;
  const auto found = analysis::spin_orbit_section(
      hyperion(hyperion_state(angle, spin), orbits, Adaptive{1e-9}), saturn);
  for (const analysis::SpinOrbitPoint& point : found.points)
    met.emplace(static_cast<int>(std::floor(point.angle * 32.0 / pi)),
                static_cast<int>(std::floor(point.spin * 16.0)));
  return met.size();
}

// A curve meets as many boxes as its length asks for, an area fills them: so does MEGNO tell.
TEST(SpinOrbitSection, ChaosFillsAnAreaAndRegularMotionACurve) {
  const double orbits = 400.0;
  const auto megno = [&](double angle, double spin) {
    return analysis::chaos_indicator(hyperion(hyperion_state(angle, spin), orbits, Adaptive{1e-9}),
                                     SaveAt::times({orbits * hyperion_orbit}))
        .mean_megno();
  };
  EXPECT_GT(megno(pi / 2.0, 1.0), 10.0);
  EXPECT_GT(boxes(pi / 2.0, 1.0, orbits), 200U);
  for (const auto& [angle, spin] : {std::pair{pi / 2.0, 2.6}, {0.0, 2.3}}) {
    EXPECT_LT(megno(angle, spin), 2.5);
    EXPECT_LT(boxes(angle, spin, orbits), 70U);
  }
}

// L^2 of a free body where l is known: its energy.
double free_L(double l, double E, double G) {
  const Vec3& I = body.moments();
  const double s = std::sin(l), c = std::cos(l);
  const double across = s * s / I.x + c * c / I.y;
  return std::sqrt((2.0 * E - G * G * across) / (1.0 / I.z - across));
}

// The times when g passes a value, by the exact rotation looked at every hundredth of a turn.
std::size_t passes(const FreeRotation& free, double stop, double value) {
  std::size_t count = 0;
  const double step = 0.01;
  double before = std::remainder(to_andoyer(free.at(0.0)).g - value, 2.0 * pi);
  for (double t = step; t < stop; t += step) {
    const double now = std::remainder(to_andoyer(free.at(t)).g - value, 2.0 * pi);
    if (before < 0.0 && now >= 0.0 && now - before < pi) ++count;
    before = now;
  }
  return count;
}

TEST(AndoyerSection, OfFreeRotationIsTheCurveOfItsEnergy) {
  const FreeRotation free(body, tumbling);
  const double stop = 300.0, value = 1.1, G = norm(tumbling.g);
  for (const Method& method :
       {Method(Adaptive{1e-13}), Method(Adaptive{.tolerance = 1e-6, .largest_step = 0.3}),
        Method(VariationOfConstants{1e-12}), Method(Splitting{0.5}), Method(Splitting{3.0})}) {
    const analysis::AndoyerSection found =
        analysis::andoyer_section({System(body), tumbling, 0.0, stop, method, {}},
                                  analysis::AndoyerSurface{analysis::AndoyerAngle::g, value});
    ASSERT_TRUE(found.outcome.ok());
    EXPECT_EQ(found.points.size(), passes(free, stop, value)) << found.method;
    for (const analysis::AndoyerPoint& point : found.points) {
      EXPECT_NEAR(std::remainder(point.andoyer.g - value, 2.0 * pi), 0.0, budget::section_curve);
      EXPECT_NEAR(point.andoyer.L, free_L(point.andoyer.l, free.energy(), G),
                  budget::section_curve);
      EXPECT_NEAR(point.andoyer.G, G, budget::section_curve);
    }
  }
}

// Steps of the method's own length.
TEST(AndoyerSection, LongStepsLoseNoPass) {
  const double stop = 300.0;
  for (const Method& method : {Method(Adaptive{1e-6}), Method(VariationOfConstants{1e-6}),
                               Method(Splitting{3.0}), Method(Splitting{20.0})}) {
    const analysis::AndoyerSection found =
        analysis::andoyer_section({System(body), tumbling, 0.0, stop, method, {}},
                                  analysis::AndoyerSurface{analysis::AndoyerAngle::g, 1.1});
    EXPECT_EQ(found.points.size(), passes(FreeRotation(body, tumbling), stop, 1.1));
  }
}

TEST(AndoyerSection, KnowsWhichWayItIsPassed) {
  const Problem problem{System(body), tumbling, 0.0, 100.0, Adaptive{1e-12}, {}};
  const auto count = [&](analysis::AndoyerAngle angle, Crossing crossing) {
    return analysis::andoyer_section(problem, analysis::AndoyerSurface{angle, 0.4, crossing})
        .points.size();
  };
  // about the short axis g rises and l falls, and h stays
  EXPECT_EQ(count(analysis::AndoyerAngle::g, Crossing::rising),
            count(analysis::AndoyerAngle::g, Crossing::both));
  EXPECT_EQ(count(analysis::AndoyerAngle::g, Crossing::falling), 0U);
  EXPECT_EQ(count(analysis::AndoyerAngle::l, Crossing::falling),
            count(analysis::AndoyerAngle::l, Crossing::both));
  EXPECT_GT(count(analysis::AndoyerAngle::l, Crossing::both), 5U);
  EXPECT_EQ(count(analysis::AndoyerAngle::h, Crossing::both), 0U);
}

// By a period: the samples of the run itself, whichever way it goes and wherever the epoch is.
TEST(AndoyerSection, ByAPeriodIsAStrobe) {
  const analysis::Strobe strobe{2.5, 0.75};
  for (const double stop : {31.0, -31.0}) {
    const Problem problem{System(body), tumbling, 0.0, stop, Adaptive{1e-11}, {}};
    const analysis::AndoyerSection found = analysis::andoyer_section(problem, strobe);
    ASSERT_EQ(found.points.size(), stop > 0.0 ? 13U : 12U);
    EXPECT_EQ(found.points[0].t, stop > 0.0 ? 0.75 : -1.75);
    std::vector<double> times;
    for (const analysis::AndoyerPoint& point : found.points) times.push_back(point.t);
    const std::vector<Sample> samples =
        integrate(problem, Keep{.samples = SaveAt::times(times)}).samples();
    for (std::size_t k = 0; k < samples.size(); ++k) {
      EXPECT_EQ(found.points[k].s, samples[k].s);
      EXPECT_EQ(found.points[k].andoyer, to_andoyer(samples[k].s));
    }
  }
  const Problem shorter{System(body), tumbling, 1.0, 2.0, Adaptive{}, {}};
  EXPECT_TRUE(analysis::andoyer_section(shorter, strobe).points.empty());
  const Problem from_one{System(body), tumbling, 0.75 + 7 * 2.5, 60.0, Adaptive{}, {}};
  EXPECT_EQ(analysis::andoyer_section(from_one, strobe).points[0].t, from_one.start);
}

TEST(AndoyerSection, PointsMayGoOneByOne) {
  const Problem problem{System(body), tumbling, 0.0, 40.0, Adaptive{1e-12}, {}};
  const analysis::AndoyerSection whole = analysis::andoyer_section(problem);
  std::vector<analysis::AndoyerPoint> points;
  const analysis::AndoyerSection end = analysis::andoyer_section(
      problem, analysis::AndoyerSurface{},
      [&](const analysis::AndoyerPoint& point) { points.push_back(point); });
  EXPECT_TRUE(end.points.empty());
  EXPECT_EQ(end.statistics.steps, whole.statistics.steps);
  ASSERT_EQ(points.size(), whole.points.size());
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_EQ(points[k].s, whole.points[k].s);
}

TEST(AndoyerSection, ARunThatCannotGoOnKeepsItsPoints) {
  const AnyPerturbation wall("wall", TorqueTerm([](double t, const RotorState& s) {
                               return (1e-3 * std::sqrt(20.0 - t)) * s.g;
                             }));
  const System system(body, Frame::inertial(), {wall});
  const auto found = analysis::andoyer_section({system, tumbling, 0.0, 50.0, Adaptive{1e-10}, {}});
  EXPECT_FALSE(found.outcome.ok());
  EXPECT_THAT(found.outcome.advice, HasSubstr("wall"));
  EXPECT_GT(found.points.size(), 2U);
}

TEST(Sections, RefuseWhatHasNone) {
  const auto andoyer = [&](const analysis::SectionSurface& surface, const Method& method) {
    return message_of([&] {
      analysis::andoyer_section({System(body), tumbling, 0.0, 1.0, method, {}}, surface);
    });
  };
  EXPECT_THAT(andoyer(analysis::Strobe{0.0}, Adaptive{}), HasSubstr("andoyer_section: period 0"));
  EXPECT_THAT(andoyer(analysis::Strobe{1.0, std::numeric_limits<double>::quiet_NaN()}, Adaptive{}),
              HasSubstr("must be finite"));
  EXPECT_THAT(andoyer(analysis::AndoyerSurface{analysis::AndoyerAngle::g,
                                               std::numeric_limits<double>::infinity()},
                      Adaptive{}),
              HasSubstr("value inf must be finite"));
  EXPECT_EQ(andoyer(analysis::Strobe{1.0}, Splitting{3.0}), "");
  const auto orbit = [&](double e) {
    const KeplerOrbit path({.gm = 1.0, .pericentre = 1.0, .eccentricity = e});
    return message_of([&] {
      analysis::spin_orbit_section({System(body), tumbling, 0.0, 1.0, Adaptive{}, {}}, path);
    });
  };
  EXPECT_THAT(orbit(0.0), HasSubstr("a circular orbit has no pericentre"));
  EXPECT_THAT(orbit(1.5), HasSubstr("a hyperbola passes its pericentre once"));
  EXPECT_EQ(orbit(0.3), "");
}

}  // namespace
