// SPDX-License-Identifier: MIT
// Appendix A.4 and A.5 of the paper: rates of the node, and Andoyer's method of finding canonical
// variables.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "budgets.hpp"
#include "paper/support.hpp"

namespace polhode::paper {
namespace {

using budget::paper_derivative;
using budget::paper_exact;
using budget::paper_misprint;

// Rates of g, J and l in free motion.
struct NodeRates {
  explicit NodeRates(const AndoyerCase& e) {
    const Phase dH = gradient([&](const Phase& a) { return andoyer_energy(e.I, a); }, e.a);
    g = dH[4];
    l = dH[3];
    J = dH[0] / (e.a[4] * s(e.J));  // L = G cosJ
    omega = unscaled(e.I, e.g_B);
  }
  Mp g, l, J;
  Vec omega;
};

// [SA (9995), (9996), (9997)] body rates from g, J, l: free motion only
TEST(PaperAppendix, Eq9995_Eq9997_BodyRates) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const NodeRates r(e);
    const Mp sl = s(e.a[0]), cl = c(e.a[0]);
    gap.add(r.omega,
            Vec{r.g * s(e.J) * sl + r.J * cl, r.g * s(e.J) * cl - r.J * sl, r.l + r.g * c(e.J)});
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA "A.4"] ldot cosJ: printed cos^2 theta where cos^2 J stands
TEST(PaperErrata, A4Section_CosSquaredJ) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    const NodeRates r(e);
    const Mp along = (r.omega[0] * s(e.a[0]) + r.omega[1] * c(e.a[0])) / s(e.J);
    const Mp first = r.omega[2] * c(e.J);
    printed.add(r.l * c(e.J), first - squared(c(e.q[1])) * along);
    right.add(r.l * c(e.J), first - squared(c(e.J)) * along);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// A non-canonical pair z with x(z, t), y(z, t), and K(z, t), with their derivatives by z1, z2, t.
struct Moving {
  Mp z1, z2, t;
  Mp x() const { return z1 + t * z2 * z2; }
  Mp y() const { return z2 + t * t * z1 * z2; }
  Mp x1() const { return 1; }
  Mp x2() const { return 2 * t * z2; }
  Mp xt() const { return z2 * z2; }
  Mp y1() const { return t * t * z2; }
  Mp y2() const { return 1 + t * t * z1; }
  Mp yt() const { return 2 * t * z1 * z2; }
  // J_u = dK/du + y dx/du with K = t z1 z2
  Mp j1() const { return t * z2 + y() * x1(); }
  Mp j2() const { return t * z1 + y() * x2(); }
  Mp jt() const { return z1 * z2 + y() * xt(); }
  Mp H() const { return y() * y() / 2 + c(x()); }
};
using Part = std::function<Mp(const Moving&)>;
Mp by_z1(const Part& f, const Moving& m) {
  return derivative([&](const Mp& v) { return f({v, m.z2, m.t}); }, m.z1);
}
Mp by_z2(const Part& f, const Moving& m) {
  return derivative([&](const Mp& v) { return f({m.z1, v, m.t}); }, m.z2);
}
Mp by_t(const Part& f, const Moving& m) {
  return derivative([&](const Mp& v) { return f({m.z1, m.z2, v}); }, m.t);
}
// dz1/dt and dz2/dt from dx/dt = H_y, dy/dt = -H_x
std::array<Mp, 2> z_rates(const Moving& m) {
  const Mp x_rate = m.y() - m.xt(), y_rate = s(m.x()) - m.yt();
  const Mp D = m.x1() * m.y2() - m.x2() * m.y1();
  return {(x_rate * m.y2() - m.x2() * y_rate) / D, (m.x1() * y_rate - x_rate * m.y1()) / D};
}

// [SA "eqHam", "linear", "defJ"] Lagrange brackets, for variables that depend on time explicitly
TEST(PaperAppendix, Linear_LagrangeBrackets) {
  Gap equation, brackets;
  Random random(5);
  for (int i = 0; i < 6; ++i) {
    const Moving m{Mp(random.number(-1, 1)), Mp(random.number(0.2, 1)), Mp(random.number(-1, 1))};
    const auto z = z_rates(m);
    const Mp b12 = m.x1() * m.y2() - m.y1() * m.x2();
    const Mp b1t = m.x1() * m.yt() - m.y1() * m.xt(), b2t = m.x2() * m.yt() - m.y2() * m.xt();
    equation.add(by_z1([](const Moving& w) { return w.H(); }, m) + b1t + b12 * z[1], Mp(0));
    equation.add(by_z2([](const Moving& w) { return w.H(); }, m) + b2t - b12 * z[0], Mp(0));
    const Part J1 = [](const Moving& w) { return w.j1(); };
    const Part J2 = [](const Moving& w) { return w.j2(); };
    const Part Jt = [](const Moving& w) { return w.jt(); };
    brackets.add(b12, by_z2(J1, m) - by_z1(J2, m));
    brackets.add(b1t, by_t(J1, m) - by_z1(Jt, m));
    brackets.add(b2t, by_t(J2, m) - by_z2(Jt, m));
  }
  EXPECT_LT(equation.size(), paper_derivative);
  EXPECT_LT(brackets.size(), paper_derivative);
}

// [SA "H'"] the new Hamiltonian is H - J_t, printed H - t
TEST(PaperErrata, HPrime_MinusJt) {
  Gap printed, right;
  Random random(6);
  for (int i = 0; i < 6; ++i) {
    const Moving m{Mp(random.number(-1, 1)), Mp(random.number(0.2, 1)), Mp(random.number(-1, 1))};
    const auto z = z_rates(m);
    const Part J1 = [](const Moving& w) { return w.j1(); };
    const Part J2 = [](const Moving& w) { return w.j2(); };
    const Part printed_H = [](const Moving& w) { return w.H() - w.t; };
    const Part right_H = [](const Moving& w) { return w.H() - w.jt(); };
    const Mp curl = by_z2(J1, m) - by_z1(J2, m);
    printed.add(by_z1(printed_H, m) + by_t(J1, m) + curl * z[1], Mp(0));
    right.add(by_z1(right_H, m) + by_t(J1, m) + curl * z[1], Mp(0));
    right.add(by_z2(right_H, m) + by_t(J2, m) - curl * z[0], Mp(0));
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA "dH'/dq_k"] chain rule: the index of summation belongs on q*, not the free one
TEST(PaperErrata, HPrime_ChainRuleIndex) {
  Gap printed, right;
  const std::array<Mp, 2> q{Mp("0.3"), Mp("-0.8")};
  const auto star = [](const std::array<Mp, 2>& v) {
    return std::array<Mp, 2>{v[0] + v[0] * v[1], s(v[0]) - 2 * v[1]};
  };
  const auto H = [](const std::array<Mp, 2>& w) { return w[0] * w[0] + 3 * w[0] * c(w[1]); };
  const auto with = [](std::array<Mp, 2> v, std::size_t i, const Mp& x) {
    v[i] = x;
    return v;
  };
  const std::array<Mp, 2> at = star(q);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto by_star = [&](std::size_t j) {
      return derivative([&](const Mp& x) { return H(with(at, j, x)); }, at[j]);
    };
    Mp sum_printed = 0, sum = 0;
    for (std::size_t j = 0; j < 2; ++j) {
      const Mp slope = derivative([&](const Mp& x) { return star(with(q, k, x))[j]; }, q[k]);
      sum_printed += by_star(k) * slope;
      sum += by_star(j) * slope;
    }
    const Mp direct = derivative([&](const Mp& x) { return H(star(with(q, k, x))); }, q[k]);
    printed.add(direct, sum_printed);
    right.add(direct, sum);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA "p and q*"] the text calls p_j the momenta of q*_j; by dp/dt = +dH'/dq* they are coordinates,
// as l, g, h are, and q* = J_p are the momenta L, G, H
TEST(PaperErrata, AndoyerMethod_CoordinatesAndMomenta) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Phase x{e.q[0], e.q[1], e.q[2], e.p[0], e.p[1], e.p[2]};
    const Phase dH = gradient([&](const Phase& z) { return euler_energy(e.I, z); }, x);
    const auto rows = jacobian(andoyer_of_euler, x);
    const auto flow = [&](std::size_t i) { return bracket(rows[i], dH); };
    const Phase by = gradient([&](const Phase& a) { return andoyer_energy(e.I, a); }, e.a);
    printed.add(flow(3), by[0]);  // q* as coordinate, p as its momentum
    printed.add(flow(0), -by[3]);
    right.add(flow(3), -by[0]);
    right.add(flow(0), by[3]);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA "2T"] I2 omega3^2 printed for I3 omega3^2
TEST(PaperErrata, TwoT_ThirdMoment) {
  Gap printed, right;
  for (const EulerCase& e : euler_cases()) {
    const Vec& w = e.omega;
    const Mp first = e.I[0] * squared(w[0]) + e.I[1] * squared(w[1]);
    printed.add(dot(e.g, w), first + e.I[1] * squared(w[2]));
    right.add(dot(e.g, w), first + e.I[2] * squared(w[2]));
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// The vector of virtual rotation of one of Andoyer's variables, and J_alpha = sum p dq/dalpha.
struct Virtual {
  Virtual(const AndoyerCase& e, const Phase& d) {
    Vec dq;
    for (std::size_t i = 0; i < 3; ++i)
      dq[i] = rate(e, d, [i](const AndoyerCase& x) { return x.q[i]; });
    omega = body_rate(e.q, dq);
    J = dot(e.p, dq);
  }
  Vec omega;  // body components
  Mp J;
};

// [SA "J_alpha"] the polar form ends with I3 omega3 omega3alpha, printed I2
TEST(PaperErrata, JAlpha_ThirdMoment) {
  Gap printed, right;
  Random random(7);
  for (const AndoyerCase& e : andoyer_cases()) {
    const Virtual turn(e, direction(random));
    const Vec omega = unscaled(e.I, e.g_B);
    const Mp first = e.g_B[0] * turn.omega[0] + e.g_B[1] * turn.omega[1];
    printed.add(turn.J, first + e.I[1] * omega[2] * turn.omega[2]);
    right.add(turn.J, first + e.I[2] * omega[2] * turn.omega[2]);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA "J_l"] J_l = G.omega_l = G cosJ, printed G.omega_J, which is zero
TEST(PaperErrata, JL_VirtualRotation) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Virtual of_l(e, {Mp(1), Mp(0), Mp(0), Mp(0), Mp(0), Mp(0)});
    const Virtual of_J(e, {Mp(0), Mp(0), Mp(0), Mp(1), Mp(0), Mp(0)});  // J moves through L
    printed.add(of_l.J, dot(e.g_B, of_J.omega));
    right.add(of_l.J, dot(e.g_B, of_l.omega));
    right.add(of_l.J, e.a[4] * c(e.J));
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA "J_alpha", "J_l"] J_g = G, J_h = G cosI, and J_I = J_J = J_G = 0
TEST(PaperAppendix, JAlpha_OfTheOtherVariables) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const auto J = [&](std::size_t i) {
      Phase d{};
      d[i] = 1;
      return Virtual(e, d).J;
    };
    gap.add(J(1), e.a[4]);
    gap.add(J(2), e.a[4] * c(e.incl));
    for (const std::size_t i : {3u, 4u, 5u}) gap.add(J(i), Mp(0));
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

}  // namespace
}  // namespace polhode::paper
