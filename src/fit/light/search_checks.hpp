// SPDX-License-Identifier: MIT
// What searches of light curves and their extension ask of their numbers.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

template <class Number>
void require_at_least_one(const std::string& who, const char* name, Number value) {
  if (value < 1)
    throw DomainError(who + name + " = " + std::to_string(value) + " must be 1 or more");
}

inline void require_within(const std::string& who, double within) {
  if (!(within >= 1.0))
    throw DomainError(who + "within = " + polhode::detail::number_text(within) +
                      " must be 1 or more");
}

// The iterations as they are where there can be no more.
inline int times(int iterations, int factor) {
  return iterations > std::numeric_limits<int>::max() / factor ? iterations : factor * iterations;
}

template <class Search>
void check_search(const std::string& who, const Search& s) {
  light::require_sound(s.curves, {.vectors = true});
  if (s.periods.empty()) throw DomainError(who + "no periods to start from; expected one pair");
  for (const auto& p : s.periods) {
    if (p.mode != Regime::short_axis && p.mode != Regime::long_axis)
      throw DomainError(who + "the mode must be short_axis or long_axis");
    for (const double period : {p.precession_period, p.rotation_period})
      if (!(period > 0.0) || !std::isfinite(period))
        throw DomainError(who + "period " + polhode::detail::number_text(period) +
                          " must be positive");
  }
  require_at_least_one(who, "starts", s.starts);
  require_at_least_one(who, "tries", s.tries);
  require_at_least_one(who, "short_iterations", s.short_iterations);
  require_at_least_one(who, "finalists", s.finalists);
  require_at_least_one(who, "most_iterations", s.most_iterations);
  require_at_least_one(who, "threads", s.threads);
  require_within(who, s.within);
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
