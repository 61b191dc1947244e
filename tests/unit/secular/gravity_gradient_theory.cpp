// SPDX-License-Identifier: MIT
// Mean rotation under a gravity gradient. Oracles: the energy of GravityGradient, closed forms of
// Hansen's coefficients and of the first-order precession, and the rotor itself, integrated: slopes
// 2 and 3 of the error for the first and the second order.
#include "polhode/secular/gravity_gradient_theory.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/series/compiled_series.hpp"
#include "polhode/series/product.hpp"
#include "polhode/series/taylor_coefficient.hpp"
#include "secular/gravity_gradient_transform.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
using polhode::test::Worst;
using ::testing::HasSubstr;

constexpr double n = 0.0531;  // mean motion; bodies turn about once in 2 pi
const Quaternion attitude = normalized(Quaternion{0.6, 0.5, -0.3, 0.4});

const Body axisymmetric(1.0, 1.0, 1.5), short_axis(1.0, 1.3, 1.7), long_axis(1.0, 1.8, 2.0);

KeplerOrbit orbit_of(double e, double mean_motion = n) {
  return KeplerOrbit({mean_motion * mean_motion, 1.0 - e, e, 0.5, 0.3, 0.7, 0.2, -3.0});
}
RotorState start(const Body& body) {
  const bool is_long = body.moments() == long_axis.moments();
  return rotor_state(body, attitude, is_long ? Vec3{1.0, 0.1, 0.2} : Vec3{0.3, 0.1, 1.0});
}
double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = conj(a) * b;
  return 2.0 * std::atan2(std::hypot(d.x, d.y, d.z), std::abs(d.w));
}

// The largest error in attitude and momentum over a run, of gm = n^2 times `strength`.
double error(const Body& body, const RotorState& s0, double e, double strength,
             const secular::GravityGradientOptions& options) {
  const double gm = strength * n * n, stop = 300.0;
  const KeplerOrbit orbit = orbit_of(e);
  const secular::GravityGradientTheory theory(body, gm, orbit, s0, 0.0, options);
  std::vector<double> times;
  for (int i = 1; i <= 20; ++i) times.push_back(stop * i / 20.0);
  const std::vector<RotorState> found = theory.states(0.0, theory.mean(0.0, s0), times, 1e-13);
  const System system(body, Frame::inertial(),
                      {AnyPerturbation("torque", GravityGradient<KeplerOrbit>(gm, orbit))});
  const Trajectory exact =
      integrate(Problem{system, s0, 0.0, stop, Adaptive{1e-13}}, Keep{SaveAt::times(times), false});
  Worst worst;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const RotorState& s = exact.samples()[i].s;
    worst.add(angle_between(found[i].q, s.q));
    worst.add(norm(found[i].g - s.g) / norm(s.g));
  }
  return worst.value();
}

void expect_slope(const Body& body, const RotorState& s0, double e, double strength,
                  const secular::GravityGradientOptions& options) {
  const double slope = std::log2(error(body, s0, e, strength, options) /
                                 error(body, s0, e, 0.5 * strength, options));
  EXPECT_NEAR(slope, options.order + 1, budget::gravity_theory_slope)
      << "order " << options.order << ", orbit averaged: " << options.averages_orbit;
}
void expect_slopes(const Body& body, double e, double strength) {
  for (const bool averages : {true, false})
    for (const int order : {1, 2})
      expect_slope(body, start(body), e, strength, {order, averages, 1e-15});
}

