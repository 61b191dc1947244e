// SPDX-License-Identifier: MIT
#include "polhode/secular/history_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/kepler_equation.hpp"
#include "polhode/orbit/kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace {

double required(double x, bool is_valid, const char* what, const char* requirement) {
  if (!is_valid || !std::isfinite(x))
    throw DomainError(std::string("HistoryOrbit: ") + what + " " + detail::number_text(x) +
                      " must be " + requirement);
  return x;
}

double motion(double gm, double a) {
  required(gm, gm > 0.0, "gm", "positive");
  required(a, a > 0.0, "semi-major axis", "positive");
  return std::sqrt(gm / a) / a;
}

// Of a quarter of a turn at the pericentre.
double quarter(const OrbitHistory& elements, double gm, double a) {
  const double t = std::clamp(0.0, elements.first_time(), elements.last_time());
  const double e = eccentricity(elements.at(t));
  return quarter_turn({.gm = gm, .pericentre = a * (1.0 - e), .eccentricity = e});
}

template <class T>
BasicVec3<T> placed(const BasicOrbitElements<T>& o, const SinCos<T>& longitude, double a) {
  using std::atan2, std::sqrt;
  const T e2 = o.k * o.k + o.h * o.h, e = sqrt(e2), one(1.0);
  // towards the pericentre; on a circle axis 1
  const T x = e > T(0.0) ? o.k / e : one, y = e > T(0.0) ? o.h / e : T(0.0);
  const T M = atan2(longitude.sin * x - longitude.cos * y, longitude.cos * x + longitude.sin * y);
  const auto E = eccentric_anomaly(M, BasicEccentricity<T>{e, one - e});
  const T along = (one - e) - E.versine, across = sqrt((one - e) * (one + e)) * E.sine;
  const BasicVec3<T> in_plane{T(a) * (along * x - across * y), T(a) * (along * y + across * x),
                              T(0.0)};
  return rotate(equinoctial_attitude(o), in_plane);
}

}  // namespace

HistoryOrbit::HistoryOrbit(OrbitHistory elements, double gm, double semi_major_axis,
                           double longitude)
    : elements_(std::move(elements)),
      gm_(gm),
      a_(semi_major_axis),
      angle_(required(longitude, true, "longitude", "finite"), motion(gm, semi_major_axis), 0.0),
      time_scale_(quarter(elements_, gm, semi_major_axis)) {}

Vec3 HistoryOrbit::position(double t) const { return placed(elements_.at(t), angle_.at(t), a_); }
BasicVec3<DoubleDouble> HistoryOrbit::position(const DoubleDouble& t) const {
  return placed(elements_.at(t), angle_.at(t), a_);
}

}  // namespace v0
}  // namespace polhode
