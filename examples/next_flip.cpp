// SPDX-License-Identifier: MIT
// When will the wing nut turn over next? Sadov's angle phi_l grows evenly, and the momentum crosses
// the plane across the intermediate axis where phi_l is 0 or pi: each flip is a division, not a
// search.
#include <cmath>
#include <cstdio>

#include "polhode/polhode.hpp"

using namespace polhode;

int main() {
  constexpr double pi = 3.141592653589793;
  const Body nut(30.53, 83.87, 113.3);
  const RotorState start = rotor_state(nut, Quaternion{}, Vec3{0.01096, 2 * pi, 0.0});
  const FreeRotation motion(nut, start);

  const double rate = sadov_frequencies(motion).n_l;
  const double angle = to_sadov(motion, 0.0).phi_l;
  const auto flip = [&](double turns) { return (turns * pi - angle) / rate; };
  const double direction = rate < 0 ? -1.0 : 1.0;
  const double first = std::ceil(direction * angle / pi);  // half turns of phi_l up to now
  for (const double k : {0.0, 1.0, 1e6}) {
    const double t = flip(direction * (first + k));
    const Vec3 g = motion.at(t).g;
    std::printf("flip %7.0f at t = %.6f s, momentum along axis 2: %s\n", k + 1, t,
                std::abs(g.y) < 1e-6 * motion.momentum() ? "none" : "some");
  }
}

// Prints:
//   flip       1 at t = 1.825270 s, momentum along axis 2: none
//   flip       2 at t = 5.475811 s, momentum along axis 2: none
//   flip 1000001 at t = 3650542.629811 s, momentum along axis 2: none
