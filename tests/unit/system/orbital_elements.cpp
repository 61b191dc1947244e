// SPDX-License-Identifier: MIT
// Elements of a satellite in every gauge, beside the integration of its position and momentum.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/dynamics/satellite_path.hpp"
#include "polhode/system/satellite_system.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
using polhode::test::Worst;
using testing::HasSubstr;
using enum satellites::OrbitalSet;

constexpr double gm = 1.3, pi = std::numbers::pi;
constexpr double J2 = 2e-3, radius = 0.8;
const satellites::SatelliteState start{{1.1, -0.2, 0.4}, {0.1, 0.9, 0.35}};

Frame precessing() { return Frame::precessing({0.36, 0.48, 0.8}, 0.03); }
// A precession about a cone whose rate grows, and an energy with a dH'/dp quadratic in p that
// depends on time.
satellites::SatelliteSystem bent_system() {
  const Frame frame = Frame::orbit_plane([](const auto& t) { return 0.02 * t + 0.004 * t * t; },
                                         [](const auto& t) { return 0.3 + 0.01 * t; });
  const auto H = []<class T>(const T& t, const satellites::BasicSatelliteState<T>& s) {
    using std::cos;
    return T(T(0.002) * s.p.x * s.p.y * s.p.z + T(0.004) * cos(T(0.7) * t) * s.p.x * s.r.y);
  };
  return satellites::SatelliteSystem(
      gm, frame, {satellites::oblateness(gm, J2, radius), satellites::OrbitalPerturbation(H)});
}
satellites::SatelliteSystem oblate_planet() {
  return satellites::SatelliteSystem(gm, precessing(), {satellites::oblateness(gm, J2, radius)});
}
rates::Gauge general_gauge() {
  return rates::Gauge([](const rates::Gauge::Elements& C, const Tangent& t) {
    using std::cos;
    using std::sin;
    return BasicVec3<Tangent>{Tangent(0.002) * sin(C[0] + Tangent(0.3) * t) * C[4],
                              Tangent(0.001) * C[3] + Tangent(0.002) * cos(C[1]),
                              Tangent(0.0015) * sin(C[2]) + Tangent(0.0004) * C[5]};
  });
}
std::array<rates::Gauge, 3> gauges() {
  return {rates::Gauge::canonical(), rates::Gauge::osculating(), general_gauge()};
}
bool is_angle(satellites::OrbitalSet set, std::size_t k) { return set == delaunay ? k < 3 : k > 2; }

// d/dt of the elements along the motion by differences of order 8.
double error_of_rates(satellites::OrbitalSet set, const satellites::SatelliteSystem& system,
                      const rates::Gauge& gauge) {
  constexpr double t = 0.4, h = 0.02;
  constexpr std::array<double, 4> weights{672.0 / 840, -168.0 / 840, 32.0 / 840, -3.0 / 840};
  const BasicTrajectory<satellites::SatelliteState> later =
      satellites::satellite_path(system, start, t, t + 5 * h);
  const BasicTrajectory<satellites::SatelliteState> before =
      satellites::satellite_path(system, start, t, t - 5 * h);
  satellites::OrbitalElements expected{};
  for (int k = 1; k <= 4; ++k) {
    const double d = k * h;
    const auto b = elements_of_state(system, t + d, later.at(t + d), set, gauge);
    const auto a = elements_of_state(system, t - d, before.at(t - d), set, gauge);
    for (std::size_t i = 0; i < 6; ++i) {
      const double change = b[i] - a[i];
      expected[i] += weights[static_cast<std::size_t>(k - 1)] / h *
                     (is_angle(set, i) ? std::remainder(change, 2.0 * pi) : change);
    }
  }
  const auto rates =
      element_rates(system, t, elements_of_state(system, t, start, set, gauge), set, gauge);
  Worst worst;
  for (std::size_t i = 0; i < 6; ++i) worst.add(std::fabs(rates[i] - expected[i]));
  return worst.value();
}

