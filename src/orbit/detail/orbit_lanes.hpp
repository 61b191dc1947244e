// SPDX-License-Identifier: MIT
// What orbits at many times ask of the lanes of the processor.
#pragma once

#include <algorithm>
#include <cstddef>

#include "polhode/math/double_double.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// So many numbers at a time, in rows of a whole number of lanes whose last ones repeat the last.
inline constexpr std::size_t orbit_block = 16;
struct alignas(64) OrbitBlock {
  double of[orbit_block];

  void fill(const double* from, std::size_t count) {
    if (from != of) std::copy_n(from, count, of);
    std::fill(of + count, of + orbit_block, of[count - 1]);
  }
  void fill(double x) { std::fill(of, of + orbit_block, x); }
};

// The phase of an ellipse whose shape stays.
struct SteadyEllipse {
  DoubleDouble frequency;  // turns per time
  DoubleDouble pericentre_time;
  double e, complement;
};
struct AnomalyRows {
  double* sine;
  double* versine;
};

// Each computes `count` numbers and what is left to a whole number of lanes.
struct OrbitLanes {
  void (*directions)(const SteadyEllipse&, std::size_t count, const double* t, const double* rest,
                     const AnomalyRows& to);
  // Of mean anomalies within half a turn, and of an ellipse for each.
  void (*anomalies)(std::size_t count, const double* M, const double* e, const double* complement,
                    const AnomalyRows& to);
  void (*sines)(std::size_t count, const double* angle, double* sine, double* cosine);
};
// Of a set that this processor has.
OrbitLanes orbit_lanes(InstructionSet set);

// f(first, count) of one block after the other.
template <class F>
void each_orbit_block(std::size_t count, const F& f) {
  for (std::size_t i = 0; i < count; i += orbit_block) f(i, std::min(orbit_block, count - i));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
