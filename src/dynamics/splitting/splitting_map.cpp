// SPDX-License-Identifier: MIT
// One step of a splitting as a map, and torques that jump within it.
#include "dynamics/splitting/splitting_map.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "dynamics/adaptive/switching_functions.hpp"
#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/detail/time_zeros.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

constexpr double largest_momentum = 1e140;  // its square has room to spare
// Radians per unit of time, and in one arc that a quaternion of doubles does not see: a body that a
// damping has brought to rest. Squares of its momentum would leave the range of a double.
constexpr double slowest = 1e-28;
constexpr double shortest_arc = 1e-20;
// What is left of a component, as a rate, whose square would do so: nothing.
constexpr double smallest_part = 1e-150;
// A step beyond this many radians has lost its phase to rounding, and no kick can follow.
constexpr double largest_arc = 0x1p20;

bool is_finite_state(const SplittingState& s) {
  return has_finite_numbers(RotorState{s.q_IB, s.g.hi});
}

// The parts of a step of h in turn: drift(a part of h in two terms), kick(a part of h).
template <class Drift, class Kick>
void each_part(const SplittingCoefficients& of, double h, const Drift& drift, const Kick& kick) {
  for (std::size_t i = 0; i < of.drifts.size() + of.kicks.size(); ++i) {
    if ((i % 2 == 0) == of.drift_first)
      drift(two_prod(of.drifts[i / 2], h));
    else
      kick(of.kicks[i / 2] * h);
  }
}

// The momentum at the end of a flow, keeping the low part where the flow leaves g as it is.
TwoPartMomentum replaced(const TwoPartMomentum& g, const Vec3& now) { return g + (now - g.hi); }

}  // namespace

void SplittingMap::serialize(Archive& bytes, SplittingState& s) {
  bytes.all(s.t, s.q_IB, s.g.hi, s.g.lo, s.evaluations);
  bool has_torque = s.torque.has_value();
  bytes(has_torque);
  if (!has_torque) return s.torque.reset();
  if (!s.torque) s.torque.emplace();
  bytes.all(s.torque->constant, s.torque->damping);
}

SplittingMap::SplittingMap(const System& system, SplittingScheme scheme)
    : system_(system), free_(system.body()) {
  for (const AnyPerturbation& term : system_.terms()) {
    if (term.is_kick()) {
      kicks_.push_back(term);
    } else if (term.is_affine()) {
      affine_.push_back(term);
    } else if (term.supports_flow()) {
      flows_.push_back(term);
    } else {
      throw DomainError("Splitting: term \"" + term.name() +
                        "\" has no exact flow: use Adaptive, which needs none");
    }
  }
  if (!flows_.empty()) {
    flows_.insert(flows_.end(), affine_.begin(), affine_.end());
    affine_.clear();
  }
  const bool exact = flows_.empty() || (kicks_.empty() && flows_.size() == 1);
  coefficients_ = splitting_coefficients(scheme, exact);
  composed_ = {1.0};
  if (!exact && !composes_order2(scheme)) {
    // Three symmetric steps of order 2 make one of order 4 (Yoshida 1990).
    const double outer = 1.0 / (2.0 - std::cbrt(2.0));
    composed_ = {outer, 1.0 - 2.0 * outer, outer};
  }
}

SplittingState SplittingMap::start(double t, const RotorState& s) const {
  const Quaternion q = normalized(s.q);
  return {{t, 0.0},
          system_.frame().is_inertial() ? q : system_.frame().at(t).q_IS * q,
          {s.g, {}},
          std::nullopt,
          0};
}

SystemState SplittingMap::state(const SplittingState& s) const {
  if (system_.frame().is_inertial()) return {normalized(s.q_IB), s.g.hi};
  return {normalized(conj(system_.frame().at(s.t.hi).q_IS) * s.q_IB), s.g.hi};
}

double SplittingMap::rate(const SplittingState& s) const {
  const Vec3& I = system_.body().moments();
  const Vec3& g = s.g.hi;
  return larger(std::abs(g.x / I.x), std::abs(g.y / I.y), std::abs(g.z / I.z));
}

Setting SplittingMap::setting(const SplittingState& s, const Quaternion& q_IS) const {
  return {system_.body(), s.t.hi, {conj(q_IS) * s.q_IB, s.g.hi}, q_IS, s.t.lo};
}

std::string SplittingMap::term_not_finite(const SplittingState& s) const {
  const Quaternion q_IS = system_.frame().at(s.t.hi).q_IS;
  for (const AnyPerturbation& term : system_.terms()) {
    const Effect e = term.effect(setting(s, q_IS));
    if (!is_finite(e.u) || !is_finite(e.v)) return term.name();
  }
  return "";
}

