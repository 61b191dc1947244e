// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "polhode/fit/light_search.hpp"
#include "polhode/fit/likely_periods.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double same_periods = 1e-3;

}  // namespace

std::vector<TumblerPeriods> labelled_periods(std::span<const ScanMinimum> minima,
                                             const LabelChoice& choice) {
  std::vector<TumblerPeriods> found;
  const auto is_known = [&](const TumblerPeriods& l) {
    return std::ranges::any_of(found, [&](const TumblerPeriods& p) {
      return p.mode == l.mode &&
             std::abs(p.precession_period / l.precession_period - 1.0) < same_periods &&
             std::abs(p.rotation_period / l.rotation_period - 1.0) < same_periods;
    });
  };
  std::size_t pairs = 0;
  for (const ScanMinimum& m : minima) {
    if (!m.resolved || !m.refined.converged || m.at_edge) continue;
    if (pairs++ == choice.pairs) break;
    std::size_t taken = 0;
    for (const LikelyPeriods& l : likely_periods(m.refined.fit)) {
      if (taken++ == choice.labels) break;
      if (!is_known(l.periods)) found.push_back(l.periods);
    }
  }
  return found;
}

}  // namespace v0
}  // namespace polhode
