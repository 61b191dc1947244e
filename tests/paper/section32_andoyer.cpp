// SPDX-License-Identifier: MIT
// Section 3.2 of the paper: Andoyer's variables and their relation to Euler's.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "budgets.hpp"
#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/chart_jacobian.hpp"

namespace polhode::paper {
namespace {

using budget::paper_derivative;
using budget::paper_exact;
using budget::paper_misprint;

// Sines and cosines of the five angles of a case, named as in the paper.
struct Trig {
  explicit Trig(const AndoyerCase& e)
      : sl(s(e.a[0])),
        cl(c(e.a[0])),
        sg(s(e.a[1])),
        cg(c(e.a[1])),
        sh(s(e.a[2])),
        ch(c(e.a[2])),
        sJ(s(e.J)),
        cJ(c(e.J)),
        sI(s(e.incl)),
        cI(c(e.incl)) {}
  Mp sl, cl, sg, cg, sh, ch, sJ, cJ, sI, cI;
  // The two bracketed factors that recur in the matrix, first and second row.
  Mp along1() const { return cl * cg - sl * cJ * sg; }
  Mp along2() const { return -sl * cg - cl * cJ * sg; }
  Mp across1() const { return cl * sg + sl * cJ * cg; }
  Mp across2() const { return -sl * sg + cl * cJ * cg; }
};

// sqrt(G^2 - L^2), sqrt(G^2 - H^2)
Mp side_L(const AndoyerCase& e) { return root(e.a[4] * e.a[4] - e.a[3] * e.a[3]); }
Mp side_H(const AndoyerCase& e) { return root(e.a[4] * e.a[4] - e.a[5] * e.a[5]); }

Phase euler_phase(const AndoyerCase& e) { return {e.q[0], e.q[1], e.q[2], e.p[0], e.p[1], e.p[2]}; }

// [SA "Rnew", "v1", "v2", "v3"] what is right as printed: third row, and first row of column 3
TEST(PaperAndoyer, Rnew_EntriesRightAsPrinted) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Trig k(e);
    const Mp tilt = k.sJ * k.cg * k.cI + k.cJ * k.sI;
    gap.add(e.R[2], Vec{k.sJ * k.sg * k.ch + tilt * k.sh, k.sJ * k.sg * k.sh - tilt * k.ch,
                        -k.sJ * k.cg * k.sI + k.cJ * k.cI});
    gap.add(e.R[0][2], k.across1() * k.sI + k.sl * k.sJ * k.cI);
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA "v1"] brackets lost in rows 1 and 2 of the first column
TEST(PaperErrata, V1_FirstColumnBrackets) {
  Gap printed1, printed2, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Trig k(e);
    printed1.add(e.R[0][0], k.along1() * k.ch - k.across1() * k.cI - k.sl * k.sJ * k.sI * k.sh);
    printed2.add(e.R[1][0], -k.sl * k.cg - k.cl * k.cJ * k.sg * k.ch - k.across2() * k.cI -
                                k.cl * k.sJ * k.sI * k.sh);
    right.add(e.R[0][0], k.along1() * k.ch - (k.across1() * k.cI - k.sl * k.sJ * k.sI) * k.sh);
    right.add(e.R[1][0], k.along2() * k.ch - (k.across2() * k.cI - k.cl * k.sJ * k.sI) * k.sh);
  }
  EXPECT_GT(printed1.size(), paper_misprint);
  EXPECT_GT(printed2.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA "v2"] brackets lost in rows 1 and 2 of the second column
TEST(PaperErrata, V2_SecondColumnBrackets) {
  Gap printed1, printed2, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Trig k(e);
    printed1.add(e.R[0][1], k.along1() * k.sh + k.across1() * k.cI - k.sl * k.sJ * k.sI * k.ch);
    printed2.add(e.R[1][1], -k.sl * k.cg - k.cl * k.cJ * k.sg * k.sh + k.across2() * k.cI -
                                k.cl * k.sJ * k.sI * k.ch);
    right.add(e.R[0][1], k.along1() * k.sh + (k.across1() * k.cI - k.sl * k.sJ * k.sI) * k.ch);
    right.add(e.R[1][1], k.along2() * k.sh + (k.across2() * k.cI - k.cl * k.sJ * k.sI) * k.ch);
  }
  EXPECT_GT(printed1.size(), paper_misprint);
  EXPECT_GT(printed2.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA "v3"] brackets lost in row 2 of the third column
TEST(PaperErrata, V3_ThirdColumnBrackets) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Trig k(e);
    printed.add(e.R[1][2], -k.sl * k.sg + k.cl * k.cJ * k.cg * k.sI + k.cl * k.sJ * k.cI);
    right.add(e.R[1][2], k.across2() * k.sI + k.cl * k.sJ * k.cI);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA "dr1", "dr2"] dR stands for the vector of the infinitesimal rotation
