// SPDX-License-Identifier: MIT
// Section 4 of the paper against the library: for momentum-dependent perturbations in frames at
// rest, precessing and tumbling, Hamilton's equations in Euler's variables, differenced at 50
// digits, against Effect{v, u} and all that follows from it.
#include <gtest/gtest.h>

#include "budgets.hpp"
#include "paper/section4_support.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/system/andoyer_method.hpp"
#include "polhode/system/axes.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "polhode/system/osculation.hpp"

namespace polhode::paper {
namespace {

constexpr CanonicalChart euler_chart{CanonicalSet::euler};
constexpr CanonicalChart andoyer_chart{CanonicalSet::andoyer};

Vec coordinates(const Phase& x) { return {x[0], x[1], x[2]}; }
Vec momenta(const Phase& x) { return {x[3], x[4], x[5]}; }
Vec exact(const std::array<double, 3>& a) { return {Mp(a[0]), Mp(a[1]), Mp(a[2])}; }
using paper::exact;
Phase phase(const AndoyerState& a) { return {a.l, a.g, a.h, a.L, a.G, a.H}; }
Phase phase(const rates::AndoyerRates& a) { return {a.l, a.g, a.h, a.L, a.G, a.H}; }
Phase phase(const rates::EulerPhaseRates& e) {
  return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
}

void add(Gap& gap, const Phase& a, const Phase& b) {
  gap.add(coordinates(a), coordinates(b));
  gap.add(momenta(a), momenta(b));
}
// Angles in coordinates, so modulo 2 pi.
void add_elements(Gap& gap, const Phase& a, const Phase& b) {
  for (std::size_t i = 0; i < 3; ++i) gap.add(turned(a[i] - b[i]), Mp(0));
  gap.add(momenta(a), momenta(b));
}

// The rate of a function of Euler's variables along the motion.
template <class F>
auto along(const PerturbedCase& e, F f) {
  const Phase x = e.euler(), rates = e.euler_rates();
  auto value = f(x);
  for (std::size_t i = 0; i < value.size(); ++i)
    value[i] = derivative([&](const Mp& h) { return f(moved(x, rates, h))[i]; }, Mp(0));
  return value;
}

// [SA (101), (107), (123), (124)] hub rates, both angular velocities and the energy
TEST(PaperSection4, LibraryHamiltonsEquations) {
  Gap rates, velocity, energies;
  for (const PerturbedCase& e : perturbed_cases(401, 8)) {
    const System system = e.system();
    const Phase x = e.euler(), x_rates = e.euler_rates();
    const Vec w_SB = body_rate(coordinates(x), coordinates(x_rates));
    const Vec g_rate = along(e, [](const Phase& y) { return euler_body_momentum(y); });
    const rates::HubRates hub = rates::hub_rates(system, e.t, e.s);
    rates.add(exact(hub.theta), w_SB);
    rates.add(exact(hub.g), g_rate);
    const RotorRates direct = rotor_rates(system, e.t, e.s);
    rates.add(exact(direct.g), g_rate);
    const Quaternion half = conj(e.s.q) * direct.q;
    rates.add(2 * exact(Vec3{half.x, half.y, half.z}), w_SB);
    const AngularVelocities w = angular_velocity(system, e.t, e.s);
    velocity.add(exact(w.relative), w_SB);
    velocity.add(exact(w.inertial), w_SB + euler_matrix(coordinates(x)) * e.mu_S);
    energies.add(Mp(energy(system, e.t, e.s)), e.H(x));
  }
  EXPECT_LT(rates.size(), budget::paper_perturbed);
  EXPECT_LT(velocity.size(), budget::paper_perturbed);
  EXPECT_LT(energies.size(), budget::paper_perturbed);
}

// [SA (101), (107)] v = dDeltaH/dg and u in Euler's variables: from v alone the angles' rates, with
// u the momenta's
TEST(PaperSection4, LibraryEffectIsTheDerivativeOfTheEnergy) {
  Gap gap;
  for (const PerturbedCase& e : perturbed_cases(402, 8)) {
    const Phase x = e.euler();
    const Phase d = gradient([&](const Phase& y) { return e.delta_H(y); }, x);
    const Phase added{d[3], d[4], d[5], -d[0], -d[1], -d[2]};
    const Effect total = effect(e.system(), e.t, e.s);
    gap.add(exact(total.v), body_rate(coordinates(x), coordinates(added)));
    const Vec g_added = [&] {
      Vec v;
      for (std::size_t i = 0; i < 3; ++i)
        v[i] =
            derivative([&](const Mp& h) { return euler_body_momentum(moved(x, added, h))[i]; }, 0);
      return v;
    }();
    gap.add(exact(total.u) + cross(exact(e.s.g), exact(total.v)), g_added);
  }
  EXPECT_LT(gap.size(), budget::paper_perturbed);
}

// [SA "Hamilton" in section 3.2, "dot_g", "dot_h", "dot_l", "dot_G", "dot_H", "dot_L", (97), (101),
// "eqHam"] the free rates and those under perturbations, in Andoyer's and in Euler's canonical
// variables
TEST(PaperSection4, LibraryCanonicalRates) {
  Gap gap;
  for (const PerturbedCase& e : perturbed_cases(403, 8)) {
    const System system = e.system();
    add(gap, phase(rates::euler_phase_rates(system, e.t, e.s)), e.euler_rates());
    add(gap, phase(rates::andoyer_rates(system, e.t, e.s)), along(e, andoyer_of_euler));
    const Phase a = andoyer_of_euler(e.euler());
    const Phase d = gradient([&](const Phase& y) { return andoyer_energy(e.I, y); }, a);
    add(gap, phase(rates::andoyer_rates(System(body_of(e.I)), e.t, e.s)),
        {d[3], d[4], d[5], -d[0], -d[1], -d[2]});
  }
  EXPECT_LT(gap.size(), budget::paper_perturbed);
}

// [SA (104), (106), (107), (109), (111), (119)] the convective term dDeltaH/dp in Euler's
// angles and in Andoyer's; with the unperturbed rates of the same variables it makes the velocity
TEST(PaperSection4, LibraryConvectiveTerm) {
  Gap gap;
  for (const PerturbedCase& e : perturbed_cases(404, 8)) {
    const System system = e.system();
    const Phase x = e.euler(), a = andoyer_of_euler(x);
    const Vec euler_term = exact(rates::convective_term(system, e.t, e.s, euler_chart));
    gap.add(euler_term, momenta(gradient([&](const Phase& y) { return e.delta_H(y); }, x)));
    const Phase unperturbed = gradient([&](const Phase& y) { return euler_energy(e.I, y); }, x);
    gap.add(momenta(unperturbed) + euler_term, coordinates(e.euler_rates()));
    const auto delta_of_andoyer = [&](const Phase& y) {
      const AndoyerCase k = andoyer_case(e.I, y);
      return e.delta_H({k.q[0], k.q[1], k.q[2], k.p[0], k.p[1], k.p[2]});
    };
    gap.add(exact(rates::convective_term(system, e.t, e.s, andoyer_chart)),
            momenta(gradient(delta_of_andoyer, a)));
  }
  EXPECT_LT(gap.size(), budget::paper_perturbed);
}

// [SA (119), (120), (121), (122), (4448)] the frame's part in closed form; parts of several
// perturbations add up
TEST(PaperSection4, LibraryConvectiveTermOfAFrame) {
  Gap frame_part, sum;
  for (const PerturbedCase& e : perturbed_cases(405, 6)) {
    const Body body = body_of(e.I);
    const System moving(body, e.frame.frame), resting(body, Frame::inertial(), e.system().terms());
    const Phase x = e.euler();
    const Vec mu = euler_matrix(coordinates(x)) * e.mu_S;
    const Mp st = paper::s(x[1]), ct = c(x[1]), sp = paper::s(x[2]), cp = c(x[2]);
    const Mp across = mu[0] * sp + mu[1] * cp;
    const Vec term = exact(rates::convective_term(moving, e.t, e.s, euler_chart));
    frame_part.add(term, {-across / st, -mu[0] * cp + mu[1] * sp, across * ct / st - mu[2]});
    frame_part.add(exact(effect(moving, e.t, e.s).v), Mp(-1) * mu);
    sum.add(exact(rates::convective_term(e.system(), e.t, e.s, euler_chart)),
            term + exact(rates::convective_term(resting, e.t, e.s, euler_chart)));
  }
  EXPECT_LT(frame_part.size(), budget::paper_perturbed);
  EXPECT_LT(sum.size(), budget::paper_perturbed);
}

// [SA (118)] in frame components, A = mu1 sin h - mu2 cos h: hdot = -mu3 + cot I A, gdot = -A/sin
// I, Hdot = G sin I (mu1 cos h + mu2 sin h), and nothing for l, G, L
TEST(PaperSection4, LibraryFrameRatesOfAndoyersVariables) {
  Gap gap;
  for (const PerturbedCase& e : perturbed_cases(406, 6)) {
    const Phase a = andoyer_of_euler(e.euler());
    const Mp cI = a[5] / a[4], sI = root(1 - cI * cI), sh = paper::s(a[2]), ch = c(a[2]);
    const Vec& mu = e.mu_S;
    const Mp A = mu[0] * sh - mu[1] * ch;
    const rates::CanonicalRates r =
        rates::perturbation_rates(System(body_of(e.I), e.frame.frame), e.t, e.s, andoyer_chart);
    add(gap, {r[0], r[1], r[2], r[3], r[4], r[5]},
        {Mp(0), -A / sI, cI / sI * A - mu[2], Mp(0), Mp(0), a[4] * sI * (mu[0] * ch + mu[1] * sh)});
  }
  EXPECT_LT(gap.size(), budget::paper_perturbed);
}

// [SA (102), (103)] the modified set of an axisymmetric body, whose free flow is linear in time:
// Hamilton's equations of DeltaH*(C, t) = DeltaH(A(C, t)) by differences at 50 digits
TEST(PaperSection4, LibraryModifiedSetAxisymmetric) {
  Gap elements, rates;
  for (PerturbedCase e : perturbed_cases(407, 6)) {
    e.I[0] = e.I[1];
    const double t0 = e.t - 1.75;
    const Mp slow = 1 / e.I[2] - 1 / e.I[0], dt = Mp(e.t) - Mp(t0);
    const auto flown = [&](const Phase& y, const Mp& time) {
      return Phase{y[0] + slow * y[3] * time, y[1] + y[4] / e.I[0] * time, y[2], y[3], y[4], y[5]};
    };
    const Phase C = flown(andoyer_of_euler(e.euler()), -dt);
    const auto delta_star = [&](const Phase& y) {
      const AndoyerCase k = andoyer_case(e.I, flown(y, dt));
      return e.delta_H({k.q[0], k.q[1], k.q[2], k.p[0], k.p[1], k.p[2]});
    };
    const Phase d = gradient(delta_star, C);
    const System system = e.system();
    add_elements(elements, phase(charts::modified_andoyer(system.body(), e.t, e.s, t0)), C);
    add(rates, phase(charts::modified_andoyer_rates(system, e.t, e.s, t0)),
        {d[3], d[4], d[5], -d[0], -d[1], -d[2]});
  }
  EXPECT_LT(elements.size(), budget::paper_perturbed);
  EXPECT_LT(rates.size(), budget::paper_perturbed);
}

// [SA (99), (106), (107), (111)] any triaxial body: sum of dq/dC_j dC_j/dt over the modified set is
// the same convective term, dDeltaH/dp
TEST(PaperSection4, LibraryConvectiveTermThroughTheModifiedSet) {
  Gap gap, nothing;
  for (const PerturbedCase& e : perturbed_cases(408, 6)) {
    const System system = e.system();
    const double t0 = e.t + 2.5;
    const rates::AndoyerRates r = charts::modified_andoyer_rates(system, e.t, e.s, t0);
    const double C_rates[6] = {r.l, r.g, r.h, r.L, r.G, r.H};
    const FreeRotation motion(system.body(), e.s, e.t);
    const FreeRotation from_epoch(system.body(), motion.at(t0), t0);
    const Matrix6 B_C =
        from_epoch.state_transition(e.t) * chart_jacobian(motion.at(t0), andoyer_chart);
    const Matrix6 by_C = canonical_transformation(e.s.g, B_C, chart_jacobian(e.s, euler_chart));
    Vec convective{};
    for (int n = 0; n < 3; ++n)
      for (int j = 0; j < 6; ++j)
        convective[static_cast<std::size_t>(n)] += Mp(by_C(n, j)) * Mp(C_rates[j]);
    const Phase x = e.euler();
    gap.add(convective, momenta(gradient([&](const Phase& y) { return e.delta_H(y); }, x)));
    // constants where nothing perturbs
    add(nothing, phase(charts::modified_andoyer_rates(System(body_of(e.I)), e.t, e.s, t0)),
        Phase{});
  }
  EXPECT_LT(gap.size(), budget::paper_modified);
  EXPECT_EQ(nothing.size(), 0.0);
}

// [SA (104), (107), (124)] osculating momentum I w_SB, w_SB from Hamilton's equations; the map back
// is its inverse, for v nonlinear in g too; in a frame alone I^-1 g is the inertial rate
TEST(PaperSection4, LibraryOsculatingElements) {
  Gap momentum, elements, back, frame_alone;
  for (const PerturbedCase& e : perturbed_cases(409, 8)) {
    const System system = e.system();
    const Phase x = e.euler();
    const Vec w_SB = body_rate(coordinates(x), coordinates(e.euler_rates()));
    const Vec g_osc = scaled(e.I, w_SB);
    const RotorState osculating = charts::osculating_state(system, e.t, e.s);
    momentum.add(exact(osculating.g), g_osc);
    const Vec p = euler_momenta(coordinates(x), g_osc);
    add_elements(elements, phase(charts::osculating_andoyer(system, e.t, e.s)),
                 andoyer_of_euler({x[0], x[1], x[2], p[0], p[1], p[2]}));
    const System moving(body_of(e.I), e.frame.frame);
    const RotorState touched = charts::osculating_state(moving, e.t, e.s);
    back.add(exact(charts::canonical_state(moving, e.t, touched).g), exact(e.s.g));
    const Vec mu = euler_matrix(coordinates(x)) * e.mu_S;
    frame_alone.add(exact(touched.g), exact(e.s.g) - scaled(e.I, mu));
  }
  EXPECT_LT(momentum.size(), budget::paper_perturbed);
  EXPECT_LT(elements.size(), budget::paper_osculating_elements);
  EXPECT_LT(back.size(), budget::paper_perturbed);
  EXPECT_LT(frame_alone.size(), budget::paper_perturbed);
}

// [SA (84), (124)] figure, momentum and rotation axis; (I_r, h_r) from Omega3/|Omega| and from
// (Omega1, -Omega2)
TEST(PaperSection4, LibraryAxes) {
  Gap gap;
  for (const PerturbedCase& e : perturbed_cases(410, 6)) {
    const System system = e.system();
    const Phase x = e.euler(), a = andoyer_of_euler(x);
    const Mat S_from_B = transposed(euler_matrix(coordinates(x)));
    const Mat I_from_S = transposed(e.frame.matrix(Mp(e.t)));
    const Vec w_S = S_from_B * body_rate(coordinates(x), coordinates(e.euler_rates()));
    const auto add_axis = [&](const charts::AxisAngles& axis, const Vec& v) {
      gap.add(Mp(axis.I), angle(root(v[0] * v[0] + v[1] * v[1]), v[2]));
      gap.add(turned(Mp(axis.h) - angle(v[0], -v[1])), Mp(0));
    };
    const charts::RotorAxes relative = charts::relative_axes(system, e.t, e.s);
    const charts::RotorAxes inertial = charts::inertial_axes(system, e.t, e.s);
    const Vec b3{Mp(0), Mp(0), Mp(1)}, g = exact(e.s.g);
    add_axis(relative.figure, S_from_B * b3);
    add_axis(relative.momentum, S_from_B * g);
    add_axis(relative.rotation, w_S);
    add_axis(inertial.figure, I_from_S * (S_from_B * b3));
    add_axis(inertial.momentum, I_from_S * (S_from_B * g));
    add_axis(inertial.rotation, I_from_S * (w_S + e.mu_S));
    gap.add(Mp(relative.figure.I), x[1]);
    gap.add(turned(Mp(relative.figure.h) - x[0]), Mp(0));
    gap.add(c(Mp(relative.momentum.I)), a[5] / a[4]);
    gap.add(turned(Mp(relative.momentum.h) - a[2]), Mp(0));
  }
  EXPECT_LT(gap.size(), budget::paper_osculating_elements);
}

// (l, g, h, J, G, I): not canonical.
struct Inclinations {
  template <Real T>
  BasicRotorState<T> operator()(const rates::Variables<T>& z) const {
    using std::cos;
    return to_rotor(BasicAndoyerState<T>{z[0], z[1], z[2], T(z[4] * T(cos(z[3]))), z[4],
                                         T(z[4] * T(cos(z[5])))});
  }
};

// [SA "Lagrange brackets", "[u, v]"] by the derivatives of Euler's variables, and by those of
// J_u = Phi phi_u + Theta theta_u + Psi psi_u
TEST(PaperAppendix, LibraryLagrangeBrackets) {
  Gap definition, derivatives;
  const Vec equal_moments{Mp(1), Mp(1), Mp(1)};
  const auto euler_of = [&](const Phase& z) {
    const AndoyerCase k =
        andoyer_case(equal_moments, {z[0], z[1], z[2], z[4] * c(z[3]), z[4], z[4] * c(z[5])});
    return Phase{k.q[0], k.q[1], k.q[2], k.p[0], k.p[1], k.p[2]};
  };
  for (const rates::Variables<double>& at :
       {rates::Variables<double>{0.7, -1.1, 2.0, 1.2, 1.3, 0.8},
        rates::Variables<double>{-2.1, 0.4, 0.9, 2.2, 0.9, 1.7}}) {
    Phase z;
    for (std::size_t i = 0; i < 6; ++i) z[i] = at[i];
    const Matrix6 found = rates::lagrange_brackets(Inclinations{}, at);
    const auto rows = jacobian(euler_of, z);
    const auto J = [&](const Phase& y) {
      const auto by = jacobian(euler_of, y);
      const Vec p = momenta(euler_of(y));
      Phase all;
      for (std::size_t u = 0; u < 6; ++u) all[u] = dot(p, {by[0][u], by[1][u], by[2][u]});
      return all;
    };
    const auto J_rows = jacobian(J, z);
    for (std::size_t u = 0; u < 6; ++u)
      for (std::size_t v = 0; v < 6; ++v) {
        const Mp bracket_uv = Mp(found(static_cast<int>(u), static_cast<int>(v)));
        Mp sum = 0;
        for (std::size_t i = 0; i < 3; ++i)
          sum += rows[i][u] * rows[i + 3][v] - rows[i + 3][u] * rows[i][v];
        definition.add(bracket_uv, sum);
        derivatives.add(bracket_uv, J_rows[u][v] - J_rows[v][u]);
      }
  }
  EXPECT_LT(definition.size(), budget::paper_library);
  EXPECT_LT(derivatives.size(), budget::paper_library);
}

// [SA "linear"] the equations of motion in variables that are not canonical, by their Lagrange
// brackets, against the chain rule along Hamilton's equations in Euler's variables
TEST(PaperAppendix, LibraryAndoyersMethod) {
  Gap gap;
  for (const PerturbedCase& e : perturbed_cases(411, 8)) {
    const auto inclined = [](const Phase& x) {
      const Phase a = andoyer_of_euler(x);
      const auto arc = [&a](const Mp& p) { return angle(root(a[4] * a[4] - p * p), p); };
      return Phase{a[0], a[1], a[2], arc(a[3]), a[4], arc(a[5])};
    };
    const Phase z = inclined(e.euler());
    rates::Variables<double> near{};
    for (std::size_t i = 0; i < 6; ++i) near[i] = static_cast<double>(z[i]);
    const auto r = rates::equations_of_motion(e.system(), e.t, near, Inclinations{});
    add(gap, {r[0], r[1], r[2], r[3], r[4], r[5]}, along(e, inclined));
  }
  EXPECT_LT(gap.size(), budget::paper_perturbed);
}

}  // namespace
}  // namespace polhode::paper
