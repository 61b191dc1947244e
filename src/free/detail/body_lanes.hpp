// SPDX-License-Identifier: MIT
// Many bodies, one time each, a body a lane; compiled once for each set of instructions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>

#include "free/detail/direct_flow_state.hpp"
#include "free/detail/lanes_declared.hpp"
#include "polhode/detail/math/pack.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Below this k'^2 the nome of k is too large for the short series.
inline constexpr double least_trigonometric = 0.08;

// What a block is for.
enum class DirectForm { short_arc, long_arc, near_separatrix };

// Packs of bodies through one stage after another: within a stage the chains of operations of
// several packs overlap.
template <InstructionSet isa, class Arithmetic, DirectForm form>
class DirectBlock {
 public:
  using T = Pack<isa>;
  using Two = TwoParts<Arithmetic, T>;
  static constexpr std::size_t packs = 4;
  static constexpr std::size_t bodies = packs * T::width;

  DirectBlock(const BodyRows& rows, std::span<RotorState> results)
      : rows_(rows), results_(results) {}

  // Those at index[0], index[1], ...; left[i] remains true where the body is none of these.
  [[gnu::flatten]] void write(const std::size_t* index, std::size_t count, bool* left) {
    const std::size_t n = (count + T::width - 1) / T::width;
    for (std::size_t i = 0; i < n; ++i) gather(i, index + i * T::width, count - i * T::width);
    Mask<T> wanted(false);
    for (std::size_t i = 0; i < n; ++i) {
      in_place(lane_[i], [&] {
        return primed_lane<form == DirectForm::near_separatrix, Arithmetic, T>(body(i));
      });
      wanted = wanted || is_done(i);
    }
    if (!any(wanted)) return;
    for (std::size_t i = 0; i < n; ++i) in_place(rates_[i], [&] { return rates(lane_[i]); });
    if constexpr (form == DirectForm::near_separatrix) {
      for (std::size_t i = 0; i < n; ++i)
        in_place(near_[i], [&] { return near_series(lane_[i], rates_[i]); });
      for (std::size_t i = 0; i < n; ++i)
        put(i, near_state(body(i), lane_[i], rates_[i], near_[i]));
    } else {
      for (std::size_t i = 0; i < n; ++i)
        in_place(series_[i], [&] { return direct_series(lane_[i], rates_[i]); });
      for (std::size_t i = 0; i < n; ++i) epoch_[i] = direct_epoch(lane_[i], rates_[i]);
      for (std::size_t i = 0; i < n; ++i) advance_[i] = at_time(rates_[i].phase, i);
      for (std::size_t i = 0; i < n; ++i) turn_[i] = at_time(rates_[i].half_precession, i);
      for (std::size_t i = 0; i < n; ++i)
        put(i, direct_state(body(i), lane_[i], series_[i], epoch_[i], advance_[i], turn_[i]));
    }
    for (std::size_t i = 0; i < n; ++i)
      scatter(i, index + i * T::width, std::min(T::width, count - i * T::width), left);
  }

