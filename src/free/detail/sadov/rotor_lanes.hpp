// SPDX-License-Identifier: MIT
// States of a body from Sadov's variables or Serret's elements in lanes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

#include "free/detail/sadov/constants.hpp"
#include "free/detail/sadov/polhode.hpp"
#include "free/detail/sadov/polhode_states.hpp"
#include "math/pack_functions.hpp"
#include "math/pack_rows.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The states of many sets of Sadov's variables of a body, as many at a time as a register holds;
// compiled once for each set of instructions.
//
// The polhode of each action first (polhode.hpp), then the attitude, by theta4 and theta1 of
// x - ia. docs/design/0036-threads-and-the-way-back.md.
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

// Phases of more lose digits; elements whose t0 is the nearest to t have at most half a turn.
inline constexpr double most_phase = 4.0;

// 1 - E I, of E in two parts.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> one_less(const TwoTerms<Pack<isa>>& E, double I) {
  using T = Pack<isa>;
  const TwoTerms<T> p = exact_product(E.hi, T(I)), s = two_sum(T(1.0), T(-p.hi));
  return s.hi + (s.lo - (p.lo + E.lo * T(I)));
}

// The states of many sets of Serret's elements of a body at times, as many at a time as a register
// holds; compiled once for each set of instructions.
//
// The polhode of an energy, in two parts as far as it cancels. The frame's mean rate is 2T/G less
// the phase's rate times the deficit of the action, since the energy is of degree two in the
// actions: so the turn that grows with time is a product of two given numbers.
// docs/design/0036-threads-and-the-way-back.md.
template <InstructionSet isa>
class RotorsOfSerret : private StatesOnPolhodes<isa> {
  using Base = StatesOnPolhodes<isa>;
  using Base::c_, Base::kap2_, Base::mean_, Base::motion_, Base::polhode_;
  using typename Base::Mask, typename Base::Motion, typename Base::T;

 public:
  explicit RotorsOfSerret(const SadovConstants& c) : Base(c) {}

  [[gnu::flatten]] void convert(const SerretState* sets, const TimesOfStates& times,
                                std::size_t count, RotorState* results, bool* usual) {
    const std::size_t packs = (count + T::width - 1) / T::width;
    for (std::size_t i = 0; i < packs; ++i) {
      const std::size_t first = T::width * i;
      begin(i, sets + first, times.from(first), std::min(T::width, count - first));
      this->begin_polhode(i);
    }
    this->steps_of_mean(packs);
    for (std::size_t i = 0; i < packs; ++i) set_phase(i);
    for (std::size_t i = 0; i < packs; ++i)
      this->finish(i, std::min(T::width, count - T::width * i), results + T::width * i,
                   usual + T::width * i);
  }

 private:
  struct Elapsed {
    TwoTerms<T> E, time;  // 2T/G^2; t - t0 in the unit in which the momentum is 1
  };

