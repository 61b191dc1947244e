// SPDX-License-Identifier: MIT
// In this header: orbit_elements, orbit_history, history_orbit, shipped_orbit.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/detail/orbit/uniform_angle.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/orbit/table_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

// The elements of a planet's orbit as they change over ages: plane and ellipse, without a
// singularity, from a table or a series.
//
// Equations   k = e cos(varpi), h = e sin(varpi), q = sin(i/2) cos(Omega), p = sin(i/2) sin(Omega).
//             The equinoctial axes of the orbit are those that the shortest turn brings from the
//             reference axes: its quaternion is (sqrt(1 - p^2 - q^2), q, p, 0); axis 3 is the
//             normal n, and axis 1 the origin of the longitude varpi = Omega + omega.
//             A table is interpolated as TableOrbit is. A series is k + i h = sum A exp(i(nu t +
//             phi)), and so q + i p (Laskar 1988).
// Units       any time; rad.
// Domain      0 <= e < 1, inclinations below 180 degrees; tables as TableOrbit takes them, NaN
//             outside. T = double, DoubleDouble or a Dual.
// Accuracy    of tables that of order-10 interpolation: budget secular_table.
// Errors      DomainError names the row of elements that are none, and times that do not rise.
// Cost        50 ns for the plane of a table, twice that for all; 10 ns for a term of a series.

template <class T>
struct BasicOrbitElements {
  T k, h, q, p;
};
using OrbitElements = BasicOrbitElements<double>;

// Of e, i, Omega and varpi - Omega.
OrbitElements orbit_elements(double eccentricity, double inclination, double node, double argument);

// What turns a spin axis: the plane and e^2, which is smooth where e is 0.
struct OrbitPlane {
  double q, p, e2;
};

inline OrbitPlane orbit_plane(const OrbitElements& o) { return {o.q, o.p, o.k * o.k + o.h * o.h}; }
inline double eccentricity(const OrbitElements& o) { return std::sqrt(o.k * o.k + o.h * o.h); }

// Of the orbit with this unit normal and this vector of length e towards the pericentre.
OrbitElements orbit_elements(const Vec3& normal, const Vec3& pericentre);
// Along other axes: q turns vectors from those of the elements to them.
OrbitElements turned(const OrbitElements& o, const Quaternion& q);

// From the equinoctial axes to those of reference.
template <class T>
BasicQuaternion<T> equinoctial_attitude(const BasicOrbitElements<T>& o) {
  using std::sqrt;
  return {sqrt(T(1.0) - o.p * o.p - o.q * o.q), o.q, o.p, T(0.0)};
}
// The normal, and the direction of the pericentre.
Vec3 orbit_normal(const OrbitPlane& o);
inline Vec3 orbit_normal(const OrbitElements& o) { return orbit_normal(OrbitPlane{o.q, o.p, 0.0}); }
Vec3 pericentre_direction(const OrbitElements& o);

// The first row of rising times that has a gap before it: an interval more than three times as long
// as is usual among the four before it, and among the four after. 0: there is none.
std::size_t row_after_gap(std::span<const double> times);

class ElementTable {
 public:
  // order as that of a TableOrbit without velocities.
  ElementTable(std::vector<double> times, std::span<const OrbitElements> rows, int order = 0);

  // The rows as they were given.
  const std::vector<double>& times() const { return plane_.table().times; }
  OrbitElements row(std::size_t k) const {
    const Vec3 &ellipse = ellipse_.table().positions.at(k), &plane = plane_.table().positions.at(k);
    return {ellipse.x, ellipse.y, plane.x, plane.y};
  }
  int order() const { return plane_.order(); }
  bool operator==(const ElementTable&) const = default;

  double first_time() const { return plane_.first_time(); }
  double last_time() const { return plane_.last_time(); }

  template <class T>
  BasicOrbitElements<T> at(const T& t) const {
    const auto ellipse = ellipse_.position(t), plane = plane_.position(t);
    return {ellipse.x, ellipse.y, plane.x, plane.y};
  }
  OrbitPlane plane(double t) const {
    const Vec3 of = plane_.position(t);
    return {of.x, of.y, of.z};
  }
  // About the largest error between rows, of the largest eccentricity or inclination: NaN for too
  // few rows to tell.
  double interpolation_error() const;

 private:
  TableOrbit ellipse_;
  TableOrbit plane_;  // and e^2
};

// A exp(i (nu t + phi)).
struct SeriesTerm {
  double frequency;
  double amplitude;
  double phase;

  bool operator==(const SeriesTerm&) const = default;
};

class ElementSeries {
 public:
  ElementSeries(std::vector<SeriesTerm> ellipse, std::vector<SeriesTerm> plane);

  const std::vector<SeriesTerm>& ellipse_terms() const { return ellipse_; }
  const std::vector<SeriesTerm>& plane_terms() const { return plane_; }
  bool operator==(const ElementSeries&) const = default;