TEST(GravityGradientTheory, SlopesOfAxisymmetricBody) {
  expect_slopes(axisymmetric, 0.0, 0.2);
  expect_slopes(axisymmetric, 0.1, 0.2);
}
TEST(GravityGradientTheory, SlopesOfTriaxialBodies) {
  expect_slopes(short_axis, 0.0, 0.2);
  expect_slope(short_axis, start(short_axis), 0.05, 0.2, {2, true, 1e-14});
  expect_slopes(long_axis, 0.0, 0.05);
}
// A satellite that turns 160 times an orbit: what is dropped must not show in the mean rates, and
// the drift is told. With 1e-11 the error was 1.6e-7, and nothing said so.
TEST(GravityGradientTheory, DriftIsWhatIsTold) {
  const double mean_motion = 1.0 / 160.0, gm = mean_motion * mean_motion;
  const double stop = 6.0 * std::numbers::pi / mean_motion;
  const KeplerOrbit orbit = orbit_of(0.05, mean_motion);
  const RotorState s0 = start(short_axis);
  const System system(short_axis, Frame::inertial(),
                      {AnyPerturbation("torque", GravityGradient<KeplerOrbit>(gm, orbit))});
  const Trajectory exact = integrate(Problem{system, s0, 0.0, stop, Collocation{1e-14}},
                                     Keep{SaveAt::times({stop}), false});
  const auto drift = [&](const secular::GravityGradientOptions& options, double& told) {
    const secular::GravityGradientTheory theory(short_axis, gm, orbit, s0, 0.0, options);
    told = theory.rate_error() * stop;
    return angle_between(theory.states(0.0, theory.mean(0.0, s0), {{stop}}, 1e-13)[0].q,
                         exact.samples()[0].s.q);
  };
  double told = 0.0;
  EXPECT_LT(drift({.averages_orbit = false}, told), budget::gravity_theory_drift);
  EXPECT_LT(told, 30.0 * budget::gravity_theory_drift);
  const double coarse = drift({.averages_orbit = false, .least = 1e-11}, told);
  EXPECT_LT(coarse, told);
  EXPECT_GT(coarse, told / budget::gravity_theory_told);
}
// The other lobe, momentum below the orbit, moments in another order, a prolate body.
TEST(GravityGradientTheory, SlopesInEveryMode) {
  const Body prolate(1.0, 1.5, 1.5), permuted(1.7, 1.0, 1.3);
  const secular::GravityGradientOptions second{2, true, 1e-15};
  const auto slope = [&](const Body& body, const Vec3& w, const Quaternion& q, double e,
                         double strength) {
    expect_slope(body, rotor_state(body, q, w), e, strength, second);
  };
  const Quaternion below = rotation_x(2.2) * attitude;
  slope(axisymmetric, {0.3, 0.1, -1.0}, attitude, 0.05, 0.2);
  slope(short_axis, {0.3, 0.1, -1.0}, attitude, 0.0, 0.2);
  slope(axisymmetric, {0.3, 0.1, 1.0}, below, 0.05, 0.2);
  slope(short_axis, {0.3, 0.1, 1.0}, below, 0.0, 0.2);
  slope(permuted, {1.0, 0.3, 0.1}, attitude, 0.0, 0.2);
  slope(long_axis, {-1.0, 0.1, 0.2}, attitude, 0.0, 0.05);
  slope(prolate, {1.0, 0.1, 0.2}, attitude, 0.0, 0.05);
  slope(prolate, {-1.0, 0.1, 0.2}, attitude, 0.05, 0.05);
}

// At the first order the mean node moves by -3/2 gm/a^3 (1 - e^2)^(-3/2) (C - A) cos I
// (1 - 3/2 sin^2 J) / G.
TEST(GravityGradientTheory, FirstOrderPrecessionIsTheClosedForm) {
  const double e = 0.3, gm = 0.1 * n * n;
  const RotorState s0 = start(axisymmetric);
  const secular::GravityGradientTheory theory(axisymmetric, gm, orbit_of(e), s0, 0.0,
                                              {1, true, 1e-15});
  const secular::MeanRotation m = theory.mean(0.0, s0);
  const auto rates = theory.rates(DoubleDouble(0.0), theory.values<double>(m));
  const double cos_I = m.I_h / m.I_g, cos_J = m.I_l / m.I_g;
  const double exact = -1.5 * gm * std::pow(1.0 - e * e, -1.5) * 0.5 * cos_I *
                       (1.0 - 1.5 * (1.0 - cos_J * cos_J)) / m.I_g;
  EXPECT_NEAR(rates[2] / exact, 1.0, budget::gravity_theory_closed);
  EXPECT_EQ(rates[5], 0.0);
}

// On a circle the second-order K depends on actions alone too; on an ellipse on phi_h.
TEST(GravityGradientTheory, MeanHamiltonianHasTheAnglesThatStay) {
  const double gm = 0.1 * n * n;
  const RotorState s0 = start(short_axis);
  const auto angles = [&](double e, bool averages, const char* name) {
    const secular::GravityGradientTheory theory(short_axis, gm, orbit_of(e), s0, 0.0,
                                                {2, averages, 1e-11});
    return !series::derivative(theory.mean_hamiltonian(), name).is_zero();
  };
  EXPECT_FALSE(angles(0.0, true, "phi_h"));
  EXPECT_TRUE(angles(0.05, true, "phi_h"));
  EXPECT_TRUE(angles(0.0, false, "M"));
  for (const char* const name : {"phi_l", "phi_g"}) EXPECT_FALSE(angles(0.05, false, name));
}

