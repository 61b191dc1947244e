// SPDX-License-Identifier: MIT
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
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {

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

ScanAdvice scan_advice(std::span<const LightCurve> sessions, std::size_t order = 3);

}  // namespace v0
}  // namespace polhode
