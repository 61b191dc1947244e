// SPDX-License-Identifier: MIT
// A satellite on a circular orbit librates about the local vertical: its frequencies against the
// linear theory (DeBra & Delp 1961; Hughes, Spacecraft Attitude Dynamics, 1986, section 9.2) and,
// in pitch, against the pendulum. S turns with the orbit: x outward, y along the track, z along its
// normal; n = 1.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "budgets.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::larger;

// Moments of yaw, roll, pitch: in Lagrange's region, and no libration near twice another. (At (0.4,
// 0.85, 1) pitch has twice the slow frequency of roll and yaw, which 1e-3 rad then shifts
// by 1.4e-6.)
const Body satellite(0.5, 0.8, 1.0);

System on_circular_orbit(const Body& body) {
  const KeplerOrbit orbit({.gm = 1.0, .pericentre = 1.0, .eccentricity = 0.0});
  return System(body, Frame::precessing({0.0, 0.0, 1.0}, 1.0),
                {AnyPerturbation("gravity gradient", GravityGradient(1.0, orbit))});
}

// Angles (yaw, roll, pitch), small but for pitch, and their rates relative to S, to first order.
RotorState tilted(const Body& body, const Vec3& angle, const Vec3& rate) {
  const Quaternion pitch = rotation_z(angle.z);
  const Quaternion small{1.0, 0.5 * angle.x, 0.5 * angle.y, 0.0};
  const Quaternion q = normalized(pitch * small);
  const Vec3 w = rate + rotate(conj(q), Vec3{0.0, 0.0, 1.0});
  const Vec3& I = body.moments();
  return {q, {I.x * w.x, I.y * w.y, I.z * w.z}};
}

// The mean frequency of the falling zeros of one component of q over a run.
double frequency(const RotorState& start, double Quaternion::*component, double span) {
  Problem p{on_circular_orbit(satellite), start, 0.0, span, Adaptive{.tolerance = 1e-13}};
  p.events = {{"zero", [component](double, const RotorState& s) { return s.q.*component; },
               Crossing::falling}};
  const Trajectory run = integrate(p, {.dense = false});
  const std::vector<EventRecord>& zeros = run.events();
  EXPECT_GT(zeros.size(), 10U);
  const double cycles = static_cast<double>(zeros.size() - 1);
  return 2.0 * std::numbers::pi * cycles / (zeros.back().t - zeros.front().t);
}

double pitch_frequency() {
  const Vec3& I = satellite.moments();
  return std::sqrt(3.0 * (I.y - I.x) / I.z);
}

TEST(Libration, SmallPitchHasTheLinearFrequency) {
  const RotorState start = tilted(satellite, {0.0, 0.0, 1e-3}, {});
  EXPECT_NEAR(frequency(start, &Quaternion::z, 600.0) / pitch_frequency(), 1.0,
              budget::libration_frequency);
}

// theta'' = -(w0^2/2) sin 2 theta: twice the pitch is a pendulum.
TEST(Libration, LargePitchHasThePendulumsFrequency) {
  const RotorState start = tilted(satellite, {0.0, 0.0, 0.5}, {});
  const double k = std::sin(0.5);
  const double pendulum = pitch_frequency() * std::numbers::pi / (2.0 * std::comp_ellint_1(k));
  EXPECT_NEAR(frequency(start, &Quaternion::z, 600.0) / pendulum, 1.0, budget::libration_frequency);
}

// With yaw a = B sin wt and roll A cos wt: w^4 - (1 + 3 kr + kr ky) w^2 + 4 kr ky = 0 and
// B (ky - w^2) = -(1 - ky) w A, ky = (I3 - I2)/I1, kr = (I3 - I1)/I2.
TEST(Libration, RollAndYawHaveTheirTwoLinearFrequencies) {
  const Vec3& I = satellite.moments();
  const double ky = (I.z - I.y) / I.x, kr = (I.z - I.x) / I.y;
  const double half = 0.5 * (1.0 + 3.0 * kr + kr * ky);
  const double root = std::sqrt(half * half - 4.0 * kr * ky);
  for (const double w2 : {half - root, half + root}) {
    const double w = std::sqrt(w2);
    const double roll = 1e-3 / larger(1.0, std::fabs((1.0 - ky) * w / (w2 - ky)));
    const double yaw = (1.0 - ky) * w / (w2 - ky) * roll;
    const RotorState start = tilted(satellite, {0.0, roll, 0.0}, {yaw * w, 0.0, 0.0});
    EXPECT_NEAR(frequency(start, &Quaternion::y, 600.0) / w, 1.0, budget::libration_frequency);
  }
}

// Outside the regions the same disturbance grows at the linear rate.
TEST(Libration, AnUnstableShapeLeavesAtTheLinearRate) {
  const Body upside_down(0.85, 0.4, 1.0);  // I1 > I2: pitch is unstable
  const double rate = std::sqrt(3.0 * (0.85 - 0.4) / 1.0);
  const Trajectory run = integrate({on_circular_orbit(upside_down),
                                    tilted(upside_down, {0.0, 0.0, 1e-6}, {0.0, 0.0, 1e-6 * rate}),
                                    0.0, 8.0 / rate, Adaptive{.tolerance = 1e-13}},
                                   {.samples = SaveAt::times({1.0 / rate, 8.0 / rate})});
  const double growth = std::log(run.samples()[1].s.q.z / run.samples()[0].s.q.z);
  EXPECT_NEAR(growth, 7.0, budget::libration_growth);
}

}  // namespace
