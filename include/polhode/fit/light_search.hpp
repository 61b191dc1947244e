// SPDX-License-Identifier: MIT
// search_light(): light curves of a tumbler to all its spin states and shapes that fit, from pairs
// of periods and many starts: of ellipsoids, of a body whose shape is known, or of convex bodies
// and meshes that follow the ellipsoids.
//
// Equations   of an ellipsoid a start takes one pair of periods, a tilt and a ratio of moments
//             (inertia_from_periods.hpp), a phase of the polhode; of `tries` attitudes the one that
//             fits best; then fit_light in a few iterations. Of each pair of periods the best and
//             those that differ most are fitted to the end, whatever the other pairs reach. Pairs
//             near the limit get more starts, in rounds of 50, at most eight pairs a round: one
//             round where nothing is within the limit, else two to six, until no solution within it
//             was found from a single start (Good 1953, Biometrika 40, 237). What comes to one
//             state, up to half turns about the axes of the ellipsoid, is one solution. Each that
//             is within is started from its images, too: turned by pi about the normal of the plane
//             of Sun and observer, about their bisector, and about the difference of their
//             directions (see LightImage). Moments and a law that are unknown are freed at the end,
//             from what was found without them: first the law, then both.
//             Where shape and moments are known, a pair of periods and a mode leave the momentum of
//             the body its size and its polhode (to_rotor of polhode/free/tumbler.hpp), on either
//             side of the axis of circulation. A start takes one pair, a side and a phase;
//             attitudes are tried on some of the points. There are no rounds, and half turns of the
//             body are other states. Of the images only the half turn about the bisector of Sun and
//             observer leaves the light of every body as it is, where the directions stay: it
//             exchanges both, and facets that are lit and seen do not mind.
//             Convex bodies and a mesh follow the ellipsoids (SurfaceSearch). They are fitted from
//             the best ellipsoid of every pair of periods, also beyond the limit, from the
//             ellipsoids within the limit, and then from the images of bodies within the limit. A
//             mesh is also searched for by its periods. From an ellipsoid it takes mode, periods,
//             pole and phases, in each of four half turns.
// Units       as fit_light.
// Domain      periods as the labels of a scan list them (`labelled_periods`). An ellipsoid fits an
//             alias as well as the truth at times: solutions are all that there are, the lowest
//             chi-square or loss is no proof.
// Accuracy    the bits do not depend on threads: a start is drawn by its number.
// Errors      DomainError as fit_light; no periods, periods that are not positive, fewer than one
//             start, try, iteration, finalist or thread, `within` below 1.
// Cost        benchmarks/fit_light_curves.cpp: ms a start. Of a mesh a start takes `tries` times
//             about 60 of its brightnesses (10 at least of each session), and a few iterations of
//             all points (benchmarks/brightness.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/light_fit.hpp"

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

// Inertial half turns after which light is the same, for an ellipsoid that is lit and seen from
// fixed directions: an ellipsoid looks the same from the opposite direction (normal), and laws that
// do not change when Sun and observer are exchanged give the others.
enum class LightImage { none, normal, bisector, difference };

LightModel image_of(const LightModel& body, LightImage image, const Vec3& to_sun,
                    const Vec3& to_observer);

// The second ellipsoid in the state that is nearest to the first: up to half turns about its axes,
// and up to any exchange of axes where moments are not those of an even filling, so that nothing
// determines which axis comes first.
LightModel nearest_of_same(const LightModel& about, const LightModel& body);

struct LabelChoice {
  // The lowest minima of a scan; those that are not resolved, not converged or at the edge of the
  // grid are left out.
  std::size_t pairs = 5;
  std::size_t labels = 20;  // of each, the most likely ones (likely_periods)
};

// Periods that minima of a scan may be; those that are the same to 1e-3 once.
std::vector<TumblerPeriods> labelled_periods(std::span<const ScanMinimum> minima,
                                             const LabelChoice& choice = {});

// The convex bodies or the mesh that are fitted after the ellipsoids and become the solutions.
struct SurfaceSearch {
  // A mesh of known shape, law and inertia; its attitude, rate and epoch are ignored. nullopt:
  // convex bodies.
  std::optional<LightModel> mesh = std::nullopt;
  int degree = 6, rows = 8;     // of convex bodies, as GaussianImage has them
  LightUnknowns unknowns = {};  // the shape of a mesh is known
  Regularisation regularisation = {};
  int most_iterations = 100;  // of a fit
  // So many pairs of periods are continued, those with the best ellipsoids first.
  std::size_t pairs = std::numeric_limits<std::size_t>::max();

  // The facets of an ellipsoid, with which the fit of a convex body begins.
  LightModel convex_of(const LightModel& ellipsoid) const;
  LightFit fit_from(const LightModel& start, std::vector<light::LightCurve> curves,
                    const Loss& loss, int iterations) const;
};

