// SPDX-License-Identifier: MIT
// What a search of light curves asks of its numbers, be it for ellipsoids or for a mesh.
#pragma once

#include <cmath>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/light_curve_checks.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <class Search>
void check_search(const std::string& who, const Search& s) {
  require_sound(s.curves, {.vectors = true});
  if (s.periods.empty()) throw DomainError(who + "no periods to start from; expected one pair");
  for (const auto& p : s.periods) {
    if (p.mode != Regime::short_axis && p.mode != Regime::long_axis)
      throw DomainError(who + "the mode must be short_axis or long_axis");
    for (const double period : {p.precession_period, p.rotation_period})
      if (!(period > 0.0) || !std::isfinite(period))
        throw DomainError(who + "period " + number_text(period) + " must be positive");
  }
  const auto at_least_one = [&](const char* name, auto value) {
    if (value < 1)
      throw DomainError(who + name + " = " + std::to_string(value) + " must be 1 or more");
  };
  at_least_one("starts", s.starts);
  at_least_one("tries", s.tries);
  at_least_one("short_iterations", s.short_iterations);
  at_least_one("finalists", s.finalists);
  at_least_one("most_iterations", s.most_iterations);
  at_least_one("threads", s.threads);
  if (!(s.within >= 1.0))
    throw DomainError(who + "within = " + number_text(s.within) + " must be 1 or more");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
