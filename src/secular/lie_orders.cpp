// SPDX-License-Identifier: MIT
#include "polhode/secular/detail/lie_orders.hpp"

#include <algorithm>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/secular/detail/lie_problem.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {
// Factorials and rows of the triangle: more is never reached by series that fit in memory.
constexpr int most_orders = 30;
}  // namespace

void require_small(const Symbols& symbols, const Truncation& keep) {
  if (keep.weights.empty())
    throw DomainError("LieTransform: no small parameters; keep.weights must name them");
  if (keep.order < 0 || keep.order > most_orders)
    throw DomainError("LieTransform: the order " + std::to_string(keep.order) + " is out of [0, " +
                      std::to_string(most_orders) + "]");
  for (const auto& [name, weight] : keep.weights)
    for (const ConjugatePair& pair : symbols.pairs())
      if (weight != 0 && (pair.coordinate == name || pair.momentum == name))
        throw DomainError("LieTransform: the small parameter " + name +
                          " has a conjugate; brackets would change the order");
}

void require_symbol(const Symbols& symbols, std::string_view name) {
  if (!symbols.has_angle(name)) symbols.variable(name);
}

void require_turning(const Symbols& symbols, const std::vector<std::string>& angles,
                     const std::set<std::string>& clocks) {
  for (const std::string& angle : angles) {
    symbols.angle(angle);  // throws for an unknown one
    const auto is_of = [&](const ConjugatePair& pair) { return pair.coordinate == angle; };
    if (!clocks.contains(angle) && std::ranges::none_of(symbols.pairs(), is_of))
      throw DomainError("LieTransform: the angle " + angle +
                        " is to be eliminated, and has neither a momentum nor a clock");
  }
}

void require_bound(const char* name, double bound) {
  if (!(bound >= 0.0))
    throw DomainError("LieTransform: " + std::string(name) + " = " + number_text(bound) +
                      " must not be negative");
}

KeptAngles::KeptAngles(const Symbols& symbols, const std::vector<std::string>& angles,
                       const std::vector<std::vector<std::pair<std::string, int>>>& resonances)
    : symbols_(symbols) {
  for (const std::string& name : angles) places_.push_back(symbols.angle(name));
  for (const auto& combination : resonances) {
    std::vector<int> multipliers(places_.size(), 0);
    for (const auto& [name, n] : combination) {
      const auto found = std::find(places_.begin(), places_.end(), symbols.angle(name));
      if (found == places_.end())
        throw DomainError("LieTransform: the resonance has the angle " + name +
                          ", which is not among those to be eliminated");
      multipliers[static_cast<std::size_t>(found - places_.begin())] += n;
    }
    resonances_.push_back(std::move(multipliers));
  }
}

bool KeptAngles::keeps(const TermKey& key) const {
  std::vector<int> k;
  for (const int place : places_) k.push_back(multiplier(symbols_, key, place));
  if (std::all_of(k.begin(), k.end(), [](int n) { return n == 0; })) return true;
  // k = (p / q) r: cross products are zero, and the quotient is an integer.
  return std::any_of(resonances_.begin(), resonances_.end(), [&](const std::vector<int>& r) {
    const auto first = std::find_if(r.begin(), r.end(), [](int n) { return n != 0; });
    if (first == r.end()) return false;
    const auto place = static_cast<std::size_t>(first - r.begin());
    if (k[place] % *first != 0) return false;
    const int times = k[place] / *first;
    for (std::size_t i = 0; i < k.size(); ++i)
      if (k[i] != times * r[i]) return false;
    return true;
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