struct LightSearch {
  std::vector<light::LightCurve> curves;
  std::vector<TumblerPeriods> periods;
  std::size_t starts = 1000;  // at first, in all, taken by the pairs of periods in turn
  std::size_t tries = 30;
  int short_iterations = 8;
  std::size_t finalists = 4;  // of each pair of periods
  double within = 1.5;        // chi-square, or the sum under a robust loss, over the lowest, up to
                              // which solutions are reported
  // With a known body, its shape stays, and moments are unknown only in the fits of finalists.
  LightUnknowns unknowns;
  light::Scattering law;  // of ellipsoids
  Loss loss;
  int most_iterations = 60;  // of a finalist; an ellipsoid near the limit may go on for four times
                             // as many
  std::uint64_t seed = 0;
  int threads = 1;
  // Called before each attitude that is tried and each fit, in any of the threads; what it throws
  // ends the search.
  std::function<void()> between = {};
  // Called when a stage begins, with how much work it is: "search", "40 starts of 2 pairs of
  // periods", and with a surface "surfaces".
  std::function<void(const std::string& stage, const std::string& work)> begins = {};
  // Called with the part of the work of the stage that is done, in one thread at a time; the last
  // call has 1. The number of further fits is estimated from the solutions found so far, so the
  // part may fall.
  std::function<void(double part)> progress = {};
  // Keeps the results of a search that may be interrupted.
  ensemble::CellJournal* journal = nullptr;
  // Whose shape, law and inertia are known; attitude, rate and epoch are ignored. nullopt: an
  // ellipsoid.
  std::optional<LightModel> body = std::nullopt;
  // Fitted after the ellipsoids; not allowed with a known body.
  std::optional<SurfaceSearch> surface = std::nullopt;
};

struct FoundLight {
  LightSolution solution;
  std::size_t periods = 0;  // the place of those that it was started from
  // Fits that came to it; where law or moments are unknown, only fits with all unknowns count.
  std::size_t starts = 0;
  // Its relation to the first solution that it resembles, and the place of that.
  enum class Beside { first, image, alias, other_mode, other_pole };
  Beside beside = Beside::first;
  LightImage image = LightImage::none;
  std::size_t of = 0;
  std::string sentence;
  // Its own shape, or of another body the ellipsoid of the same moments, a = 1.
  light::Ellipsoid ellipsoid{1.0, 1.0, 1.0};
  // The ellipsoid that another body was fitted from; of sessions that joined one by one, the convex
  // body that was the usual one.
  std::optional<LightModel> begun = std::nullopt;
};

// A solution by itself, without relations to others.
FoundLight found_light(LightSolution solution, std::size_t periods = 0);

struct LightSearchResult {
  // By what was minimised, chi-square or the sum under a robust loss; those whose sums differ by
  // 1e-6 or less, by the height of their pole. Within the limit alone; all converged.
  std::vector<FoundLight> solutions;
  // The lowest sum that an ellipsoid or the known body of each pair of periods came to, chi-square
  // or what was minimised under a robust loss; infinite where nothing converged. It is a bound from
  // above, of few fits where a pair is far beyond the limit.
  std::vector<double> chi_square_of_periods;
  // The best of them, also beyond the limit. Where fits with unknown law or moments did not
  // converge, it is the one without them.
  std::vector<std::optional<LightSolution>> best_of_periods;
  // With a surface: the best fit of the surface from each of these, converged ones before
  // others.
  std::vector<std::optional<LightSolution>> surface_of_periods;
  std::size_t starts = 0;     // that had a body
  std::size_t finalists = 0;  // fitted to the end, images included
  std::size_t converged = 0;
  std::size_t surfaces = 0, surfaces_converged = 0;  // fits of the surface
  std::string failure;                               // why there are no solutions
  std::vector<std::string> notes;
};

LightSearchResult search_light(const LightSearch& search);

// What each solution is beside those before it: `beside`, `image`, `of` and `sentence`, as
// search_light says it of its own. `half_turns`: bodies are the same after half turns about their
// axes, as ellipsoids are, and facets that a fit may move; a given mesh is not.
void describe_solutions(std::vector<FoundLight>& solutions,
                        std::span<const light::LightCurve> curves, bool half_turns = true);

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

struct LightExtension {
  std::vector<light::LightCurve> curves;  // the sessions
  std::size_t first = 0;                  // of them the one that the starts are near
  std::vector<LightModel> starts;         // all ellipsoids, all convex bodies or the same mesh
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
  ensemble::CellJournal* journal = nullptr;
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

}  // namespace fit
}  // namespace v0
}  // namespace polhode
