// SPDX-License-Identifier: MIT
// The library's generating function of section 3.1 against its definition by quadrature at 50
// digits, and its derivatives against differences of that definition.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "budgets.hpp"
#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/free/generating_function.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode::paper {
namespace {

// S of (51) as it stands.
Mp defined(const Vec& moments, const Phase& euler, const Mp& t) {
  const Phase a = andoyer_of_euler(euler);
  const Polhode p = polhode(moments, a);
  return -t * p.T + p.G * (a[5] / p.G) * a[2] + p.G * a[1] + p.G * tilt_integral(p, Mp(0), p.xi);
}

// S at the attitude of a state and its constants, both rounded, on the branch of its motion.
struct Rounded {
  free::GeneratingFunction f;
  Phase x;  // the arguments' angles, and the momenta that f returns
};
Rounded library(const Vec& moments, const RotorState& s0, double t) {
  const Body body = body_of(moments);
  const EulerAngles q = euler_angles(s0.q);
  const free::GeneratingFunction f =
      free::generating_function(body, q, to_serret(FreeRotation(body, s0, t), t), t);
  return {f, {Mp(q.phi), Mp(q.theta), Mp(q.psi), Mp(f.Phi), Mp(f.Theta), Mp(f.Psi)}};
}

// [SA (51), (55), (A47), (A48)] its value, on the branch t - t0 = u/n and g0 in (-pi, pi]
TEST(PaperSerret, LibraryGeneratingFunction) {
  Gap gap;
  for (const AndoyerCase& e : branches(4)) {
    const RotorState s0 = hub_state(e);
    const double t = 0.3;
    const auto [f, x] = library(e.I, s0, t);
    const Polhode p = polhode(e.I, andoyer_of_euler(x));
    // g0 as a number modulo 2 pi: S modulo 2 pi G
    const Mp off = (Mp(f.S) - defined(e.I, x, Mp(t))) / p.G;
    gap.add(turned(off), Mp(0));
  }
  EXPECT_LT(gap.size(), budget::paper_generating);
}

// [SA (37), (38), (39), (40), (41), (42), (43), (56), (57), (58), (59), (60), (61), (62), (A66)]
// for any variation of q, P and t: dS = momenta . dq + g0 dG + h dH - t0 dT - T dt with the
// library's eight derivatives, dS of the definition
TEST(PaperSerret, LibraryGeneratingFunctionDerivatives) {
  Gap gap;
  Random random(56);
  for (const AndoyerCase& e : branches(4)) {
    const RotorState s0 = hub_state(e);
    const double t = -0.7;
    const Rounded r = library(e.I, s0, t);
    const free::GeneratingFunction& f = r.f;
    const Phase& x = r.x;
    for (int n = 0; n < 7; ++n) {
      Phase d{};
      Mp dt = 0;
      if (n < 6)
        for (Mp& component : d) component = random.number(-1, 1);
      else
        dt = 1;
      const auto at = [&](const Mp& h) {
        Phase y = x;
        for (std::size_t i = 0; i < 6; ++i) y[i] += h * d[i];
        return y;
      };
      const auto change = [&](const std::function<Mp(const Phase&)>& value) {
        return derivative([&](const Mp& h) { return value(at(h)); }, Mp(0));
      };
      const Mp dS =
          derivative([&](const Mp& h) { return defined(e.I, at(h), Mp(t) + h * dt); }, Mp(0));
      const Mp by_q = Mp(f.Phi) * d[0] + Mp(f.Theta) * d[1] + Mp(f.Psi) * d[2];
      const Mp dG = change([](const Phase& y) { return andoyer_of_euler(y)[4]; });
      const Mp dT = change([&](const Phase& y) { return euler_energy(e.I, y); });
      // g0 and h modulo 2 pi, on the branch of the definition
      const Phase a = andoyer_of_euler(x);
      const Polhode p = polhode(e.I, a);
      const Mp node =
          a[1] + tilt_integral(p, Mp(0), p.xi) - 2 * p.T / p.G * (ellint_F(p.xi, p.k) / p.n);
      const Mp g0 = node + turned(Mp(f.g0) - node);
      gap.add(dS, by_q + g0 * dG + Mp(f.h) * d[3] + Mp(f.minus_t0) * dT + Mp(f.minus_T) * dt);
    }
  }
  EXPECT_LT(gap.size(), budget::paper_generating);
}

}  // namespace
}  // namespace polhode::paper
