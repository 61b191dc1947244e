// SPDX-License-Identifier: MIT
// Nutation series of a rigid planet, and the torque on its bulge that they come from.
#include "polhode/secular/nutation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "secular/nutation_theory.hpp"
#include "series/fourier.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

namespace {

std::vector<std::string> names_of(const NutationProblem& problem) {
  std::vector<std::string> names;
  for (const NutationArgument& one : problem.arguments) names.push_back(one.name);
  const Vec3& moments = problem.body.moments();
  if (moments.x != moments.y) names.emplace_back("Phi");
  return names;
}

series::Symbols symbols_of(const std::vector<std::string>& arguments, bool has_phi) {
  std::vector<std::string> angles{NutationSymbols::h};
  angles.insert(angles.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables{NutationSymbols::x, NutationSymbols::k};
  std::vector<series::ConjugatePair> pairs{{NutationSymbols::h, NutationSymbols::x}};
  if (has_phi) {
    variables.emplace_back(NutationSymbols::y);
    pairs.push_back({"Phi", NutationSymbols::y});
  }
  return series::Symbols(std::move(variables), std::move(angles), std::move(pairs));
}

series::FourierSeries analysed(const NutationProblem& problem, const NutationSymbols& names) {
  std::vector<series::FourierAngle> angles;
  for (const NutationArgument& one : problem.arguments) angles.push_back({one.name, one.points});
  return series::fourier_series(names.symbols(), angles, [&](std::span<const double> at) {
    std::vector<double> q(5, 0.0);
    for (const NutationBody& body : problem.bodies) {
      const Vec3 r = body.position(at);
      const double r2 = r.x * r.x + r.y * r.y + r.z * r.z;
      const double of_r = body.gm / (r2 * r2 * std::sqrt(r2));  // gm / r^3, and r^2 of u u
      q[0] += of_r * (r.z * r.z - r2 / 3.0);
      q[1] += of_r * r.z * r.x;
      q[2] += of_r * r.z * r.y;
      q[3] += of_r * (r.x * r.x - r.y * r.y);
      q[4] += of_r * 2.0 * r.x * r.y;
    }
    return q;
  });
}

// Without what makes less than a tenth of the smallest term, and without the dust of the transform.
series::Series<double> sifted(const series::Series<double>& q, const NutationProblem& problem,
                              double dust, const std::vector<double>& rates) {
  const double per_torque = 3.0 / problem.spin_rate / std::sin(problem.obliquity);
  std::vector<series::Term<double>> kept;
  for (const series::Term<double>& term : q.terms()) {
    const double rate = std::abs(rate_of(q.symbols(), term.key, rates));
    const bool matters = std::abs(term.c) * per_torque >= 0.1 * problem.least * rate;
    if (std::abs(term.c) > dust && matters) kept.push_back(term);
  }
  return series::Series<double>(q.symbols(), std::move(kept));
}

double largest(const series::Series<double>& q) {
  double size = 0.0;
  for (const series::Term<double>& term : q.terms()) size = std::max(size, std::abs(term.c));
  return size;
}

}  // namespace

NutationSymbols::NutationSymbols(const NutationProblem& problem)
    : arguments_(names_of(problem)),
      given_(problem.arguments.size()),
      symbols_(symbols_of(arguments_, has_phi())) {}

double rate_of(const series::Symbols& symbols, const series::TermKey& key,
               const std::vector<double>& rates) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rates.size(); ++i)
    sum += series::multiplier(symbols, key, static_cast<int>(i) + 1) * rates[i];  // after h
  return sum;
}

NutationTorque::NutationTorque(const NutationProblem& problem, const NutationSymbols& names,
                               const std::vector<double>& rates)
    : q0(names.symbols()), q1{q0, q0}, q2{q0, q0}, folding(0.0) {
  series::FourierSeries found = analysed(problem, names);
  double size = 0.0;
  for (const series::Series<double>& one : found.series) size = std::max(size, largest(one));
  folding = found.at_border / size;
  constexpr double rounding = 1e-14;
  for (series::Series<double>& one : found.series)
    one = sifted(one, problem, rounding * size, rates);
  q0 = found.series[0];
  q1 = {found.series[1], found.series[2]};
  q2 = {found.series[3], found.series[4]};
}

}  // namespace detail

