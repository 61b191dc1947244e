// SPDX-License-Identifier: MIT
// Switching functions of a system: on which side of each a run is.
#include "dynamics/adaptive/switching_functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/finite.hpp"
#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

Setting setting_of(const System& system, const DoubleDouble& t, const RotorState& s) {
  const Frame& frame = system.frame();
  const Quaternion q_IS = frame.is_inertial() ? Quaternion{} : frame.at(t.hi).q_IS;
  return {system.body(), t.hi, s, q_IS, t.lo};
}

// The values of all terms, one after the other.
SwitchSides switches_of(const System& system, const DoubleDouble& t, const RotorState& s) {
  const Setting at = setting_of(system, t, s);
  SwitchSides all;
  for (const AnyPerturbation& term : system.terms()) {
    all.first.push_back(all.values.size());
    if (!term.supports_switches()) continue;
    const std::vector<double> own = term.switches(at);
    all.values.insert(all.values.end(), own.begin(), own.end());
  }
  all.first.push_back(all.values.size());
  return all;
}

}  // namespace

SwitchWatch::SwitchWatch(const System& system, const char* jumps)
    : system_(system),
      jumps_(jumps),
      needed_(std::any_of(system.terms().begin(), system.terms().end(),
                          [](const AnyPerturbation& term) { return term.supports_switches(); })) {}

std::string SwitchWatch::begin(const DoubleDouble& t, const RotorState& s) {
  if (begun_ || !needed_) return {};
  SwitchSides sides = switches_of(system_, t, s);
  const std::vector<double> values = sides.values;
  for (double& value : sides.values) value = side_of(value);
  if (!sides.values.empty()) sides_ = std::make_shared<const SwitchSides>(std::move(sides));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isnan(values[i])) return nan_text(i, t.hi);
  see(values);
  begun_ = true;
  return {};
}

std::vector<double> SwitchWatch::values(const DoubleDouble& t, const RotorState& s) const {
  SwitchSides now = switches_of(system_, t, s);
  for (std::size_t i = 0; i + 1 < now.first.size(); ++i) {
    const std::size_t count = now.first[i + 1] - now.first[i];
    const std::size_t before = sides_->first[i + 1] - sides_->first[i];
    if (count != before)
      throw DomainError("integrate: term \"" + system_.terms()[i].name() + "\" has " +
                        std::to_string(count) + " switching functions, and " +
                        std::to_string(before) + " at the start: expected as many");
  }
  for (std::size_t i = 0; i < now.values.size(); ++i) now.values[i] *= sides_->values[i];
  return std::move(now.values);
}

void SwitchWatch::see(const std::vector<double>& values) {
  largest_.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isinf(values[i])) largest_[i] = larger(largest_[i], std::fabs(values[i]));
}

// A function that a torque brings to zero and leaves there walks by roundings of what it is made
// of.
double SwitchWatch::rounding(std::size_t which) const {
  return 64.0 * epsilon<double>() * largest_[which];
}

double SwitchWatch::longest_step(const RotorState& s) const {
  constexpr double turn = 1.5;  // rad; a side of a facet lasts about half a turn
  const double rate = norm(polhode::angular_velocity(system_.body(), s));
  return rate > 0.0 ? turn / rate : std::numeric_limits<double>::infinity();
}

void SwitchWatch::cross(std::size_t which) {
  SwitchSides next = *sides_;
  next.values[which] = -next.values[which];
  sides_ = std::make_shared<const SwitchSides>(std::move(next));
}

bool SwitchWatch::cross_at_once(std::size_t which) {
  // functions that are zero together are crossed one by one, and a touch there and back
  if (++crossed_at_once_ > 2 * static_cast<int>(size())) return false;
  cross(which);
  return true;
}

std::size_t SwitchWatch::term_of(std::size_t which) const {
  std::size_t term = 0;
  while (which >= sides_->first[term + 1]) ++term;
  return term;
}

std::string SwitchWatch::text(std::size_t which) const {
  const std::size_t term = term_of(which);
  return "switching function " + std::to_string(which - sides_->first[term] + 1) + " of term \"" +
         system_.terms()[term].name() + "\"";
}
std::string SwitchWatch::nan_text(std::size_t which, double t) const {
  return text(which) + " is NaN at t = " + number_text(t) +
         ": give it a value there, or stop before";
}

