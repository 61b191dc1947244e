// SPDX-License-Identifier: MIT
#include "dynamics/detail/switch_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// The values of all terms, one after the other.
SwitchSides switches_of(const System& system, const DoubleDouble& t, const RotorState& s) {
  const Frame& frame = system.frame();
  const Quaternion q_IS = frame.is_inertial() ? Quaternion{} : frame.at(t.hi).q_IS;
  const Setting at{system.body(), t.hi, s, q_IS, t.lo};
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

SwitchWatch::SwitchWatch(const System& system)
    : system_(system),
      needed_(std::any_of(system.terms().begin(), system.terms().end(),
                          [](const AnyPerturbation& term) { return term.supports_switches(); })) {}

void SwitchWatch::begin(const DoubleDouble& t, const RotorState& s) {
  if (begun_ || !needed_) return;
  begun_ = true;
  SwitchSides sides = switches_of(system_, t, s);
  see(sides.values);
  for (double& value : sides.values) value = side_of(value);
  if (!sides.values.empty()) sides_ = std::make_shared<const SwitchSides>(std::move(sides));
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
    largest_[i] = std::max(largest_[i], std::fabs(values[i]));
}

// A function that a torque brings to zero and leaves there walks by roundings of what it is made
// of.
double SwitchWatch::rounding(std::size_t which) const {
  return 64.0 * epsilon<double>() * largest_[which];
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

std::string SwitchWatch::text(std::size_t which) const {
  std::size_t term = 0;
  while (which >= sides_->first[term + 1]) ++term;
  return "switching function " + std::to_string(which - sides_->first[term] + 1) + " of term \"" +
         system_.terms()[term].name() + "\"";
}

void SwitchWatch::transfer(StateBytes& bytes) {
  bytes.all(begun_, crossed_at_once_, largest_);
  transfer(bytes, sides_);
}

void SwitchWatch::transfer(StateBytes& bytes, std::shared_ptr<const SwitchSides>& sides) const {
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
