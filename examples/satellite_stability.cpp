// SPDX-License-Identifier: MIT
// Which shapes of a satellite on a circular orbit keep one face to the Earth? Runs every shape from
// a small disturbance for some orbits and prints how far it has tilted: the stability regions of
// Lagrange and of DeBra & Delp (1961), drawn from runs.
//
//   satellite_stability [CELLS ORBITS]   > regions.csv
//
// Moments: I1 about the radius (yaw), I2 along the track (roll), I3 about the orbit's normal
// (pitch); k_yaw = (I3 - I2)/I1, k_roll = (I3 - I1)/I2, both between -1 and 1 for every real body.
// Without arguments: a map, # where the satellite stays within 0.5 rad of the orbital axes for 40
// orbits. With them, CSV: k_roll, k_yaw, the largest angle in rad, and 1 where the linear theory
// says stable (docs/guide/satellite-stability.md). The diagonal, where pitch is neutral, is a
// border.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "polhode/polhode.hpp"

namespace {

using namespace polhode;

constexpr double kick = 1e-3;    // rad: the disturbance
constexpr double tumbled = 0.5;  // rad: a run ends there

// Moments of a body with these two ratios, up to scale: k_yaw I1 = I3 - I2, k_roll I2 = I3 - I1.
Body satellite(double k_roll, double k_yaw) {
  const double I1 = 1.0 - k_roll, I2 = 1.0 - k_yaw, I3 = 1.0 - k_roll * k_yaw;
  const double largest = std::max({I1, I2, I3});
  return Body(I1 / largest, I2 / largest, I3 / largest);
}

// Linear theory: pitch is stable for I2 > I1; roll and yaw for real frequencies.
bool stable_by_theory(double k_roll, double k_yaw) {
  const double b = 1.0 + 3.0 * k_roll + k_roll * k_yaw, c = k_roll * k_yaw;
  return k_roll > k_yaw && c > 0.0 && b > 0.0 && b > 4.0 * std::sqrt(c);
}

double largest_tilt(const Body& body, double orbits) {
  const KeplerOrbit orbit({.gm = 1.0, .pericentre = 1.0, .eccentricity = 0.0});
  const System system(body, Frame::precessing({0.0, 0.0, 1.0}, 1.0),
                      {AnyPerturbation("gravity gradient", GravityGradient(1.0, orbit))});
  const Vec3& I = body.moments();
  const RotorState start{normalized(Quaternion{1.0, 0.5 * kick, 0.7 * kick, 0.6 * kick}),
                         {0.0, 0.0, I.z}};
  double tilt = 0.0;
  const Event tumbles{"tumbles",
                      [&tilt](double, const RotorState& s) {
                        const double angle =
                            2.0 * std::atan2(std::hypot(s.q.x, s.q.y, s.q.z), std::fabs(s.q.w));
                        tilt = std::max(tilt, angle);
                        return angle - tumbled;
                      },
                      Crossing::rising, true};
  integrate(
      {system, start, 0.0, orbits * 2.0 * std::numbers::pi, Adaptive{.tolerance = 1e-9}, {tumbles}},
      {.dense = false});
  return tilt;
}

double center(int i, int cells) { return -1.0 + (2.0 * i + 1.0) / cells; }

// One row per k_yaw, from +1 down; k_roll from -1 to +1.
void print_map(int cells, double orbits) {
  int unlike = 0;
  for (int j = cells - 1; j >= 0; --j) {
    for (int i = 0; i < cells; ++i) {
      const double k_roll = center(i, cells), k_yaw = center(j, cells);
      const bool stays = largest_tilt(satellite(k_roll, k_yaw), orbits) < tumbled;
      unlike += stays != stable_by_theory(k_roll, k_yaw);
      std::printf("%s%c", i == 0 ? "" : " ", stays ? '#' : '.');
    }
    std::printf("\n");
  }
  std::printf("unlike the linear theory: %d of %d\n", unlike, cells * cells);
}

void print_table(int cells, double orbits) {
  std::printf("k_roll,k_yaw,tilt,stable\n");
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const double k_roll = center(i, cells), k_yaw = center(j, cells);
      std::printf("%.6f,%.6f,%.6f,%d\n", k_roll, k_yaw,
                  largest_tilt(satellite(k_roll, k_yaw), orbits), stable_by_theory(k_roll, k_yaw));
    }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1) {
    print_map(20, 40.0);
    return 0;
  }
  const int cells = std::atoi(argv[1]);
  const double orbits = argc > 2 ? std::atof(argv[2]) : 40.0;
  if (cells < 1 || !(orbits > 0.0)) {
    std::fprintf(stderr, "satellite_stability: CELLS and ORBITS must be positive\n");
    return 2;
  }
  print_table(cells, orbits);
}

// Prints:
// . . . . . . . . . . . . . . . . . . . #
// . . . . . . . . . . . . . . . . . . # #
// . . . . . . . . . . . . . . . . . # # #
// . . . . . . . . . . . . . . . . # # # #
// . . . . . . . . . . . . . . . # # # # #
// . . . . . . . . . . . . . . # # # # # #
// . . . . . . . . . . . . . # # # # # # #
// . . . . . . . . . . . . # # # # # # # #
// . . . . . . . . . . . # # # # # # # # #
// . . . . . . . . . . # # # # # # # # # #
// . . . . . . . . . # . . . . . . . . . .
// . . . . . . . . . # . . . . . . . . . .
// . . . . . . . . . # . . . . . . . . . .
// . . . . . . . . . # . . . . . . . . . .
// . . . . . . . . . # . . . . . . . . . .
// . . . . . . . . . # . . . . . . . . . .
// . . . . . . . . . # . . . . . . . . . .
// . . . . . . . . . # . . . . . . . . . .
// . . . . . . . . . # . . . . . . . . . .
// . . . . . . . . . # . . . . . . . . . .
// unlike the linear theory: 11 of 400
