// SPDX-License-Identifier: MIT
#include "polhode/ephemeris/teme_axes.hpp"

#include <erfa.h>

#include <cmath>

namespace polhode {
inline namespace v0 {

Mat3 j2000_from_teme(const Date& date) {
  const Date tt = converted(date, TimeScale::TT);
  double dpsi = 0.0, deps = 0.0, of_date[3][3];
  eraNut80(tt.day, tt.fraction, &dpsi, &deps);
  eraPnm80(tt.day, tt.fraction, of_date);  // of date from J2000
  const double a = dpsi * std::cos(eraObl80(tt.day, tt.fraction));
  const double c = std::cos(a), s = std::sin(a);
  const Mat3 true_from_teme{{{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}}};
  Mat3 j2000_from_date;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) j2000_from_date(i, k) = of_date[k][i];
  return j2000_from_date * true_from_teme;
}

}  // namespace v0
}  // namespace polhode