  // The last ones next to copies of the first of them.
  [[gnu::always_inline]] void begin(std::size_t i, const SerretState* sets,
                                    const TimesOfStates& times, std::size_t count) {
    double rows[7 * T::width], at[T::width];
    static_assert(sizeof(SerretState) == 7 * sizeof(double));
    Motion& s = motion_[i];
    Mask negative_g1(false), negative_g3(false), signs(true);
    for (std::size_t j = 0; j < T::width; ++j) {
      const SerretState& one = sets[j < count ? j : 0];
      std::memcpy(rows + 7 * j, &one, sizeof one);
      at[j] = times[j < count ? j : 0];
      LaneTraits<T>::set_mask(negative_g1, j, one.sign_g1 < 0);
      LaneTraits<T>::set_mask(negative_g3, j, one.sign_g3 < 0);
      const auto is_sign = [](int x) { return x == 1 || x == -1; };
      LaneTraits<T>::set_mask(signs, j, is_sign(one.sign_g1) && is_sign(one.sign_g3));
    }
    const std::array<T, 7> row = loaded_rows<7, isa>(rows);
    const auto& [g0, h, t0, G, H, energy, sign] = row;
    const T t = T::loaded(at), zero(0.0), one(1.0);
    set_elapsed(i, t, t0, G, energy);
    const TwoTerms<T>& E = elapsed_[i].E;
    const T D1 = one_less(E, c_.moment[0]), D2 = one_less(E, c_.moment[1]),
            D3 = -one_less(E, c_.moment[2]);
    s.long_axis = D2 < zero;
    s.negative3 = (s.long_axis && negative_g1) || (!s.long_axis && negative_g3);
    const Mask negative1 = (s.long_axis && negative_g3) || (!s.long_axis && negative_g1);
    s.angle = g0;  // and what the frame has turned
    s.h = h;
    s.G = G;
    s.H = H;
    const T DA = select(s.long_axis, D3, D1), DC = select(s.long_axis, D1, D3);
    s.usual = signs && !negative1 && of_mode<T>(s.long_axis, c_.usual) > zero && DA > zero &&
              DC > zero && G > T(0x1p-100) && G < T(0x1p100) && abs(H) <= G &&
              abs(h) <= T(std::numeric_limits<double>::max()) &&
              abs(g0) <= T(std::numeric_limits<double>::max());
    const T over = one / DA;
    PolhodeOfDeficit<T>& c = polhode_[i];
    kap2_[i] = of_mode<T>(s.long_axis, c_.kap2);
    c.r2 = of_mode<T>(s.long_axis, c_.A_over_C) * DC * over;
    c.k2 = of_mode<T>(s.long_axis, c_.k2_per_DC) * DC * over;
    c.kp2 =
        of_mode<T>(s.long_axis, c_.kp2_per_D2) * (abs(D2) * T(c_.moment[0] * c_.moment[2])) * over;
    c.a3 = one / sqrt(T(one + c.r2));
  }

  [[gnu::always_inline]] void set_elapsed(std::size_t i, const T& t, const T& t0, const T& G,
                                          const T& energy) {
    Elapsed& e = elapsed_[i];
    const TwoTerms<T> G2 = exact_product(G, G), since = two_sum(t, T(-t0));
    const T twice = T(2.0 * c_.moment_unit) * energy, over = T(1.0) / G2.hi;
    e.E.hi = twice * over;
    const TwoTerms<T> p = exact_product(e.E.hi, G2.hi);
    e.E.lo = (((twice - p.hi) - p.lo) - e.E.hi * G2.lo) * over;
    const T rate = G * T(1.0 / c_.moment_unit);
    e.time = exact_product(since.hi, rate);
    e.time.lo = e.time.lo + since.lo * rate;
  }

  // The phase by the mean, and the turn of the frame.
  [[gnu::always_inline]] void set_phase(std::size_t i) {
    const T one(1.0);
    Motion& s = motion_[i];
    const PolhodeOfDeficit<T>& c = polhode_[i];
    const SadovMean<T>& m = mean_[i];
    const Elapsed& e = elapsed_[i];
    const T rate = of_mode<T>(s.long_axis, c_.rate_per_a3) * c.a3 * (m.mean * T(1.0 / 128));
    s.x = negated(s.long_axis, rate) * e.time.hi;
    const T cel = (m.b + m.a * m.mean) / (m.mean * (m.mean + m.p));
    const T deficit = of_mode<T>(s.long_axis, c_.root_of_kap2) * c.a3 * c.r2 * cel;
    TwoTerms<T> turn = exact_product(e.E.hi, e.time.hi);
    turn.lo = turn.lo + (e.E.hi * e.time.lo + e.E.lo * e.time.hi);
    s.usual = s.usual && abs(s.x) < T(most_phase) && abs(turn.hi) < T(most_radians) &&
              abs(s.angle) < T(most_radians) && one > deficit;
    s.angle = s.angle + (whole_turns_off<2>(turn) - deficit * s.x);
  }

  Elapsed elapsed_[Base::most];
};

// At most 64 sets; usual[i] says whether result i is right.
template <InstructionSet isa>
void rotors_of_serret_in_lanes(const SadovConstants& constants, const SerretState* sets,
                               const TimesOfStates& times, std::size_t count, RotorState* results,
                               bool* usual) {
  RotorsOfSerret<isa> block(constants);
  block.convert(sets, times, count, results, usual);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