TEST(PaperAndoyer, InfinitesimalRotationVector) {
  Gap euler, andoyer;
  Random random(67);
  for (const AndoyerCase& e : andoyer_cases()) {
    const Phase d = direction(random);
    const Vec turn = inertial_rate([&](const Mp& t) { return moved(e, d, t).R; });
    const Vec s3{Mp(0), Mp(0), Mp(1)};
    const Vec node{c(e.q[0]), s(e.q[0]), Mp(0)};
    const Vec i{c(e.a[2]), s(e.a[2]), Mp(0)};
    const Vec j = (1 / (e.a[4] * s(e.J))) * cross(e.G_vec, e.R[2]);
    euler.add(turn, rate(e, d, [](const AndoyerCase& x) { return x.q[0]; }) * s3 +
                        rate(e, d, [](const AndoyerCase& x) { return x.q[1]; }) * node +
                        rate(e, d, [](const AndoyerCase& x) { return x.q[2]; }) * e.R[2]);
    andoyer.add(turn, d[2] * s3 + rate(e, d, [](const AndoyerCase& x) { return x.incl; }) * i +
                          (d[1] / e.a[4]) * e.G_vec +
                          rate(e, d, [](const AndoyerCase& x) { return x.J; }) * j + d[0] * e.R[2]);
  }
  EXPECT_LT(euler.size(), paper_derivative);
  EXPECT_LT(andoyer.size(), paper_derivative);
}

// [SA (72), (76)] projections of the momentum on the five axes of rotation; Phi = H, Psi = L
TEST(PaperAndoyer, Eq72_Eq76_Projections) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Vec node{c(e.q[0]), s(e.q[0]), Mp(0)}, i{c(e.a[2]), s(e.a[2]), Mp(0)};
    gap.add(e.p, Vec{e.G_vec[2], dot(e.G_vec, node), dot(e.G_vec, e.R[2])});
    gap.add(dot(e.G_vec, i), Mp(0));
    gap.add(e.p[0], e.a[5]);
    gap.add(e.p[2], e.a[3]);
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA "cantran2", (73), (74), (75)] Phi dphi + Theta dtheta + Psi dpsi = G . dR = L dl + G dg + H
// dh
TEST(PaperAndoyer, Eq75_EqualOneForms) {
  Gap gap;
  Random random(75);
  for (const AndoyerCase& e : andoyer_cases()) {
    const Phase d = direction(random);
    Mp euler = 0;
    for (std::size_t i = 0; i < 3; ++i)
      euler += e.p[i] * derivative([&](const Mp& t) { return moved(e, d, t).q[i]; }, Mp(0));
    const Mp andoyer = e.a[3] * d[0] + e.a[4] * d[1] + e.a[5] * d[2];
    const Vec turn = inertial_rate([&](const Mp& t) { return moved(e, d, t).R; });
    gap.add(euler, dot(e.G_vec, turn));
    gap.add(dot(e.G_vec, turn), andoyer);
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA (75)] in the tangent (dtheta_B, dg_B) of the hub: B Jc B^T = Pi for B = d(hub)/d(Andoyer)
TEST(PaperAndoyer, Eq75_HubTangent) {
  Gap tensor;
  for (const AndoyerCase& e : andoyer_cases()) {
    std::array<Phase, 6> B;  // rows: three of dtheta_B, three of dg_B
    for (std::size_t j = 0; j < 6; ++j) {
      Phase d{};
      d[j] = 1;
      const Vec turn = e.R * inertial_rate([&](const Mp& t) { return moved(e, d, t).R; });
      for (std::size_t i = 0; i < 3; ++i) {
        B[i][j] = turn[i];
        B[i + 3][j] = rate(e, d, [i](const AndoyerCase& x) { return x.g_B[i]; });
      }
    }
    const Mat g = hat(e.g_B);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const Mp one = i == j ? 1 : 0;
        tensor.add(bracket(B[i], B[j]), Mp(0));
        tensor.add(bracket(B[i], B[j + 3]), one);
        tensor.add(bracket(B[i + 3], B[j]), -one);
        tensor.add(bracket(B[i + 3], B[j + 3]), g[i][j]);
      }
  }
  EXPECT_LT(tensor.size(), paper_derivative);
}