bool SplittingMap::is_at_rest(const SplittingState& s, double time) const {
  const double fastest = rate(s);
  return fastest < slowest && fastest * std::abs(time) < shortest_arc;
}

void SplittingMap::drift(SplittingState& s, const TwoTerms<double>& time) const noexcept {
  // |g|^2 would be no number: the state says it
  const Vec3& g = s.g.hi;
  if (!(larger(std::abs(g.x), std::abs(g.y), std::abs(g.z)) < largest_momentum)) {
    s.g.hi.x = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  if (!is_at_rest(s, time.hi)) {
    for (int i = 0; i < 3; ++i)
      if (std::abs(s.g.hi[i]) < smallest_part * system_.body().moments()[i])
        s.g.hi[i] = s.g.lo[i] = 0.0;
    const ShortFlow::Arc arc = free_.after(s.g, time.hi, time.lo);
    const Quaternion q = s.q_IB * arc.turn;
    const double f = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    s.q_IB = {f * q.w, f * q.x, f * q.y, f * q.z};
    s.g = arc.g;
  }
  const TwoTerms<double> t = two_sum(s.t.hi, time.hi);
  s.t = quick_two_sum(t.hi, t.lo + (s.t.lo + time.lo));
  s.torque.reset();
}

AffineTorque SplittingMap::torque(SplittingState& s) const {
  const Setting at = setting(s, system_.frame().at(s.t.hi).q_IS);
  AffineTorque sum;
  for (const AnyPerturbation& term : affine_) sum = sum + term.affine_torque(at);
  for (const AnyPerturbation& term : kicks_) sum.constant = sum.constant + term.effect(at).u;
  ++s.evaluations;
  return sum;
}

void SplittingMap::kick(SplittingState& s, double h) const {
  if (!flows_.empty()) {
    for (const double fraction : composed_) composed_kick(s, fraction * h);
    return;
  }
  if (kicks_.empty() && affine_.empty()) return;
  if (!s.torque) s.torque = torque(s);
  s.g = s.g + (affine_.empty() ? h * s.torque->constant : change_of_momentum(*s.torque, s.g.hi, h));
}

void SplittingMap::composed_kick(SplittingState& s, double h) const {
  if (kicks_.empty() && flows_.size() == 1) {
    flow(s, flows_[0], h);
    return;
  }
  for (const AnyPerturbation& term : flows_) flow(s, term, 0.5 * h);
  if (!kicks_.empty()) s.g = s.g + h * torque(s).constant;
  for (std::size_t i = flows_.size(); i-- > 0;) flow(s, flows_[i], 0.5 * h);
}

void SplittingMap::flow(SplittingState& s, const AnyPerturbation& term, double h) const {
  const Quaternion q_IS = system_.frame().at(s.t.hi).q_IS;
  const RotorState after = term.flow(setting(s, q_IS), h);
  s.q_IB = normalized(q_IS * after.q);
  s.g = replaced(s.g, after.g);
  ++s.evaluations;
}

SplittingState SplittingMap::stepped(SplittingState s, double h) const {
  each_part(
      coefficients_, h, [&](const TwoTerms<double>& time) { drift(s, time); },
      [&](double part) { kick(s, part); });
  return s;
}

// q -> q exp(dtheta_B / 2) moves the torque, and nothing else does.
Matrix6 SplittingMap::kick_transition(const SplittingState& s, double h) const {
  const BasicSetting<Tangent> at = with_variables(setting(s, system_.frame().at(s.t.hi).q_IS));
  Matrix6 M = Matrix6::identity();
  for (const AnyPerturbation& term : kicks_) {
    const BasicEffect<Tangent> e = term.effect(at);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) M(3 + i, j) += h * e.u[i].derivative[static_cast<std::size_t>(j)];
  }
  return M;
}

bool SplittingMap::may_grow_backwards() const {
  const auto is_negative = [](double c) { return c < 0.0; };
  const bool backwards =
      std::any_of(coefficients_.kicks.begin(), coefficients_.kicks.end(), is_negative) ||
      std::any_of(composed_.begin(), composed_.end(), is_negative);
  return backwards && !(flows_.empty() && affine_.empty());
}

void SplittingMap::require_kicks() const {
  const std::vector<AnyPerturbation>& others = flows_.empty() ? affine_ : flows_;
  if (!others.empty())
    throw DomainError("Splitting: the flow of term \"" + others[0].name() +
                      "\" has no derivative: use Adaptive for state transitions");
}

std::string SplittingMap::obstacle(const SplittingState& s, double h) const {
  const double arc = rate(s) * std::abs(h);
  if (!(arc > largest_arc)) return {};
  return "step " + number_text(std::abs(h)) + " is " + number_text(std::rint(arc)) +
         " radians of rotation at t = " + number_text(s.t.hi) + ": take a step of less than a turn";
}

