// SPDX-License-Identifier: MIT
// Periods of a tumbling body: their labels in a spectrum, and the bodies that have them.
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

namespace {

std::vector<LineLabel> lines(int most) {
  std::vector<LineLabel> all;
  for (int j = -most; j <= most; ++j)
    for (int k = -most; k <= most; ++k)
      if (j != 0 || k != 0) all.push_back({j, k});
  const int halves = most + 1;
  for (int j = -halves; j <= halves; ++j)
    for (int k = -halves; k <= halves; ++k)
      if (j % 2 != 0 || k % 2 != 0) all.push_back({j, k, 2});
  return all;
}

bool of_ellipsoid(const LineLabel& line, Regime mode) {
  return mode == Regime::long_axis ? line.k % 2 == 0 : (line.j + line.k) % 2 == 0;
}

int weakness(const LineLabel& line) {
  const int j = std::abs(line.j), k = std::abs(line.k);
  if (line.over == 2) return 5 + j + k;
  if (j == 2 && k == 0) return 0;
  if (j == 2 && k == 2) return 1;
  if (j + k <= 2) return 2;
  return j + k;
}

int weakness(const PeriodLabel& label) {
  return (label.of_ellipsoid ? 0 : 100) + weakness(label.first) + weakness(label.second);
}

}  // namespace

std::vector<PeriodLabel> period_labels(double f1, double f2, int most) {
  for (const double f : {f1, f2})
    if (!(f > 0.0) || !std::isfinite(f))
      throw DomainError("period_labels: frequency " + polhode::detail::number_text(f) +
                        " must be positive");
  if (most < 1 || most > 9)
    throw DomainError("period_labels: most " + std::to_string(most) + ": it must be 1 to 9");
  std::vector<PeriodLabel> labels;
  const std::vector<LineLabel> all = lines(most);
  for (const LineLabel& a : all)
    for (const LineLabel& b : all) {
      const int determinant = a.j * b.k - a.k * b.j;
      if (determinant == 0) continue;
      const double line1 = a.over * f1, line2 = b.over * f2;
      const double f_phi = (b.k * line1 - a.k * line2) / determinant;
      const double f_psi = (a.j * line2 - b.j * line1) / determinant;
      if (!(f_phi > 0.0) || !(f_psi > 0.0)) continue;
      for (const Regime mode : {Regime::long_axis, Regime::short_axis}) {
        if (mode == Regime::short_axis && !(f_psi < f_phi)) continue;
        labels.push_back(
            {mode, 1.0 / f_phi, 1.0 / f_psi, a, b, of_ellipsoid(a, mode) && of_ellipsoid(b, mode)});
      }
    }
  std::stable_sort(labels.begin(), labels.end(), [](const PeriodLabel& a, const PeriodLabel& b) {
    return weakness(a) < weakness(b);
  });
  return labels;
}

bool allows(const Body& body, const PeriodLabel& label) {
  const double ratio = label.rotation_period / label.precession_period;
  try {
    return ratio > least_period_ratio(body, label.mode);
  } catch (const DomainError&) {
    return false;  // a body that does not have the mode
  }
}