// [SA (75)] all brackets of Andoyer's variables, taken in Euler's
TEST(PaperAndoyer, Eq75_CanonicalBrackets) {
  for (std::size_t n = 0; n < 4; ++n) {
    const AndoyerCase& e = andoyer_cases()[n];
    EXPECT_LT(symplectic_defect(jacobian(andoyer_of_euler, euler_phase(e))), paper_derivative);
  }
}

// [SA (84), (78)] cosines of I and J; cos theta
TEST(PaperAndoyer, Eq78_Eq84_CosTheta) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Mp &L = e.a[3], &G = e.a[4], &H = e.a[5];
    gap.add(c(e.incl), H / G);
    gap.add(c(e.J), L / G);
    gap.add(c(e.q[1]), L * H / (G * G) - c(e.a[1]) / (G * G) * side_L(e) * side_H(e));
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA (79)] sign of the second term inside the denominator
TEST(PaperErrata, Eq79_TanPsiDenominator) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Trig k(e);
    const Mp &L = e.a[3], &G = e.a[4], &H = e.a[5];
    const Mp above = side_H(e) * (G * k.sg * k.cl + L * k.sl * k.cg) + H * k.sl * side_L(e);
    const Mp last = H * k.cl * side_L(e);
    const Mp below_printed = -side_H(e) * (G * k.sg * k.sl + L * k.cl * k.cg) + last;
    const Mp below = -side_H(e) * (G * k.sg * k.sl - L * k.cl * k.cg) + last;
    printed.add(turned(e.q[2] - angle(above, below_printed)), Mp(0));
    right.add(turned(e.q[2] - angle(above, below)), Mp(0));
    // and in size: the pair is G^2 sin theta (sin psi, cos psi)
    right.add(below, G * G * s(e.q[1]) * c(e.q[2]));
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA (80)] right as a tangent; as an angle phi = atan2(N, -D), while atan2(-N, D) is off by pi
TEST(PaperAndoyer, Eq80_TanPhi) {
  Gap tangent, right, literal;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Trig k(e);
    const Mp &L = e.a[3], &G = e.a[4], &H = e.a[5];
    const Mp N = side_L(e) * (G * k.sg * k.ch + H * k.sh * k.cg) + L * k.sh * side_H(e);
    const Mp D = side_L(e) * (G * k.sg * k.sh - H * k.ch * k.cg) - L * k.ch * side_H(e);
    tangent.add(-N * c(e.q[0]), D * s(e.q[0]));
    right.add(turned(e.q[0] - angle(N, -D)), Mp(0));
    literal.add(magnitude(turned(e.q[0] - angle(-N, D))), pi());
  }
  EXPECT_LT(tangent.size(), paper_exact);
  EXPECT_LT(right.size(), paper_exact);
  EXPECT_LT(literal.size(), paper_exact);
}

// [SA "Theta"] the momentum after (80): printed sin(psi - l)
TEST(PaperErrata, Theta_SignOfSine) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    printed.add(e.p[1], side_L(e) * s(e.q[2] - e.a[0]));
    right.add(e.p[1], side_L(e) * s(e.a[0] - e.q[2]));
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA "newhamil", (1490), (1491), (1492)]
TEST(PaperAndoyer, Newhamil_EnergyAndBodyMomentum) {
  Gap energy, momentum;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Trig k(e);
    const Mp &L = e.a[3], &G = e.a[4];
    energy.add(
        kinetic(e.I, e.g_B),
        (k.sl * k.sl / e.I[0] + k.cl * k.cl / e.I[1]) * (G * G - L * L) / 2 + L * L / (2 * e.I[2]));
    momentum.add(e.g_B, Vec{side_L(e) * k.sl, side_L(e) * k.cl, L});
  }
  EXPECT_LT(energy.size(), paper_exact);
  EXPECT_LT(momentum.size(), paper_exact);
}

