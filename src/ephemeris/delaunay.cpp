// SPDX-License-Identifier: MIT
#include "ephemeris/delaunay.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <span>

#include "orbit/mean_ellipse.hpp"
#include "polhode/ephemeris/ephemeris.hpp"

namespace polhode {
inline namespace v0 {
namespace ephemeris {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double au_km = 149597870.7;  // IAU 2012

// Multipliers of D, l', l, F; the coefficient of a sine in 1e-6 deg, that of a cosine in m.
struct LunarTerm {
  int D, lp, l, F;
  double sine, cosine;
};
// Meeus (1998), table 47.A: longitude and distance.
constexpr std::array<LunarTerm, 60> longitude_and_distance = {{
    {0, 0, 1, 0, 6288774, -20905355},
    {2, 0, -1, 0, 1274027, -3699111},
    {2, 0, 0, 0, 658314, -2955968},
    {0, 0, 2, 0, 213618, -569925},
    {0, 1, 0, 0, -185116, 48888},
    {0, 0, 0, 2, -114332, -3149},
    {2, 0, -2, 0, 58793, 246158},
    {2, -1, -1, 0, 57066, -152138},
    {2, 0, 1, 0, 53322, -170733},
    {2, -1, 0, 0, 45758, -204586},
    {0, 1, -1, 0, -40923, -129620},
    {1, 0, 0, 0, -34720, 108743},
    {0, 1, 1, 0, -30383, 104755},
    {2, 0, 0, -2, 15327, 10321},
    {0, 0, 1, 2, -12528, 0},
    {0, 0, 1, -2, 10980, 79661},
    {4, 0, -1, 0, 10675, -34782},
    {0, 0, 3, 0, 10034, -23210},
    {4, 0, -2, 0, 8548, -21636},
    {2, 1, -1, 0, -7888, 24208},
    {2, 1, 0, 0, -6766, 30824},
    {1, 0, -1, 0, -5163, -8379},
    {1, 1, 0, 0, 4987, -16675},
    {2, -1, 1, 0, 4036, -12831},
    {2, 0, 2, 0, 3994, -10445},
    {4, 0, 0, 0, 3861, -11650},
    {2, 0, -3, 0, 3665, 14403},
    {0, 1, -2, 0, -2689, -7003},
    {2, 0, -1, 2, -2602, 0},
    {2, -1, -2, 0, 2390, 10056},
    {1, 0, 1, 0, -2348, 6322},
    {2, -2, 0, 0, 2236, -9884},
    {0, 1, 2, 0, -2120, 5751},
    {0, 2, 0, 0, -2069, 0},
    {2, -2, -1, 0, 2048, -4950},
    {2, 0, 1, -2, -1773, 4130},
    {2, 0, 0, 2, -1595, 0},
    {4, -1, -1, 0, 1215, -3958},
    {0, 0, 2, 2, -1110, 0},
    {3, 0, -1, 0, -892, 3258},
    {2, 1, 1, 0, -810, 2616},
    {4, -1, -2, 0, 759, -1897},
    {0, 2, -1, 0, -713, -2117},
    {2, 2, -1, 0, -700, 2354},
    {2, 1, -2, 0, 691, 0},
    {2, -1, 0, -2, 596, 0},
    {4, 0, 1, 0, 549, -1423},
    {0, 0, 4, 0, 537, -1117},
    {4, -1, 0, 0, 520, -1571},
    {1, 0, -2, 0, -487, -1739},
    {2, 1, 0, -2, -399, 0},
    {0, 0, 2, -2, -381, -4421},
    {1, 1, 1, 0, 351, 0},
    {3, 0, -2, 0, -340, 0},
    {4, 0, -3, 0, 330, 0},
    {2, -1, 2, 0, 327, 0},
    {0, 2, 1, 0, -323, 1165},
    {1, 1, -1, 0, 299, 0},
    {2, 0, 3, 0, 294, 0},
    {2, 0, -1, -2, 0, 8752},
}};
// Meeus (1998), table 47.B: latitude.
constexpr std::array<LunarTerm, 60> latitude = {{
    {0, 0, 0, 1, 5128122, 0}, {0, 0, 1, 1, 280602, 0},  {0, 0, 1, -1, 277693, 0},
    {2, 0, 0, -1, 173237, 0}, {2, 0, -1, 1, 55413, 0},  {2, 0, -1, -1, 46271, 0},
    {2, 0, 0, 1, 32573, 0},   {0, 0, 2, 1, 17198, 0},   {2, 0, 1, -1, 9266, 0},
    {0, 0, 2, -1, 8822, 0},   {2, -1, 0, -1, 8216, 0},  {2, 0, -2, -1, 4324, 0},
    {2, 0, 1, 1, 4200, 0},    {2, 1, 0, -1, -3359, 0},  {2, -1, -1, 1, 2463, 0},
    {2, -1, 0, 1, 2211, 0},   {2, -1, -1, -1, 2065, 0}, {0, 1, -1, -1, -1870, 0},
    {4, 0, -1, -1, 1828, 0},  {0, 1, 0, 1, -1794, 0},   {0, 0, 0, 3, -1749, 0},
    {0, 1, -1, 1, -1565, 0},  {1, 0, 0, 1, -1491, 0},   {0, 1, 1, 1, -1475, 0},
    {0, 1, 1, -1, -1410, 0},  {0, 1, 0, -1, -1344, 0},  {1, 0, 0, -1, -1335, 0},
    {0, 0, 3, 1, 1107, 0},    {4, 0, 0, -1, 1021, 0},   {4, 0, -1, 1, 833, 0},
    {0, 0, 1, -3, 777, 0},    {4, 0, -2, 1, 671, 0},    {2, 0, 0, -3, 607, 0},
    {2, 0, 2, -1, 596, 0},    {2, -1, 1, -1, 491, 0},   {2, 0, -2, 1, -451, 0},
    {0, 0, 3, -1, 439, 0},    {2, 0, 2, 1, 422, 0},     {2, 0, -3, -1, 421, 0},
    {2, 1, -1, 1, -366, 0},   {2, 1, 0, 1, -351, 0},    {4, 0, 0, 1, 331, 0},
    {2, -1, 1, 1, 315, 0},    {2, -2, 0, -1, 302, 0},   {0, 0, 1, 3, -283, 0},
    {2, 1, 1, -1, -229, 0},   {1, 1, 0, -1, 223, 0},    {1, 1, 0, 1, 223, 0},
    {0, 1, -2, -1, -220, 0},  {2, 1, -1, -1, -220, 0},  {1, 0, 1, 1, -185, 0},
    {2, -1, -2, -1, 181, 0},  {0, 1, 2, 1, -177, 0},    {4, 0, -2, -1, 176, 0},
    {4, -1, -1, -1, 166, 0},  {1, 0, 1, -1, -164, 0},   {4, 0, 1, -1, 132, 0},
    {1, 0, -1, -1, -119, 0},  {4, -1, 0, -1, 115, 0},   {2, -2, 0, 1, 107, 0},
}};

// Powers of T in degrees: Chapront-Touze & Chapront (1988) in the form of Meeus (1998), with the
// mean longitude of Simon et al. (1994).
using Polynomial = std::array<double, 5>;
constexpr Polynomial moon_longitude = {218.31665436, 481267.88123421, -0.0015786, 1.0 / 538841.0,
                                       -1.0 / 65194000.0};
constexpr Polynomial moon_elongation = {297.8501921, 445267.1114034, -0.0018819, 1.0 / 545868.0,
                                        -1.0 / 113065000.0};
constexpr Polynomial sun_anomaly = {357.5291092, 35999.0502909, -0.0001536, 1.0 / 24490000.0, 0.0};
constexpr Polynomial moon_anomaly = {134.9633964, 477198.8675055, 0.0087414, 1.0 / 69699.0,
                                     -1.0 / 14712000.0};
constexpr Polynomial moon_latitude = {93.2720950, 483202.0175233, -0.0036539, 1.0 / 3526000.0,
                                      1.0 / 863310000.0};

double value(const Polynomial& p, double T) {
  return degree * (p[0] + T * (p[1] + T * (p[2] + T * (p[3] + T * p[4]))));
}
double slope(const Polynomial& p, double T) {
  return degree * (p[1] + T * (2.0 * p[2] + T * (3.0 * p[3] + T * 4.0 * p[4])));
}

// exp(i n angle) for n from -4 to 4.
struct Multiples {
  std::array<std::complex<double>, 9> of;
  explicit Multiples(double angle) {
    of[4] = 1.0;
    const std::complex<double> one(std::cos(angle), std::sin(angle));
    for (std::size_t n = 1; n <= 4; ++n) {
      of[4 + n] = of[3 + n] * one;
      of[4 - n] = std::conj(of[4 + n]);
    }
  }
  const std::complex<double>& operator()(int n) const { return *(of.begin() + 4 + n); }
};

// The sums of sines and of cosines.
std::complex<double> sum(std::span<const LunarTerm> terms, const DelaunayArguments& a, double T) {
  const Multiples D(a.D), lp(a.lp), l(a.l), F(a.F);
  // The eccentricity of the orbit of the Earth falls: terms with l' were made for that of T = 0.
  const double E = 1.0 - T * (0.002516 + T * 0.0000074);
  const std::array<double, 3> powers = {1.0, E, E * E};
  std::complex<double> total = 0.0;
  for (const LunarTerm& term : terms) {
    const std::complex<double> wave = D(term.D) * lp(term.lp) * l(term.l) * F(term.F);
    const double E_n = powers.at(static_cast<std::size_t>(std::abs(term.lp)));
    total += E_n * std::complex<double>(term.cosine * wave.real(), term.sine * wave.imag());
  }
  return total;
}

}  // namespace

DelaunayArguments delaunay_arguments(double T) {
  const double F = value(moon_latitude, T);
  return {value(moon_anomaly, T), value(sun_anomaly, T), F, value(moon_elongation, T),
          value(moon_longitude, T) - F};
}

DelaunayArguments delaunay_rates(double T) {
  const double F = slope(moon_latitude, T);
  return {slope(moon_anomaly, T), slope(sun_anomaly, T), F, slope(moon_elongation, T),
          slope(moon_longitude, T) - F};
}

EclipticPosition moon_of_date(const DelaunayArguments& a, double T) {
  const double mean = a.F + a.Om;
  const std::complex<double> main = sum(longitude_and_distance, a, T);
  const double flattening_l = 1962.0 * std::sin(a.Om);
  const double flattening_b =
      -2235.0 * std::sin(mean) + 127.0 * std::sin(mean - a.l) - 115.0 * std::sin(mean + a.l);
  return {mean + 1e-6 * degree * (main.imag() + flattening_l),
          1e-6 * degree * (sum(latitude, a, T).imag() + flattening_b),
          1e-3 * (385000560.0 + main.real())};
}

Vec3 sun_of_date(const DelaunayArguments& a, double T) {
  const double e = 0.016708634 - T * (0.000042037 + T * 0.0000001267);
  const double mean_longitude = a.F - a.D + a.Om;
  // The centre of the Earth is off that of Earth and Moon.
  const double earth = planetary_gm(Planetary::earth), moon = planetary_gm(Planetary::moon);
  return on_ellipse(1.000001018 * au_km, e, a.lp, mean_longitude - a.lp) +
         (moon / (earth + moon)) * cartesian(moon_of_date(a, T));
}

Vec3 cartesian(const EclipticPosition& p) {
  const double rho = p.distance * std::cos(p.latitude);
  return {rho * std::cos(p.longitude), rho * std::sin(p.longitude),
          p.distance * std::sin(p.latitude)};
}

}  // namespace ephemeris
}  // namespace v0
}  // namespace polhode