namespace {

using polhode::detail::number_text;

void require(const NutationProblem& problem) {
  const auto refuse = [](const std::string& why) { throw DomainError("NutationTheory: " + why); };
  const Vec3& moments = problem.body.moments();
  if (!(moments.x < moments.z && moments.y < moments.z))
    refuse("moments (" + number_text(moments.x) + ", " + number_text(moments.y) + ", " +
           number_text(moments.z) + "); the third must be the largest");
  if (!(problem.spin_rate > 0.0) || !std::isfinite(problem.spin_rate))
    refuse("spin_rate " + number_text(problem.spin_rate) + " must be positive and finite");
  constexpr double margin = 1e-3;
  if (!(problem.obliquity >= margin && problem.obliquity <= std::numbers::pi - margin))
    refuse("obliquity " + number_text(problem.obliquity) +
           " rad must be between 0 and pi, and not within 0.001 of either: the node is not there");
  if (problem.order != 1 && problem.order != 2)
    refuse("order " + std::to_string(problem.order) + " must be 1 or 2");
  const auto finite = [&](double value, const char* name) {
    if (!std::isfinite(value)) refuse(name + (" " + number_text(value)) + " must be finite");
  };
  if (!(problem.least > 0.0)) refuse("least " + number_text(problem.least) + " must be positive");
  finite(problem.least, "least");
  if (!(problem.slowest >= 0.0))
    refuse("slowest " + number_text(problem.slowest) + " must not be negative");
  finite(problem.slowest, "slowest");
  for (const double rate :
       {problem.ecliptic_rate.x, problem.ecliptic_rate.y, problem.ecliptic_rate.z})
    finite(rate, "a component of ecliptic_rate");
  if (problem.bodies.empty()) refuse("no bodies; one at least must pull");
  for (const NutationArgument& one : problem.arguments)
    if (!std::isfinite(one.rate) || !std::isfinite(one.at_epoch))
      refuse("the argument " + one.name + " must have a finite rate and value at the epoch");
  for (const NutationBody& one : problem.bodies) {
    if (!(one.gm > 0.0)) refuse("gm " + number_text(one.gm) + " must be positive");
    finite(one.gm, "gm");
  }
}

double size(const NutationTerm& term) {
  const NutationWave& of = term.wave;
  return std::hypot(std::hypot(of.longitude_sine, of.longitude_cosine),
                    std::hypot(of.obliquity_sine, of.obliquity_cosine));
}

// Rows of the table from sums, with the last multiplier positive.
std::vector<NutationTerm> table(const detail::Waves& waves, const std::vector<double>& rates,
                                const NutationProblem& problem) {
  std::vector<NutationTerm> terms;
  for (const auto& [multipliers, wave] : waves) {
    NutationTerm term{multipliers, 0.0, wave};
    const auto last =
        std::find_if(multipliers.rbegin(), multipliers.rend(), [](int k) { return k != 0; });
    if (last == multipliers.rend()) continue;  // the offset
    if (*last < 0) {
      for (int& k : term.multipliers) k = -k;
      term.wave.longitude_sine = -wave.longitude_sine;
      term.wave.obliquity_sine = -wave.obliquity_sine;
    }
    for (std::size_t i = 0; i < rates.size(); ++i) term.rate += term.multipliers[i] * rates[i];
    if (size(term) >= problem.least && std::abs(term.rate) >= problem.slowest)
      terms.push_back(term);
  }
  std::ranges::stable_sort(terms, [](const auto& a, const auto& b) { return size(a) > size(b); });
  return terms;
}

NutationOffset offset_of(const detail::Waves& waves, std::size_t count) {
  const auto constant = waves.find(std::vector<int>(count, 0));
  if (constant == waves.end()) return {0.0, 0.0};
  return {constant->second.longitude_cosine, constant->second.obliquity_cosine};
}

using ByMultipliers = std::map<std::vector<int>, NutationWave>;

ByMultipliers by_multipliers(const std::vector<NutationTerm>& terms) {
  ByMultipliers all;
  for (const NutationTerm& term : terms) all.emplace(term.multipliers, term.wave);
  return all;
}

NutationWave slope(const NutationWave& a, const NutationWave& b, double interval) {
  return {(b.longitude_sine - a.longitude_sine) / interval,
          (b.longitude_cosine - a.longitude_cosine) / interval,
          (b.obliquity_cosine - a.obliquity_cosine) / interval,
          (b.obliquity_sine - a.obliquity_sine) / interval};
}

}  // namespace

