// SPDX-License-Identifier: MIT
// The states of many sets of Sadov's variables of a body, as many at a time as a register holds;
// compiled once for each set of instructions.
//
// The polhode of each action first (deficit.hpp), then the attitude, by theta4 and theta1 of
// x - ia. docs/design/0036-threads-and-the-way-back.md.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "free/detail/sadov/constants.hpp"
#include "free/detail/sadov/curve.hpp"
#include "free/detail/sadov/deficit.hpp"
#include "free/detail/sadov/polhode_states.hpp"
#include "polhode/math/pack_functions.hpp"
#include "polhode/math/pack_rows.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <InstructionSet isa>
class RotorsOfSadov : private StatesOnPolhodes<isa> {
  using Base = StatesOnPolhodes<isa>;
  using Base::c_, Base::kap2_, Base::motion_, Base::polhode_;
  using typename Base::Mask, typename Base::Motion, typename Base::T;

 public:
  explicit RotorsOfSadov(const SadovConstants& c) : Base(c) {}

  [[gnu::flatten]] void convert(const SadovState* sets, std::size_t count, RotorState* results,
                                bool* usual) {
    const std::size_t packs = (count + T::width - 1) / T::width;
    for (std::size_t i = 0; i < packs; ++i)
      begin(i, sets + T::width * i, std::min(T::width, count - T::width * i));
    solve(packs);
    for (std::size_t i = 0; i < packs; ++i) {
      const Root& r = root_[i];
      polhode_[i] = polhode_at(r.y, r.kap2, r.most, r.least);
      kap2_[i] = r.kap2;
      this->begin_polhode(i);
    }
    this->steps_of_mean(packs);
    for (std::size_t i = 0; i < packs; ++i)
      this->finish(i, std::min(T::width, count - T::width * i), results + T::width * i,
                   usual + T::width * i);
  }

 private:
  struct Root {
    T y, target, first, most, root_of_kap2, kap2, least;
    Mask done;
  };

  // The last ones next to copies of the first of them.
  [[gnu::always_inline]] void begin(std::size_t i, const SadovState* sets, std::size_t count) {
    double rows[7 * T::width];
    static_assert(sizeof(SadovState) == 7 * sizeof(double));
    Motion& s = motion_[i];
    s.usual = Mask(true);
    Mask negative_lobe(false);
    for (std::size_t j = 0; j < T::width; ++j) {
      const SadovState& one = sets[j < count ? j : 0];
      std::memcpy(rows + 7 * j, &one, sizeof one);
      LaneTraits<T>::set_mask(s.long_axis, j, one.region == SadovRegion::long_axis);
      LaneTraits<T>::set_mask(negative_lobe, j, one.lobe < 0);
      LaneTraits<T>::set_mask(s.usual, j, one.lobe == 1 || one.lobe == -1);
    }
    const std::array<T, 7> row = loaded_rows<7, isa>(rows);
    const auto& [phi_l, phi_g, phi_h, I_l, I_g, I_h, region] = row;
    const T zero(0.0), one(1.0), size = abs(I_l);
    s.negative3 = (s.long_axis && negative_lobe) || (!s.long_axis && I_l < zero);
    s.x = negated(!(s.long_axis || s.negative3), phi_l);
    s.angle = phi_g - select(s.long_axis, zero, s.x);
    s.h = phi_h;
    s.G = I_g;
    s.H = I_h;
    s.usual = s.usual && of_mode<T>(s.long_axis, c_.usual) > zero && I_g > T(0x1p-100) &&
              I_g < T(0x1p100) && abs(I_h) <= I_g && size <= I_g &&
              abs(phi_h) <= T(std::numeric_limits<double>::max());
    Root& r = root_[i];
    r.target = select(s.long_axis, I_l, T(I_g - size)) / I_g;
    r.kap2 = of_mode<T>(s.long_axis, c_.kap2);
    r.root_of_kap2 = of_mode<T>(s.long_axis, c_.root_of_kap2);
    r.most = of_mode<T>(s.long_axis, c_.most);
    r.least = of_mode<T>(s.long_axis, c_.least);
    const T part = r.target / of_mode<T>(s.long_axis, c_.border);
    s.usual = s.usual && r.target > T(1e-20) && part < one;
    r.first = r.most * part;
    const T tangent = r.target / r.root_of_kap2;
    r.y = r.first + (tangent - r.first) * (one - part);
    r.done = !s.usual;
    r.target = select(s.usual, r.target, T(0.5));
    r.y = select(s.usual, r.y, T(0.5 * r.most));
  }

  // Each lane by its own steps, whatever its neighbours need.
  [[gnu::always_inline]] void solve(std::size_t packs) {
    for (int k = 0; k < most_steps; ++k) {
      Mask rest(false);
      for (std::size_t i = 0; i < packs; ++i) {
        Root& r = root_[i];
        if (all(r.done)) continue;
        const auto at = deficit_at(polhode_at(r.y, r.kap2, r.most, r.least), r.y, r.root_of_kap2);
        const T step = (at.deficit - r.target) / at.slope, half(0.5);
        T next = r.y - step;
        next = select(next < r.first, T(half * (r.y + r.first)), next);
        next = select(next < r.most, next, T(half * (r.y + r.most)));
        const T room = r.most - next, size = select(room < next, room, next);
        const Mask settled = abs(step) <= T(0x1p-27) * size;
        r.y = select(r.done, r.y, next);
        r.done = r.done || settled;
        rest = rest || !r.done;
      }
      if (!any(rest)) return;
    }
    for (std::size_t i = 0; i < packs; ++i) motion_[i].usual = motion_[i].usual && root_[i].done;
  }

  static constexpr int most_steps = 12;

  Root root_[Base::most];
};

// At most 64 sets; usual[i] says whether result i is right.
template <InstructionSet isa>
void rotors_of_sadov_in_lanes(const SadovConstants& constants, const SadovState* sets,
                              std::size_t count, RotorState* results, bool* usual) {
  RotorsOfSadov<isa> block(constants);
  block.convert(sets, count, results, usual);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