TEST(GravityGradientTheory, MeanElementsGoBackToTheState) {
  const KeplerOrbit orbit = orbit_of(0.1);
  for (const Body& body : {axisymmetric, short_axis, long_axis}) {
    const RotorState s0 = start(body);
    const secular::GravityGradientTheory theory(body, 0.05 * n * n, orbit, s0, 2.0,
                                                {2, true, 1e-11});
    Worst worst;
    for (const double t : {2.0, 7.5}) {
      const secular::MeanRotation m = theory.mean(t, s0);
      const RotorState back = theory.osculating(t, m);
      worst.add(angle_between(back.q, s0.q));
      worst.add(norm(back.g - s0.g));
      EXPECT_GT(std::abs(m.I_g - theory.elements(t, s0).I_g), budget::gravity_theory_moved);
    }
    EXPECT_LT(worst.value(), budget::gravity_theory_back);
    // Near the motion that it was made of, 1e-3 of the momentum away.
    const RotorState near = {s0.q, 1.001 * s0.g};
    EXPECT_LT(angle_between(theory.osculating(0.0, theory.mean(0.0, near)).q, near.q),
              budget::gravity_theory_back);
  }
}

TEST(GravityGradientTheory, StatesBeforeAndAfterInAnyOrder) {
  const RotorState s0 = start(short_axis);
  const secular::GravityGradientTheory theory(short_axis, 0.1 * n * n, orbit_of(0.05), s0, 0.0);
  const secular::MeanRotation m = theory.mean(0.0, s0);
  const std::vector<double> times = {20.0, -10.0, 0.0, 20.0};
  const auto found = theory.states(0.0, m, times);
  EXPECT_EQ(found[0], found[3]);
  EXPECT_EQ(found[2], theory.osculating(0.0, m));
  for (const std::size_t i : {0U, 1U}) {
    const BasicProblem<secular::GravityGradientTheory> problem{theory, m, 0.0, times[i],
                                                               Adaptive{1e-12}};
    const secular::MeanRotation there = integrate(problem, Keep{}, Progress{}).at(times[i]);
    EXPECT_LT(angle_between(found[i].q, theory.osculating(times[i], there).q),
              budget::gravity_theory_back);
  }
  EXPECT_TRUE(theory.states(0.0, m, {}).empty());
  std::vector<double> seen;
  const auto means = theory.means(0.0, m, times, 1e-12, [&](double t) { seen.push_back(t); });
  EXPECT_EQ(theory.osculating(-10.0, means[1]), found[1]);
  EXPECT_EQ(means[2], m);
  EXPECT_THAT(seen, ::testing::Contains(-10.0));
}

// --- what it is made of ---

TEST(RotationHarmonics, AreTheEnergyOfTheGravityGradient) {
  using polhode::secular::detail::ActionTaylor;
  const double e = 0.2, gm = 2.0;
  const KeplerOrbit orbit({gm, 1.0 - e, e});  // in its own axes
  const series::Symbols names({"I_l", "I_g", "I_h", "k"}, {"phi_l", "phi_g", "phi_h", "M"},
                              {{"phi_l", "I_l"}, {"phi_g", "I_g"}, {"phi_h", "I_h"}});
  const GravityGradient<KeplerOrbit> torque(gm, orbit);
  for (const Body& body : {axisymmetric, short_axis, long_axis, Body(1.7, 1.0, 1.3)}) {
    const RotorState s0 = start(body);
    const FreeRotation motion(body, s0);
    SadovState at = to_sadov(motion, 0.0);
    const auto tensor = polhode::secular::detail::turning_tensor(body, at, 1e-16);
    EXPECT_NEAR(tensor.energy.constant(), motion.energy(), budget::gravity_theory_series);
    EXPECT_NEAR(tensor.energy.derivative(0).constant(), sadov_frequencies(motion).n_l,
                budget::gravity_theory_series);
    EXPECT_NEAR(tensor.energy.derivative(1).constant(), sadov_frequencies(motion).n_g,
                budget::gravity_theory_series);
    const auto waves = polhode::secular::detail::orbit_waves(Eccentricity::of(e), 1e-16);
    const auto series =
        polhode::secular::detail::gradient_series(names, tensor, waves, at, 1.5 * gm);
    const series::CompiledSeries compiled(series::expanded(series));
    Worst worst;
    for (int i = 0; i < 10; ++i) {
      // Other actions too, as near as their Taylor polynomials reach.
      const double d = 3e-5 * (i % 3 - 1), t = 0.7 * i;
      SadovState s = at;
      s.phi_l = 0.9 * i;
      s.phi_g = 2.0 - 1.3 * i;
      s.phi_h = 0.4 * i;
      s.I_l += d;
      s.I_g += 2.0 * d;
      s.I_h -= d;
      const std::array<double, 8> point = {d,       2.0 * d, -d,      1.0,
                                           s.phi_l, s.phi_g, s.phi_h, orbit.mean_motion() * t};
      const Setting here{body, t, to_rotor(body, s), {}};
      worst.add(std::abs(compiled.at(point) - torque.energy(here)));
    }
    EXPECT_LT(worst.value(), budget::gravity_theory_series);
  }
}

