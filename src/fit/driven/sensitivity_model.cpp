// SPDX-License-Identifier: MIT
// The variational equations. With w = I^-1 g, an unknown that changes a moment changes w by
// I^-1 (dg - w dI), and the terms see the state (q, g + dg - w dI) of a body that is as it was;
// what the moments do to them at a fixed w comes in addition, and what a parameter does.
#include "fit/driven/sensitivity_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/finite.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Of the moments of a sphere, to bodies that have one more of them.
constexpr double growth = 0.5;

Body grown(double moment, int k) {
  Vec3 I{moment, moment, moment};
  I[k] *= 1.0 + growth;
  return {I.x, I.y, I.z};
}

Tangent tangent(const std::array<double, SensitivityState::size>& y, std::size_t n) {
  Tangent x(y[n]);
  for (std::size_t c = 0; c < 6; ++c) x.derivative[c] = y[7 * (c + 1) + n];
  return x;
}

void put(std::array<double, SensitivityState::size>& y, std::size_t n, const Tangent& x) {
  y[n] = x.value;
  for (std::size_t c = 0; c < 6; ++c) y[7 * (c + 1) + n] = x.derivative[c];
}

TangentRotor dual(const std::array<double, SensitivityState::size>& y) {
  const auto n = [&](std::size_t i) { return tangent(y, i); };
  return {{n(0), n(1), n(2), n(3)}, {n(4), n(5), n(6)}};
}

std::array<double, SensitivityState::size> numbers(const BasicQuaternion<Tangent>& q,
                                                   const BasicVec3<Tangent>& g) {
  std::array<double, SensitivityState::size> y{};
  const Tangent* const all[7] = {&q.w, &q.x, &q.y, &q.z, &g.x, &g.y, &g.z};
  for (std::size_t n = 0; n < 7; ++n) put(y, n, *all[n]);
  return y;
}

double largest(const std::array<double, SensitivityState::size>& y, std::size_t from,
               std::size_t count) {
  double r = 0.0;
  for (std::size_t i = from; i < from + count; ++i) r = larger(r, std::abs(y[i]));
  return r;
}

// An error of a column that is 0 is relative to nothing, but it may be no number.
double over(double error, double size) { return size > 0.0 || error != error ? error / size : 0.0; }

}  // namespace

TangentRotor tangent_rotor(const SensitivityState& s) { return dual(s.y); }
SensitivityState sensitivity_state(const TangentRotor& s) { return {numbers(s.q, s.g)}; }

Effect effect_at_rate(const std::vector<AnyPerturbation>& terms, const Body& body,
                      const Setting& at, const Vec3& w) {
  const Vec3& I = body.moments();
  const Setting there{body, at.t, {at.s.q, {I.x * w.x, I.y * w.y, I.z * w.z}}, at.q_IS, at.t_rest};
  Effect sum;
  for (const AnyPerturbation& term : terms) sum = sum + term.effect(there);
  return sum;
}

SensitivityModel::SensitivityModel(System system, std::array<SensitivityTerm, 6> terms)
    : system_(std::move(system)),
      terms_(std::move(terms)),
      sphere_(system_.body().moments().z, system_.body().moments().z, system_.body().moments().z),
      grown_{grown(sphere_.moments().z, 0), grown(sphere_.moments().z, 1),
             grown(sphere_.moments().z, 2)} {
  for (const AnyPerturbation& term : system_.terms()) {
    time_scale_ = std::min(time_scale_, term.time_scale());
  }
}

SensitivityModel::State SensitivityModel::state(const Values& y) const {
  TangentRotor s = dual(y);
  s.q = normalized(s.q);
  return sensitivity_state(s);
}

Effect SensitivityModel::by_moment(int k, const Setting& at, const Vec3& w) const {
  const auto i = static_cast<std::size_t>(k);
  const Effect one = effect_at_rate(system_.terms(), sphere_, at, w);
  const Effect more = effect_at_rate(system_.terms(), grown_[i], at, w);
  const double by = 1.0 / (growth * sphere_.moments().z);
  return {by * (more.v - one.v), by * (more.u - one.u)};
}

SensitivityModel::Motion SensitivityModel::motion(const DoubleDouble& t, const Values& y) const {
  Motion m{dual(y), {}, {}};
  const Vec3& I = system_.body().moments();
  const Vec3 w{y[4] / I.x, y[5] / I.y, y[6] / I.z};
  TangentRotor seen = m.s;
  for (std::size_t c = 0; c < 6; ++c) {
    const SensitivityTerm& by = terms_[c];
    if (by.moment) seen.g[*by.moment].derivative[c] -= by.moment_rate * w[*by.moment];
  }
  m.w0 = {seen.g.x / I.x, seen.g.y / I.y, seen.g.z / I.z};
  const std::vector<AnyPerturbation>& terms = system_.terms();
  const BasicSetting<Tangent> at{system_.body(), Tangent(t.hi), seen,
                                 constant<double, 6>(Quaternion{}), Tangent(t.lo)};
  for (const AnyPerturbation& term : terms) m.e = m.e + term.effect(at);
  const Setting here{
      system_.body(), t.hi, {{y[0], y[1], y[2], y[3]}, {y[4], y[5], y[6]}}, {}, t.lo};
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

SensitivityModel::Values SensitivityModel::rates(const DoubleDouble& t, const Values& y) const {
  const Motion m = motion(t, y);
  const BasicRotorRates<Tangent> r = inertial_rates(m.s, m.w0, m.e);
  return numbers(r.q, r.g);
}

BasicVec3<Tangent> SensitivityModel::rate(double t, const State& s) const {
  const Motion m = motion(DoubleDouble(t), s.y);
  return m.w0 + m.e.v;
}

// As that of a rotor with derivatives: relative to |q| = 1, |g| and the size of each column, that
// of a step included, since columns of torques begin at 0.
double SensitivityModel::error_size(const Values& error, const Values& y,
                                    const Values& increment) const {
  const double g = largest(y, 4, 3) + largest(increment, 4, 3);
  double size = larger(largest(error, 0, 4), over(largest(error, 4, 3), g));
  for (std::size_t c = 7; c < y.size(); c += 7) {
    const double column = largest(y, c, 4) + largest(increment, c, 4) +
                          over(largest(y, c + 4, 3) + largest(increment, c + 4, 3), g);
    size = larger(size, over(largest(error, c, 4), column));
    size = larger(size, over(largest(error, c + 4, 3), g * column));
  }
  return size;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
