// SPDX-License-Identifier: MIT
// In this header: scan_points, fourier_fit, fourier_scan, scan_minima, scan_advice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/light/light_curve.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
class CellJournal;
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode

namespace polhode {
inline namespace v0 {
namespace fit {

// ScanPoints: light curves as Fourier scans take them, weighted, each session from a constant of
// its own.
//
// Equations   relative fluxes are F_i / s of one factor s a session. In flux (ScanQuantity::flux)
//             each session is divided by its mean and has a constant of its own, which is a factor
//             to first order in the difference of the means: what is left over is that difference
//             times the variation (Pravec et al. 2005 scan fluxes so). In logarithms
//             (ScanQuantity::log_flux, magnitudes but for 1.086) a factor is a constant exactly, as
//             in Harris et al. (1989), and the error of ln F is sigma / F. Calibrated sessions
//             share one mean and one constant.
// Units       those of the light curves; values are relative to a mean, 1 being all of it.
// Domain      any times in any order, the same time twice included; flux finite, sigma > 0. Vectors
//             to Sun and observer are not looked at: times should be free of light time.
// Accuracy    that of double.
// Errors      DomainError for no points, times, fluxes or sigmas that are no such, a mean that is
//             not positive (flux) or a flux that is not (log_flux), a relative session of one
//             point, all points at one time.
// Cost        a pass over the points.

namespace detail {
struct ScanTable;
}  // namespace detail

enum class ScanQuantity { flux, log_flux };

class ScanPoints {
 public:
  explicit ScanPoints(std::span<const light::LightCurve> sessions,
                      ScanQuantity quantity = ScanQuantity::flux);

  std::size_t size() const;
  // Constants of their own: one of each relative session, one of all calibrated ones.
  std::size_t constants() const;
  double epoch() const { return epoch_; }          // midway between the first and the last time
  double time_base() const { return time_base_; }  // from the first to the last
  // Sum of weights times squares of the values, each from the mean of its group: chi-square of no
  // harmonics at all.
  double total() const;

  // For the sources of this layer.
  const detail::ScanTable& table() const { return *table_; }

 private:
  std::shared_ptr<const detail::ScanTable> table_;
  double epoch_ = 0.0, time_base_ = 0.0;
};

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
  ensemble::CellJournal* journal = nullptr;
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
  ensemble::CellJournal* journal = nullptr;
};

// By chi-square after refinement, the lowest first.
std::vector<ScanMinimum> scan_minima(const ScanPoints& points, const Landscape& landscape,
                                     const MinimaOptions& options = {});

// What the times of light curves say about a scan: how fine a grid must be, which frequencies they
// can show, and which they take for one another.
//
// Equations   over the time base T a frequency that is off by d/2, d the step of the grid, turns
//             the phase of harmonic 2 m (m of each frequency) by 2 pi m d T / 2 at either end: an
//             eighth of a turn for d = 1 / (4 m T). The fastest line that is not taken for a slower
//             one is that of half the typical time from point to point; main lines of tumblers are
//             at twice a frequency (Kaasalainen 2001). Window |sum exp(2 pi i f t)|^2 / n^2: a line
//             at f0 shows at f0 +- f of its peaks, too (a day's turn for one site).
// Units       frequencies in turns per unit of time, heights of peaks 0 to 1.
// Domain      light curves as for ScanPoints; peaks up to `most`, among 60,000 frequencies at most.
// Accuracy    peaks to a tenth of 1 / T.
// Errors      DomainError as of ScanPoints, and for an order of 0.
// Cost        as many sines as points times frequencies of the window: a second at most of 1000.

struct SessionTimes {
  std::string name;
  std::size_t points;
  double first, last;
  double longest_gap;  // between neighbours; 0 of one point
};

struct WindowPeak {
  double frequency;
  double height;
};

struct ScanAdvice {
  double time_base;
  double step;   // of a grid
  double least;  // one turn in the time base
  double most;   // whose second harmonic the points still follow
  double typical_gap;
  double covered;  // part of the time base that is within sessions
  std::vector<SessionTimes> sessions;
  std::vector<WindowPeak> aliases;  // the highest first; none below half
};

ScanAdvice scan_advice(std::span<const light::LightCurve> sessions, std::size_t order = 3);

}  // namespace fit
}  // namespace v0
}  // namespace polhode
