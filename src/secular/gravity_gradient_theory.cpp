// SPDX-License-Identifier: MIT
#include "polhode/secular/gravity_gradient_theory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/series/compiled_series.hpp"
#include "polhode/series/taylor_coefficient.hpp"
#include "secular/gravity_gradient_transform.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace {

using detail::refuse_theory;
using polhode::detail::number_text;
using Local = series::Series<detail::ActionTaylor>;
using Six = std::array<double, 6>;

constexpr std::array<const char*, 6> element_names = {"phi_l", "phi_g", "phi_h",
                                                      "I_l",   "I_g",   "I_h"};

Six numbers_of(const MeanRotation& m) { return {m.phi_l, m.phi_g, m.phi_h, m.I_l, m.I_g, m.I_h}; }
MeanRotation rotation_of(const Six& y) { return {y[0], y[1], y[2], y[3], y[4], y[5]}; }
MeanRotation rotation_of(const SadovState& s) {
  return {s.phi_l, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h};
}
SadovState with_elements(const SadovState& s, const MeanRotation& m) {
  return {m.phi_l, m.phi_g, m.phi_h, m.I_l, m.I_g, m.I_h, s.region, s.lobe};
}

// What is of order N + 1 at most, displacements of the actions being of order 1.
series::Series<double> in_displacements(const Local& series, int order) {
  series::Series<double> sum(series.symbols());
  for (int n = 0; n <= order; ++n)
    sum += series::expanded(series::part_of_order(series, detail::gradient_orders(order), n),
                            std::min<int>(detail::action_degree, order + 1 - n));
  return sum;
}

Quaternion axes_of(const KeplerElements& e) {
  return rotation_z(e.node) * rotation_x(e.inclination) * rotation_z(e.argument);
}
RotorState in_axes(const Quaternion& axes, const RotorState& s) { return {conj(axes) * s.q, s.g}; }

void require_finite(double t) {
  if (!std::isfinite(t)) refuse_theory("the time " + number_text(t) + " must be finite");
}

}  // namespace

struct GravityGradientTheory::Parts {
  detail::GravityGradientRequest request;
  Quaternion orbit_axes;  // to inertial axes
  std::size_t term_count;
  double rate_error;
  series::Series<double> mean_hamiltonian;
  std::vector<series::CompiledSeries> rates;          // of phi_l, phi_g, phi_h, and -I_h
  std::vector<series::CompiledSeries> short_periods;  // of the elements, in their order

  static std::shared_ptr<const Parts> of(const detail::GravityGradientRequest& request) {
    const auto [transform, term_count, largest_angle, left_out] = detail::transformed(request);
    const int order = request.options.order;
    const auto compiled = [&](const Local& series) {
      return series::CompiledSeries(in_displacements(series, order));
    };
    const Local& K = transform.mean_hamiltonian();
    std::vector<series::CompiledSeries> rates, short_periods;
    for (const char* const symbol : {"I_l", "I_g", "I_h", "phi_h"})
      rates.push_back(compiled(series::derivative(K, symbol)));
    // The next order: smaller than the last one by the largest short period, and some more.
    constexpr double more = 3.0;
    double truncated = 0.0;
    for (const char* const symbol : {"I_l", "I_g", "I_h"}) {
      double rate = 0.0;
      const Local last = series::part_of_order(series::derivative(K, symbol),
                                               detail::gradient_orders(order), order);
      for (const auto& term : last.terms()) rate += std::abs(term.c.constant());
      truncated = std::max<double>(truncated, more * rate * largest_angle);
    }
    const double turning =
        request.at.I_g /
        std::min({request.body.moments().x, request.body.moments().y, request.body.moments().z});
    for (const char* const symbol : element_names)
      short_periods.push_back(compiled(transform.short_period(symbol)));
    return std::make_shared<const Parts>(Parts{
        request, axes_of(request.orbit.elements()), term_count, truncated + left_out * turning,
        in_displacements(K, order), std::move(rates), std::move(short_periods)});
  }