NutationTheory::NutationTheory(const NutationProblem& problem)
    : precession_{0.0, 0.0}, relative_offset_{0.0, 0.0}, folding_(0.0) {
  require(problem);
  const detail::NutationSymbols names(problem);
  arguments_ = names.arguments();
  for (const NutationArgument& one : problem.arguments) {
    at_epoch_.push_back(one.at_epoch);
    rates_.push_back(one.rate);
  }
  if (arguments_.size() > rates_.size()) {  // Phi
    at_epoch_.push_back(0.0);
    rates_.push_back(problem.spin_rate);
  }
  const detail::NutationTorque torque(problem, names, rates_);
  folding_ = torque.folding;
  const detail::MomentumMotion momentum = momentum_motion(problem, names, torque, rates_);
  precession_ = momentum.precession;
  const detail::WobbleMotion wobble = wobble_motion(problem, names, torque, rates_);
  if (names.has_phi()) rates_.back() = momentum.phi_rate;
  const auto axis = [&](const detail::Waves& oppolzer) {
    const detail::Waves both = detail::sum(momentum.nutation, oppolzer);
    return AxisSeries{table(both, rates_, problem), table(oppolzer, rates_, problem),
                      offset_of(both, rates_.size())};
  };
  momentum_ = axis({});
  figure_ = axis(wobble.figure);
  rotation_ = axis(wobble.rotation);
  const Vec3& mu = problem.ecliptic_rate;
  const double c = std::cos(problem.obliquity), s = std::sin(problem.obliquity);
  // The axis of w - mu less that of w, in the plane normal to the momentum.
  relative_offset_ = {-mu.x / (s * problem.spin_rate), (s * mu.z - c * mu.y) / problem.spin_rate};
}

std::string_view name(PlanetAxis axis) { return planet_axes.at(static_cast<std::size_t>(axis)); }

std::optional<PlanetAxis> planet_axis(std::string_view name) {
  const auto found = std::ranges::find(planet_axes, name);
  if (found == planet_axes.end()) return std::nullopt;
  return static_cast<PlanetAxis>(found - planet_axes.begin());
}

const NutationTheory::AxisSeries& NutationTheory::of(PlanetAxis axis) const {
  return axis == PlanetAxis::momentum ? momentum_
         : axis == PlanetAxis::figure ? figure_
                                      : rotation_;
}

const std::vector<NutationTerm>& NutationTheory::terms(PlanetAxis axis) const {
  return of(axis).terms;
}
const std::vector<NutationTerm>& NutationTheory::oppolzer_terms(PlanetAxis axis) const {
  return of(axis).oppolzer;
}
NutationOffset NutationTheory::offset(PlanetAxis axis) const { return of(axis).offset; }

NutationOffset NutationTheory::at(PlanetAxis axis, double t) const {
  NutationOffset sum = of(axis).offset;
  for (const NutationTerm& term : of(axis).terms) {
    double theta = term.rate * t;
    for (std::size_t i = 0; i < at_epoch_.size(); ++i) theta += term.multipliers[i] * at_epoch_[i];
    const double sine = std::sin(theta), cosine = std::cos(theta);
    const NutationWave &a = term.wave, &b = term.change;
    sum.longitude += (a.longitude_sine + t * b.longitude_sine) * sine +
                     (a.longitude_cosine + t * b.longitude_cosine) * cosine;
    sum.obliquity += (a.obliquity_sine + t * b.obliquity_sine) * sine +
                     (a.obliquity_cosine + t * b.obliquity_cosine) * cosine;
  }
  return sum;
}

NutationTheory NutationTheory::changing(const NutationTheory& before, const NutationTheory& after,
                                        double interval) const {
  if (before.arguments_ != arguments_ || after.arguments_ != arguments_)
    throw DomainError("NutationTheory::changing: theories with other arguments");
  if (!(interval > 0.0))
    throw DomainError("NutationTheory::changing: interval " + number_text(interval) +
                      " must be positive");
  const auto change = [&](std::vector<NutationTerm>& terms, const std::vector<NutationTerm>& first,
                          const std::vector<NutationTerm>& second) {
    const ByMultipliers from = by_multipliers(first), to = by_multipliers(second);
    for (NutationTerm& term : terms) {
      const auto a = from.find(term.multipliers), b = to.find(term.multipliers);
      if (a != from.end() && b != to.end()) term.change = slope(a->second, b->second, interval);
    }
  };
  NutationTheory with = *this;
  for (AxisSeries NutationTheory::*const axis :
       {&NutationTheory::momentum_, &NutationTheory::figure_, &NutationTheory::rotation_}) {
    change((with.*axis).terms, (before.*axis).terms, (after.*axis).terms);
    change((with.*axis).oppolzer, (before.*axis).oppolzer, (after.*axis).oppolzer);
  }
  return with;
}

}  // namespace secular
}  // namespace v0
}  // namespace polhode