// [SA (104)]
TEST(OrbitalElements, HaveTheRatesAlongAPathInEverySetAndGauge) {
  for (const satellites::OrbitalSet set : {delaunay, keplerian})
    for (const rates::Gauge& gauge : gauges()) {
      EXPECT_LE(error_of_rates(set, oblate_planet(), gauge), budget::orbital_rates);
      EXPECT_LE(error_of_rates(set, bent_system(), gauge), budget::orbital_rates);
    }
}

TEST(OrbitalElements, GoToStatesAndBackInEverySetAndGauge) {
  const satellites::SatelliteSystem system = bent_system();
  for (const satellites::OrbitalSet set : {delaunay, keplerian})
    for (const rates::Gauge& gauge : gauges()) {
      const satellites::OrbitalElements C = elements_of_state(system, 0.4, start, set, gauge);
      const satellites::SatelliteState back = element_state(system, 0.4, C, set, gauge);
      EXPECT_LE(norm(back.r - start.r) + norm(back.p - start.p), budget::orbital_maps);
      // the velocity is that of the Kepler orbit and the convective term
      const Vec3 velocity = satellites::satellite_rates(system, 0.4, start).r;
      const Vec3 u = element_state(satellites::SatelliteSystem(gm), 0.4, C, set).p;
      const Vec3 phi = element_convective_term(system, 0.4, C, set, gauge);
      EXPECT_LE(norm(u + phi - velocity), budget::orbital_maps);
    }
}

// Mean rates of canonical elements are derivatives of the mean energy:
// <H'> = -gm J2 R^2 (3 cos^2 i - 1) / (4 a^3 (1 - e^2)^(3/2)) and -mu_3 H.
TEST(OrbitalElements, MeanCanonicalRatesAreTheSecularOnes) {
  const double a = 1.2, e = 0.25, i = 0.7, mu3 = 0.02;
  const satellites::SatelliteSystem system(gm, Frame::precessing({0.0, 0.0, 1.0}, mu3),
                                           {satellites::oblateness(gm, J2, radius)});
  constexpr int count = 64;
  double node = 0.0, argument = 0.0;
  for (int k = 0; k < count; ++k) {
    const auto rates =
        element_rates(system, 0.0, {a, e, i, 0.4, 1.1, 2.0 * pi * k / count}, keplerian);
    node += rates[3] / count;
    argument += rates[4] / count;
  }
  const double n = std::sqrt(gm / (a * a * a)), parameter = a * (1.0 - e * e);
  const double size = 1.5 * n * J2 * std::pow(radius / parameter, 2), c = std::cos(i);
  EXPECT_NEAR(node, -size * c - mu3, budget::orbital_secular);
  EXPECT_NEAR(argument, size * (2.5 * c * c - 0.5), budget::orbital_secular);
}

struct Six {
  satellites::OrbitalElements z{};
  bool operator==(const Six&) const = default;
};
template <class Visit>
void each_number(Six& s, Visit&& visit) {
  for (double& x : s.z) visit(x);
}
struct InElements {
  using State = Six;
  using Values = satellites::OrbitalElements;
  static constexpr std::string_view name = "orbital elements";

  satellites::SatelliteSystem system;
  rates::Gauge gauge;

  template <std::same_as<double> T>
  Values values(const State& s) const {
    return s.z;
  }
  State state(const Values& y) const { return {y}; }
  Values rates(const DoubleDouble& t, const Values& y) const {
    return element_rates(system, to_double(t), y, delaunay, gauge);
  }
  double error_size(const Values& error, const Values&, const Values&) const {
    double sum = 0.0;
    for (const double x : error) sum += x * x;
    return std::sqrt(sum);
  }
};

// Errors of inclination, node and position.
double error_of_motion(const satellites::SatelliteSystem& system, const rates::Gauge& gauge,
                       double stop) {
  const BasicProblem<InElements> p{{system, gauge},
                                   {elements_of_state(system, 0.0, start, delaunay, gauge)},
                                   0.0,
                                   stop,
                                   Collocation{.tolerance = 1e-15}};
  const auto run = integrate(p);
  EXPECT_TRUE(run.outcome().ok()) << run.outcome().advice;
  const satellites::OrbitalElements end = run.at(stop).z;
  const satellites::SatelliteState direct =
      satellites::satellite_path(system, start, 0.0, stop).at(stop);
  const satellites::OrbitalElements expected =
      elements_of_state(system, stop, direct, delaunay, gauge);
  Worst worst;
  worst.add(std::fabs(std::acos(end[5] / end[4]) - std::acos(expected[5] / expected[4])));
  worst.add(std::fabs(std::remainder(end[2] - expected[2], 2.0 * pi)));
  worst.add(norm(element_state(system, stop, end, delaunay, gauge).r - direct.r));
  return worst.value();
}

