// SPDX-License-Identifier: MIT
// scan_sessions(): the two periods of a tumbler from several nights, night by night first.
//
// Equations   a grid over all nights is as fine as their whole time base asks for, and its pairs
//             grow with the square of that. Here each session has a series of its own, with its own
//             phases, which needs a grid as fine as the longest session alone: the sum of their
//             chi-squares is a landscape without the relation between nights. Around its lowest
//             minima, 1.5 of its steps to all sides, pairs are scanned on the whole time base.
//             f1 and f2 exchanged are one minimum.
// Units       frequencies in turns per unit of time.
// Domain      sessions with more points than a series has unknowns count in the coarse landscape,
//             one of them at least; all do in the fine ones. What no single night tells apart is
//             told apart in the fine scan alone, where it is near a minimum of the coarse one:
//             periods longer than a night are not found so.
// Accuracy    as scan_pairs and scan_minima.
// Errors      DomainError as scan_pairs and ScanPoints; no session with enough points; fewer than
//             one window.
// Cost        windows x (3 T / T_s)^2 pairs, T the whole time base, T_s that of the longest
//             session, beside the coarse ones of each session: session_scan_size says how many.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polhode/fit/fourier_fit.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

struct SessionScanOptions {
  ScanOptions scan;  // its progress is that of all pairs
  ScanQuantity quantity = ScanQuantity::flux;
  std::size_t windows = 20;  // minima of the coarse landscape that are looked into
  std::size_t most = 5;      // minima of each that are refined
};

struct SessionScan {
  Landscape coarse;          // sums of sessions
  std::size_t sessions = 0;  // that are in them
  std::size_t pairs = 0;     // of the fine scans
  // On the whole time base, the lowest first; row and column are those of the coarse landscape.
  std::vector<ScanMinimum> minima;
};

// What scan_sessions computes, before it does.
struct SessionScanSize {
  std::size_t sessions;  // with enough points
  double coarse_step;    // of the grid of each of them
  double coarse;         // its pairs
  double fine;           // pairs of each window
  double pairs(std::size_t windows) const {
    return static_cast<double>(sessions) * coarse + static_cast<double>(windows) * fine;
  }
};
SessionScanSize session_scan_size(std::span<const light::LightCurve> sessions, double least,
                                  double most, std::size_t order = 3);

// Both frequencies from `least` to `most`.
SessionScan scan_sessions(std::span<const light::LightCurve> sessions, double least, double most,
                          const SessionScanOptions& options = {});

}  // namespace fit
}  // namespace v0
}  // namespace polhode
