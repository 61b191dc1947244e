// SPDX-License-Identifier: MIT
// Orbits from outside: tables of positions, and AnyOrbit's error for an orbit without velocity.
#include "polhode/orbit/table_orbit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"

namespace polhode {
inline namespace v0 {

namespace {

constexpr std::size_t usual_nodes = 10;
constexpr std::size_t usual_nodes_with_velocities = 6;
// At the ends of a table: an order of 12, which magnifies rounding by less than 100 there.
constexpr std::size_t most_end_nodes = 12;
constexpr std::size_t most_end_nodes_with_velocities = 6;

[[noreturn]] void fail(const std::string& what) { throw DomainError("TableOrbit: " + what); }
[[noreturn]] void fail_at(std::size_t row, const std::string& what) {
  fail("row " + std::to_string(row) + ": " + what);
}

void require_rows(const PositionTable& table) {
  const std::vector<double>& t = table.times;
  if (table.positions.size() != t.size() ||
      (!table.velocities.empty() && table.velocities.size() != t.size()))
    fail("times, positions and velocities must be as many of each");
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (!std::isfinite(t[k])) fail_at(k, "time " + detail::number_text(t[k]) + " must be finite");
    if (k > 0 && !(t[k] > t[k - 1]))
      fail_at(k, "time " + detail::number_text(t[k]) + " must be after " +
                     detail::number_text(t[k - 1]));
    if (!detail::is_finite(table.positions[k]) ||
        (!table.velocities.empty() && !detail::is_finite(table.velocities[k])))
      fail_at(k, "position and velocity must be finite");
  }
}

// How many rows a polynomial goes through.
std::size_t nodes_of(const PositionTable& table, int order, std::size_t most) {
  const bool slopes = !table.velocities.empty();
  const int per_node = slopes ? 2 : 1;
  const std::size_t rows = table.times.size();
  if (order == 0) {
    const std::size_t least = slopes ? 2 : 4;
    if (rows < least)
      fail(std::to_string(rows) + " rows must be " + std::to_string(least) + " at least");
    return std::min(slopes ? usual_nodes_with_velocities : usual_nodes, rows - rows % 2);
  }
  const int largest = static_cast<int>(most) * per_node;
  if (order < 2 * per_node || order > largest || order % (2 * per_node) != 0)
    fail("order " + std::to_string(order) + " must be a multiple of " +
         std::to_string(2 * per_node) + " from " + std::to_string(2 * per_node) + " to " +
         std::to_string(largest));
  const auto nodes = static_cast<std::size_t>(order / per_node);
  if (rows < nodes)
    fail(std::to_string(rows) + " rows must be " + std::to_string(nodes) + " at least for order " +
         std::to_string(order));
  return nodes;
}

// Whether each time is where equal steps put it, to two roundings of the largest.
bool evenly_spaced(const std::vector<double>& t) {
  const double largest = std::max(std::fabs(t.front()), std::fabs(t.back()));
  const double rounding = 2.0 * largest * epsilon<double>();
  const double step = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  for (std::size_t k = 0; k < t.size(); ++k)
    if (std::fabs(t[k] - (t.front() + static_cast<double>(k) * step)) > rounding) return false;
  return rounding < 1e-3 * step;
}

}  // namespace

TableOrbit::TableOrbit(PositionTable table, int order, double overhang) {
  require_rows(table);
  const std::size_t nodes = nodes_of(table, order, most_nodes);
  const std::vector<double>& t = table.times;
  const double spacing = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  const bool even = evenly_spaced(t);
  const double first = t.front(), rate = 1.0 / spacing;
  if (!(rate > 0.0) || !std::isfinite(rate) || !std::isfinite(spacing))
    fail("times from " + detail::number_text(first) + " to " + detail::number_text(t.back()) +
         " must have a spacing that a double can hold");
  if (!(overhang >= 0.0 && overhang <= spacing))
    fail("overhang " + detail::number_text(overhang) + " must be from 0 to the mean spacing " +
         detail::number_text(spacing));
  std::vector<double> places;
  const bool slopes = !table.velocities.empty();
  const std::size_t end_nodes =
      std::min(nodes, slopes ? most_end_nodes_with_velocities : most_end_nodes);
  const std::size_t sets = even ? (nodes - end_nodes) / 2 + 1 : t.size() - 1;
  for (std::size_t k = 0; k < (even ? nodes : t.size()); ++k)
    places.push_back(even ? static_cast<double>(k) : (t[k] - first) * rate);
  data_ = std::make_shared<Data>(Data{std::move(table),
                                      nodes,
                                      end_nodes,
                                      even,
                                      spacing,
                                      rate,
                                      overhang,
                                      {},
                                      std::vector<Weights>(sets * nodes)});
  for (std::size_t i = 0; i < sets; ++i)
    weigh(i * nodes, even ? Window{0, end_nodes + 2 * i} : window(i), places);
  if (!even) data_->places = std::move(places);
}

void TableOrbit::weigh(std::size_t at, const Window& window, std::span<const double> places) {
  for (std::size_t k = 0; k < window.count; ++k) {
    double product = 1.0, sum = 0.0;
    for (std::size_t j = 0; j < window.count; ++j) {
      if (j == k) continue;
      const double apart = places[window.first + k] - places[window.first + j];
      product *= apart;
      sum += 1.0 / apart;
    }
    const double weight = 1.0 / product;
    if (!std::isfinite(weight) || weight == 0.0)
      fail("time " + detail::number_text(data_->table.times[window.first + k]) +
           " must not be that much nearer to its neighbours than others are");
    data_->weights[at + k] = {weight, has_velocities() ? -2.0 * sum : 0.0};
  }
}

double TableOrbit::time_scale() const {
  const std::vector<double>& t = data_->table.times;
  const std::vector<Vec3>& x = data_->table.positions;
  double rate = 0.0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double angle = std::atan2(norm(cross(x[k - 1], x[k])), dot(x[k - 1], x[k]));
    rate = std::max(rate, angle / (t[k] - t[k - 1]));
  }
  return rate > 0.0 ? 0.5 * std::numbers::pi / rate : std::numeric_limits<double>::infinity();
}

