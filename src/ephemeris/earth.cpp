// SPDX-License-Identifier: MIT
// The Earth at a date: rotation, nutation, axes of two-line elements (TEME), and the IGRF dipole.
#include <erfa.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "math/number_text.hpp"
#include "polhode/ephemeris/ephemeris.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ephemeris {

IauNutation iau_nutation(double T) {
  IauNutation at{};
  eraNut00a(2451545.0, 36525.0 * T, &at.longitude, &at.obliquity);
  return at;
}

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

namespace {

struct DipoleEpoch {
  double year, g10, g11, h11;
};
// IGRF-14; 2030 by its secular variation.
constexpr std::array<DipoleEpoch, 27> igrf = {{
    {1900, -31543, -2298, 5922},          {1905, -31464, -2298, 5909},
    {1910, -31354, -2297, 5898},          {1915, -31212, -2306, 5875},
    {1920, -31060, -2317, 5845},          {1925, -30926, -2318, 5817},
    {1930, -30805, -2316, 5808},          {1935, -30715, -2306, 5812},
    {1940, -30654, -2292, 5821},          {1945, -30594, -2285, 5810},
    {1950, -30554, -2250, 5815},          {1955, -30500, -2215, 5820},
    {1960, -30421, -2169, 5791},          {1965, -30334, -2119, 5776},
    {1970, -30220, -2068, 5737},          {1975, -30100, -2013, 5675},
    {1980, -29992, -1956, 5604},          {1985, -29873, -1905, 5500},
    {1990, -29775, -1848, 5406},          {1995, -29692, -1784, 5306},
    {2000, -29619.4, -1728.2, 5186.1},    {2005, -29554.63, -1669.05, 5077.99},
    {2010, -29496.57, -1586.42, 4944.26}, {2015, -29441.46, -1501.77, 4795.99},
    {2020, -29403.41, -1451.37, 4653.35}, {2025, -29350.0, -1410.3, 4545.5},
    {2030, -29287.0, -1360.3, 4438.0},
}};

}  // namespace

Mat3 j2000_from_earth(const Date& date, std::optional<double> dut1) {
  const Date tt = converted(date, TimeScale::TT, dut1);
  const Date ut1 = converted(tt, TimeScale::UT1, dut1.value_or(0.0));
  double terrestrial[3][3];
  eraC2t06a(tt.day, tt.fraction, ut1.day, ut1.fraction, 0.0, 0.0, terrestrial);
  // the equinox of J2000 is 0.02" from the axes of the ICRS, which do as well here
  Mat3 celestial;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) celestial(i, k) = terrestrial[k][i];
  return celestial;
}

Vec3 igrf_dipole(const Date& date) {
  const Date tt = converted(date, TimeScale::TT);
  constexpr double j2000_year = 2451544.5, days = 365.25;  // 2000-01-01T00
  const double year = 2000.0 + ((tt.day - j2000_year) + tt.fraction) / days;
  if (!(year >= igrf.front().year && year <= igrf.back().year))
    throw DomainError("igrf_dipole: the year " + polhode::detail::number_text(year) +
                      " must be from 1900 to 2030, which the IGRF-14 covers");
  const auto after = std::find_if(igrf.begin() + 1, igrf.end() - 1,
                                  [&](const DipoleEpoch& one) { return one.year > year; });
  const DipoleEpoch &a = *(after - 1), &b = *after;
  const double share = (year - a.year) / (b.year - a.year);
  const auto between = [&](double x, double y) { return x + share * (y - x); };
  return {between(a.g10, b.g10), between(a.g11, b.g11), between(a.h11, b.h11)};
}

}  // namespace ephemeris
}  // namespace v0
}  // namespace polhode
