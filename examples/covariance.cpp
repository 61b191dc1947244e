// SPDX-License-Identifier: MIT
// How well is the attitude of a tumbling satellite known an orbit after the last contact? Its
// covariance through the exact state transition matrix: P(t) = M P M^T, without an integrator.
#include <cmath>
#include <cstdio>

#include "polhode/polhode.hpp"

using namespace polhode;

int main() {
  constexpr double deg = 0.017453292519943295;
  const Body satellite(110.0, 150.0, 180.0);  // kg m2
  const RotorState contact =
      rotor_state(satellite, Quaternion{0.5, 0.5, 0.5, 0.5}, Vec3{0.3 * deg, 2.0 * deg, 0.4 * deg});
  const FreeRotation motion(satellite, contact);

  Matrix6 P;  // attitude to 0.1 deg, rates to 0.001 deg/s, independent
  const Vec3& I = satellite.moments();
  for (int i = 0; i < 3; ++i) {
    P(i, i) = std::pow(0.1 * deg, 2);
    P(i + 3, i + 3) = std::pow(I[i] * 0.001 * deg, 2);
  }
  for (const double minutes : {0.0, 1.0, 10.0, 90.0}) {
    const Matrix6 M = motion.state_transition(60 * minutes);
    const Matrix6 now = M * P * transpose(M);
    const double attitude = std::sqrt(now(0, 0) + now(1, 1) + now(2, 2)) / deg;
    std::printf("after %2.0f min the attitude is known to %.3f deg\n", minutes, attitude);
  }
}

// Prints:
//   after  0 min the attitude is known to 0.173 deg
//   after  1 min the attitude is known to 0.198 deg
//   after 10 min the attitude is known to 0.683 deg
//   after 90 min the attitude is known to 5.451 deg
