// SPDX-License-Identifier: MIT
// States that charts find hard, and the bits of numbers.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "oracle/random_draw.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace rotor_test {

using polhode::RotorState;

// Half angles, the sizes of momenta and their directions: ordinary, exactly at a pole, next to one.
inline std::vector<RotorState> hard_states(int count = 3000) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<RotorState> all;
  oracle::Draw draw(81, 0);
  const auto part = [&] {
    const double kind = draw.uniform(0.0, 1.0);
    if (kind < 0.5) return draw.normal();
    return kind < 0.7 ? 0.0 : draw.sign() * draw.power_of_ten(-170.0, -3.0);
  };
  for (int i = 0; i < count; ++i) {
    const double size = draw.chance(0.3) ? draw.power_of_ten(-290.0, 290.0) : 1.0;
    RotorState s{{part(), part(), part(), part()}, {size * part(), size * part(), size * part()}};
    if (draw.chance(0.1)) s.g = {};
    if (draw.chance(0.01)) s.g.y = nan;
    if (draw.chance(0.5)) s.q = normalized(s.q);
    all.push_back(s);
  }
  return all;
}

// One pattern for every NaN: its sign and payload mean nothing.
inline std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(std::isnan(x) ? std::numeric_limits<double>::quiet_NaN() : x);
}

}  // namespace rotor_test
