// SPDX-License-Identifier: MIT
// Where the long axis of Apophis points, from the published periods (Pravec et al. 2014): ecliptic
// longitude and latitude every six hours. Phases are set to 0 at the epoch.
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
  const TumblerState published{27.38, 263.0, pole, Regime::short_axis, 0.0, 0.0};
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
//       0    163.203   -11.777
//       6     83.586   -26.572
//      12      1.114   -17.108
//      18    -74.093     1.932
//      24   -151.307     2.329
//      30    131.940   -14.930
//      36     48.999   -20.223
//      42    -30.038    -2.293
//      48   -108.622    11.481
