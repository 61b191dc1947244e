// SPDX-License-Identifier: MIT
// Minima of a landscape: ranked, and refined to the frequencies where chi-square itself is least.
//
// Equations   a minimum is no higher than the neighbours of its cell and lower than those before
//             it; the lowest of them are refined (fit/fourier_fit.hpp), by steps of at most one of
//             the grid. Those that meet, also with f1 and f2 exchanged, are one.
// Units       frequencies in turns per unit of time.
// Domain      any landscape of these points. `resolved` says whether the harmonics are told apart:
//             where two of them, or one and a constant, are nearly the same over the time base,
//             huge amplitudes that cancel can follow any slow change, and a low chi-square means
//             little; the condition of the columns is then beyond resolved_condition.
// Accuracy    that of refined_pair.
// Errors      DomainError for fewer points than the landscape's orders have unknowns.
// Cost        some ten fits a minimum.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "polhode/fit/fourier_scan.hpp"

namespace polhode {
inline namespace v0 {

class CellJournal;
inline constexpr double resolved_condition = 100.0;
inline bool is_resolved(const FourierFit& fit) {
  return fit.rank == fit.unknowns && fit.condition <= resolved_condition;
}

struct ScanMinimum {
  std::size_t row, column;  // the cell it was found in
  double chi_square;        // of that
  bool at_edge;             // the least may lie beyond the grid
  bool resolved;
  RefinedPair refined;
};

struct MinimaOptions {
  std::size_t most = 20;  // so many cells are refined, the lowest
  int threads = 1;
  // Called before each refinement, in any of the threads; what it throws ends the search.
  std::function<void()> between = {};
  // Keeps the results of a search that may be interrupted.
  CellJournal* journal = nullptr;
};

// By chi-square after refinement, the lowest first.
std::vector<ScanMinimum> scan_minima(const ScanPoints& points, const Landscape& landscape,
                                     const MinimaOptions& options = {});

}  // namespace v0
}  // namespace polhode