  template <class T>
  BasicOrbitElements<T> at(const T& t) const {
    BasicOrbitElements<T> sum{T(0.0), T(0.0), T(0.0), T(0.0)};
    add(sum.k, sum.h, ellipse_, t);
    add(sum.q, sum.p, plane_, t);
    return sum;
  }
  OrbitPlane plane(double t) const { return orbit_plane(at(t)); }

 private:
  template <class T>
  static void add(T& x, T& y, const std::vector<SeriesTerm>& terms, const T& t) {
    using std::cos, std::sin;
    for (const SeriesTerm& term : terms) {
      const T angle = T(term.frequency) * t + T(term.phase);
      x = x + T(term.amplitude) * cos(angle);
      y = y + T(term.amplitude) * sin(angle);
    }
  }

  std::vector<SeriesTerm> ellipse_;
  std::vector<SeriesTerm> plane_;
};

// OrbitHistory: the elements of an orbit over ages, whatever they are made from.
//
// Equations   those of the table or the series.
// Units       those of the table or the series.
// Domain      that of the table; all times for a series.
// Accuracy    that of the table or the series.
// Cost        that of what it holds. Copies share.

class OrbitHistory {
 public:
  explicit OrbitHistory(ElementTable table) : of_(std::make_shared<const Of>(std::move(table))) {}
  explicit OrbitHistory(ElementSeries series)
      : of_(std::make_shared<const Of>(std::move(series))) {}

  template <class T>
  BasicOrbitElements<T> at(const T& t) const {
    return std::visit([&](const auto& of) { return of.at(t); }, *of_);
  }
  OrbitPlane plane(double t) const {
    return std::visit([&](const auto& of) { return of.plane(t); }, *of_);
  }
  // Where it begins and ends; infinite for a series.
  double first_time() const { return table() ? table()->first_time() : -no_end; }
  double last_time() const { return table() ? table()->last_time() : no_end; }
  // Null for a series.
  const ElementTable* table() const { return std::get_if<ElementTable>(of_.get()); }
  // Null for a table.
  const ElementSeries* series() const { return std::get_if<ElementSeries>(of_.get()); }

 private:
  using Of = std::variant<ElementTable, ElementSeries>;
  static constexpr double no_end = std::numeric_limits<double>::infinity();

  std::shared_ptr<const Of> of_;
};

// HistoryOrbit: where a planet is on an orbit that changes over ages, for what is not averaged over
// the year.
//
// Equations   k, h, q, p of the history at t; mean longitude = longitude + n t from axis 1 of the
//             equinoctial axes, n = sqrt(gm / a^3); Kepler's equation with e = |(k, h)|.
// Units       any time; lengths of a, gm in both.
// Domain      that of the history, NaN outside. a and n do not change, as in secular theory. T =
//             double or DoubleDouble.
// Accuracy    that of the history, and of n, which is rounded: after N turns 2 pi N roundings.
// Errors      DomainError for gm or a that is not positive, for a longitude that is not finite.
// Cost        0.3 us with a table of elements.

class HistoryOrbit {
 public:
  HistoryOrbit(OrbitHistory elements, double gm, double semi_major_axis, double longitude = 0.0);

  const OrbitHistory& elements() const { return elements_; }
  double gm() const { return gm_; }
  double semi_major_axis() const { return a_; }
  double longitude() const { return angle_.start(); }
  double mean_motion() const { return angle_.rate(); }
  // At the pericentre of t = 0, or of the time of the history next to it.
  double time_scale() const { return time_scale_; }

  Vec3 position(double t) const;
  BasicVec3<DoubleDouble> position(const DoubleDouble& t) const;

 private:
  OrbitHistory elements_;
  double gm_, a_;
  UniformAngle angle_;
  double time_scale_;
};

// The orbits of the Earth and Mars over 40 million years, which the library brings along.
//
// Equations   k, h, q, p as polhode/secular/orbit_history.hpp, every 1,000 years, from an
//             integration of the eight planets with REBOUND from the states of DE440 at J2000; the
//             Earth stands for the barycentre of Earth and Moon (tools/orbits/, data/orbits/).
//             What is faster than some 4,000 years is filtered out.
// Units       Julian years from J2000, rad; axes ecliptic-J2000.
// Domain      -20 to 20 million years; beyond some 50 the planets are chaotic anyway.
// Accuracy    the eccentricity of the Earth against La2004: budgets shipped_orbit_*.
// Errors      DomainError for a name that is not among shipped_orbit_names().
// Cost        3 ms; some 10 MB.

std::span<const std::string_view> shipped_orbit_names();
// `year` is what a Julian year is in the unit of time of the table.
ElementTable shipped_orbit(std::string_view name, double year = 1.0);

}  // namespace secular
}  // namespace v0
}  // namespace polhode
