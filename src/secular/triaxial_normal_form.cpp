// SPDX-License-Identifier: MIT
#include "polhode/secular/triaxial_normal_form.hpp"

#include <array>
#include <string>
#include <string_view>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/secular/lie_transform.hpp"

namespace polhode {
inline namespace v0 {
namespace {

Symbols symbols() { return Symbols({"L", "G", "e"}, {"l", "g"}, {{"l", "L"}, {"g", "G"}}); }

LieTransform<Rational> transform_of(int order) {
  if (order < 1 || order > 16)
    throw DomainError("TriaxialNormalForm: order " + std::to_string(order) +
                      " must be from 1 to 16");
  const Symbols s = symbols();
  const auto G2_less_L2 =
      monomial(s, Rational(1), {{"G", 2}}) - monomial(s, Rational(1), {{"L", 2}});
  const auto wave = cosine(s, Rational(1, 2), {{"e", 1}}, {{"l", 2}});
  return LieTransform<Rational>(
      {monomial(s, Rational(-1, 2), {{"L", 2}}) - wave * G2_less_L2, {{{"e", 1}}, order}, {"l"}});
}

CompiledSeries compiled(const Series<Rational>& a) { return CompiledSeries(to_doubles(a)); }

}  // namespace

struct TriaxialNormalForm::Parts {
  LieTransform<Rational> transform;
  Map map(bool back) const {
    const auto of = [&](std::string_view name) {
      return compiled(back ? transform.short_period_back(name) : transform.short_period(name));
    };
    return {of("l"), of("g"), of("L")};
  }
};

TriaxialNormalForm::TriaxialNormalForm(const Body& body, int order)
    : TriaxialNormalForm(body, Parts{transform_of(order)}) {}

TriaxialNormalForm::TriaxialNormalForm(const Body& body, const Parts& parts)
    : a_(0.5 * (1.0 / body.moments().x + 1.0 / body.moments().y)),
      b_(a_ - 1.0 / body.moments().z),
      e_(0.5 * (1.0 / body.moments().x - 1.0 / body.moments().y) / b_),
      series_(parts.transform.mean_hamiltonian()),
      h_(compiled(series_)),
      dh_dL_(compiled(derivative(series_, "L"))),
      dh_dG_(compiled(derivative(series_, "G"))),
      to_mean_(parts.map(true)),
      to_osculating_(parts.map(false)) {
  const Vec3& m = body.moments();
  if (!(m.x <= m.y && m.y < m.z))
    throw DomainError("TriaxialNormalForm: moments (" + detail::number_text(m.x) + ", " +
                      detail::number_text(m.y) + ", " + detail::number_text(m.z) +
                      ") must rise, A <= B < C");
}

double TriaxialNormalForm::energy(double L, double G) const {
  const std::array<double, 5> at = {L, G, e_, 0.0, 0.0};
  return 0.5 * a_ * G * G + b_ * h_.at(at);
}

RotorFrequencies TriaxialNormalForm::frequencies(double L, double G) const {
  const std::array<double, 5> at = {L, G, e_, 0.0, 0.0};
  return {b_ * dh_dL_.at(at), a_ * G + b_ * dh_dG_.at(at)};
}

AndoyerState TriaxialNormalForm::displaced(const AndoyerState& s, const Map& by) const {
  const std::array<double, 5> at = {s.L, s.G, e_, s.l, s.g};
  AndoyerState moved = s;
  moved.l += by.l.at(at);
  moved.g += by.g.at(at);
  moved.L += by.L.at(at);
  return moved;
}

AndoyerState TriaxialNormalForm::mean(const AndoyerState& osculating) const {
  return displaced(osculating, to_mean_);
}
AndoyerState TriaxialNormalForm::osculating(const AndoyerState& mean) const {
  return displaced(mean, to_osculating_);
}

}  // namespace v0
}  // namespace polhode