TEST(RotationHarmonics, HansenCoefficientsHaveTheirClosedForms) {
  const auto of = [](const std::vector<polhode::secular::detail::OrbitWave>& waves, int q) {
    for (const auto& wave : waves)
      if (wave.multiple == q) return wave.c;
    return 0.0;
  };
  const auto circle = polhode::secular::detail::orbit_waves(Eccentricity::of(0.0), 1e-14);
  ASSERT_EQ(circle.even.size(), 1U);
  ASSERT_EQ(circle.turning.size(), 1U);
  EXPECT_EQ(circle.turning[0].multiple, 2);
  EXPECT_NEAR(circle.turning[0].c, 1.0, budget::gravity_theory_closed);
  for (const double e : {0.01, 0.2, 0.7, 0.9}) {
    const auto waves = polhode::secular::detail::orbit_waves(Eccentricity::of(e), 1e-14);
    const double mean = std::pow(1.0 - e * e, -1.5);
    EXPECT_NEAR(of(waves.even, 0) / mean, 1.0, budget::gravity_theory_closed);
    EXPECT_NEAR(of(waves.turning, 0), 0.0, budget::gravity_theory_closed);
    double pericentre = 0.0;  // all are in phase there
    for (const auto& wave : waves.turning) pericentre += wave.c;
    EXPECT_NEAR(pericentre * std::pow(1.0 - e, 3), 1.0, budget::gravity_theory_closed);
    EXPECT_EQ(of(waves.even, 3), of(waves.even, -3));
  }
  // X_1(-3, 2) = -e/2 + e^3/16, X_3 = 7e/2 - 123 e^3/16 (Goldreich & Peale 1966).
  const double e = 1e-3;
  const auto waves = polhode::secular::detail::orbit_waves(Eccentricity::of(e), 1e-18);
  EXPECT_NEAR(of(waves.turning, 1), -0.5 * e + e * e * e / 16.0, budget::gravity_theory_closed);
  EXPECT_NEAR(of(waves.turning, 3), 3.5 * e - 123.0 / 16.0 * e * e * e,
              budget::gravity_theory_closed);
}

