// SPDX-License-Identifier: MIT
// The error of a step by collocation, by its rates in Legendre polynomials.
#pragma once

#include <array>
#include <cmath>

#include "dynamics/collocation/step_polynomial.hpp"
#include "math/larger.hpp"
#include "polhode/perturb/stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The effects of the terms of a System, u and then v, in Legendre polynomials; the last row is 0.
using DriveRows = std::array<StageRow, 7>;

// Of a step of h and s stages from y by `increment`, in the measure of a field.
template <class Field, class Values>
struct StepEstimate {
  const Field& field;
  std::size_t s;
  double h;
  const Values& y;
  const Values& increment;

  // Gauss' quadrature of a polynomial errs by its coefficient of degree 2 s. Those of an analytic
  // rate fall like powers, from the first to that of degree s - 1 and on.
  template <class Rows>
  double of_motion(const Rows& rates) const {
    Values last = zeros_like(y), largest = zeros_like(y);
    for (std::size_t n = 0; n < rates.size(); ++n) {
      last[n] = h * pair(rates[n], s - 1);
      largest[n] = h * (std::abs(rates[n][0]) + std::abs(rates[n][1]) + std::abs(rates[n][2]));
    }
    const double most = field.error_size(largest, y, increment);
    const double error = field.error_size(last, y, increment);
    const double n = static_cast<double>(s);
    return most == 0.0 ? error : most * std::pow(error / most, 2.0 * n / (n - 1.0));
  }
  // The effects by themselves, on the rotor that a state begins with: next to the free rotation the
  // last coefficients of a weak torque that no step resolves look like those of a motion that falls
  // fast. From the middle degrees to the last, and twice as far again, short of degree 2 s: so a
  // kink shows, whose coefficients hardly fall. Where kinks are many and small the first
  // coefficients fall fast all the same, and a tenth of the last is left: as measured on meshes of
  // 48 and 360 facets in sunlight.
  double of_effects(const DriveRows& drive, bool has_many_kinks) const {
    const double least = has_many_kinks ? 0.1 : 0.0;
    Values error = zeros_like(y);
    for (std::size_t n = 0; n < 6; ++n) {
      const double last = pair(drive[n], s - 1), middle = pair(drive[n], s / 2 - 1);
      const double fall = last < middle ? last / middle : 1.0;
      const double size = h * (last * larger(fall * fall, least));
      error[n < 3 ? 4 + n : n - 2] = n < 3 ? size : 0.5 * size;  // of g; of q, half a turn
    }
    return field.error_size(error, y, increment);
  }
  // What no stage sees: a jump or a kink between the outermost stages and the ends of the step, of
  // which they are `gap` apart. At the ends the effects are then not those of the polynomial.
  double of_ends(const DriveRows& drive, const std::array<double, 6>& first,
                 const std::array<double, 6>& last, double gap) const {
    constexpr double much = 16.0;  // times what an analytic effect leaves to further degrees
    Values error = zeros_like(y);
    for (std::size_t n = 0; n < 6; ++n) {
      double at_first = first[n], at_last = last[n];
      for (std::size_t m = 0; m < s; ++m) {
        at_first -= m % 2 == 0 ? drive[n][m] : -drive[n][m];
        at_last -= drive[n][m];
      }
      const double miss = larger(std::abs(at_first), std::abs(at_last));
      const double tail = larger(pair(drive[n], s - 1), pair(drive[n], s - 2));
      const double size = miss <= much * tail ? 0.0 : h * (gap * miss);
      error[n < 3 ? 4 + n : n - 2] = n < 3 ? size : 0.5 * size;
    }
    return field.error_size(error, y, increment);
  }
  // The same of rates of which nothing more is known. Coefficients that do not fall any more are
  // those of something that the step does not resolve, however little it is.
  template <class Rows>
  double of_tail(const Rows& rates) const {
    Values error = zeros_like(y);
    for (std::size_t n = 0; n < rates.size(); ++n) {
      const double last = pair(rates[n], s - 1), before = pair(rates[n], s - 3);
      const double fall = last < before ? (last / before) * (last / before) : 1.0;
      error[n] = h * (last * (fall * fall));
    }
    return field.error_size(error, y, increment);
  }

 private:
  // The larger of coefficients m and m - 1: in an even or an odd function every other one is 0.
  static double pair(const StageRow& row, std::size_t m) {
    return larger(std::abs(row[m]), std::abs(row[m - 1]));
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
