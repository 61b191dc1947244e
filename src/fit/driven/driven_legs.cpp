// SPDX-License-Identifier: MIT
#include "fit/driven/driven_legs.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace polhode {
inline namespace v0 {
namespace detail {

std::vector<DrivenLeg> driven_legs(std::span<const double> times, double t0,
                                   const std::vector<SpinJump>& jumps,
                                   const std::vector<AnyPerturbation>& terms) {
  std::vector<DrivenLeg> legs;
  for (const double side : {1.0, -1.0}) {
    // A jump acts just after its time: at t0 on the way forwards.
    const auto is_here = [&](double t) { return side > 0.0 ? t >= t0 : t < t0; };
    std::vector<double> wanted;
    for (const double t : times) {
      if (is_here(t)) wanted.push_back(side * t);
    }
    if (wanted.empty()) continue;
    std::ranges::sort(wanted);
    wanted.erase(std::ranges::unique(wanted).begin(), wanted.end());
    const double last = wanted.back();
    std::vector<std::pair<double, std::optional<std::size_t>>> ends;
    for (std::size_t j = 0; j < jumps.size(); ++j) {
      const double t = jumps[j].t;
      // Forwards what is seen at its time is before it, backwards too, which is after undoing it.
      if (is_here(t) && (side > 0.0 ? t < last : -t <= last)) ends.emplace_back(side * t, j);
    }
    for (const AnyPerturbation& term : terms) {
      for (const double t : term.breakpoints()) {
        if (side * t > side * t0 && side * t < last) ends.emplace_back(side * t, std::nullopt);
      }
    }
    // At one time: backwards first the jumps, so that no leg with its observations comes before.
    std::ranges::sort(ends, {}, [&](const auto& end) {
      return std::tuple(end.first, side < 0.0 && !end.second, end.second);
    });
    ends.emplace_back(last, std::nullopt);
    double from = side * t0;
    std::size_t next = 0;
    for (std::size_t e = 0; e < ends.size(); ++e) {
      const auto& [to, jump] = ends[e];
      DrivenLeg leg{side * from, side * to, {}, 0, jump, e == 0};
      while (next < wanted.size() &&
             (wanted[next] < to || (wanted[next] == to && (side > 0.0 || !jump)))) {
        leg.times.push_back(side * wanted[next++]);
      }
      leg.asked = leg.times.size();
      if (leg.times.empty() || leg.times.back() != leg.to) leg.times.push_back(leg.to);
      legs.push_back(std::move(leg));
      from = to;
    }
  }
  return legs;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
