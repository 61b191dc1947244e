// SPDX-License-Identifier: MIT
// The variational equations. With w = I^-1 g, an unknown that changes a moment changes w by
// I^-1 (dg - w dI), and the terms see the state (q, g + dg - w dI) of a body that is as it was;
// what the moments do to them at a fixed w comes in addition, and what a parameter does.
#include "fit/driven/sensitivity_field.hpp"

#include <cmath>
#include <utility>

#include "math/finite.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {
namespace {

// Relative increase of one moment of the sphere.
constexpr double growth = 0.5;

Body grown(double moment, int k) {
  Vec3 I{moment, moment, moment};
  I[k] *= 1.0 + growth;
  return {I.x, I.y, I.z};
}

// The largest of `count` numbers, at intervals of `apart`.
double largest(const polhode::detail::ColumnValues& y, std::size_t from, std::size_t count,
               std::size_t apart = 1) {
  double r = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    r = polhode::detail::larger(r, std::abs(y[from + i * apart]));
  return r;
}

// An error of a column that is 0 is relative to nothing, but it may be no number.
double over(double error, double size) { return size > 0.0 || error != error ? error / size : 0.0; }

}  // namespace

Effect effect_at_rate(const std::vector<AnyPerturbation>& terms, const Body& body,
                      const Setting& at, const Vec3& w) {
  const Vec3& I = body.moments();
  const Setting there{body, at.t, {at.s.q, {I.x * w.x, I.y * w.y, I.z * w.z}}, at.q_IS, at.t_rest};
  Effect sum;
  for (const AnyPerturbation& term : terms) sum = sum + term.effect(there);
  return sum;
}

SensitivityField::SensitivityField(const System& system, std::array<SensitivityTerm, 6> terms)
    : AugmentedField(system),
      terms_(std::move(terms)),
      sphere_(system.body().moments().z, system.body().moments().z, system.body().moments().z),
      grown_{grown(sphere_.moments().z, 0), grown(sphere_.moments().z, 1),
             grown(sphere_.moments().z, 2)} {}

Effect SensitivityField::by_moment(int k, const Setting& at, const Vec3& w) const {
  const auto i = static_cast<std::size_t>(k);
  const Effect one = effect_at_rate(system().terms(), sphere_, at, w);
  const Effect more = effect_at_rate(system().terms(), grown_[i], at, w);
  const double by = 1.0 / (growth * sphere_.moments().z);
  return {by * (more.v - one.v), by * (more.u - one.u)};
}

SensitivityField::Motion SensitivityField::motion(const DoubleDouble& t, const Values& y,
                                                  const SwitchSides* sides) const {
  Motion m{polhode::detail::rotor_state<Tangent>(polhode::detail::dual_values(y)), {}, {}};
  const Body& body = system().body();
  const Vec3& I = body.moments();
  const Vec3 w{y[4] / I.x, y[5] / I.y, y[6] / I.z};
  TangentRotor seen = m.s;
  for (std::size_t c = 0; c < 6; ++c) {
    const SensitivityTerm& by = terms_[c];
    if (by.moment) seen.g[*by.moment].derivative[c] -= by.moment_rate * w[*by.moment];
  }
  m.w0 = {seen.g.x / I.x, seen.g.y / I.y, seen.g.z / I.z};
  const std::vector<AnyPerturbation>& terms = system().terms();
  const BasicSetting<Tangent> at{body, Tangent(t.hi), seen,
                                 polhode::detail::constant<double, 6>(Quaternion{}), Tangent(t.lo)};
  m.e = sum_of_terms(system(), at, sides);
  const Setting here{body, t.hi, polhode::detail::rotor_state<double>(y), {}, t.lo};
  std::vector<Effect> now;
  for (std::size_t c = 0; c < 6; ++c) {
    const SensitivityTerm& by = terms_[c];
    Effect change;
    if (by.moment) {
      const Effect of_moment = by_moment(*by.moment, here, w);
      change = {by.moment_rate * of_moment.v, by.moment_rate * of_moment.u};
    } else if (!by.stepped.empty()) {
      for (std::size_t i = now.size(); i < terms.size(); ++i) now.push_back(terms[i].effect(here));
      for (std::size_t i = 0; i < terms.size(); ++i) {
        const Effect then = by.stepped[i].effect(here);
        change = change + Effect{(1.0 / by.step) * (then.v - now[i].v),
                                 (1.0 / by.step) * (then.u - now[i].u)};
      }
    } else {
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      m.e.v[k].derivative[c] += change.v[k];
      m.e.u[k].derivative[c] += change.u[k];
    }
  }
  return m;
}

SensitivityField::Values SensitivityField::operator()(const DoubleDouble& t, const Values& y,
                                                      const SwitchSides* sides) const {
  const Motion m = motion(t, y, sides);
  const BasicRotorRates<Tangent> r = inertial_rates(m.s, m.w0, m.e);
  return polhode::detail::column_values(polhode::detail::rotor_values<Tangent>({r.q, r.g}));
}

BasicVec3<Tangent> SensitivityField::rate(double t, const TangentRotor& s) const {
  const Motion m = motion(
      DoubleDouble(t), polhode::detail::column_values(polhode::detail::rotor_values(s)), nullptr);
  return m.w0 + m.e.v;
}

// As that of a rotor with derivatives: relative to |q| = 1, |g| and the size of each column, that
// of a step included, since columns of torques begin at 0.
double SensitivityField::error_size(const Values& error, const Values& y,
                                    const Values& increment) const {
  const double g = largest(y, 4, 3) + largest(increment, 4, 3);
  double size = polhode::detail::larger(largest(error, 0, 4), over(largest(error, 4, 3), g));
  for (std::size_t c = 0; c < 6; ++c) {
    const auto dq = [c](const Values& of) {
      return largest(of, polhode::detail::column_place(0, c), 4, 6);
    };
    const auto dg = [c](const Values& of) {
      return largest(of, polhode::detail::column_place(4, c), 3, 6);
    };
    const double column = dq(y) + dq(increment) + over(dg(y) + dg(increment), g);
    size = polhode::detail::larger(size, over(dq(error), column));
    size = polhode::detail::larger(size, over(dg(error), g * column));
  }
  return size;
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