namespace {

const double quarter_turn = 0.5 * pi<double>();

void check(const TumblerPeriods& p, double tilt) {
  const std::string who = "body_with_periods: ";
  if (p.mode != Regime::short_axis && p.mode != Regime::long_axis)
    throw DomainError(who + "the mode must be short_axis or long_axis");
  for (const double period : {p.precession_period, p.rotation_period})
    if (!(period > 0.0) || !std::isfinite(period))
      throw DomainError(who + "period " + polhode::detail::number_text(period) +
                        " must be positive");
  if (!(tilt > 0.0) || !(tilt < quarter_turn))
    throw DomainError(who + "tilt " + polhode::detail::number_text(tilt) +
                      " must be between 0 and pi/2");
}

// Where the axis of circulation leans most, the momentum has no part along the third of the axes
// that is neither it nor the middle one.
Vec3 momentum(Regime mode, double tilt) {
  return mode == Regime::long_axis ? Vec3{std::cos(tilt), std::sin(tilt), 0.0}
                                   : Vec3{0.0, std::sin(tilt), std::cos(tilt)};
}

// The turn from the body's axes to the inertial ones that puts the momentum along the third.
Quaternion upright(const Vec3& g) {
  const double G = norm(g);
  const Quaternion q{G + g.z, g.y, -g.x, 0.0};
  return normalized(q);
}

FreeRotation motion_of(Regime mode, double tilt, double least, double middle, double size) {
  const Vec3 g = size * momentum(mode, tilt);
  return FreeRotation(Body(least, middle, 1.0), {upright(g), g});
}

// P_phi / P_psi.
double inverse_ratio(Regime mode, double tilt, double least, double middle) {
  // where the lesser moments are equal, the momentum turns about the short axis alone
  if (mode == Regime::long_axis && least >= middle) return 0.0;
  const FreeRotation motion = motion_of(mode, tilt, least, middle, 1.0);
  return 2.0 * pi<double>() / (motion.polhode_period() * motion.precession_rate_long());
}

struct Ends {
  double flat, round;  // P_phi / P_psi at I1 = I3 - I2 and at I1 = I2
};

// The highest I1 that is tried: short of the middle one, whose body has no long axis.
double round_moment(Regime mode, double middle) {
  return mode == Regime::long_axis ? middle : middle * (1.0 - 1e-12);
}

Ends ends_of(Regime mode, double tilt, double middle) {
  return {inverse_ratio(mode, tilt, 1.0 - middle, middle),
          inverse_ratio(mode, tilt, round_moment(mode, middle), middle)};
}

std::optional<double> least_moment(const TumblerPeriods& p, double tilt, double middle,
                                   const Ends& ends) {
  const double wanted = p.precession_period / p.rotation_period;
  const auto off = [&](double least) {
    return inverse_ratio(p.mode, tilt, least, middle) - wanted;
  };
  if (!((ends.flat - wanted) * (ends.round - wanted) <= 0.0)) return std::nullopt;
  std::uintmax_t trips = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      off, 1.0 - middle, round_moment(p.mode, middle), ends.flat - wanted, ends.round - wanted,
      boost::math::tools::eps_tolerance<double>(52), trips);
  return std::abs(off(low)) < std::abs(off(high)) ? low : high;
}

TumblingBody scaled(const TumblerPeriods& p, double tilt, double least, double middle) {
  const double rate = motion_of(p.mode, tilt, least, middle, 1.0).precession_rate_long();
  const FreeRotation motion =
      motion_of(p.mode, tilt, least, middle, 2.0 * pi<double>() / (p.precession_period * rate));
  return {motion.body(), motion.initial_state()};
}

}  // namespace

TumblingBody body_with_periods(const TumblerPeriods& p, double tilt, double middle) {
  check(p, tilt);
  if (!(middle > 0.5) || !(middle < 1.0))
    throw DomainError("body_with_periods: I2/I3 " + polhode::detail::number_text(middle) +
                      " must be between 1/2 and 1");
  const Ends ends = ends_of(p.mode, tilt, middle);
  const std::optional<double> least = least_moment(p, tilt, middle, ends);
  if (!least)
    throw DomainError("body_with_periods: P_psi/P_phi " +
                      polhode::detail::number_text(p.rotation_period / p.precession_period) +
                      ": bodies with tilt " + polhode::detail::number_text(tilt) + " and I2/I3 " +
                      polhode::detail::number_text(middle) + " have " +
                      polhode::detail::number_text(1.0 / ends.flat) + " to " +
                      polhode::detail::number_text(1.0 / ends.round));
  return scaled(p, tilt, *least, middle);
}

std::vector<TumblingBody> inertia_from_periods(const TumblerPeriods& p, double tilt,
                                               std::size_t count) {
  check(p, tilt);
  std::vector<TumblingBody> bodies;
  for (std::size_t i = 0; i < count; ++i) {
    const double middle = 0.5 + 0.5 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const Ends ends = ends_of(p.mode, tilt, middle);
    if (const auto least = least_moment(p, tilt, middle, ends))
      bodies.push_back(scaled(p, tilt, *least, middle));
  }
  return bodies;
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
