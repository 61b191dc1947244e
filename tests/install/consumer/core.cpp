// SPDX-License-Identifier: MIT
// Uses the installed core: every public header, one constructor, one computed number.
#include <cstdio>

#include "polhode/polhode.hpp"

int main() {
  const polhode::Body body(1.0, 2.0, 2.5);
  const polhode::RotorState s{polhode::Quaternion{1, 0, 0, 0}, polhode::Vec3{1, 2, 5}};
  std::printf("%s %.17g\n", polhode::version(), polhode::kinetic_energy(body, s));
  return 0;
}
