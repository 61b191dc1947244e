// SPDX-License-Identifier: MIT
// Chi-square of Fourier series of light curves over a grid of frequencies, or of pairs of them: the
// search for the two periods of a tumbler.
//
// Equations   chi-square of fourier_fit (fit/fourier_fit.hpp) at each pair. Normal equations: as
//             cos a cos b = (cos(a - b) + cos(a + b)) / 2 and its like, all of their entries are
//             sums of weights times cosines and sines of j f1 + k f2 to j, k = 2 m, and these are
//             products of (4 m + 1) rows of functions of f1 with as many of f2, for whole rows and
//             columns of the grid at a time; constants are eliminated first; then Cholesky's L.
//             docs/design/0047-fourier-scan.md.
// Units       frequencies in turns per unit of time.
// Domain      grids of positive frequencies. A pair where a column of L falls below scan_floor of
//             itself is computed again by fourier_fit, so that dependent columns have the
//             chi-square of their span.
// Accuracy    budget fourier_scan in tests/budgets/fit.hpp, of ScanPoints::total(). The bits do not
//             depend on threads, on the set of instructions, nor on the rest of the grid.
// Errors      DomainError for a grid without frequencies or with ones that are not positive, a step
//             that is not, orders as in fourier_fit, no more points than unknowns, fewer than one
//             thread, instructions that the processor lacks.
// Cost        benchmarks/fit_fourier_scan.cpp. Memory: eight bytes a pair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/scan_points.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {

class CellJournal;
// first, first + step, ...
struct FrequencyGrid {
  double first;
  double step;
  std::size_t count;

  double at(std::size_t i) const { return first + static_cast<double>(i) * step; }
  // From least to at most most, both included.
  static FrequencyGrid between(double least, double most, double step);
};

// Least part of a column that is not a sum of the others, below which a pair is computed again.
inline constexpr double scan_floor = 1e-5;

// Chi-square by f1 (rows) and f2 (columns).
struct Landscape {
  FrequencyGrid first, second;
  FourierOrders orders;
  std::vector<double> chi_square;
  std::size_t again = 0;  // pairs that were computed by orthogonal columns

  double at(std::size_t row, std::size_t column) const {
    return chi_square[row * second.count + column];
  }
};

struct ScanOptions {
  std::size_t order = 3;
  int threads = 1;
  InstructionSet set = widest_instruction_set();
  // Called before each block of pairs, and before each pair that is computed again, in any of the
  // threads; what it throws ends the scan.
  std::function<void()> between = {};
  // Which part of the pairs is done, after each block; one call after the other.
  std::function<void(double part)> progress = {};
  // Keeps the results of a search that may be interrupted.
  CellJournal* journal = nullptr;
};

Landscape scan_pairs(const ScanPoints& points, const FrequencyGrid& first,
                     const FrequencyGrid& second, const ScanOptions& options = {});

// Both frequencies on one grid: chi-square is the same for f1 and f2 exchanged, and half of it is
// computed. Its rows come in an order that makes the first ones a sample of all, so that `progress`
// tells how long it takes.
Landscape scan_pairs(const ScanPoints& points, const FrequencyGrid& both,
                     const ScanOptions& options = {});

// One period: a landscape of one row, whose f1 is not looked at.
Landscape scan_periods(const ScanPoints& points, const FrequencyGrid& grid,
                       const ScanOptions& options = {});

}  // namespace v0
}  // namespace polhode
