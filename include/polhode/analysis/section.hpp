// SPDX-License-Identifier: MIT
// Surfaces of section of a run: in the plane of Andoyer's l and L, and in the classical plane of
// spin and orbit.
//
// Equations   Andoyer: the canonical elements of S (polhode/rotor/andoyer.hpp) where g, or another
//             of the angles, passes a value modulo a turn; or once in a period of what acts.
//             Spin-orbit: at every pericentre t_p + k 2 pi / n, n the anomalistic mean motion, with
//             P towards the pericentre, N the normal and Q = N x P: angle = atan2(b1 . Q, b1 . P)
//             of the body axis 1 projected onto the plane of the orbit, modulo half a turn; spin =
//             w_IB . N / n; tilt = the angle from N to the body axis 3. A body that turns about N
//             (tilt 0) has theta'' + (3/2) ((B - A)/C) (a/r)^3 sin 2 (theta - f) = 0 with theta =
//             angle and theta' = n spin (Wisdom, Peale and Mignard 1984).
// Units       angles in radians; spin is a pure number; times and momenta those of the system.
// Domain      any problem, either direction; its events are not looked for. Angles of Andoyer are
//             in (-pi, pi]; angle is in (-pi/2, pi/2], that of the long axis where body axis 1 has
//             the least moment, and 0 where that axis stands on the plane. The orbit is in inertial
//             axes, an ellipse with e > 0, and need not be what acts. Passes are events: two of
//             them within a step are found too (event.hpp).
// Accuracy    that of the method; passes are roots of its dense output, times of pericentres have
//             two roundings at most. Passes are found in steps of any length, as often as the body
//             turns there (event.hpp).
// Errors      DomainError for what is no problem, a value, period or orbit out of the domain. A run
//             that cannot go on: an outcome that says why, with the points so far. What a term, the
//             sink or `progress` throws passes through.
// Cost        the run; some ten evaluations of the dense output per pass.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/rotor/andoyer.hpp"

namespace polhode {
inline namespace v0 {
namespace analysis {

enum class AndoyerAngle { l, g, h };

// Where one of Andoyer's angles passes a value: with g or h a surface for the plane of l and L.
struct AndoyerSurface {
  AndoyerAngle angle = AndoyerAngle::g;
  double value = 0.0;
  Crossing crossing = Crossing::rising;  // as time runs, backwards too

  constexpr bool operator==(const AndoyerSurface&) const = default;
};

// At epoch + k period, for every whole k within the run.
struct Strobe {
  double period;
  double epoch = 0.0;

  constexpr bool operator==(const Strobe&) const = default;
};

using SectionSurface = std::variant<AndoyerSurface, Strobe>;

struct AndoyerPoint {
  double t;
  RotorState s;
  AndoyerState andoyer;  // of s
};

struct SpinOrbitPoint {
  double t;
  RotorState s;
  double angle;
  double spin;
  double tilt;
};

// Points in the order of the run.
template <class Point>
struct BasicSection {
  std::vector<Point> points;
  Outcome outcome;
  Statistics statistics;
  std::string method;  // in words: provenance
};
using AndoyerSection = BasicSection<AndoyerPoint>;
using SpinOrbitSection = BasicSection<SpinOrbitPoint>;

// Where points go one by one.
template <class Point>
using PointSink = std::function<void(const Point&)>;

AndoyerSection andoyer_section(const Problem& problem,
                               const SectionSurface& surface = AndoyerSurface{},
                               const Progress& progress = {});
SpinOrbitSection spin_orbit_section(const Problem& problem, const PrecessingKeplerOrbit& orbit,
                                    const Progress& progress = {});
SpinOrbitSection spin_orbit_section(const Problem& problem, const KeplerOrbit& orbit,
                                    const Progress& progress = {});

// The same in constant memory: the section returned has no points.
AndoyerSection andoyer_section(const Problem& problem, const SectionSurface& surface,
                               const PointSink<AndoyerPoint>& sink, const Progress& progress = {});
SpinOrbitSection spin_orbit_section(const Problem& problem, const PrecessingKeplerOrbit& orbit,
                                    const PointSink<SpinOrbitPoint>& sink,
                                    const Progress& progress = {});

// DomainError unless an orbit has a pericentre that comes again.
void require_pericentres(const KeplerElements& elements, const char* function);

}  // namespace analysis
}  // namespace v0
}  // namespace polhode
