// SPDX-License-Identifier: MIT
// Free rotation over the hard cases: constants of the motion, states up to 1e15 turns away, state
// transitions, short arcs, Hamilton's principal function.
#include "cases.hpp"
#include "record.hpp"

namespace {

using namespace polhode;
using probe::Case;
using probe::Record;

constexpr double turns[] = {0.0, 0.3, -7.1, 100.7, 12345.6, 1e9 / 3, -1e15 / 7};
constexpr int of_each = 150;

void print_constants(const Record& out, const FreeRotation& motion) {
  out.value("regime", static_cast<double>(motion.regime()));
  out.value("momentum", motion.momentum());
  out.value("energy", motion.energy());
  out.value("m", motion.modulus().m());
  out.value("m1", motion.modulus().m1());
  out.value("separatrix_distance", motion.separatrix_distance());
  out.value("circulates_long_axis", motion.circulates_long_axis());
  out.value("sign_g1", motion.sign_g1());
  out.value("sign_g3", motion.sign_g3());
  out.value("circulation_action", motion.circulation_action());
  out.value("circulation_deficit", motion.circulation_deficit());
  out.value("polhode_period", motion.polhode_period());
  out.value("precession_rate_long", motion.precession_rate_long());
  out.value("precession_rate_short", motion.precession_rate_short());
}

void print_generating_function(const Record& out, const FreeRotation& motion, double t) {
  const EulerAngles q = euler_angles(motion.at(t).q);
  const free::GeneratingFunction f =
      free::generating_function(motion.body(), q, to_serret(motion, t), t);
  const double values[] = {f.S, f.Phi, f.Theta, f.Psi, f.g0, f.h, f.minus_t0, f.minus_T};
  for (int i = 0; i < 8; ++i)
    out.value("generating_function[" + std::to_string(i) + "]", values[i]);
}

void print_motion(const Record& out, const Case& c) {
  const Body body(c.moments[0], c.moments[1], c.moments[2]);
  const RotorState start{{c.q[0], c.q[1], c.q[2], c.q[3]}, {c.g[0], c.g[1], c.g[2]}};
  const FreeRotation motion(body, start, c.t0);
  print_constants(out, motion);
  for (const double n : turns)
    out.state("at(" + std::to_string(n) + ")", motion.at(c.t0 + n * c.turn));
  for (const double n : {0.3, 12.1})
    out.matrix("state_transition(" + std::to_string(n) + ")",
               motion.state_transition(c.t0 + n * c.turn), 6);
  out.tried("short_arc", [&] {
    const FreeRotation arc = FreeRotation::short_arc(body, start, c.t0);
    for (const double n : {0.02, -1.7})
      out.state("short_arc(" + std::to_string(n) + ")", arc.at(c.t0 + n * c.turn));
  });
  out.tried("generating_function",
            [&] { print_generating_function(out, motion, c.t0 + 0.3 * c.turn); });
}

}  // namespace

int main() {
  for (const Case& c : probe::cases(of_each)) {
    const Record out(c.name);
    out.tried("motion", [&] { print_motion(out, c); });
  }
}