TEST(OrbitalElements, AMotionInElementsIsThatOfPositionAndMomentum) {
  constexpr double orbit = 5.8;
  EXPECT_LE(error_of_motion(oblate_planet(), rates::Gauge::canonical(), 10.0 * orbit),
            budget::orbital_motion);
  EXPECT_LE(error_of_motion(oblate_planet(), rates::Gauge::osculating(), orbit),
            budget::orbital_motion);
  EXPECT_LE(error_of_motion(oblate_planet(), general_gauge(), 0.3 * orbit), budget::orbital_motion);
  EXPECT_LE(error_of_motion(bent_system(), rates::Gauge::osculating(), 0.1 * orbit),
            budget::orbital_motion);
}

TEST(OrbitalElements, ASatelliteMayBeReleasedAtRest) {
  const satellites::SatelliteSystem system(gm);
  const auto path = satellites::satellite_path(system, {{1.0, 0.0, 0.0}, {}}, 0.0, 0.5);
  ASSERT_TRUE(path.outcome().ok()) << path.outcome().advice;
  const satellites::SatelliteState end = path.at(0.5);
  EXPECT_NEAR(0.5 * dot(end.p, end.p) - gm / norm(end.r), -gm, budget::orbital_motion);
}

TEST(OrbitalElements, EnergyIsConstantAlongAPath) {
  const satellites::SatelliteSystem system = oblate_planet();
  const BasicTrajectory<satellites::SatelliteState> path =
      satellites::satellite_path(system, start, 0.0, 50.0);
  const double E = satellites::energy(system, 0.0, start);
  EXPECT_NEAR(energy(system, 50.0, path.at(50.0)), E, budget::orbital_motion);
}

TEST(OrbitalElements, SingularitiesAndUnboundOrbitsAreRejected) {
  const satellites::SatelliteSystem system = oblate_planet();
  struct Row {
    satellites::OrbitalSet set;
    satellites::OrbitalElements elements;
    const char* message;
  };
  for (const Row& row :
       {Row{keplerian, {1.0, 0.0, 0.5, 0.1, 0.2, 0.3}, "a singularity of Keplerian elements"},
        Row{keplerian, {1.0, 0.1, 0.0, 0.1, 0.2, 0.3}, "a singularity of Keplerian elements"},
        Row{keplerian, {1.0, 0.1, pi, 0.1, 0.2, 0.3}, "a singularity of Keplerian elements"},
        Row{delaunay, {0.1, 0.2, 0.3, 1.0, 1.0, 0.5}, "a singularity of Delaunay's elements"},
        Row{keplerian, {1.0, 1.2, 0.5, 0.1, 0.2, 0.3}, "not a bound orbit"},
        Row{keplerian, {-1.0, 0.2, 0.5, 0.1, 0.2, 0.3}, "not a bound orbit"},
        Row{delaunay, {0.1, 0.2, 0.3, 1.0, 0.9, 0.95}, "not a bound orbit"},
        Row{delaunay, {0.1, 0.2, 0.3, -1.0, -0.9, -0.5}, "not a bound orbit"}})
    EXPECT_THAT(message_of([&] { element_rates(system, 0.0, row.elements, row.set); }),
                HasSubstr(row.message));
  EXPECT_THAT(message_of([&] {
                elements_of_state(system, 0.0, {{1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}}, keplerian);
              }),
              HasSubstr("expected 0 <= e < 1"));
  EXPECT_THAT(message_of([] { satellites::SatelliteSystem(-1.0); }), HasSubstr("got gm = -1"));
  EXPECT_THAT(message_of([] { satellites::oblateness(1.0, 1e-3, 0.0); }), HasSubstr("radius > 0"));
}

}  // namespace
