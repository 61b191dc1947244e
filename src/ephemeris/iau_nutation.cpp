// SPDX-License-Identifier: MIT
#include "polhode/ephemeris/iau_nutation.hpp"

#include <erfa.h>

namespace polhode {
inline namespace v0 {

IauNutation iau_nutation(double T) {
  IauNutation at{};
  eraNut00a(2451545.0, 36525.0 * T, &at.longitude, &at.obliquity);
  return at;
}

}  // namespace v0
}  // namespace polhode