  double mean_anomaly(const DoubleDouble& t) const {
    const KeplerElements& e = request.orbit.elements();
    const DoubleDouble turned =
        DoubleDouble(request.orbit.mean_motion()) * (t - DoubleDouble(e.epoch));
    return e.mean_anomaly + turned.hi;
  }
  std::array<double, 8> point(const DoubleDouble& t, const MeanRotation& m) const {
    const SadovState& at = request.at;
    return {m.I_l - at.I_l, m.I_g - at.I_g, m.I_h - at.I_h, 1.0,
            m.phi_l,        m.phi_g,        m.phi_h,        mean_anomaly(t)};
  }
  MeanRotation osculating(double t, const MeanRotation& mean) const {
    require_near(t, mean);
    const auto here = point(DoubleDouble(t), mean);
    Six y = numbers_of(mean);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += short_periods[i].at(here);
    return rotation_of(y);
  }
  // Beyond, Taylor polynomials of the actions are of no use.
  void require_near(double t, const MeanRotation& mean) const;
  // Of which these are the osculating ones. Not by the Lie transform back: its coefficients belong
  // to the osculating actions, which can be farther from the mean ones than a small divisor allows.
  MeanRotation mean(double t, const MeanRotation& osculating_elements) const;
};

void GravityGradientTheory::Parts::require_near(double t, const MeanRotation& mean) const {
  require_finite(t);
  constexpr double share = 0.3;
  const auto require = [&](const char* name, double is, double made, double distance) {
    if (std::abs(is - made) < share * distance) return;
    refuse_theory(std::string(name) + " = " + number_text(is) + ", and the theory is made for " +
                  number_text(made) + " and what is within " + number_text(share * distance));
  };
  const SadovState& at = request.at;
  require("I_g", mean.I_g, at.I_g, at.I_g);
  require("I_l / I_g", mean.I_l / mean.I_g, at.I_l / at.I_g,
          detail::distance_in_region(request.body, at));
  require("I_h / I_g", mean.I_h / mean.I_g, at.I_h / at.I_g, 1.0 - std::abs(at.I_h) / at.I_g);
}

MeanRotation GravityGradientTheory::Parts::mean(double t, const MeanRotation& elements) const {
  constexpr int most_rounds = 50;
  constexpr double small = 1e-12;  // of what is left when nothing but rounding changes
  const Six wanted = numbers_of(elements);
  Six y = wanted;
  double change = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_rounds; ++i) {
    const double before = change;
    const Six reached = numbers_of(osculating(t, rotation_of(y)));
    change = 0.0;
    for (std::size_t j = 0; j < y.size(); ++j) {
      const double by = wanted[j] - reached[j];
      y[j] += by;
      change = std::max<double>(change, std::abs(j < 3 ? by : by / request.at.I_g));
    }
    if (change < small && !(change < before)) return rotation_of(y);
  }
  refuse_theory("no mean elements were found for the state: its short periods are too large");
}

GravityGradientTheory::GravityGradientTheory(const Body& body, double gm, const KeplerOrbit& orbit,
                                             const RotorState& state, double t,
                                             const GravityGradientOptions& options)
    : options_(options) {
  require_finite(t);
  const RotorState in_orbit = in_axes(axes_of(orbit.elements()), state);
  detail::GravityGradientRequest request{body, gm, orbit,
                                         to_sadov(FreeRotation(body, in_orbit, t), t), options};
  detail::require_valid(request);
  // Mean actions to the first order, and the theory there.
  const MeanRotation osculating_elements = rotation_of(request.at);
  request.options.order = 1;
  const MeanRotation first = Parts::of(request)->mean(t, osculating_elements);
  request.options.order = options.order;
  request.at = with_elements(request.at, first);
  parts_ = Parts::of(request);
}