// What does not look at the state has the same bits for every state.
bool SwitchWatch::depends_on_state(std::size_t which, const DoubleDouble& t,
                                   const RotorState& s) const {
  constexpr double little = 0x1p-10;
  const double g = norm(s.g), kick = little * (g > 0.0 ? g : 1.0);
  const double value = switches_of(system_, t, s).values[which];
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along{};
    along[axis] = 1.0;
    const Vec3 half = (0.5 * little) * along;
    const RotorState turned{normalized(s.q * Quaternion{1.0, half.x, half.y, half.z}), s.g};
    const RotorState kicked{s.q, s.g + kick * along};
    for (const RotorState& other : {turned, kicked})
      if (!(switches_of(system_, t, other).values[which] == value)) return true;
  }
  return false;
}

bool SwitchWatch::is_fading(std::size_t which, const DoubleDouble& t, const RotorState& s) const {
  return system_.terms()[term_of(which)].fades_at_switches() && !depends_on_state(which, t, s);
}

double SwitchWatch::bend(std::size_t which, const DoubleDouble& t, const RotorState& s,
                         double h) const {
  const std::size_t term = term_of(which);
  const double g = norm(s.g);
  double largest = 0.0;
  // a torque may happen to vanish at one attitude
  for (int axis = -1; axis < 3; ++axis) {
    RotorState turned = s;
    if (axis >= 0) {
      Vec3 half{};
      half[axis] = 0.5;
      turned.q = normalized(s.q * Quaternion{1.0, half.x, half.y, half.z});
    }
    const auto effect = [&](double x) {
      Setting at = setting_of(system_, t + x * h, turned);
      at.sides = sides_->of(term);
      return system_.terms()[term].effect(at);
    };
    const Effect a = effect(0.0), b = effect(0.5), c = effect(1.0);
    const Vec3 u = a.u - 2.0 * b.u + c.u, v = a.v - 2.0 * b.v + c.v;
    // a body at rest: of the momentum that it gets
    const double momentum = larger(g, std::fabs(h) * norm(b.u));
    if (momentum > 0.0) largest = larger(largest, norm(u) / momentum);
    largest = larger(largest, norm(v));
  }
  return largest;
}

Effect SwitchWatch::change(std::size_t which, const DoubleDouble& t, const RotorState& s) const {
  const std::size_t term = term_of(which);
  SwitchSides sides = *sides_;
  Setting at = setting_of(system_, t, s);
  at.sides = sides.of(term);
  const Effect here = system_.terms()[term].effect(at);
  sides.values[which] = -sides.values[which];
  const Effect beyond = system_.terms()[term].effect(at);
  return {beyond.v - here.v, beyond.u - here.u};
}

std::string SwitchWatch::refused_jump(std::size_t which, const DoubleDouble& t, const RotorState& s,
                                      std::initializer_list<RotorState> before) const {
  if (jumps_ == nullptr || !depends_on_state(which, t, s)) return {};
  constexpr double part = 1e-6;
  const Effect here = change(which, t, s);
  double u = 0.0, v = 0.0;
  for (const RotorState& other : before) {
    const Effect away = change(which, t, other);
    u = larger(u, norm(away.u));
    v = larger(v, norm(away.v));
  }
  const bool torque = norm(here.u) > part * u;
  if (!torque && !(norm(here.v) > part * v)) return {};
  return std::string("the ") + (torque ? "torque" : "rate") + " of term \"" +
         system_.terms()[term_of(which)].name() +
         "\" jumps where the state says so, at t = " + number_text(t.hi) + ": " + jumps_;
}

void SwitchWatch::serialize(Archive& bytes) {
  bytes.all(begun_, crossed_at_once_, largest_);
  serialize(bytes, sides_);
}

void SwitchWatch::serialize(Archive& bytes, std::shared_ptr<const SwitchSides>& sides) const {
  SwitchSides values = sides ? *sides : SwitchSides{};
  std::vector<std::int64_t> first(values.first.begin(), values.first.end());
  bytes.all(first, values.values);
  if (!bytes.reads()) return;
  values.first.assign(first.begin(), first.end());
  if (!first.empty() && first.size() != system_.terms().size() + 1)
    throw DomainError("resume: the checkpoint is of another problem: terms differs");
  sides = first.empty() ? nullptr : std::make_shared<const SwitchSides>(std::move(values));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
