// SPDX-License-Identifier: MIT
// extend_light(): spin states and shapes known from one session of light curves, to all sessions,
// one after the other.
//
// Equations   the session nearest in time joins those that are fitted. A time D before or after the
//             middle t0 of these, the errors of the frequencies F = (1/P_phi, 1/P_psi) leave counts
//             of turns open. So fits begin at F + d for every d of a lattice with steps 1/(2 D) and
//             1/(4 D), the light of an ellipsoid being the same after half a turn, with
//             d^T V^-1 d <= 3^2: V = J C J^T, J = dF/dx, C the covariance scaled by error_factor()
//             where that is above 1; widened by 0.35 of a step. Each begins at the likeliest
//             unknowns of those frequencies, x + C J^T V^-1 d, by Newton's method. What comes to
//             one state is one solution, and those within the limit go on to the next session.
// Units       as fit_light.
// Domain      as fit_light, of bodies of any shape. Where the data do not determine the two
//             periods, or the motion is none that has two, a solution goes on as it is.
// Accuracy    the bits do not depend on threads.
// Errors      DomainError as fit_light; no starts, starts of several shapes, a first session that
//             is not there, fewer than one iteration, count or thread, `within` below 1.
// Cost        a fit for each count of turns and solution: some ms for each 100 points.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {

class CellJournal;
struct LightExtension {
  std::vector<LightCurve> curves;  // the sessions
  std::size_t first = 0;           // of them the one that the starts are near
  std::vector<LightModel> starts;  // all ellipsoids, all convex bodies or the same mesh
  LightUnknowns unknowns;
  Loss loss;
  double within = 1.5;             // as LightSearch
  std::size_t most_counts = 5000;  // of turns, for one solution and session
  int most_iterations = 200;       // of a fit; near the limit it may go on for five times as many
  int threads = 1;
  // Called before each fit, in any of the threads; what it throws ends the extension.
  std::function<void()> between = {};
  // Called with the part that is done, rising to 1, in one thread at a time.
  std::function<void(double part)> progress = {};
  // Keeps the results of a search that may be interrupted.
  CellJournal* journal = nullptr;
  Regularisation regularisation = {};  // of convex bodies
};

// What a session came to when it joined those before it.
struct JoinedSession {
  std::size_t session;  // its place among the curves
  double distance;      // of its middle from that of those before it; of the first 0
  // Fits that were begun, one for each count of turns and solution; for the first session, one for
  // each start.
  std::size_t counts;
  std::size_t converged;  // of them
  std::size_t solutions;  // within the limit, of all sessions so far
  double cost;            // of the lowest
};

struct LightExtensionResult {
  // Of all sessions, as those of LightSearchResult; `periods` is the place of the start it
  // came from.
  std::vector<FoundLight> solutions;
  std::vector<JoinedSession> joined;
  // Why there are no solutions: the first session that could not join, and what may help.
  std::string failure;
  std::vector<std::string> notes;
};

LightExtensionResult extend_light(const LightExtension& extension);

}  // namespace v0
}  // namespace polhode
