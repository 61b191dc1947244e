// SPDX-License-Identifier: MIT
// What orbits at many times ask of the lanes of the processor.
#pragma once

#include <algorithm>
#include <cstddef>

#include "polhode/detail/orbit/many_times.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline constexpr std::size_t orbit_lanes_width = 8;  // what a count is filled up to
inline constexpr std::size_t orbit_block = 16;       // so many numbers at a time

struct alignas(64) OrbitBlock {
  double of[orbit_block];  // first `count`, then copies of the last up to a whole number of lanes

  void fill_up(std::size_t count) {
    for (std::size_t i = count; i % orbit_lanes_width != 0; ++i) of[i] = of[count - 1];
  }
  void fill(double x) { std::fill(of, of + orbit_block, x); }
};
inline constexpr OrbitBlock no_rests{};

// A block of times as lanes take them: where they lie, or filled up.
struct LaneTimes {
  std::size_t first, count;
  const double* t;
  const double* rest;
  OrbitBlock filled_t, filled_rest;

  LaneTimes(const TimeRows& times, std::size_t begin, std::size_t size)
      : first(begin),
        count(size),
        t(times.t + first),
        rest(times.rest == nullptr ? no_rests.of : times.rest + first) {
    if (is_whole()) return;
    t = filled(t, filled_t);
    rest = filled(rest, filled_rest);
  }
  bool is_whole() const { return count % orbit_lanes_width == 0; }
  // Where lanes write to: the row itself, or, where that has no room for all, a block.
  double* room(double* row, OrbitBlock& block) const { return is_whole() ? row + first : block.of; }
  void take(double* row, const OrbitBlock& block) const {
    if (!is_whole()) std::copy_n(block.of, count, row + first);
  }

 private:
  const double* filled(const double* from, OrbitBlock& to) const {
    std::copy_n(from, count, to.of);
    to.fill_up(count);
    return to.of;
  }
};
template <class F>
void each_block(const TimeRows& times, const F& f) {
  for (std::size_t i = 0; i < times.count; i += orbit_block)
    f(LaneTimes(times, i, std::min(orbit_block, times.count - i)));
}

// The phase and the size of an ellipse that does not change.
struct SteadyEllipse {
  DoubleDouble frequency;  // turns per time
  DoubleDouble pericentre_time;
  double e, complement;
  double pericentre, a, b;
};
// Of the anomaly, or in the plane.
struct TwoRows {
  double* first;
  double* second;
};
struct PlaneAxes {
  Vec3 to_pericentre, along_motion;
};

// Each computes `count` numbers and what is left to a whole number of lanes, of rows that have as
// much.
struct OrbitLanes {
  void (*directions)(const SteadyEllipse&, const LaneTimes&, const TwoRows& sine_and_versine);
  void (*points)(const SteadyEllipse&, const LaneTimes&, const TwoRows& x_and_y);
  // Of mean anomalies within half a turn, and of an ellipse for each.
  void (*anomalies)(std::size_t count, const double* M, const double* e, const double* complement,
                    const TwoRows& sine_and_versine);
  // Of angles within half a turn, and a little beyond.
  void (*sines)(std::size_t count, const double* angle, const double* beyond,
                const TwoRows& sine_and_cosine);
  // x and y of a plane, in place.
  void (*places)(std::size_t count, const PlaneAxes&, const VectorRows&);
};
// Of a set that this processor has.
OrbitLanes orbit_lanes(InstructionSet set);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