namespace {

double largest_distance(const PositionTable& table) {
  double largest = 0.0;
  for (const Vec3& x : table.positions) largest = std::fmax(largest, norm(x));
  return largest;
}

// An error is relative to this distance; passing through the centre must not make it infinite.
double size_at(const Vec3& x, double largest) { return std::fmax(norm(x), 1e-3 * largest); }

// The error of cubics through two or three rows with velocities. In a curve that turns by an angle
// a between rows, `bend` is a^2 / 8 of the size, `twist` a^3 / 12 and the error a^4 / 384. Two
// bounds are combined: after a whole revolution the velocities agree, and only the twist is left.
// The factors are 6 times those of a circle, since along ellipses and straight falls the fourth
// derivative is up to 14 times the square of the second.
double cubic_error(const TableOrbit& orbit, ErrorSize size) {
  const PositionTable& table = orbit.table();
  const std::vector<double>& t = table.times;
  const std::vector<Vec3>&x = table.positions, &v = table.velocities;
  const double distance = largest_distance(table);
  double largest = 0.0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double step = t[k] - t[k - 1];
    const double whole = size_at(orbit.position(t[k - 1] + 0.5 * step), distance);
    const double bend = 0.125 * step * norm(v[k] - v[k - 1]) / whole;
    const double twist = norm(x[k] - x[k - 1] - 0.5 * step * (v[k - 1] + v[k])) / whole;
    const double error =
        std::fmin(bend + twist, std::fmax(bend * bend, 0.4 * twist * std::cbrt(twist)));
    largest = std::fmax(largest, size == ErrorSize::relative ? error : error * whole);
  }
  return largest;
}

}  // namespace

double interpolation_error(const TableOrbit& orbit, ErrorSize size) {
  const PositionTable& table = orbit.table();
  const std::vector<double>& t = table.times;
  const int step = orbit.has_velocities() ? 4 : 2, per_row = step / 2;  // of two rows
  const int order = orbit.order(), above = order + step;
  // two orders below show how fast the error falls; of a low order, the one above how large it is
  const bool falls = order > 2 * step;
  const bool is_long = t.size() >= static_cast<std::size_t>(above / per_row);
  if (!falls && !is_long && order == step)
    return orbit.has_velocities() ? cubic_error(orbit, size)
                                  : std::numeric_limits<double>::quiet_NaN();
  const TableOrbit other(table, falls || !is_long ? order - step : above);
  const TableOrbit lowest(table, falls ? order - 2 * step : order);
  // orders above 12 fall to 12 at the ends
  const int end_order = std::min(order, static_cast<int>(most_end_nodes));
  const bool drops = order > end_order;
  const auto half = static_cast<std::size_t>(order / per_row / 2);  // of the rows of a polynomial
  const TableOrbit end_other = drops ? TableOrbit(table, end_order - step) : other;
  const TableOrbit end_lowest = drops ? TableOrbit(table, end_order - 2 * step) : lowest;
  const double distance = largest_distance(table);
  // half-way across a single gap the orders may agree by chance
  constexpr std::array<double, 2> places = {0.5, 0.3};
  const std::span<const double> looks(places.data(), orbit.is_evenly_spaced() ? 1 : 2);
  double largest = 0.0;
  for (std::size_t k = 1; k < t.size(); ++k) {  // each, since a single gap decides
    const bool at_end = drops && std::min(k, t.size() - k) < half;
    for (const double place : looks) {
      const double at = t[k - 1] + place * (t[k] - t[k - 1]);
      const Vec3 x = orbit.position(at), near = (at_end ? end_other : other).position(at);
      const double gap = norm(x - near);
      const double before = norm(near - (at_end ? end_lowest : lowest).position(at));
      // too short for either, of a curve whose error at the lowest order is `gap`
      const double squared = 6.0 * gap * (gap / size_at(x, distance));
      const double error = !falls && !is_long            ? std::fmin(gap, squared)
                           : falls && 4.0 * gap < before ? 4.0 * gap * (gap / before)
                                                         : gap;
      const double whole = size == ErrorSize::relative ? size_at(x, distance) : 1.0;
      if (error > largest * whole) largest = error / whole;
    }
  }
  return largest;
}

std::size_t TableOrbit::row_before(double u) const {
  const std::size_t last = data_->table.times.size() - 2;
  if (data_->even) return u > 0.0 ? std::min(static_cast<std::size_t>(u), last) : 0;
  const std::vector<double>& places = data_->places;
  const auto after = std::upper_bound(places.begin(), places.end(), u);
  const auto row =
      after == places.begin() ? 0 : static_cast<std::size_t>(after - places.begin()) - 1;
  return std::min(row, last);
}

namespace detail {

void orbit_without_velocity(const std::string& name) {
  throw DomainError("AnyOrbit: orbit \"" + name +
                    "\" has no velocity: write position(t) as a template on the number type");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
