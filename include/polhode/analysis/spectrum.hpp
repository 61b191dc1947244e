// SPDX-License-Identifier: MIT
// The leading frequencies of evenly spaced samples: Laskar's frequency analysis, then all lines
// fitted together.
//
// Equations   x(t) = sum A_k exp(i (nu_k t + phi_k)), of real samples mean + sum A_k cos(nu_k t +
//             phi_k). Line after line, |integral x exp(-i nu t) w dt| is largest at nu_k (Laskar
//             1993), w = (1 + cos(pi tau))^p with tau from -1 to 1 along the samples, Hann's window
//             of order p. Then frequencies, amplitudes and phases of all lines are those of least
//             squares with the weights w (Gauss-Newton), which frees them of each other.
// Units       any time; frequencies in rad per time, phases in rad, those at t = 0.
// Domain      8 samples or more, finite, and at least 3 numbers for each line. Lines farther apart
//             than 10 turns over the whole of the samples are resolved; closer ones are counted
//             by unresolved(). A line that would wander off its peak in the fit by more than half a
//             turn keeps the frequency of the peak.
// Accuracy    budgets spectrum_*: for sums of lines alone that of rounding. Errors of a line are
//             those that noise of the size of the residual would leave.
// Errors      DomainError for too few samples or samples that are not finite, for an interval that
//             is not positive, for a window or a number of lines outside the domain.
// Cost        N samples, n lines: n transforms, and some ten times 9 N n^2 operations.
#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace analysis {

struct SpectralLine {
  double frequency;
  double amplitude;
  double phase;  // in (-pi, pi], at t = 0
  double frequency_error;
  double amplitude_error;
  double phase_error;  // at the middle of the samples, where it is least
  double isolation;    // how far the next line is, or of real samples its own mirror image

  bool operator==(const SpectralLine&) const = default;
};

struct Spectrum {
  double mean = 0.0;                // of real samples; of complex ones it is a line
  std::vector<SpectralLine> lines;  // the largest first
  double residual = 0.0;            // root mean square of what is left over
  double size = 0.0;                // root mean square of the samples, of real ones about the mean
  double resolution = 0.0;  // 10 turns over the samples: closer lines are not free of each other
};

// The number of lines closer than that.
int unresolved(const Spectrum& of);

struct SpectrumOptions {
  std::optional<int> lines = std::nullopt;  // at most; 20, or a third of the samples' numbers
  int window = 1;                           // order of Hann's, 0 to 5
  double smallest = 1e-10;                  // lines below this fraction of the largest are left out
};

// Samples at start + k interval.
Spectrum spectrum(double start, double interval, std::span<const double> samples,
                  const SpectrumOptions& options = {});
Spectrum spectrum(double start, double interval, std::span<const std::complex<double>> samples,
                  const SpectrumOptions& options = {});

}  // namespace analysis
}  // namespace v0
}  // namespace polhode
