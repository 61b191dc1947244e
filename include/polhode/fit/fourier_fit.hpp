// SPDX-License-Identifier: MIT
// FourierFit: the two-dimensional Fourier series of a light curve at one pair of frequencies.
//
// Equations   y(t) = C_s + sum_jk A_jk cos 2 pi (j f1 + k f2)(t - epoch)
//             + B_jk sin 2 pi (j f1 + k f2)(t - epoch), with j = 0 to m, k = -m to m and half of
//             the plane, j > 0 or k > 0 (Kaasalainen 2001; Pravec et al. 2005), C_s a constant of
//             each group of sessions; weighted least squares by orthogonal columns. Refined:
//             Gauss and Newton's method in (f1, f2) with Kaufman's derivative of the residuals,
//             damped as Levenberg and Marquardt do.
// Units       frequencies in turns per unit of time; amplitudes of the values of ScanPoints.
// Domain      any frequencies. Where columns depend on each other (f1 = f2, simple ratios,
//             frequencies that the time base does not tell apart), the rank is that of pivots above
//             1e-9 of the largest, and `condition` the ratio of the largest to the least of those;
//             amplitudes beyond it have no meaning, chi-square has.
// Accuracy    budget fourier_scan in tests/budgets/fit.hpp.
// Errors      DomainError for a frequency that is no finite number, an order of 0 or above 9, and
//             for no more points than unknowns.
// Cost        2 n p^2 operations of n points and p unknowns: a millisecond at order 3 of 350
//             points; refined, some ten of these.
#pragma once

#include <cstddef>
#include <vector>

#include "polhode/fit/scan_points.hpp"

namespace polhode {
inline namespace v0 {

// Harmonics: j f1 + k f2 to j = first, k = +-second. One period has first = 0.
struct FourierOrders {
  std::size_t first, second;

  static FourierOrders pair(std::size_t order) { return {order, order}; }
  static FourierOrders single(std::size_t order) { return {0, order}; }
  std::size_t harmonics() const { return ((2 * first + 1) * (2 * second + 1) - 1) / 2; }
};

struct FourierTerm {
  int j, k;
  double cosine, sine;
};

struct FourierFit {
  double f1, f2;
  double chi_square;
  std::size_t degrees_of_freedom;  // points less rank
  std::size_t rank, unknowns;
  double condition;
  std::vector<double> constants;   // of the groups of ScanPoints, from their means
  std::vector<FourierTerm> terms;  // in the order j, k
};

FourierFit fourier_fit(const ScanPoints& points, double f1, double f2, FourierOrders orders);

// The frequencies where chi-square is least, from those given. Errors: from chi-square itself, and
// as chi-square per degree of freedom scales them; they are those of a parabola.
struct RefinedPair {
  FourierFit fit;
  bool converged;
  // Raw: of the sigmas of the points. Infinite, and NaN, where the points do not determine them.
  double sigma_f1, sigma_f2, correlation;
  double scale;  // sqrt(chi-square / degrees of freedom), frequencies not counted as unknowns
  int iterations;
};

// Steps of at most `reach` in each frequency. Orders with first = 0 move f2 alone.
RefinedPair refined_pair(const ScanPoints& points, double f1, double f2, FourierOrders orders,
                         double reach);

}  // namespace v0
}  // namespace polhode
