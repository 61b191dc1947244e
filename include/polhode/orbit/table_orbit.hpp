// SPDX-License-Identifier: MIT
// TableOrbit: a path through tabulated positions, with velocities or without.
//
// Equations   between two rows the polynomial through the `order` rows around them (Lagrange), or
//             through order / 2 rows with their velocities (Hermite). In a window of nodes t_k,
//             with l_k = prod_{j != k} (t - t_j) / (t_k - t_j) and d_k = sum_{j != k} 1 / (t_k -
//             t_j): x = sum l_k x_k, or sum l_k^2 ((1 - 2 d_k (t - t_k)) x_k + (t - t_k) v_k).
// Units       any; velocities in those of the positions over that of the times.
// Domain      rising times, evenly spaced or not; order a multiple of 2 up to 16 (with velocities
//             of 4 up to 32), and as many rows as it needs; left out, 10 (with velocities 12) or
//             what the rows allow. At the ends the window stays inside, and an order above 12
//             falls to 12 as rows on one side run out, since polynomials of high order magnify
//             rounding there. If spacings vary by a factor of 30 or more, the highest orders
//             lose accuracy everywhere: with spacings from 0.003 to 0.3 rad of an orbit of e = 0.3,
//             the error is 2e-9 by order 12 and 1e-2 by order 32. NaN for times outside the table,
//             or farther outside than an overhang, up to which the polynomials at the ends go on:
//             for ends that times read from dates miss by their rounding.
// Accuracy    budget table_orbit_*: exact for polynomials of degree order - 1; otherwise an error
//             of order spacing^order. Positions are continuous, and with velocities their slope
//             is. In double-double the arithmetic is wide; the rows and weights are not.
// Errors      DomainError for times that do not rise, values that are not finite, too few rows, an
//             overhang that is negative or longer than the spacing.
// Cost        some 40 ns at the default order where rows are evenly spaced (to the rounding of
//             times); otherwise a binary search more: 130 ns with 4000 rows. Where times jump about
//             in a table larger than the caches, what memory takes besides (benchmarks/orbit.cpp).
//             Copies share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "polhode/orbit/orbit.hpp"

