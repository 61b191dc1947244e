// SPDX-License-Identifier: MIT
// Section 3.1 of the paper: the generating function and Serret's canonical constants.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "budgets.hpp"
#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/serret.hpp"

namespace polhode::paper {
namespace {

using budget::paper_derivative;
using budget::paper_exact;
using budget::paper_misprint;
using budget::paper_quadrature;

// u/n: the time since xi = 0, that is since l = pi/2 (short axis) or l = sign pi/2 (long axis).
Mp elapsed(const Polhode& p) { return ellint_F(p.xi, p.k) / p.n; }

// (g_o, h, -t_o; G, H, T) at time t
Phase serret(const Vec& moments, const Phase& a, const Mp& t) {
  const Polhode p = polhode(moments, a);
  const Mp tau = elapsed(p);
  return {
      a[1] - 2 * p.T / p.G * tau + tilt_integral(p, Mp(0), p.xi), a[2], tau - t, a[4], a[5], p.T};
}

// Andoyer's variables ordered as pairs (g, h, l; G, H, L), in the order of Serret's.
Phase andoyer_pairs(const Phase& y) { return {y[2], y[0], y[1], y[5], y[3], y[4]}; }

std::array<Phase, 6> serret_rows(const AndoyerCase& e,
                                 const std::function<Phase(const Phase&)>& elements) {
  const Phase y{e.a[1], e.a[2], e.a[0], e.a[4], e.a[5], e.a[3]};
  return jacobian([&](const Phase& z) { return elements(andoyer_pairs(z)); }, y);
}

// [SA (39), (41), (43), (47), (51), (60)] for any variation of the state and of t:
// dS = Phi dphi + Theta dtheta + Psi dpsi + g_o dG + h dH + (u/n - t) dT - T dt, S from (51) with
// int cosJ dl taken from u = 0; so dS/dq = p, dS/dP = Q, dS/dt = -T and the Jacobi equation holds.
TEST(PaperSerret, Eq51_GeneratingFunction) {
  Gap gap;
  Random random(51);
  for (const AndoyerCase& e : branches(2)) {
    const Mp t = random.number(-3, 3), dt = random.number(-1, 1);
    const Phase d = direction(random);
    const auto along = [&](const std::function<Mp(const AndoyerCase&, const Mp&)>& f) {
      return derivative([&](const Mp& x) { return f(moved(e, d, x), t + x * dt); }, Mp(0));
    };
    const Mp dS = along([](const AndoyerCase& x, const Mp& time) {
      const Polhode p = polhode(x.I, x.a);
      return -time * p.T + x.a[5] * x.a[2] + p.G * x.a[1] + p.G * tilt_integral(p, Mp(0), p.xi);
    });
    const Phase Q = serret(e.I, e.a, t);
    Mp sum = Q[0] * d[4] + Q[1] * d[5] - Q[5] * dt;
    sum += Q[2] * along([](const AndoyerCase& x, const Mp&) { return kinetic(x.I, x.g_B); });
    for (std::size_t i = 0; i < 3; ++i)
      sum += e.p[i] * along([i](const AndoyerCase& x, const Mp&) { return x.q[i]; });
    gap.add(dS, sum);
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA (49), (50), (A52)] for any variation, with I, J and G varying too
TEST(PaperSerret, Eq49_Eq50_AngleDifferentials) {
  Gap integrand, angles;
  Random random(50);
  for (const AndoyerCase& e : andoyer_cases()) {
    const Phase d = direction(random);
    Vec dq;
    for (std::size_t i = 0; i < 3; ++i)
      dq[i] = derivative([&](const Mp& t) { return moved(e, d, t).q[i]; }, Mp(0));
    const Mp& G = e.a[4];
    const Mp twist = -c(e.J) * (d[0] - dq[2]) + s(e.J) * s(e.a[0] - e.q[2]) * dq[1];
    integrand.add(e.p[1] * dq[1] + e.p[2] * dq[2], G * c(e.J) * d[0] + G * twist);
    angles.add(d[1] - (dq[0] - d[2]) * c(e.incl), twist);
  }
  EXPECT_LT(integrand.size(), paper_derivative);
  EXPECT_LT(angles.size(), paper_derivative);
}

// [SA "dimensionless"] u/n - t is an integral: (u/n, T) = 1. n is the rate of u, not the mean
// angular velocity that the text calls it: the momentum comes round after 4K/n, not 2 pi/n.
TEST(PaperSerret, DimensionlessTime) {
  Gap unit, rate, period, wording;
  for (const AndoyerCase& e : branches(1)) {
    const Field energy = [&](const Phase& y) { return andoyer_energy(e.I, y); };
    const Field time = [&](const Phase& y) { return elapsed(polhode(e.I, y)); };
    unit.add(bracket(time, energy, e.a), Mp(1));
    const Polhode p = polhode(e.I, e.a);
    if (p.long_axis) continue;
    const Mp G2 = p.G * p.G;
    rate.add(p.n, root((G2 / e.I[0] - 2 * p.T) * (1 / e.I[1] - 1 / e.I[2])));
    // one turn of l, by its own rate; L as a function of l from the energy
    const auto time_per_l = [&](const Mp& l) {
      const Mp spread = s(l) * s(l) / e.I[0] + c(l) * c(l) / e.I[1];
      const Mp tilt = root((spread * G2 - 2 * p.T) / (spread - 1 / e.I[2]));
      return 1 / (tilt * (spread - 1 / e.I[2]));
    };
    Mp round = 0;  // by eighths: next to the separatrix the rate of l has narrow dips
    for (int i = 0; i < 8; ++i) round += integral(time_per_l, pi() * i / 4, pi() * (i + 1) / 4);
    period.add(round, 4 * ellint_K(p.k) / p.n);
    wording.add(round, 2 * pi() / p.n);
  }
  EXPECT_LT(unit.size(), paper_derivative);
  EXPECT_LT(rate.size(), paper_exact);
  EXPECT_LT(period.size(), paper_quadrature);
  EXPECT_GT(wording.size(), paper_misprint);
}

// [SA (52)] dg + cosJ dl = (2T/G) dt
TEST(PaperSerret, Eq52_NodeRates) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Phase dH = gradient([&](const Phase& y) { return andoyer_energy(e.I, y); }, e.a);
    gap.add(dH[4] + c(e.J) * dH[3], 2 * kinetic(e.I, e.g_B) / e.a[4]);
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA (54)] g_o is an integral of the free motion
TEST(PaperSerret, Eq54_NodeAtEpoch) {
  Gap gap;
  for (const AndoyerCase& e : branches(1)) {
    const Field energy = [&](const Phase& y) { return andoyer_energy(e.I, y); };
    gap.add(bracket([&](const Phase& y) { return serret(e.I, y, Mp(0))[0]; }, energy, e.a), Mp(0));
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA (55)] equals (51) in value
TEST(PaperSerret, Eq55_ShortFormOfS) {
  Gap gap;
  const Mp t("0.7");
  for (const AndoyerCase& e : branches(2)) {
    const Polhode p = polhode(e.I, e.a);
    const Phase Q = serret(e.I, e.a, t);
    const Mp S = -t * p.T + e.a[5] * e.a[2] + p.G * e.a[1] + p.G * tilt_integral(p, Mp(0), p.xi);
    gap.add(S, (2 * elapsed(p) - t) * p.T + e.a[5] * e.a[2] + p.G * Q[0]);
  }
  EXPECT_LT(gap.size(), paper_quadrature);
}

// [SA (36), (56), (57), (58), (59), (61), (62)] the set (g_o, h, -t_o; G, H, T) is canonical, in
// all four branches
TEST(PaperSerret, Eq56_Eq62_CanonicalSet) {
  for (const AndoyerCase& e : branches(1)) {
    const auto rows = serret_rows(e, [&](const Phase& a) { return serret(e.I, a, Mp("0.3")); });
    EXPECT_LT(symplectic_defect(rows), paper_derivative);
  }
}

// [SA (51), (54)] the integral must start where u does: from l = 0 instead of pi/2 the set is not
// canonical
TEST(PaperSerret, BasePointOfTheIntegral) {
  for (const AndoyerCase& e : andoyer_cases(false, 1, 2)) {
    const auto rows = serret_rows(e, [&](const Phase& a) {
      Phase Q = serret(e.I, a, Mp(0));
      const Polhode p = polhode(e.I, a);
      Q[0] += tilt_integral(p, pi() / 2, Mp(0));  // xi = pi/2 is l = 0
      return Q;
    });
    EXPECT_GT(symplectic_defect(rows), paper_misprint);
  }
}

// [SA (A22), (A23), (A24), (52), (12)] the library's state at other times: the
// momentum by Jacobi's functions, the node by dg = (2T/G) dt - cosJ dl, in all four branches
TEST(PaperSerret, LibraryFreeRotation) {
  Gap momentum, attitude;
  for (const AndoyerCase& e : branches(3)) {
    const RotorState s0 = hub_state(e);
    const Phase a0 = andoyer_of_euler(exact_euler(s0));
    const Polhode p = polhode(e.I, a0);
    const FreeRotation motion(body_of(e.I), s0);
    EXPECT_EQ(motion.regime(), p.long_axis ? Regime::long_axis : Regime::short_axis);
    for (const double t : {-3.0, 0.7, 5.0}) {
      const Jacobi j = jacobi(ellint_F(p.xi, p.k) + p.n * Mp(t), p.k);
      const Vec g = momentum_at(p, j.am);
      const Mp node = a0[1] + 2 * p.T / p.G * Mp(t) - tilt_integral(p, p.xi, j.am);
      const AndoyerCase then =
          andoyer_case(e.I, {angle(g[0], g[1]), node, a0[2], g[2], p.G, a0[5]});
      const RotorState at = motion.at(t);
      momentum.add(exact(at.g), then.g_B);
      attitude.add(exact(at.q), then.R);
    }
  }
  EXPECT_LT(momentum.size(), budget::free_attitude);
  EXPECT_LT(attitude.size(), budget::free_attitude);
}

// [SA (54), (58), (59), (62), "dimensionless"] the library's Serret elements, and the way back to
// the hub
TEST(PaperSerret, LibrarySerretState) {
  Gap forth, back;
  for (const AndoyerCase& e : branches(3)) {
    const RotorState s0 = hub_state(e);
    const Body body = body_of(e.I);
    const FreeRotation motion(body, s0);
    const auto compare = [](Gap& gap, const SerretState& s, const Phase& x) {
      gap.add(turned(Mp(s.g0) - x[0]), Mp(0));
      gap.add(turned(Mp(s.h) - x[1]), Mp(0));
      gap.add(Mp(s.t0), -x[2]);
      gap.add(Vec{Mp(s.G), Mp(s.H), Mp(s.T)}, Vec{x[3], x[4], x[5]});
    };
    const Phase a = andoyer_of_euler(exact_euler(s0));
    const Polhode p = polhode(e.I, a);
    const SerretState s = to_serret(motion, 0.0);
    EXPECT_EQ(Mp(p.long_axis ? s.sign_g1 : s.sign_g3), p.sign);
    compare(forth, s, serret(e.I, a, Mp(0)));
    const double t = 0.4;
    const RotorState later = to_rotor(body, s, t);
    compare(back, s, serret(e.I, andoyer_of_euler(exact_euler(later)), Mp(t)));
  }
  EXPECT_LT(forth.size(), budget::paper_library_adapted);
  EXPECT_LT(back.size(), budget::paper_library_adapted);
}

}  // namespace
}  // namespace polhode::paper
