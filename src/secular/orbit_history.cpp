// SPDX-License-Identifier: MIT
// Histories of an orbit: rows of its elements, interpolated, and the orbit that follows them.
#include "polhode/secular/orbit_history.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

namespace {

[[noreturn]] void refuse_row(std::size_t row, const std::string& what) {
  throw DomainError("ElementTable: row " + std::to_string(row) + ": " + what);
}

constexpr std::size_t rows_beside = 4;

// The middle one of the intervals of `times` from `first` to `last`, at most rows_beside; 0 of
// none.
double usual_interval(std::span<const double> times, std::size_t first, std::size_t last) {
  std::array<double, rows_beside> intervals;
  intervals.fill(std::numeric_limits<double>::infinity());  // of those beyond, sorted to the end
  const std::size_t count = last - first;
  for (std::size_t k = 0; k < count; ++k) intervals[k] = times[first + k + 1] - times[first + k];
  std::sort(intervals.begin(), intervals.end());
  return count == 0 ? 0.0 : intervals[count / 2];
}

void require_rows(const std::vector<double>& times, std::span<const OrbitElements> rows) {
  if (times.size() != rows.size())
    throw DomainError("ElementTable: got " + std::to_string(times.size()) + " times and " +
                      std::to_string(rows.size()) + " rows; expected as many of each");
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const OrbitElements& o = rows[k];
    if (!std::isfinite(times[k]))
      refuse_row(k,
                 "got time " + polhode::detail::number_text(times[k]) + "; expected a finite one");
    if (k > 0 && !(times[k] > times[k - 1]))
      refuse_row(k, "got time " + polhode::detail::number_text(times[k]) + " after " +
                        polhode::detail::number_text(times[k - 1]) + "; expected rising times");
    if (!(eccentricity(o) < 1.0))
      refuse_row(k, "got eccentricity " + polhode::detail::number_text(eccentricity(o)) +
                        "; expected 0 to below 1");
    if (!(o.q * o.q + o.p * o.p < 1.0))
      refuse_row(k, "got q^2 + p^2 = " + polhode::detail::number_text(o.q * o.q + o.p * o.p) +
                        "; expected below 1, an inclination below 180 degrees");
  }
  if (const std::size_t row = row_after_gap(times))
    refuse_row(row, "a gap of " + polhode::detail::number_text(times[row] - times[row - 1]) +
                        " before this row; expected a table without gaps");
}

std::vector<Vec3> ellipses(std::span<const OrbitElements> rows) {
  std::vector<Vec3> of;
  of.reserve(rows.size());
  for (const OrbitElements& o : rows) of.push_back({o.k, o.h, 0.0});
  return of;
}
std::vector<Vec3> planes(std::span<const OrbitElements> rows) {
  std::vector<Vec3> of;
  of.reserve(rows.size());
  for (const OrbitElements& o : rows) {
    const OrbitPlane plane = orbit_plane(o);
    of.push_back({plane.q, plane.p, plane.e2});
  }
  return of;
}

}  // namespace

std::size_t row_after_gap(std::span<const double> times) {
  constexpr double widest = 3.0;
  for (std::size_t row = 1; row < times.size(); ++row) {
    const std::size_t first = row > rows_beside ? row - 1 - rows_beside : 0,
                      last = std::min(times.size() - 1, row + rows_beside);
    const double before = usual_interval(times, first, row - 1),
                 after = usual_interval(times, row, last);
    const double usual = before > after ? before : after;
    if (usual > 0.0 && times[row] - times[row - 1] > widest * usual) return row;
  }
  return 0;
}