namespace polhode {
inline namespace v0 {

// The rows of a table of positions; `velocities` may be empty.
struct PositionTable {
  std::vector<double> times;
  std::vector<Vec3> positions;
  std::vector<Vec3> velocities = {};

  bool operator==(const PositionTable&) const = default;
};

class TableOrbit {
 public:
  // order 0: the default. The overhang is a time.
  explicit TableOrbit(PositionTable table, int order = 0, double overhang = 0.0);

  const PositionTable& table() const { return data_->table; }
  bool has_velocities() const { return !data_->table.velocities.empty(); }
  int order() const { return static_cast<int>(data_->nodes) * (has_velocities() ? 2 : 1); }
  bool is_evenly_spaced() const { return data_->even; }
  double first_time() const { return data_->table.times.front(); }
  double last_time() const { return data_->table.times.back(); }
  double overhang() const { return data_->overhang; }
  // From the largest angle about the centre between two rows; infinite where nothing turns.
  double time_scale() const;
  // Of the same rows and order, and so of the same positions, whatever their overhangs.
  bool operator==(const TableOrbit& other) const {
    return order() == other.order() && table() == other.table();
  }
  bool shares_with(const TableOrbit& other) const { return data_ == other.data_; }
  // From a to b, in either order, without a NaN.
  bool covers(double a, double b) const { return is_inside(a) && is_inside(b); }

  // At t + rest: any Real, and a Dual of a Real.
  Vec3 position(double t, double rest = 0.0) const { return interpolated(t, rest); }
  BasicVec3<DoubleDouble> position(const DoubleDouble& t) const {
    return interpolated(t, DoubleDouble());
  }
  template <Real T, int N>
  BasicVec3<Dual<T, N>> position(const Dual<T, N>& t) const {
    return chained(t, position(t.value), velocity(t.value));
  }
  // The derivative of the position.
  template <Real T>
  BasicVec3<T> velocity(const T& t) const {
    using D = Dual<T, 1>;
    if (!is_inside(to_double(t))) return nowhere<T>();
    const BasicVec3<D> x = interpolated(D::variable(t, 0), D());
    return {x.x.derivative[0], x.y.derivative[0], x.z.derivative[0]};
  }

 private:
  static constexpr std::size_t most_nodes = 16;

  struct Weights {
    double product;  // prod 1 / (t_k - t_j), times in mean spacings
    double slope;    // -2 sum 1 / (t_k - t_j); 0 without velocities
  };
  struct Data {
    PositionTable table;
    std::size_t nodes;      // of a polynomial, away from the ends
    std::size_t end_nodes;  // at the ends
    bool even;
    double spacing;  // mean
    double rate;     // 1 / spacing
    double overhang;
    std::vector<double> places;  // of the times, in spacings from the first; empty where even
    // `nodes` for each interval of rows; where even, for each number of nodes
    std::vector<Weights> weights;
  };

  template <Real T>
  static BasicVec3<T> nowhere() {
    const T nan(std::numeric_limits<double>::quiet_NaN());
    return {nan, nan, nan};
  }
  bool is_inside(double t) const {
    return t >= first_time() - overhang() && t <= last_time() + overhang();
  }
  // The rows that a polynomial goes through.
  struct Window {
    std::size_t first, count;
  };
  Window window(std::size_t row) const {
    const Data& d = *data_;
    const std::size_t rows = d.table.times.size();
    const std::size_t inside = 2 * std::min(row + 1, rows - 1 - row);
    const std::size_t count = std::clamp(inside, d.end_nodes, d.nodes), half = count / 2 - 1;
    return {std::min(row > half ? row - half : 0, rows - count), count};
  }
  // Where its weights are.
  std::size_t weights_at(std::size_t row, const Window& window) const {
    return data_->nodes * (data_->even ? (window.count - data_->end_nodes) / 2 : row);
  }
  std::size_t row_before(double u) const;
  void weigh(std::size_t at, const Window& window, std::span<const double> places);

  template <Real T>
  BasicVec3<T> interpolated(const T& t, const T& rest) const;

  std::shared_ptr<Data> data_;
};

// About the largest error of the polynomials between rows (half-way, and where the spacing varies
// at 0.3 as well), as a fraction of the distance from the centre, or absolute: the difference from
// those through two rows less, carried on by how much smaller it is than the one before; at the two
// lowest orders, that from those of two more rows. Of two or three rows with velocities: from how
// much the velocities change, and how far they lead past the next position. NaN for two or three
// rows without velocities. Looks at every interval: 0.1 to 1 s for a million rows.
enum class ErrorSize { relative, absolute };
double interpolation_error(const TableOrbit& orbit, ErrorSize size = ErrorSize::relative);

template <Real T>
BasicVec3<T> TableOrbit::interpolated(const T& t, const T& rest) const {
  const Data& d = *data_;
  if (!is_inside(to_double(t))) return nowhere<T>();
  const T u = ((t - T(first_time())) + rest) * T(d.rate);
  const std::size_t row = row_before(to_double(u));
  const Window around = window(row);
  const std::size_t n = around.count, first = around.first;
  const Weights* const w = d.weights.data() + weights_at(row, around);
  // from node to time, and its products from either side: nothing is divided, so nothing is
  // singular at a node
  std::array<T, most_nodes> s, before;
  T product(1.0);
  for (std::size_t k = 0; k < n; ++k) {
    s[k] = u - T(d.even ? static_cast<double>(first + k) : d.places[first + k]);
    before[k] = product;
    product = product * s[k];
  }
  // Differences from one row: the sum of all l_k is 1, and rounding acts on differences alone.
  const Vec3& base = d.table.positions[row];
  BasicVec3<T> sum{};
  product = T(1.0);
  for (std::size_t k = n; k-- > 0;) {
    const T l = before[k] * product * T(w[k].product);
    product = product * s[k];
    const Vec3 x = d.table.positions[first + k] - base;
    if (!has_velocities()) {
      sum = sum + BasicVec3<T>{l * T(x.x), l * T(x.y), l * T(x.z)};
      continue;
    }
    const Vec3& v = d.table.velocities[first + k];
    const T square = l * l, a = square * (T(1.0) + T(w[k].slope) * s[k]);
    const T b = square * s[k] * T(d.spacing);
    sum = sum +
          BasicVec3<T>{a * T(x.x) + b * T(v.x), a * T(x.y) + b * T(v.y), a * T(x.z) + b * T(v.z)};
  }
  return {T(base.x) + sum.x, T(base.y) + sum.y, T(base.z) + sum.z};
}

}  // namespace v0
}  // namespace polhode
