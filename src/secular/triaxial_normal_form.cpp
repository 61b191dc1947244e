// SPDX-License-Identifier: MIT
#include "polhode/secular/triaxial_normal_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/secular/lie_transform.hpp"
#include "polhode/series/product.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace {

series::Symbols symbols() {
  return series::Symbols({"L", "G", "e"}, {"l", "g"}, {{"l", "L"}, {"g", "G"}});
}

LieTransform<series::Rational> transform_of(int order) {
  if (order < 1 || order > 16)
    throw DomainError("TriaxialNormalForm: order " + std::to_string(order) +
                      " must be from 1 to 16");
  const series::Symbols s = symbols();
  const auto G2_less_L2 = series::monomial(s, series::Rational(1), {{"G", 2}}) -
                          series::monomial(s, series::Rational(1), {{"L", 2}});
  const auto wave = series::cosine(s, series::Rational(1, 2), {{"e", 1}}, {{"l", 2}});
  return LieTransform<series::Rational>(
      {series::monomial(s, series::Rational(-1, 2), {{"L", 2}}) - wave * G2_less_L2,
       {{{"e", 1}}, order},
       {"l"}});
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

series::CompiledSeries compiled(const series::Series<series::Rational>& a) {
  return series::CompiledSeries(series::to_doubles(a));
}

}  // namespace

struct TriaxialNormalForm::Parts {
  LieTransform<series::Rational> transform;
  int order;

  Expansion expansion(const series::Series<series::Rational>& a) const {
    const auto part = [&](int n) {
      return compiled(series::part_of_order(a, series::Truncation{{{"e", 1}}, order}, n));
    };
    return {compiled(a), part(order), part(order - 1)};
  }
  Map map(bool back) const {
    const auto of = [&](std::string_view name) {
      return expansion(back ? transform.short_period_back(name) : transform.short_period(name));
    };
    return {of("l"), of("g"), of("L")};
  }
};

// The terms that are left out, as a geometric series after the last one.
double TriaxialNormalForm::Expansion::remainder(std::span<const double> at, double ratio) const {
  const double term = std::max(std::fabs(last.at(at)), ratio * std::fabs(last_but_one.at(at)));
  return ratio < 1.0 ? term * ratio / (1.0 - ratio) : nan;
}

TriaxialNormalForm::TriaxialNormalForm(const Body& body, int order)
    : TriaxialNormalForm(body, Parts{transform_of(order), order}) {}

TriaxialNormalForm::TriaxialNormalForm(const Body& body, const Parts& parts)
    : a_(0.5 * (1.0 / body.moments().x + 1.0 / body.moments().y)),
      b_(a_ - 1.0 / body.moments().z),
      e_(0.5 * (1.0 / body.moments().x - 1.0 / body.moments().y) / b_),
      series_(parts.transform.mean_hamiltonian()),
      h_(compiled(series_)),
      dh_dL_(parts.expansion(series::derivative(series_, "L"))),
      dh_dG_(parts.expansion(series::derivative(series_, "G"))),
      to_mean_(parts.map(true)),
      to_osculating_(parts.map(false)) {
  const Vec3& m = body.moments();
  if (!(m.x <= m.y && m.y < m.z))
    throw DomainError("TriaxialNormalForm: moments (" + polhode::detail::number_text(m.x) + ", " +
                      polhode::detail::number_text(m.y) + ", " + polhode::detail::number_text(m.z) +
                      ") must rise, A <= B < C");
}

// Where the action or its derivative by the energy is singular in the plane of complex e: at its
// separatrix, and at that of -e.
double TriaxialNormalForm::ratio_of_osculating(const AndoyerState& s) const {
  const double G2 = s.G * s.G, L2 = s.L * s.L;
  return e_ * (G2 + (G2 - L2) * std::fabs(std::cos(2.0 * s.l))) / L2;
}
// On the separatrix the action I_l is 2/pi asin(sqrt(2 e/(1 + e))) of I_g.
double TriaxialNormalForm::ratio_of_mean(double L, double G) const {
  const double sine = std::sin(0.5 * std::numbers::pi * L / G), k = sine * sine;
  return e_ * (2.0 - k) / k;
}

double TriaxialNormalForm::energy(double L, double G) const {
  if (!(ratio_of_mean(L, G) < 1.0)) return nan;
  const std::array<double, 5> at = {L, G, e_, 0.0, 0.0};
  return 0.5 * a_ * G * G + b_ * h_.at(at);
}

RotorFrequencies TriaxialNormalForm::frequencies(double L, double G) const {
  if (!(ratio_of_mean(L, G) < 1.0)) return {nan, nan};
  const std::array<double, 5> at = {L, G, e_, 0.0, 0.0};
  return {b_ * dh_dL_.sum.at(at), a_ * G + b_ * dh_dG_.sum.at(at)};
}
double TriaxialNormalForm::frequency_error(double L, double G) const {
  const std::array<double, 5> at = {L, G, e_, 0.0, 0.0};
  const double ratio = ratio_of_mean(L, G);
  const RotorFrequencies n = frequencies(L, G);
  return std::max(b_ * dh_dL_.remainder(at, ratio) / std::fabs(n.n_l),
                  b_ * dh_dG_.remainder(at, ratio) / std::fabs(n.n_g));
}

AndoyerState TriaxialNormalForm::displaced(const AndoyerState& s, const Map& by,
                                           double ratio) const {
  const std::array<double, 5> at = {s.L, s.G, e_, s.l, s.g};
  AndoyerState moved = s;
  const bool converges = ratio < 1.0;
  moved.l += converges ? by.l.sum.at(at) : nan;
  moved.g += converges ? by.g.sum.at(at) : nan;
  moved.L += converges ? by.L.sum.at(at) : nan;
  return moved;
}
double TriaxialNormalForm::remainder(const AndoyerState& s, const Map& of, double ratio) const {
  const std::array<double, 5> at = {s.L, s.G, e_, s.l, s.g};
  return std::max(
      {of.l.remainder(at, ratio), of.g.remainder(at, ratio), of.L.remainder(at, ratio) / s.G});
}

AndoyerState TriaxialNormalForm::mean(const AndoyerState& s) const {
  const double G2 = s.G * s.G, L2 = s.L * s.L;
  if (L2 < e_ * (G2 - (G2 - L2) * std::cos(2.0 * s.l)))
    throw DomainError("TriaxialNormalForm: the state (l, L, G) = " +
                      polhode::detail::tuple_text({s.l, s.L, s.G}) +
                      " is in long-axis mode; the series are those of short-axis mode");
  return displaced(s, to_mean_, ratio_of_osculating(s));
}
AndoyerState TriaxialNormalForm::osculating(const AndoyerState& mean) const {
  return displaced(mean, to_osculating_, ratio_of_mean(mean.L, mean.G));
}
double TriaxialNormalForm::mean_error(const AndoyerState& osculating) const {
  return remainder(osculating, to_mean_, ratio_of_osculating(osculating));
}
double TriaxialNormalForm::osculating_error(const AndoyerState& mean) const {
  return remainder(mean, to_osculating_, ratio_of_mean(mean.L, mean.G));
}

}  // namespace secular
}  // namespace v0
}  // namespace polhode
