// SPDX-License-Identifier: MIT
// SpinBlock: the spin axes of up to N bodies on one orbit, as one state of the common loop.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "polhode/dynamics/model.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "secular/detail/spin_lanes_declared.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <std::size_t N>
struct SpinBlock {
  std::array<double, 3 * N> column{};  // x of all, y, z

  SpinAxis axis(std::size_t i) const { return {{column[i], column[N + i], column[2 * N + i]}}; }
  void put(std::size_t i, const SpinAxis& axis) {
    column[i] = axis.s.x;
    column[N + i] = axis.s.y;
    column[2 * N + i] = axis.s.z;
  }
  bool is_lost(std::size_t i) const {
    const Vec3 s = axis(i).s;
    return !std::isfinite(s.x + s.y + s.z);
  }
  bool operator==(const SpinBlock&) const = default;
};
template <std::size_t N, class Visit>
void each_number(SpinBlock<N>& block, Visit&& visit) {
  for (double& x : block.column) visit(x);
}

template <std::size_t N>
struct RateBlock {
  std::array<double, N> star{}, satellites{}, geodetic{}, drift{};
};

// The model of a block. It goes on while one of its axes does.
template <std::size_t N>
struct SpinBlockModel {
  using State = SpinBlock<N>;
  static constexpr std::string_view name = SpinPrecession<OrbitHistory>::name;

  OrbitHistory orbit;
  std::shared_ptr<const RateBlock<N>> rates;
  std::size_t count;
  decltype(&turned_in_lanes<InstructionSet::baseline>) turned;

  State frozen(std::span<const FrozenPart> parts, State axes) const {
    std::array<FrozenOrbit, most_frozen_parts> orbits;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const OrbitPlane at = orbit.plane(parts[k].t);
      orbits[k] = {parts[k].t, parts[k].h, at.e2, orbit_normal(at)};
    }
    turned({orbits.data(), parts.size()},
           {count, rates->star.data(), rates->satellites.data(), rates->geodetic.data(),
            rates->drift.data()},
           axes.column.data(), N);
    return axes;
  }
  bool goes_on(const State& at) const {
    for (std::size_t i = 0; i < count; ++i)
      if (!at.is_lost(i)) return true;
    return false;
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