// [SA "constraint", "hge0"] -G <= L <= G, and sharper than H >= 0: G^2/(2 I3) <= H <= G^2/(2 I1)
TEST(PaperAndoyer, BoundsOfTheHamiltonian) {
  for (const AndoyerCase& e : andoyer_cases()) {
    const Mp &L = e.a[3], &G = e.a[4];
    EXPECT_TRUE(-G <= L && L <= G);
    const Mp T = andoyer_energy(e.I, e.a);
    EXPECT_TRUE(G * G / (2 * e.I[2]) <= T && T <= G * G / (2 * e.I[0]));
    // both ends are reached, by spins about b3 and b1
    Phase spin = e.a;
    spin[3] = G;
    Gap ends;
    ends.add(andoyer_energy(e.I, spin), G * G / (2 * e.I[2]));
    spin[3] = 0;
    spin[0] = pi() / 2;
    ends.add(andoyer_energy(e.I, spin), G * G / (2 * e.I[0]));
    EXPECT_LT(ends.size(), paper_exact);
  }
}

// [SA "dot_g", "dot_h", "dot_l", "dot_G", "dot_H", "dot_L"] against the flow in Euler's variables
TEST(PaperAndoyer, RatesOfTheSixVariables) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Trig k(e);
    const Mp &L = e.a[3], &G = e.a[4];
    const Mp spread = k.sl * k.sl / e.I[0] + k.cl * k.cl / e.I[1];
    const Phase dH = gradient([&](const Phase& x) { return euler_energy(e.I, x); }, euler_phase(e));
    const Phase printed{L * (1 / e.I[2] - spread),
                        G * spread,
                        Mp(0),
                        (L * L - G * G) * k.sl * k.cl * (1 / e.I[0] - 1 / e.I[1]),
                        Mp(0),
                        Mp(0)};
    const auto rows = jacobian(andoyer_of_euler, euler_phase(e));
    for (std::size_t i = 0; i < 6; ++i) gap.add(bracket(rows[i], dH), printed[i]);
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA "Rnew", (84), (1490), (1491), (1492)] the library from the hub to Andoyer's variables
TEST(PaperAndoyer, LibraryToAndoyer) {
  Gap gap;
  for (const RotorState& state : hub_states(32, 200)) {
    const Phase a = exact(to_andoyer(state)), x = andoyer_of_euler(exact_euler(state));
    for (std::size_t i = 0; i < 3; ++i) gap.add(turned(a[i] - x[i]), Mp(0));
    for (std::size_t i = 3; i < 6; ++i) gap.add(a[i], x[i]);
  }
  EXPECT_LT(gap.size(), budget::paper_library);
}

// [SA "Rnew", "v1", "v2", "v3", (1490), (1491), (1492)] and back: the product of five rotations
TEST(PaperAndoyer, LibraryFromAndoyer) {
  Gap attitude, momentum;
  for (const RotorState& state : hub_states(33, 200)) {
    const AndoyerState a = to_andoyer(state);
    const RotorState back = to_rotor(a);
    const AndoyerCase e = andoyer_case({Mp(1), Mp(1), Mp(1)}, exact(a));
    attitude.add(paper::exact(back.q), e.R);
    momentum.add(paper::exact(back.g), e.g_B);
  }
  EXPECT_LT(attitude.size(), budget::paper_library);
  EXPECT_LT(momentum.size(), budget::paper_library);
}

// [SA (75)] the library's derivative of Andoyer's variables by Euler's
TEST(PaperAndoyer, LibraryCanonicalTransformation) {
  Gap gap;
  for (const RotorState& state : hub_states(34, 4)) {
    const Matrix6 M =
        canonical_transformation(state, {CanonicalSet::euler}, {CanonicalSet::andoyer});
    const auto rows = jacobian(andoyer_of_euler, exact_euler(state));
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        gap.add(Mp(M(static_cast<int>(i), static_cast<int>(j))), rows[i][j]);
  }
  EXPECT_LT(gap.size(), budget::paper_library);
}

}  // namespace
}  // namespace polhode::paper
