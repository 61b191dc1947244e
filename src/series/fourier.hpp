// SPDX-License-Identifier: MIT
// Functions of angles as Poisson series: Fourier analysis with the angles as independent variables.
//
// Equations   f = sum over k of c_k exp(i k.phi), c_k = mean of f exp(-i k.phi) over a grid of
//             equally spaced values of each angle; the real series has 2 Re c_k and -2 Im c_k.
// Units       those of f; radians.
// Domain      an odd number of points for each angle: n of them give its multipliers up to
//             (n - 1) / 2 either way. Angles of the symbols that are not named do not show.
// Accuracy    harmonics beyond those are folded back onto others; `at_border` is the largest
//             coefficient with an outermost multiplier, a measure of it. Else rounding.
// Errors      DomainError for unknown angles, angles named twice, numbers of points that are not
//             odd or below 1, a grid above 2^26 points, a least that is negative or NaN, and an f
//             that changes its number of values or has one that is not finite.
// Cost        one f a point of the grid, and as many products as points times the sum of the
//             numbers of points; 16 bytes a point and pair of functions.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace series {

struct FourierAngle {
  std::string name;
  int points;
};

struct FourierSeries {
  std::vector<Series<double>> series;  // one for each value of f
  double at_border;
};

// f takes the angles in the order given and returns all functions at once. Coefficients below
// `least` are left out.
FourierSeries fourier_series(const Symbols& symbols, const std::vector<FourierAngle>& angles,
                             const std::function<std::vector<double>(std::span<const double>)>& f,
                             double least = 0.0);

}  // namespace series
}  // namespace v0
}  // namespace polhode
