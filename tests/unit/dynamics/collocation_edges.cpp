// SPDX-License-Identifier: MIT
// Where torques are not smooth: jumps and kinks that no term names, and the edges of a penumbra.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/math/real.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "splitting_support.hpp"

namespace polhode {
namespace {

using namespace splitting_test;

// The same torque with its sides named and without: 0.3 sin 3t, its absolute value, its sign.
enum class Shape { kink, jump };

double size_of(Shape shape, double sine, double side) {
  return 0.3 * (shape == Shape::kink ? sine * side : side);
}
System unnamed(Shape shape) {
  const auto torque = [shape](const double& t, const RotorState&) {
    const double sine = std::sin(3.0 * t);
    return Vec3{size_of(shape, sine, sine < 0.0 ? -1.0 : 1.0), 0.0, 0.0};
  };
  return System(workload_body(), Frame::inertial(),
                {AnyPerturbation("unnamed", TorqueTerm(torque))});
}
System named(Shape shape) {
  const auto torque = [shape](const double& t, const RotorState&, std::span<const double> sides) {
    return Vec3{size_of(shape, std::sin(3.0 * t), sides[0]), 0.0, 0.0};
  };
  const auto sides = [](double t, const RotorState&) { return std::vector{std::sin(3.0 * t)}; };
  return System(workload_body(), Frame::inertial(),
                {AnyPerturbation("named", SwitchedTorqueTerm(torque, sides))});
}

// Before the ends of steps were looked at: 3e-3 and 8e-6 rad at 1e-12.
TEST(CollocationEdges, JumpsAndKinksThatNoTermNamesAreSeen) {
  const RotorState s = workload_state();
  for (const Shape shape : {Shape::kink, Shape::jump})
    for (const double stop : {20.1, -20.1}) {
      const RotorState exact = end_of(named(shape), s, 0.0, stop, Adaptive{1e-14});
      for (const int stages : {4, 8, 16})
        EXPECT_LE(distance(end_of(unnamed(shape), s, 0.0, stop, Collocation{1e-12, stages}), exact),
                  stages == 4 ? budget::collocation_unnamed_edge_of_four
                              : budget::collocation_unnamed_edge)
            << stages << " " << stop << (shape == Shape::kink ? " kinks" : " jumps");
    }
}

// Steps grow again after a jump that is not named, next to an edge that is; and where a term names
// a function and does not use its side.
TEST(CollocationEdges, StepsGrowAgainBesideANamedEdge) {
  const auto pushed = [](double unnamed_at) {
    const auto torque = [=](const double& t, const RotorState&, std::span<const double> sides) {
      return Vec3{t < unnamed_at ? 0.1 : 0.3, 0.05 * sides[0], 0.0};
    };
    const auto sides = [](double t, const RotorState&) { return std::vector{t - 5.0}; };
    return System(workload_body(), Frame::inertial(),
                  {AnyPerturbation("push", SwitchedTorqueTerm(torque, sides))});
  };
  for (const double at : {4.5, 4.99, 5.0, 5.01})
    for (const double start : {0.0, 4.9}) {
      Problem p{pushed(at), workload_state(), start, 12.0, Collocation{}};
      const Trajectory run = integrate(p);
      EXPECT_TRUE(run.outcome().ok()) << at << " " << run.outcome().advice;
      EXPECT_LT(run.statistics().steps, 3000) << at;
      for (std::size_t i = 1; i < run.samples().size(); ++i)
        EXPECT_GT(run.samples()[i].t, run.samples()[i - 1].t) << at;
    }
}

// A term that is smooth takes as many steps as if it were known to be.
TEST(CollocationEdges, SmoothTermsOfAUserTakeNoMoreSteps) {
  const PointMassTorque torque{1.0, 0.1};
  const AnyOrbit orbit("orbit", KeplerOrbit({1.0, 0.9, 0.1}));
  const auto steps = [&](AnyPerturbation term, double tolerance) {
    const System system(workload_body(), Frame::inertial(), {std::move(term)});
    return integrate({system, workload_state(), 0.0, 30.0, Collocation{tolerance}})
        .statistics()
        .steps;
  };
  for (const double tolerance : {1e-6, 1e-9, 1e-12, 1e-14}) {
    const auto known = steps({"known", GravityGradient(1.0, orbit)}, tolerance);
    const auto unknown = steps({"unknown", torque}, tolerance);
    EXPECT_LE(static_cast<double>(unknown), 1.02 * static_cast<double>(known)) << tolerance;
  }
}

// A planet eclipses the Sun once an orbit, and a penumbra lasts for a few degrees.
System in_a_cone() {
  const AnyOrbit orbit("orbit", KeplerOrbit({1.0, 0.95, 0.05}));
  KeplerElements far{.gm = 2e-2, .pericentre = 200.0, .eccentricity = 0.0};
  far.inclination = 0.5;
  const AnyOrbit sun("sun", KeplerOrbit(far));
  const Surface plate = Surface::of_plate({0.5, 0.3, 0.4}, {0.3, 0.0, 0.95}, 0.5, {}, true);
  return System(
      Body(0.7, 1.0, 1.2), Frame::inertial(),
      {{"gravity gradient", GravityGradient(1.0, orbit)},
       {"sunlight", SolarPressure(plate, {0.05, 200.0}, {orbit}, {sun}, Shadow::cone(0.7, 10.0))}});
}

TEST(CollocationEdges, LightOfAPenumbraIsFollowed) {
  const System system = in_a_cone();
  const RotorState s{{}, {0.42, 0.5, 15.0}};
  for (const double stop : {250.0, -250.0}) {
    const RotorState exact = end_of(system, s, 0.0, stop, Adaptive{1e-15});
    for (const double tolerance : {1e-10, 1e-12, 1e-14})
      EXPECT_LE(distance(end_of(system, s, 0.0, stop, Collocation{tolerance}), exact),
                budget::collocation_penumbra)
          << tolerance << " " << stop;
    // from within a step of an edge
    for (double start = 0.0; start < 6.3; start += 0.13) {
      const Trajectory run = integrate({system, s, start, start + 1.0, Collocation{}});
      EXPECT_TRUE(run.outcome().ok()) << start;
      EXPECT_LT(run.statistics().steps, 300) << start;
    }
    const auto count = [&](const Method& method) {
      return integrate({system, s, 0.0, stop, method}).statistics().steps;
    };
    EXPECT_LT(count(Collocation{1e-12}), count(Adaptive{1e-12})) << stop;
  }
}

// Steps are long when the spin is slow, and were 2e-6 of them off in every penumbra: 5.8e-7, 7.1e-9
// and 6.2e-11 rad. The end is that of an extrapolation in 80 bits that is split at the edges of
// the shadow and of the plates, by a program of its own.
TEST(CollocationEdges, PenumbrasOfASlowSpinAreAsAccurateAsTheTolerance) {
  const AnyOrbit orbit("orbit", KeplerOrbit({3.986004418e14, 6.878e6, 0.0, 0.0, 0.6023675687170682,
                                             2.536708039620767}));
  const AnyOrbit sun("sun", KeplerOrbit({1.32712440018e20, 1.496e11, 0.0, 0.409}));
  const Surface panel = Surface::of_plate({0.0, 3.0, 0.0}, {1.0, 0.0, 0.0}, 10.0, {0.2}, true);
  const Surface dish = Surface::of_plate({1.0, 0.0, 0.2}, {0.0, 0.0, 1.0}, 4.0, {}, true);
  std::vector<SurfaceFacet> facets(panel.facets().begin(), panel.facets().end());
  facets.insert(facets.end(), dish.facets().begin(), dish.facets().end());
  const System system(Body(500.0, 800.0, 1000.0), Frame::inertial(),
                      {{"sunlight", SolarPressure(Surface(facets), {4.56e-6, 1.496e11}, {orbit},
                                                  {sun}, Shadow::cone(6.378e6, 6.957e8))}});
  const RotorState s{normalized(Quaternion{0.9, 0.1, 0.3, 0.2}),
                     {-2.976e-4, 1.63587e-3, -1.82156e-3}};
  const RotorState exact{
      {0.44143581426982374, 0.65283662496654168, -0.45006191811799770, 0.41997980051685988},
      {0.016525643487597724, 0.091302721345406978, 0.40108896792877018}};
  for (const double tolerance : {1e-9, 1e-12, 1e-14}) {
    const Trajectory run = integrate({system, s, 0.0, 170309.4, Collocation{tolerance}},
                                     {.samples = SaveAt::times({170309.4}), .dense = false});
    EXPECT_LE(
        distance(run.samples().back().s, exact),
        budget::collocation_penumbra_per_tolerance * tolerance + budget::collocation_penumbra_floor)
        << tolerance;
    EXPECT_LT(run.statistics().steps, 6000) << tolerance;  // 17510 at 1e-14, of which too few near
  }
}

// A mesh of more facets than are watched: their kinks are not named, and were stepped over at 1e-12
// with an error of 4e-7.
TEST(CollocationEdges, KinksOfAMeshAreResolved) {
  std::vector<SurfaceFacet> facets;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 8; ++j) {
      const double polar = pi<double>() * (i + 0.5) / 6.0, azimuth = pi<double>() * (j + 0.5) / 4.0;
      const Vec3 n{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                   std::cos(polar)};
      facets.push_back({{n.x + 0.05, 0.8 * n.y, 0.6 * n.z}, n, 0.26 * std::sin(polar), {0.2, 0.3}});
    }
  const AnyOrbit orbit("orbit", KeplerOrbit({1.0, 0.95, 0.05}));
  const AnyOrbit sun("sun", KeplerOrbit({2e-2, 200.0, 0.0}));
  const System system(
      Body(0.7, 1.0, 1.2), Frame::inertial(),
      {{"sunlight", SolarPressure(Surface(facets), {0.003, 200.0}, {orbit}, {sun})}});
  const RotorState s{{}, {1.4, 1.0, 1.8}};
  const RotorState exact = end_of(system, s, 0.0, 20.0, Adaptive{1e-15});
  EXPECT_LE(distance(end_of(system, s, 0.0, 20.0, Collocation{}), exact), budget::collocation_mesh);
  EXPECT_LE(distance(end_of(system, s, 0.0, 20.0, Collocation{1e-9}), exact),
            500.0 * budget::collocation_mesh);
}

// A torque that comes and goes like the power 3/2 of the time, as a user may have one.
struct Dawn {
  bool says_so;

  Effect effect(const Setting& at) const {
    const double height = sine(at.t);
    const double side = at.sides.empty() ? side_of(height) : at.sides[0];
    if (side < 0.0) return {};
    return {{}, {0.0, 0.3 * std::pow(std::fabs(height), 1.5), 0.1 * height * height}};
  }
  std::vector<double> switches(const Setting& at) const { return {sine(at.t)}; }
  bool fades_at_switches() const { return says_so; }

 private:
  static double sine(double t) { return std::sin(t) + 0.3; }
};

TEST(CollocationEdges, ATermOfAUserCanSayThatItFades) {
  const auto system = [](bool says_so) {
    return System(workload_body(), Frame::inertial(), {{"dawn", Dawn{says_so}}});
  };
  const RotorState s = workload_state();
  const RotorState exact = end_of(system(true), s, 0.0, 60.0, Adaptive{1e-15});
  const auto error = [&](bool says_so) {
    return distance(end_of(system(says_so), s, 0.0, 60.0, Collocation{}), exact);
  };
  EXPECT_LE(error(true), budget::collocation_penumbra);
  EXPECT_GE(error(false), 10.0 * budget::collocation_penumbra);
}

}  // namespace
}  // namespace polhode
