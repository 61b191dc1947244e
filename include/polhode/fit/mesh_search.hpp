// SPDX-License-Identifier: MIT
// search_mesh(): light curves of a body of known shape to all its spin states that fit, from pairs
// of periods and many starts.
//
// Equations   shape and moments are known, so that a pair of periods and a mode leave the momentum
//             of the body its size and its polhode (to_rotor of polhode/free/tumbler.hpp), on
//             either side of the axis of circulation. A start takes one pair, a side, a phase of
//             the polhode; of `tries` attitudes the one that fits best, some of the points looked
//             at; then fit_mesh in a few iterations. Of each pair the best and those that differ
//             are fitted to the end; what comes to one state is one solution, half turns of the
//             body being others. Each that is within is started from its images, too. Of these only
//             the half turn about the bisector of Sun and observer leaves the light of every body
//             as it is, where the directions stay: it exchanges both, and facets that are lit and
//             seen do not mind.
// Units       as fit_mesh.
// Domain      periods as the labels of a scan list them (labelled_periods, likely_periods).
// Accuracy    the bits do not depend on threads: a start is drawn by its number. Solutions are all
//             that were found: no proof, as in search_light.
// Errors      DomainError as fit_mesh; no periods, periods that are not positive, fewer than one
//             start, try, iteration, finalist or thread, `within` below 1.
// Cost        a start takes `tries` times some 60 brightnesses of the mesh (10 at least of each
//             session), and a few iterations of all
//             points (benchmarks/brightness.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "polhode/fit/light_search.hpp"
#include "polhode/fit/mesh_fit.hpp"

namespace polhode {
inline namespace v0 {

class CellJournal;
struct MeshSearch {
  std::vector<LightCurve> curves;
  // Shape, law and inertia are taken; attitude, rate and epoch are not looked at.
  MeshModel body;
  std::vector<TumblerPeriods> periods;
  std::size_t starts = 1000;  // in all, taken by the pairs of periods in turn
  std::size_t tries = 60;
  int short_iterations = 6;
  std::size_t finalists = 4;  // of each pair of periods
  double within = 1.5;        // chi-square, or the sum under a robust loss, over the lowest, up to
                              // which solutions are reported
  MomentSource moments = MomentSource::start;  // or fit, of finalists alone
  bool multiple = false;
  Loss loss = {};
  int most_iterations = 60;  // of a finalist
  std::uint64_t seed = 0;
  int threads = 1;
  // Called before each attitude that is tried and each fit, in any of the threads; what it throws
  // ends the search.
  std::function<void()> between = {};
  // Keeps the results of a search that may be interrupted.
  CellJournal* journal = nullptr;
};

// `body` of a solution has the spin and the law of the mesh, and for what solutions are beside each
// other the ellipsoid of the same moments.
LightSearchResult search_mesh(const MeshSearch& search);

}  // namespace v0
}  // namespace polhode
