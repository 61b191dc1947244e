// SPDX-License-Identifier: MIT
#include "secular/nutation_torque.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "polhode/series/fourier.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

std::vector<std::string> names_of(const NutationProblem& problem) {
  std::vector<std::string> names;
  for (const NutationArgument& one : problem.arguments) names.push_back(one.name);
  const Vec3& moments = problem.body.moments();
  if (moments.x != moments.y) names.emplace_back("Phi");
  return names;
}

Symbols symbols_of(const std::vector<std::string>& arguments, bool has_phi) {
  std::vector<std::string> angles{NutationSymbols::h};
  angles.insert(angles.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables{NutationSymbols::x, NutationSymbols::k};
  std::vector<ConjugatePair> pairs{{NutationSymbols::h, NutationSymbols::x}};
  if (has_phi) {
    variables.emplace_back(NutationSymbols::y);
    pairs.push_back({"Phi", NutationSymbols::y});
  }
  return Symbols(std::move(variables), std::move(angles), std::move(pairs));
}

FourierSeries analysed(const NutationProblem& problem, const NutationSymbols& names) {
  std::vector<FourierAngle> angles;
  for (const NutationArgument& one : problem.arguments) angles.push_back({one.name, one.points});
  return fourier_series(names.symbols(), angles, [&](std::span<const double> at) {
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
Series<double> sifted(const Series<double>& q, const NutationProblem& problem, double dust,
                      const std::vector<double>& rates) {
  const double per_torque = 3.0 / problem.spin_rate / std::sin(problem.obliquity);
  std::vector<Term<double>> kept;
  for (const Term<double>& term : q.terms()) {
    const double rate = std::abs(rate_of(q.symbols(), term.key, rates));
    const bool matters = std::abs(term.c) * per_torque >= 0.1 * problem.least * rate;
    if (std::abs(term.c) > dust && matters) kept.push_back(term);
  }
  return Series<double>(q.symbols(), std::move(kept));
}

double largest(const Series<double>& q) {
  double size = 0.0;
  for (const Term<double>& term : q.terms()) size = std::max(size, std::abs(term.c));
  return size;
}

}  // namespace

NutationSymbols::NutationSymbols(const NutationProblem& problem)
    : arguments_(names_of(problem)),
      given_(problem.arguments.size()),
      symbols_(symbols_of(arguments_, has_phi())) {}

double rate_of(const Symbols& symbols, const TermKey& key, const std::vector<double>& rates) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rates.size(); ++i)
    sum += multiplier(symbols, key, static_cast<int>(i) + 1) * rates[i];  // after h
  return sum;
}

NutationTorque::NutationTorque(const NutationProblem& problem, const NutationSymbols& names,
                               const std::vector<double>& rates)
    : q0(names.symbols()), q1{q0, q0}, q2{q0, q0}, folding(0.0) {
  FourierSeries found = analysed(problem, names);
  double size = 0.0;
  for (const Series<double>& one : found.series) size = std::max(size, largest(one));
  folding = found.at_border / size;
  constexpr double rounding = 1e-14;
  for (Series<double>& one : found.series) one = sifted(one, problem, rounding * size, rates);
  q0 = found.series[0];
  q1 = {found.series[1], found.series[2]};
  q2 = {found.series[3], found.series[4]};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