TEST(GravityGradientTheory, Refuses) {
  const KeplerOrbit orbit = orbit_of(0.1);
  const auto refused = [&](const Body& body, const RotorState& s, double gm,
                           const secular::GravityGradientOptions& options = {}) {
    return message_of([&] { secular::GravityGradientTheory(body, gm, orbit, s, 0.0, options); });
  };
  const double gm = 0.05 * n * n;
  const RotorState s0 = start(short_axis);
  EXPECT_EQ(refused(short_axis, s0, gm), "");
  EXPECT_THAT(refused(short_axis, s0, -1.0), HasSubstr("gm = -1 must be positive"));
  EXPECT_THAT(refused(short_axis, s0, gm, {3, true, 1e-11}), HasSubstr("order 3 must be 1 or 2"));
  EXPECT_THAT(refused(short_axis, s0, gm, {2, true, 0.0}), HasSubstr("least = 0 must be positive"));
  EXPECT_THAT(refused(Body(1, 1, 1), s0, gm), HasSubstr("a sphere has no gravity gradient"));
  EXPECT_THAT(refused(short_axis, {attitude, {0, 0, 0}}, gm), HasSubstr("at rest"));
  const auto spinning = [&](const Vec3& w) { return rotor_state(short_axis, attitude, w); };
  EXPECT_THAT(refused(short_axis, spinning({0, 0, 1}), gm),
              HasSubstr("next to spin about an axis"));
  EXPECT_THAT(refused(short_axis, spinning({0, 1, 0}), gm),
              HasSubstr("next to spin about an axis"));
  EXPECT_THAT(refused(short_axis, spinning({0.03, 0.0, 1}), n * n),
              HasSubstr("the torque moves I_l / I_g by"));
  const Quaternion to_inertial = rotation_z(0.3) * rotation_x(0.5) * rotation_z(0.7);
  const Vec3 g_B = s0.g;
  const double tilt = std::acos(g_B.z / norm(g_B));
  const Vec3 axis = cross(g_B, Vec3{0, 0, 1});
  const Vec3 u = (1.0 / norm(axis)) * axis;
  const double sine = std::sin(0.5 * tilt);
  const Quaternion upright{std::cos(0.5 * tilt), sine * u.x, sine * u.y, sine * u.z};
  EXPECT_THAT(refused(short_axis, {to_inertial * upright, g_B}, gm),
              HasSubstr("the momentum is along the normal of the orbit"));
  EXPECT_REJECTED(
      secular::GravityGradientTheory(short_axis, gm, KeplerOrbit({1.0, 1.0, 1.5}), s0, 0.0),
      "the eccentricity 1.5 must be below 1");
  EXPECT_REJECTED(secular::GravityGradientTheory(short_axis, gm, orbit_of(0.91), s0, 0.0),
                  "the eccentricity 0.91 must be at most 0.9");
  const secular::GravityGradientTheory theory(short_axis, gm, orbit, s0, 0.0);
  EXPECT_REJECTED(theory.mean(0.0, spinning({1, 0.1, 0.1})), "in another mode");
}

TEST(GravityGradientTheory, RefusesWhatIsFarOrNoTime) {
  const RotorState s0 = start(short_axis);
  const secular::GravityGradientTheory theory(short_axis, 0.05 * n * n, orbit_of(0.1), s0, 0.0);
  const secular::MeanRotation m = theory.mean(0.0, s0);
  EXPECT_REJECTED(theory.mean(0.0, RotorState{s0.q, 1.4 * s0.g}), "and the theory is made for");
  secular::MeanRotation other = m;
  other.I_h = 0.99 * m.I_g;
  EXPECT_REJECTED(theory.osculating(0.0, other), "I_h / I_g = 0.99");
  other = m;
  other.I_l = m.I_g;
  EXPECT_REJECTED(theory.osculating(0.0, other), "I_l / I_g = 1,");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> with_nan = {1.0, nan, -2.0}, with_infinity = {infinity};
  const std::vector<std::string> messages = {
      message_of([&] { theory.states(0.0, m, with_nan); }),
      message_of([&] { theory.states(0.0, m, with_infinity); }),
      message_of([&] { theory.means(nan, m, std::vector{1.0}); }),
      message_of([&] { theory.mean(nan, s0); }),
      message_of([&] { theory.osculating(infinity, m); }),
      message_of([&] { theory.elements(nan, s0); }),
      message_of(
          [&] { secular::GravityGradientTheory(short_axis, 1e-4, orbit_of(0.1), s0, nan); })};
  for (const std::string& message : messages) EXPECT_THAT(message, HasSubstr("must be finite"));
}

// The body turns about its momentum once an orbit.
TEST(GravityGradientTheory, NamesAResonance) {
  const RotorState s0 = start(axisymmetric);
  const double n_g = sadov_frequencies(FreeRotation(axisymmetric, s0)).n_g;
  const std::string message = message_of([&] {
    secular::GravityGradientTheory(axisymmetric, 1e-3 * n_g * n_g, orbit_of(0.1, 1.001 * n_g), s0,
                                   0.0);
  });
  EXPECT_THAT(message, HasSubstr("a resonance: phi_g - M turns at the rate"));
  EXPECT_THAT(message, HasSubstr("the torque holds what is slower than"));
  EXPECT_REJECTED(
      secular::GravityGradientTheory(axisymmetric, 1e-9 * n_g * n_g, orbit_of(0.1, n_g), s0, 0.0),
      "a resonance: phi_g");
}

}  // namespace
