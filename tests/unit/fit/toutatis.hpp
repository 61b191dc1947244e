// SPDX-License-Identifier: MIT
// Attitudes of (4179) Toutatis from radar images: Takahashi, Busch & Scheeres 2013, AJ 146:95,
// table 3 (3-1-3 Euler angles in deg, J2000 ecliptic to body, days from 1992-11-09T17:49:47 UTC;
// no leap second is counted), and their start and solution, table 2. Errors 15 deg to 2000, 20 deg
// from 2004 (their section 6).
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "polhode/fit/spin_fit.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode::test {

inline constexpr double degree = std::numbers::pi / 180.0;

struct SeenToutatis {
  double days;
  double alpha, beta, gamma;
  double sigma;
};

// day of the year's count from 1992-11-09, hour, minute
inline constexpr double days_at(int day, int hour, int minute) {
  return day + (hour * 3600.0 + minute * 60.0 - (17 * 3600.0 + 49 * 60.0 + 47.0)) / 86400.0;
}

inline const std::array<SeenToutatis, 17>& toutatis_1992() {
  static const std::array<SeenToutatis, 17> seen{{
      {days_at(23, 21, 40), 122.2, 86.5, 107.0, 15},
      {days_at(24, 19, 30), 86.3, 81.8, 24.5, 15},
      {days_at(25, 18, 10), 47.8, 60.7, 284.0, 15},
      {days_at(26, 18, 50), 14.6, 39.4, 207.1, 15},
      {days_at(27, 17, 30), 331.3, 23.7, 151.6, 15},
      {days_at(28, 17, 20), 222.5, 25.4, 143.9, 15},
      {days_at(29, 16, 40), 169.8, 45.5, 106.9, 15},
      {days_at(30, 17, 50), 137.3, 71.3, 22.3, 15},
      {days_at(31, 17, 20), 103.1, 85.2, 292.6, 15},
      {days_at(32, 9, 40), 77.0, 85.7, 225.5, 15},
      {days_at(33, 9, 20), 42.8, 70.2, 133.2, 15},
      {days_at(34, 8, 10), 13.7, 44.4, 51.9, 15},
      {days_at(35, 7, 50), 323.7, 14.0, 0.0, 15},
      {days_at(36, 7, 50), 193.2, 24.4, 21.4, 15},
      {days_at(37, 7, 10), 165.1, 46.4, 310.6, 15},
      {days_at(38, 6, 49), 130.6, 76.1, 234.9, 15},
      {days_at(39, 7, 9), 91.6, 81.6, 142.4, 15},
  }};
  return seen;
}

// From 1992-11-09: 1996-11-25 is day 1477, 2000-11-04 2917, 2004-10-07 4350, 2008-11-22 5857.
inline const std::array<SeenToutatis, 16>& toutatis_later() {
  static const std::array<SeenToutatis, 16> seen{{
      {days_at(1477, 19, 48), 130.5, 78.9, 143.2, 15},
      {days_at(1478, 17, 51), 94.2, 88.1, 57.7, 15},
      {days_at(1479, 17, 34), 60.4, 81.2, 320.9, 15},
      {days_at(1481, 15, 37), 349.3, 30.0, 168.0, 15},
      {days_at(1482, 15, 47), 250.3, 14.2, 166.9, 15},
      {days_at(1483, 14, 23), 180.4, 37.6, 139.3, 15},
      {days_at(1484, 13, 43), 146.7, 64.0, 64.9, 15},
      {days_at(1485, 12, 20), 116.7, 81.4, 340.4, 15},
      {days_at(2917, 17, 6), 110.0, 88.5, 30.0, 15},
      {days_at(2918, 18, 1), 70.6, 84.0, 281.0, 15},
      {days_at(4350, 13, 56), 79.9, 85.3, 365.2, 20},
      {days_at(4351, 14, 4), 44.9, 72.5, 263.1, 20},
      {days_at(4352, 13, 57), 12.8, 47.3, 181.4, 20},
      {days_at(4353, 13, 17), 327.7, 20.4, 124.1, 20},
      {days_at(5857, 10, 54), 119.5, 90.7, 92.0, 20},
      {days_at(5858, 10, 45), 86.2, 85.0, 0.3, 20},
  }};
  return seen;
}

inline Quaternion toutatis_attitude(double alpha, double beta, double gamma) {
  return attitude(EulerAngles{alpha * degree, beta * degree, gamma * degree});
}

inline fit::Snapshots toutatis_seen(double sigma_deg = 0.0) {
  fit::Snapshots seen;
  for (const SeenToutatis& s : toutatis_1992()) {
    const double sigma = sigma_deg > 0.0 ? sigma_deg : s.sigma;
    seen.attitudes.push_back(
        {s.days, toutatis_attitude(s.alpha, s.beta, s.gamma), fit::covariance_of(sigma * degree)});
  }
  return seen;
}

inline fit::SpinState toutatis_state(double alpha, double beta, double gamma, const Vec3& w_deg,
                                     double Ixx, double Iyy) {
  fit::SpinState s;
  s.q = toutatis_attitude(alpha, beta, gamma);
  s.w_F = degree * w_deg;
  s.inertia_F(0, 0) = Ixx;
  s.inertia_F(1, 1) = Iyy;
  return s;
}

// Table 2: the a priori state, and the published one.
inline fit::SpinState toutatis_start() {
  return toutatis_state(144.863, 65.467, 241.785, {14.514, 33.532, -98.713}, 3.091, 3.2178);
}
inline fit::SpinState toutatis_published() {
  fit::SpinState s =
      toutatis_state(145.498, 65.865, 241.524, {14.510, 33.529, -98.709}, 3.0836, 3.235);
  s.inertia_F(0, 1) = s.inertia_F(1, 0) = -7.1082e-4;
  s.inertia_F(1, 2) = s.inertia_F(2, 1) = 1.1707e-3;
  s.inertia_F(0, 2) = s.inertia_F(2, 0) = 1.3252e-3;
  return s;
}

}  // namespace polhode::test
