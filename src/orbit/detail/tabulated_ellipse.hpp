// SPDX-License-Identifier: MIT
// Positions on an ellipse as polynomials of the phase: no equation is solved, nothing divided.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "orbit/detail/turn_counter.hpp"
#include "polhode/orbit/kepler_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// x and y are analytic in M up to acosh(1/e) - sqrt(1 - e^2) from the real axis: a turn in 128
// (e <= 0.2), 256 (0.36) or 512 (0.5) intervals, each with two polynomials of degree 7 about its
// middle, leaves less than a tenth of a rounding. The leading coefficient, with a rest, is added
// last, so that x and y are rounded about once.
class TabulatedEllipse {
 public:
  static constexpr double largest_eccentricity = 0.5;
  static bool serves(const PlanarKepler::Shape& shape);
  explicit TabulatedEllipse(const PlanarKepler::Shape& shape);

  bool holds(double t, double rest) const {
    return turns_.counts(t) && std::abs(rest * rate_) < 0.25;
  }
  // Precondition: holds(t, rest).
  BasicPlanarPoint<double> at(double t, double rest) const {
    const std::uint64_t phase = turns_.phase(t);
    const Row& c = rows_[phase >> row_shift_];
    // The bits of the phase below those of the row, in [1, 2).
    const double fraction =
        std::bit_cast<double>(phase << row_bits_ >> 12 | std::bit_cast<std::uint64_t>(1.0));
    const double middle = rest * rate_ - 1.5;
    const Pair u = Pair{fraction, fraction} + Pair{middle, middle}, u2 = u * u;
    // Estrin: the chain counts, not the operations.
    const Pair low = (c[1] + c[2] * u) + (c[3] + c[4] * u) * u2;
    const Pair high = (c[5] + c[6] * u) + (c[7] + c[8] * u) * u2;
    const Pair at = c[0] + (low + high * (u2 * u2));
    return {at[0], at[1]};
  }

 private:
  static constexpr std::size_t size = 9;  // value, its rest, and seven powers of u in [-1/2, 1/2]
  using Pair [[gnu::vector_size(16)]] = double;  // x and y, for two chains at the price of one
  using Row = std::array<Pair, size>;
  // About the middle of interval `j`.
  Row row(const PlanarKepler::Shape& shape, std::size_t j) const;

  TurnCounter turns_;
  double rate_;  // intervals per time
  int row_bits_, row_shift_;
  std::vector<Row> rows_;
};

}  // namespace detail

// PlanarKepler::point, for callers that want it inline.
inline BasicPlanarPoint<double> PlanarKepler::point(double t, double rest) const {
  if (table_ && table_->holds(t, rest)) [[likely]]
    return table_->at(t, rest);
  return solved_point(t, rest);
}

}  // namespace v0
}  // namespace polhode
