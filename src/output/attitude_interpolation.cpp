// SPDX-License-Identifier: MIT
// The error of attitudes that a reader interpolates between the rows of a file.
#include "output/detail/attitude_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

using Row = InterpolationError::Row;

constexpr std::size_t most_nodes = 8;
using Nodes = std::array<double, most_nodes>;

// Newton's divided differences: a node with a slope stands twice.
double polynomial(std::size_t count, const Nodes& t, Nodes x, const Nodes& slope, double at) {
  Nodes top{x[0]};
  for (std::size_t order = 1; order < count; ++order) {
    for (std::size_t i = 0; i + order < count; ++i) {
      const double step = t.at(i + order) - t.at(i);
      x.at(i) = step == 0.0 ? slope.at(i) : (x.at(i + 1) - x.at(i)) / step;
    }
    top.at(order) = x[0];
  }
  double value = top.at(count - 1);
  for (std::size_t order = count - 1; order-- > 0;)
    value = value * (at - t.at(order)) + top.at(order);
  return value;
}

double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = conj(a) * b;
  return 2.0 * std::atan2(std::hypot(d.x, d.y, d.z), std::fabs(d.w));
}

bool has_slopes(const Interpolation& of) { return of.method == "HERMITE"; }
bool has_angles(const Interpolation& of) { return of.method == "LINEAR"; }

}  // namespace

int Interpolation::degree_of(std::int64_t rows_written) const {
  const std::int64_t values = has_slopes(*this) ? 2 * rows_written : rows_written;
  return static_cast<int>(std::clamp<std::int64_t>(values - 1, 1, degree));
}

// Of the row in the middle of 2 `nodes` - 1 rows, from those at even places.
double InterpolationError::of_middle(std::size_t first, std::size_t nodes) const {
  const bool slopes = has_slopes(interpolation_);
  const bool angles = has_angles(interpolation_);
  const Row& middle = rows_[first + nodes - 1];
  std::array<double, 4> value{};
  for (std::size_t c = 0; c < (angles ? 3U : 4U); ++c) {
    Nodes t{}, x{}, slope{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < nodes; ++k) {
      const Row& node = rows_[first + 2 * k];
      const double jump =
          angles ? 360.0 * std::round((node.x.at(c) - middle.x.at(c)) / 360.0) : 0.0;
      for (int twice = 0; twice < (slopes ? 2 : 1); ++twice) {
        t.at(count) = node.t;
        x.at(count) = node.x.at(c) - jump;
        slope.at(count++) = node.slope.at(c);
      }
    }
    value.at(c) = polynomial(count, t, x, slope, middle.t);
  }
  if (!angles) return angle_between({value[0], value[1], value[2], value[3]}, middle.q);
  constexpr double degree = std::numbers::pi / 180.0;
  return angle_between(
      attitude(EulerAngles{degree * value[0], degree * value[1], degree * value[2]}), middle.q);
}

double InterpolationError::at_spacing(double found, std::size_t nodes) const {
  constexpr double resolved = 0.3;  // rad
  if (!(found < resolved)) return found;
  const int degree =
      static_cast<int>(nodes) * (interpolation_.degree + 1) / static_cast<int>(interpolation_.rows);
  // rows that hardly resolve the rotation gain less by half the spacing
  const int margin = degree > 2 ? 2 : 0;
  return interpolation_.ends * std::ldexp(found, margin - degree);
}

double InterpolationError::of_turn(std::int64_t rows_written) const {
  constexpr double half_turn = std::numbers::pi * (1.0 - 1e-9);  // for the rounding of the rates
  if (has_angles(interpolation_)) {
    if (turn_ >= half_turn) return std::numbers::pi;
    // two rows show no curvature: that of a free body is at most |omega|^2
    return rows_written == 2 ? turn_ * turn_ / 8.0 : 0.0;
  }
  const int values = interpolation_.degree_of(rows_written) + 1;
  double error = 2.0;
  for (int k = 0; k < values; ++k) {
    const int node = has_slopes(interpolation_) ? k / 2 : k;
    error *= 0.5 * turn_ * std::fabs(node - 0.5) / (k + 1);
  }
  return std::min(error, std::numbers::pi);
}

void InterpolationError::add(const Row& row) {
  if (!rows_.empty())
    turn_ = std::max(turn_, std::max(rows_.back().rate, row.rate) * (row.t - rows_.back().t));
  rows_.push_back(row);
  if (rows_.size() < span_) return;
  is_full_ = true;
  largest_ = std::max(largest_, at_spacing(of_middle(0, interpolation_.rows), interpolation_.rows));
  // the next windows show hardly another error
  for (std::size_t k = 0; k < interpolation_.rows / 2; ++k) rows_.pop_front();
}

double InterpolationError::estimate(std::int64_t rows_written) const {
  double largest = std::max(largest_, of_turn(rows_written));
  const std::size_t nodes = (rows_.size() + 1) / 4 * 2;  // even, of fewer rows
  if (is_full_ || nodes == 0) return largest;
  for (std::size_t first = 0; first + 2 * nodes - 1 <= rows_.size(); ++first)
    largest = std::max(largest, at_spacing(of_middle(first, nodes), nodes));
  return largest;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