// The step that failed is gone through again in small pieces.
std::string SplittingMap::failure(const SplittingState& from, const SplittingState& to) const {
  if (is_finite_state(to)) return {};
  const double piece = (to.t.hi - from.t.hi) / 16.0;
  SplittingState s = from;
  std::string name = term_not_finite(s);
  for (int i = 0; name.empty() && i < 16; ++i) {  // 16 trips
    SplittingState tried = stepped(s, piece);
    if (is_finite_state(tried)) {
      s = tried;
      name = term_not_finite(s);
    } else {
      s.t.hi += piece;
      name = term_not_finite(s);
      break;
    }
  }
  const std::string place = "t = " + number_text(s.t.hi);
  if (!name.empty())
    return "term \"" + name + "\" is not finite near " + place + ": check it there, or stop before";
  if (may_grow_backwards())
    return "the state is not finite near " + place +
           ": a part of a step of this scheme goes back in time, where a strong damping grows: "
           "take a smaller step, or the scheme order 2";
  return "the state is not finite near " + place +
         ": take a smaller step, or see whether a term grows without bound";
}

Matrix6 SplittingMap::step_transition(SplittingState s, double h) const {
  require_kicks();
  Matrix6 M = Matrix6::identity();
  each_part(
      coefficients_, h,
      [&](const TwoTerms<double>& time) {
        const Vec3 g = is_at_rest(s, time.hi) ? Vec3{} : s.g.hi;
        M = FreeRotation::short_arc(system_.body(), {s.q_IB, g}).state_transition(time.hi) * M;
        drift(s, time);
      },
      [&](double part) {
        M = kick_transition(s, part) * M;
        kick(s, part);
      });
  return M;
}

// A turn of the start turns the whole arc; what a change of the momentum does is ShortFlow's.
HubDirection SplittingMap::after_drift(const HubDirection& d, const SplittingState& s,
                                       double h) const {
  const Vec3 g = is_at_rest(s, h) ? Vec3{} : s.g.hi;
  const Quaternion arc = free_.plain(g, h).turn;
  const FlowTangent<double> change = free_.tangent(g, d.momentum, h, arc);
  return {rotate(conj(arc), d.turn) + change.attitude, change.momentum};
}

HubDirection SplittingMap::after_kick(HubDirection d, const SplittingState& s, double h) const {
  const Setting at = setting(s, system_.frame().at(s.t.hi).q_IS);
  const BasicSetting<Tangent> moving = moving_along(at, {d.turn, {}});
  for (const AnyPerturbation& term : kicks_)
    d.momentum = d.momentum + h * slope_of(term.effect(moving).u);
  return d;
}

DeviationStep SplittingMap::step_deviation(SplittingState s, HubDirection d, double h) const {
  require_kicks();
  each_part(
      coefficients_, h,
      [&](const TwoTerms<double>& time) {
        d = after_drift(d, s, time.hi);
        drift(s, time);
      },
      [&](double part) {
        d = after_kick(d, s, part);
        kick(s, part);
      });
  return {std::move(s), d};
}

std::string StepJumps::seen(const SplittingMap& map, const SplittingState& from,
                            const SplittingState& to) {
  if (!switches_.is_needed()) return {};
  // A kink is distinguished from a jump where the change of torque is 1e-6 of what it is at the
  // ends.
  constexpr double close = 1e-9;
  const auto time = [](const SplittingState& s) { return DoubleDouble(s.t.hi, s.t.lo); };
  if (!has_begun_) {
    if (std::string nan = switches_.begin(time(from), map.state(from)); !nan.empty()) return nan;
    has_begun_ = true;
  }
  if (switches_.size() == 0) return {};
  const double h = (to.t.hi - from.t.hi) + (to.t.lo - from.t.lo);
  const RotorState end = map.state(to);
  const std::vector<double> values = switches_.values(time(to), end);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) return switches_.nan_text(i, to.t.hi);
    if (!(values[i] < -switches_.rounding(i))) continue;
    const auto value = [&](double x) {
      const SplittingState s = map.stepped(from, x * h);
      return switches_.values(time(s), map.state(s))[i];
    };
    const auto root = root_between(value, {0.0, -values[i], 0.0}, {1.0, values[i], 0.0}, close);
    if (!root) return switches_.nan_text(i, to.t.hi);
    const SplittingState edge = map.stepped(from, root->t * h);
    std::string refused =
        switches_.refused_jump(i, time(edge), map.state(edge), {map.state(from), end});
    if (!refused.empty()) return refused;
    switches_.cross(i);
  }
  switches_.see(values);
  return {};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
