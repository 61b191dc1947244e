// SPDX-License-Identifier: MIT
// Section 4 of the paper in the library: momenta and Hamiltonian in a precessing frame, constants
// of the free motion as variables, and Delaunay's elements.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "budgets.hpp"
#include "paper/section4_support.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "polhode/system/osculation.hpp"
#include "polhode/system/satellite_system.hpp"

namespace polhode::paper {
namespace {

// An energy of the attitude alone.
struct Potential {
  template <class T>
  T operator()(const T&, const BasicRotorState<T>& s) const {
    const BasicVec3<T> axis = rotate(s.q, BasicVec3<T>{T(0.6), T(0.0), T(0.8)});
    return T(0.4) * axis.x * axis.z;
  }
};

Vec angle_rates(const rates::EulerPhaseRates& r) { return {Mp(r.phi), Mp(r.theta), Mp(r.psi)}; }

// [SA (112), (113), (114), (115)] momenta and kinetic energy by omega + mu
TEST(PaperSection4, LibraryMomentaInAFrame) {
  Gap phi, theta, psi, energies;
  for (const PerturbedCase& e : perturbed_cases(421, 8)) {
    const System moving(body_of(e.I), e.frame.frame);
    const Phase x = e.euler(), found = paper::exact(to_euler(e.s));
    const Vec omega =
        body_rate(first_half(x), angle_rates(rates::euler_phase_rates(moving, e.t, e.s)));
    const Vec sum = omega + euler_matrix(first_half(x)) * e.mu_S;
    const Mp st = paper::s(x[1]), ct = c(x[1]), sp = paper::s(x[2]), cp = c(x[2]);
    const Vec g = scaled(e.I, sum);
    phi.add(found[3], g[0] * st * sp + g[1] * st * cp + g[2] * ct);
    theta.add(found[4], g[0] * cp - g[1] * sp);
    psi.add(found[5], g[2]);
    energies.add(Mp(kinetic_energy(body_of(e.I), e.s)), dot(sum, g) / 2);
    energies.add(exact(angular_velocity(moving, e.t, e.s).inertial), sum);
  }
  EXPECT_LT(phi.size(), budget::paper_perturbed);
  EXPECT_LT(theta.size(), budget::paper_perturbed);
  EXPECT_LT(psi.size(), budget::paper_perturbed);
  EXPECT_LT(energies.size(), budget::paper_perturbed);
}

// [SA (116), (117), (118), "(118), in Andoyer's variables"] Legendre's transform with a potential,
// and T + DeltaH
TEST(PaperSection4, LibraryHamiltonianInAFrame) {
  Gap legendre, euler, andoyer;
  for (const PerturbedCase& e : perturbed_cases(422, 8)) {
    const System system(body_of(e.I), e.frame.frame,
                        {AnyPerturbation("potential", HamiltonianTerm(Potential{}))});
    const Phase x = e.euler(), a = paper::exact(to_andoyer(e.s));
    const Mp H = energy(system, e.t, e.s), V = Potential{}(Mp(e.t), wide_state(x));
    const Mp T = kinetic(e.I, exact(e.s.g));
    const Vec rates = angle_rates(rates::euler_phase_rates(system, e.t, e.s));
    legendre.add(H, dot(second_half(x), rates) - Mp(kinetic_energy(body_of(e.I), e.s)) + V);
    const Vec mu = euler_matrix(first_half(x)) * e.mu_S;
    const Mp lean = (x[3] - x[5] * c(x[1])) / paper::s(x[1]);
    const Mp sp = paper::s(x[2]), cp = c(x[2]);
    euler.add(H, T - mu[0] * (sp * lean + x[4] * cp) - mu[1] * (cp * lean - x[4] * sp) -
                     mu[2] * x[5] + V);
    const Mp side = root(squared(a[4]) - squared(a[3]));
    andoyer.add(H - V, T - mu[0] * side * paper::s(a[0]) - mu[1] * side * c(a[0]) - mu[2] * a[3]);
  }
  EXPECT_LT(legendre.size(), budget::paper_perturbed);
  EXPECT_LT(euler.size(), budget::paper_perturbed);
  EXPECT_LT(andoyer.size(), budget::paper_perturbed);
}

// [SA (105), (110), (127)] the unperturbed rates of Euler's angles through those of Andoyer's
// variables are dT/dp, also under a perturbation
TEST(PaperSection4, LibraryUnperturbedVelocity) {
  Gap gap;
  for (const PerturbedCase& e : perturbed_cases(423, 6)) {
    const Body body = body_of(e.I);
    const Matrix6 M = canonical_transformation(e.s, {CanonicalSet::andoyer}, {CanonicalSet::euler});
    const rates::AndoyerRates n = rates::andoyer_rates(System(body), e.t, e.s);
    const std::array<double, 6> velocity = M * std::array<double, 6>{n.l, n.g, n.h, n.L, n.G, n.H};
    const Phase dT = gradient([&](const Phase& y) { return euler_energy(e.I, y); }, e.euler());
    const rates::EulerPhaseRates all = rates::euler_phase_rates(e.system(), e.t, e.s);
    const auto added = rates::convective_term(e.system(), e.t, e.s, {CanonicalSet::euler});
    for (std::size_t i = 0; i < 3; ++i) {
      gap.add(Mp(velocity[i]), dT[i + 3]);
      gap.add(Mp(velocity[i]) + Mp(added[i]), angle_rates(all)[i]);
    }
  }
  EXPECT_LT(gap.size(), budget::paper_modified);
}

// [SA (98), (99), (100), (108), (125), (126)] constants C of the free motion: Andoyer's variables
// are C plus the integral of their rates, and Euler's are the same functions of them at any time
TEST(PaperSection4, LibraryVariablesOfConstants) {
  Gap integrals, euler, rest;
  for (const PerturbedCase& e : perturbed_cases(424, 4)) {
    const Body body = body_of(e.I);
    const double t0 = e.t - 0.75;
    const Phase C = paper::exact(charts::modified_andoyer(body, e.t, e.s, t0));
    const FreeRotation motion(body, e.s, e.t);
    const auto change = [&](std::size_t i) {
      return integral(
          [&](const Mp& x) {
            const auto time = static_cast<double>(x);
            const rates::AndoyerRates r = rates::andoyer_rates(System(body), time, motion.at(time));
            return Mp(std::array<double, 6>{r.l, r.g, r.h, r.L, r.G, r.H}[i]);
          },
          Mp(t0), Mp(e.t));
    };
    const Phase A = paper::exact(to_andoyer(e.s));
    for (std::size_t i = 0; i < 3; ++i) integrals.add(turned(A[i] - C[i] - change(i)), Mp(0));
    for (std::size_t i = 3; i < 6; ++i) integrals.add(A[i] - C[i], change(i));
    const AndoyerState constants = charts::modified_andoyer(body, e.t, e.s, t0);
    const Phase x = paper::exact(to_euler(charts::from_modified_andoyer(body, e.t, constants, t0)));
    const AndoyerCase k = andoyer_case(e.I, A);
    for (std::size_t i = 0; i < 3; ++i) euler.add(turned(x[i] - k.q[i]), Mp(0));
    euler.add(second_half(x), k.p);
    const rates::AndoyerRates r = charts::modified_andoyer_rates(System(body), e.t, e.s, t0);
    rest.add(Vec{Mp(r.l), Mp(r.g), Mp(r.h)}, Vec{});
    rest.add(Vec{Mp(r.L), Mp(r.G), Mp(r.H)}, Vec{});
  }
  EXPECT_LT(integrals.size(), budget::paper_modified);
  EXPECT_LT(euler.size(), budget::paper_modified);
  EXPECT_EQ(rest.size(), 0.0);
}

// Delaunay's l, g, h, L, G, H of (r, p), by vectors.
Phase delaunay_of(const Mp& gm, const Phase& x) {
  const Vec r = first_half(x), p = second_half(x), area = cross(r, p);
  const Mp size = length(r), energy = dot(p, p) / 2 - gm / size;
  const Mp a = -gm / (2 * energy), L = root(gm * a), G = length(area);
  const Vec apsis = (1 / gm) * cross(p, area) - (1 / size) * r;
  const Vec node{-area[1], area[0], Mp(0)}, beyond = (1 / G) * cross(area, node);
  const Mp across = dot(r, p) / root(gm * a), ecc = length(apsis);
  const Mp anomaly = angle(across, 1 - size / a);
  return {anomaly - ecc * s(anomaly),
          angle(dot(apsis, beyond), dot(apsis, node)),
          angle(node[1], node[0]),
          L,
          G,
          area[2]};
}

// [SA (96), "(96), footnote"] Delaunay's set is canonical; without a perturbation only the mean
// anomaly moves, at mu^2/L^3, the derivative of -mu^2/(2 L^2)
TEST(PaperSection4, LibraryDelaunayElements) {
  Gap elements, rates;
  Random random(96);
  for (int n = 0; n < 20; ++n) {
    const double gm = random.number(0.8, 1.5);
    const auto unit = [&random](double size) { return random.number(-size, size); };
    const satellites::SatelliteState start{{1.0 + unit(0.2), unit(0.3), unit(0.3)},
                                           {unit(0.2), 0.9 + unit(0.1), 0.3 + unit(0.1)}};
    const Phase x{Mp(start.r.x), Mp(start.r.y), Mp(start.r.z),
                  Mp(start.p.x), Mp(start.p.y), Mp(start.p.z)};
    const auto formula = [gm](const Phase& y) { return delaunay_of(Mp(gm), y); };
    EXPECT_LT(symplectic_defect(jacobian(formula, x)), budget::paper_derivative);
    const satellites::SatelliteSystem system(gm);
    const satellites::OrbitalElements C =
        elements_of_state(system, 0.0, start, satellites::OrbitalSet::delaunay);
    const Phase expected = formula(x);
    for (std::size_t i = 0; i < 3; ++i) elements.add(turned(Mp(C[i]) - expected[i]), Mp(0));
    for (std::size_t i = 3; i < 6; ++i) elements.add(Mp(C[i]), expected[i]);
    const satellites::SatelliteState back =
        element_state(system, 0.0, C, satellites::OrbitalSet::delaunay);
    elements.add(exact(back.r), first_half(x));
    elements.add(exact(back.p), second_half(x));
    const satellites::OrbitalElements found =
        element_rates(system, 0.0, C, satellites::OrbitalSet::delaunay);
    const Mp motion = derivative([&](const Mp& L) { return -squared(Mp(gm)) / (2 * L * L); }, C[3]);
    rates.add(Mp(found[0]), motion);
    for (std::size_t i = 1; i < 6; ++i) rates.add(Mp(found[i]), Mp(0));
  }
  EXPECT_LT(elements.size(), budget::paper_library);
  EXPECT_LT(rates.size(), budget::paper_library);
}

}  // namespace
}  // namespace polhode::paper