OrbitElements orbit_elements(double eccentricity, double inclination, double node,
                             double argument) {
  if (!(eccentricity >= 0.0 && eccentricity < 1.0))
    throw DomainError("orbit_elements: got eccentricity " +
                      polhode::detail::number_text(eccentricity) + "; expected 0 to below 1");
  if (!(inclination >= 0.0 && inclination < pi<double>()))
    throw DomainError("orbit_elements: got inclination " +
                      polhode::detail::number_text(inclination) +
                      "; expected 0 to below pi, in rad");
  if (!std::isfinite(node) || !std::isfinite(argument))
    throw DomainError("orbit_elements: got node " + polhode::detail::number_text(node) +
                      " and argument " + polhode::detail::number_text(argument) +
                      "; expected finite angles");
  const double varpi = node + argument, s = std::sin(0.5 * inclination);
  return {eccentricity * std::cos(varpi), eccentricity * std::sin(varpi), s * std::cos(node),
          s * std::sin(node)};
}

OrbitElements orbit_elements(const Vec3& normal, const Vec3& pericentre) {
  if (!(std::fabs(norm(normal) - 1.0) < 1e-9) || !(normal.z > -1.0))
    throw DomainError("orbit_elements: got a normal that is no unit vector, or opposite to axis 3");
  const double c = std::sqrt(2.0 * (1.0 + normal.z));
  OrbitElements o{0.0, 0.0, -normal.y / c, normal.x / c};
  const Vec3 e = rotate(conj(equinoctial_attitude(o)), pericentre);
  o.k = e.x;
  o.h = e.y;
  return o;
}

OrbitElements turned(const OrbitElements& o, const Quaternion& q) {
  return orbit_elements(rotate(q, orbit_normal(o)),
                        rotate(q * equinoctial_attitude(o), Vec3{o.k, o.h, 0.0}));
}

Vec3 orbit_normal(const OrbitPlane& o) {
  const double c = 2.0 * std::sqrt(1.0 - o.p * o.p - o.q * o.q);
  return {o.p * c, -o.q * c, 1.0 - 2.0 * (o.p * o.p + o.q * o.q)};
}

Vec3 pericentre_direction(const OrbitElements& o) {
  const double e = eccentricity(o), x = o.k / e, y = o.h / e;
  return rotate(equinoctial_attitude(o), Vec3{x, y, 0.0});
}

ElementTable::ElementTable(std::vector<double> times, std::span<const OrbitElements> rows,
                           int order)
    : ellipse_([&] {
        require_rows(times, rows);
        return TableOrbit({times, ellipses(rows)}, order);
      }()),
      plane_({std::move(times), planes(rows)}, order) {}

double ElementTable::interpolation_error() const {
  constexpr double least = 1e-6;  // a circle in the plane of reference has no size of its own
  double size = least, worst = 0.0;
  for (const TableOrbit* const part : {&ellipse_, &plane_}) {
    for (const Vec3& x : part->table().positions) size = std::fmax(size, norm(x));
    const double error = polhode::interpolation_error(*part, ErrorSize::absolute);
    if (!(error <= worst)) worst = error;
  }
  return worst / size;
}

ElementSeries::ElementSeries(std::vector<SeriesTerm> ellipse, std::vector<SeriesTerm> plane)
    : ellipse_(std::move(ellipse)), plane_(std::move(plane)) {
  for (const std::vector<SeriesTerm>* const terms : {&ellipse_, &plane_}) {
    double most = 0.0;
    for (const SeriesTerm& term : *terms) {
      if (!std::isfinite(term.frequency) || !std::isfinite(term.phase))
        throw DomainError("ElementSeries: got frequency " +
                          polhode::detail::number_text(term.frequency) + " and phase " +
                          polhode::detail::number_text(term.phase) + "; expected finite ones");
      most += std::abs(term.amplitude);
    }
    if (!(most < 1.0))
      throw DomainError("ElementSeries: got amplitudes that add up to " +
                        polhode::detail::number_text(most) +
                        "; expected below 1, so that each orbit is an ellipse");
  }
}

namespace {

double required(double x, bool is_valid, const char* what, const char* requirement) {
  if (!is_valid || !std::isfinite(x))
    throw DomainError(std::string("HistoryOrbit: ") + what + " " + polhode::detail::number_text(x) +
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

}  // namespace secular
}  // namespace v0
}  // namespace polhode
