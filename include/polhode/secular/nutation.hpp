// SPDX-License-Identifier: MIT
// Precession and nutation of a rigid planet: Kinoshita's theory, to the second order, for the axis
// of momentum, of figure and of rotation.
//
// Equations   Kinoshita (1977), [SA 4.4.5]. Andoyer's variables on the ecliptic of date, J small.
//             H / G = T(J) + V - (mu.n), V = 3/2 sum gm/r^3 (A u1^2 + B u2^2 + C u3^2) / G as a
//             Fourier series in the arguments; c = cos I and h are conjugate. Poisson terms: a Lie
//             transform removes the arguments from what J = 0 leaves; short periods of h and I are
//             the nutation of the momentum. Oppolzer terms: Euler's equations, linear in J, forced
//             by the same series, are solved exactly; triaxial bodies too. Longitude is -h, as it
//             is counted from the node.
//             Rotation: the unperturbed formula w = I^-1 g holds in the precessing frame, and
//             gives the inertial rate [SA 4.4.5]; the rate relative to the ecliptic of date is
//             less by mu, a constant offset of its axis.
// Units       any unit of time; rad. gm / distance^3 in 1/time^2, moments in any unit.
// Domain      bodies that turn about axis 3, the one of largest moment, J = 0 but for what is
//             forced; 0 < I < pi, not within 1e-3 of either end. Arguments advance evenly; they are
//             counted from the mean equinox of date, the direction h + pi. Orders 1 and 2.
// Accuracy    what orders beyond 2 and products of two Oppolzer terms leave out; harmonics that the
//             numbers of points do not hold (largest at the border of the series); and what is
//             below `least`.
// Errors      DomainError for numbers that break this or are not finite, for names of arguments,
//             and for a resonance, of arguments or of the torque with the free wobble.
// Cost        one analysis of the grid (0.3 s for the Earth), and brackets of series.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/math/vector.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

struct NutationArgument {
  std::string name;
  double at_epoch, rate;
  int points;  // of the grid, odd
};

// Its position from the planet: axis 1 to the mean equinox of date, axis 3 to the pole of the
// ecliptic of date, as a function of the arguments.
struct NutationBody {
  double gm;
  std::function<Vec3(std::span<const double>)> position;
};

struct NutationProblem {
  Body body;
  double spin_rate;
  double obliquity;  // I of the mean momentum
  std::vector<NutationArgument> arguments;
  std::vector<NutationBody> bodies;
  Vec3 ecliptic_rate{0.0, 0.0, 0.0};  // mu, of the ecliptic of date, along its axes
  int order = 2;
  double least = 1e-13;  // rad: smaller terms are left out
  double slowest = 0.0;  // rate: what turns slower is a secular change, as at the epoch
};

enum class PlanetAxis { momentum, figure, rotation };
inline constexpr std::array<std::string_view, 3> planet_axes = {"momentum", "figure", "rotation"};
std::string_view name(PlanetAxis axis);
std::optional<PlanetAxis> planet_axis(std::string_view name);

struct NutationWave {
  double longitude_sine = 0.0, longitude_cosine = 0.0, obliquity_cosine = 0.0, obliquity_sine = 0.0;
};

// dpsi = longitude_sine sin(theta) + longitude_cosine cos(theta), theta = sum of multipliers times
// arguments; deps likewise. The last multiplier that is not zero is positive.
struct NutationTerm {
  std::vector<int> multipliers;
  double rate;               // of theta
  NutationWave wave;         // at the epoch
  NutationWave change = {};  // of it, per unit of time
};

struct NutationOffset {
  double longitude, obliquity;
};

class NutationTheory {
 public:
  explicit NutationTheory(const NutationProblem& problem);

  // The names of the arguments: those given, and "Phi", the angle of axis 1 from the node of
  // momentum and ecliptic, where the body has A < B. Phi is 0 at the epoch.
  const std::vector<std::string>& arguments() const { return arguments_; }
  const std::vector<double>& at_epoch() const { return at_epoch_; }
  const std::vector<double>& rates() const { return rates_; }

  // The same theory with terms that change evenly, as those of two others do that are made for
  // epochs half an interval before and after.
  NutationTheory changing(const NutationTheory& before, const NutationTheory& after,
                          double interval) const;

  // Of the mean axis, on the ecliptic of date: d psi / dt and d eps / dt.
  NutationOffset precession() const { return precession_; }

  // Poisson and Oppolzer terms together, largest first.
  const std::vector<NutationTerm>& terms(PlanetAxis axis) const;
  // The Oppolzer terms alone: the axis less that of the momentum.
  const std::vector<NutationTerm>& oppolzer_terms(PlanetAxis axis) const;
  // What the axis has besides periodic terms: constant distance from the mean axis of momentum.
  NutationOffset offset(PlanetAxis axis) const;
  // What is to be added to the axis of rotation for the rate relative to the ecliptic of date.
  NutationOffset relative_offset() const { return relative_offset_; }

  // Nutation at a time from the epoch of the arguments, offset included.
  NutationOffset at(PlanetAxis axis, double t) const;

  // The largest coefficient of the torque at the border of the grid, over its largest: of folding.
  double folding() const { return folding_; }

 private:
  struct AxisSeries {
    std::vector<NutationTerm> terms, oppolzer;
    NutationOffset offset;
  };
  const AxisSeries& of(PlanetAxis axis) const;

  std::vector<std::string> arguments_;
  std::vector<double> at_epoch_, rates_;
  AxisSeries momentum_, figure_, rotation_;
  NutationOffset precession_, relative_offset_;
  double folding_;
};

}  // namespace secular
}  // namespace v0
}  // namespace polhode