MeanRotation GravityGradientTheory::elements(double t, const RotorState& state) const {
  require_finite(t);
  const detail::GravityGradientRequest& made = parts_->request;
  const SadovState s = to_sadov(FreeRotation(made.body, in_axes(parts_->orbit_axes, state), t), t);
  if (s.region != made.at.region || s.lobe != made.at.lobe || s.I_l * made.at.I_l < 0.0)
    refuse_theory("the state is in another mode than the motion that the theory is of");
  return rotation_of(s);
}
RotorState GravityGradientTheory::state_of(const MeanRotation& elements) const {
  const detail::GravityGradientRequest& made = parts_->request;
  const RotorState in_orbit = to_rotor(made.body, with_elements(made.at, elements));
  return {parts_->orbit_axes * in_orbit.q, in_orbit.g};
}

MeanRotation GravityGradientTheory::mean(double t, const RotorState& osculating) const {
  return parts_->mean(t, elements(t, osculating));
}
RotorState GravityGradientTheory::osculating(double t, const MeanRotation& mean) const {
  return state_of(parts_->osculating(t, mean));
}

GravityGradientTheory::Values GravityGradientTheory::rates(const DoubleDouble& t,
                                                           const Values& y) const {
  const auto at = parts_->point(t, state(y));
  const auto& rates = parts_->rates;
  return {rates[0].at(at), rates[1].at(at), rates[2].at(at), 0.0, 0.0, -rates[3].at(at)};
}
// The fast angles turn evenly: by 1e5 rad in a step, of which the rounding is no error of the
// method.
double GravityGradientTheory::error_size(const Values& error, const Values& y,
                                         const Values& increment) const {
  constexpr double rounding = 4e-15;
  const auto beyond_rounding = [&](std::size_t i) {
    return std::max<double>(std::abs(error[i]) - rounding * std::abs(increment[i]), 0.0);
  };
  return std::max<double>(
      {beyond_rounding(0), beyond_rounding(1), std::abs(error[2]), std::abs(error[5] / y[4])});
}

std::vector<MeanRotation> GravityGradientTheory::means(double t0, const MeanRotation& mean,
                                                       std::span<const double> times,
                                                       double tolerance,
                                                       const Progress& progress) const {
  require_finite(t0);
  for (const double t : times) require_finite(t);
  std::vector<MeanRotation> found;
  if (times.empty()) return found;
  const auto run = [&](double stop) -> std::optional<BasicTrajectory<MeanRotation>> {
    if (stop == t0) return std::nullopt;
    const BasicProblem<GravityGradientTheory> problem{*this, mean, t0, stop, Adaptive{tolerance}};
    auto trajectory = integrate(problem, Keep{}, progress);
    if (!trajectory.outcome().ok()) refuse_theory(trajectory.outcome().advice);
    return trajectory;
  };
  const auto [first, last] = std::ranges::minmax(times);
  const auto forward = run(std::max<double>(t0, last)), backward = run(std::min<double>(t0, first));
  found.reserve(times.size());
  for (const double t : times)
    found.push_back(t == t0 ? mean : (t > t0 ? forward : backward)->at(t));
  return found;
}
std::vector<RotorState> GravityGradientTheory::states(double t0, const MeanRotation& mean,
                                                      std::span<const double> times,
                                                      double tolerance,
                                                      const Progress& progress) const {
  const std::vector<MeanRotation> moved = means(t0, mean, times, tolerance, progress);
  std::vector<RotorState> found;
  found.reserve(moved.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    found.push_back(osculating(times[i], moved[i]));
    if (progress) progress(times[i]);
  }
  return found;
}

MeanRotation GravityGradientTheory::reference() const { return rotation_of(parts_->request.at); }
const series::Series<double>& GravityGradientTheory::mean_hamiltonian() const {
  return parts_->mean_hamiltonian;
}
double GravityGradientTheory::rate_error() const { return parts_->rate_error; }
std::size_t GravityGradientTheory::term_count() const { return parts_->term_count; }

}  // namespace secular
}  // namespace v0
}  // namespace polhode