 private:
  [[gnu::always_inline]] static DirectRates<Arithmetic, T> rates(
      const PrimedLane<Arithmetic, T>& p) {
    if constexpr (form == DirectForm::short_arc) {
      return short_rates(p);
    } else {
      return long_rates < form == DirectForm::long_arc ? 5 : 9 > (p);
    }
  }
  // What f returns, built where it belongs: a copy of so many registers takes a tenth of the time.
  template <class Value, class F>
  [[gnu::always_inline]] static void in_place(Value& place, const F& f) {
    ::new (static_cast<void*>(&place)) Value(f());
  }
  [[gnu::always_inline]] SinCos<T> at_time(const TwoTerms<T>& rate, std::size_t i) const {
    const TwoTerms<T> phase =
        phase_at<Arithmetic>(rate, lane_[i].elapsed, TwoTerms<T>{T(0.0), T(0.0)});
    if constexpr (form == DirectForm::short_arc) {
      return sincos_of_few_turns(phase);
    } else {
      return sincos_of_few_turns(whole_turns_off<Arithmetic>(phase));
    }
  }
  [[gnu::always_inline]] Mask<T> is_done(std::size_t i) const {
    const PrimedLane<Arithmetic, T>& p = lane_[i];
    const Mask<T> trigonometric = p.V.hi > T(least_trigonometric) * p.U.hi;
    if constexpr (form == DirectForm::near_separatrix)
      return p.ordinary && !trigonometric && p.V.hi > T(0x1p-40) * p.U.hi;
    return p.ordinary && trigonometric && (form == DirectForm::long_arc || p.is_short);
  }
  // One row after another; read as packs only when the last is written, which is when the first has
  // left the store buffer.
  [[gnu::always_inline]] void gather(std::size_t i, const std::size_t* index, std::size_t count) {
    for (std::size_t j = 0; j < T::width; ++j) {
      const std::size_t k = index[j < count ? j : 0];
      const double* const I = rows_.moments.first + k * rows_.moments.step;
      const double* const s = rows_.states.first + k * rows_.states.step;
      const std::size_t later = std::min(k + 2 * bodies, results_.size() - 1);
      __builtin_prefetch(rows_.moments.first + later * rows_.moments.step);
      __builtin_prefetch(rows_.states.first + later * rows_.states.step);
      __builtin_prefetch(&results_[later], 1);
#pragma GCC unroll 8
      for (std::size_t c = 0; c < 3; ++c) numbers_[i][c][j] = I[c];
#pragma GCC unroll 8
      for (std::size_t c = 0; c < 7; ++c) numbers_[i][3 + c][j] = s[c];
      numbers_[i][10][j] = rows_.times.first[k * rows_.times.step];
      numbers_[i][11][j] = rows_.epochs.first[k * rows_.epochs.step];
    }
  }
  [[gnu::always_inline]] BodyInLane<T> body(std::size_t i) const {
    const auto at = [&](std::size_t c) { return T::loaded(numbers_[i][c]); };
    return {{at(0), at(1), at(2)},
            {{at(3), at(4), at(5), at(6)}, {at(7), at(8), at(9)}},
            at(10),
            at(11)};
  }
  [[gnu::always_inline]] void put(std::size_t i, const BasicRotorState<T>& s) {
    const T* const from[] = {&s.q.w, &s.q.x, &s.q.y, &s.q.z, &s.g.x, &s.g.y, &s.g.z};
    for (std::size_t c = 0; c < 7; ++c) from[c]->store(numbers_[i][c]);
    const Mask<T> done = is_done(i);
    std::memcpy(done_[i], &done.lanes, sizeof done.lanes);
  }
  [[gnu::always_inline]] void scatter(std::size_t i, const std::size_t* index, std::size_t count,
                                      bool* left) {
    const auto& n = numbers_[i];
    for (std::size_t j = 0; j < count; ++j) {
      if (!done_[i][j]) continue;
      const std::size_t k = index[j];
      left[k] = false;
      results_[k] = {{n[0][j], n[1][j], n[2][j], n[3][j]}, {n[4][j], n[5][j], n[6][j]}};
    }
  }

  BodyRows rows_;
  std::span<RotorState> results_;
  alignas(64) double numbers_[packs][12][T::width];
  PrimedLane<Arithmetic, T> lane_[packs];
  DirectRates<Arithmetic, T> rates_[packs];
  DirectSeries<T> series_[packs];
  NearSeries<T> near_[packs];
  std::int64_t done_[packs][T::width];
  SinCos<T> epoch_[packs], advance_[packs], turn_[packs];
};

template <class Block>
void bodies_of_form(const BodyRows& rows, std::span<RotorState> results, bool* left) {
  const std::size_t count = results.size();
  Block block(rows, results);
  std::array<std::size_t, Block::bodies> index;
  for (std::size_t i = 0; i < count;) {
    std::size_t n = 0;
    for (; n < index.size() && i < count; ++i)
      if (left[i]) index[n++] = i;
    block.write(index.data(), n, left);
  }
}

// The bodies of which left[i] is true; it becomes false where the result is written.
template <InstructionSet isa>
void bodies_in_lanes(const BodyRows& rows, std::span<RotorState> results, bool* left) {
  using Arithmetic =
      std::conditional_t<isa == InstructionSet::baseline, DekkerArithmetic, FmaArithmetic>;
  bodies_of_form<DirectBlock<isa, Arithmetic, DirectForm::short_arc>>(rows, results, left);
  bodies_of_form<DirectBlock<isa, Arithmetic, DirectForm::long_arc>>(rows, results, left);
  bodies_of_form<DirectBlock<isa, Arithmetic, DirectForm::near_separatrix>>(rows, results, left);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
