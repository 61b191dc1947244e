// SPDX-License-Identifier: MIT
// Where the long axis of Apophis points, from the published periods (Pravec et al. 2014): ecliptic
// longitude and latitude every six hours. Phases are set to 0 at the epoch. The period of the long
// axis is their P_1; their P_phi = 27.38 h is of the short axis.
#include <cmath>
#include <cstdio>

#include "polhode/polhode.hpp"

using namespace polhode;

int main() {
  constexpr double deg = 0.017453292519943295;
  const Body apophis(0.61, 0.965, 1.0);
  const double longitude = 250 * deg, latitude = -75 * deg;
  const Vec3 pole{std::cos(latitude) * std::cos(longitude),
                  std::cos(latitude) * std::sin(longitude), std::sin(latitude)};
  const TumblerState published{30.56, 263.0, pole, Regime::short_axis, 0.0, 0.0};
  const FreeRotation motion(apophis, to_rotor(apophis, published));

  std::printf("hours  longitude  latitude\n");
  for (int i = 0; i <= 8; ++i) {
    const double hours = 6.0 * i;
    const Vec3 axis = rotate(motion.at(hours).q, Vec3{1, 0, 0});  // least moment: first axis
    std::printf("%5.0f  %9.3f  %8.3f\n", hours, std::atan2(axis.y, axis.x) / deg,
                std::asin(axis.z) / deg);
  }
}

// Prints:
//   hours  longitude  latitude
//       0    162.903   -10.704
//       6     91.992   -24.908
//      12     17.194   -19.803
//      18    -51.007    -1.940
//      24   -119.949     6.255
//      30    171.008    -4.676
//      36    100.319   -19.195
//      42     25.769   -15.810
//      48    -43.645     2.419
