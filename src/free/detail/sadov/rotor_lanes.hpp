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
#include "free/detail/sadov/frame.hpp"
#include "free/detail/sadov/mean.hpp"
#include "polhode/math/pack_functions.hpp"
#include "polhode/math/pack_rows.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <InstructionSet isa>
class RotorsOfSadov {
 public:
  using T = Pack<isa>;
  using Mask = PackMask<isa>;
  using P = LanePhasor<T>;
  static constexpr std::size_t most = 64 / T::width;  // packs

  explicit RotorsOfSadov(const SadovConstants& c) : c_(c) {}

  [[gnu::flatten]] void convert(const SadovState* sets, std::size_t count, RotorState* results,
                                bool* usual) {
    const std::size_t packs = (count + T::width - 1) / T::width;
    for (std::size_t i = 0; i < packs; ++i)
      begin(i, sets + T::width * i, std::min(T::width, count - T::width * i));
    solve(packs);
    for (std::size_t i = 0; i < packs; ++i) begin_series(i);
    step_of_mean<0>(packs);
    step_of_mean<1>(packs);
    step_of_mean<2>(packs);
    step_of_mean<3>(packs);
    step_of_mean<4>(packs);
    step_of_mean<5>(packs);
    step_of_mean<6>(packs);
    for (std::size_t i = 0; i < packs; ++i)
      finish(i, std::min(T::width, count - T::width * i), results + T::width * i,
             usual + T::width * i);
  }

 private:
  struct Set {
    T phi_l, phi_g, phi_h, I_l, I_g, I_h;
    Mask long_axis, negative3, usual;
  };
  struct Root {
    T y, target, first, most, root_of_kap2, kap2, least;
    Mask done;
  };

  // The last ones next to copies of the first of them.
  [[gnu::always_inline]] void begin(std::size_t i, const SadovState* sets, std::size_t count) {
    double rows[7 * T::width];
    static_assert(sizeof(SadovState) == 7 * sizeof(double));
    Set& s = set_[i];
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
    s.phi_l = row[0];
    s.phi_g = row[1];
    s.phi_h = row[2];
    s.I_l = row[3];
    s.I_g = row[4];
    s.I_h = row[5];
    const T zero(0.0), one(1.0), size = abs(s.I_l);
    s.negative3 = (s.long_axis && negative_lobe) || (!s.long_axis && s.I_l < zero);
    s.usual = s.usual && of_mode<T>(s.long_axis, c_.usual) > zero && s.I_g > T(0x1p-100) &&
              s.I_g < T(0x1p100) && abs(s.I_h) <= s.I_g && size <= s.I_g;
    Root& r = root_[i];
    r.target = select(s.long_axis, s.I_l, T(s.I_g - size)) / s.I_g;
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
    for (std::size_t i = 0; i < packs; ++i) set_[i].usual = set_[i].usual && root_[i].done;
  }

  [[gnu::always_inline]] void begin_series(std::size_t i) {
    const Root& r = root_[i];
    polhode_[i] = polhode_at(r.y, r.kap2, r.most, r.least);
    const PolhodeOfDeficit<T>& c = polhode_[i];
    set_[i].usual = set_[i].usual && c.kp2 > T(least_complement) && c.r2 > T(1e-24);
    begin_mean<isa>(mean_[i], c.kp2, T(T(1.0) / c.a3), T(0.0), r.kap2, c.r2);
  }
  template <int n>
  [[gnu::always_inline]] void step_of_mean(std::size_t packs) {
    for (std::size_t i = 0; i < packs; ++i)
      detail::step_of_mean<n, isa>(mean_[i], polhode_[i].k2, polhode_[i].k2 < T(0.01));
  }

  // theta4(x - ia) and theta1(x - ia) of nome q^2, the second up to a factor, and their sizes at
  // x = pi/2.
  struct Series {
    P alpha, beta;
    T alpha_quarter, beta_quarter;
  };
  [[gnu::always_inline]] static Series series(const T& q, const T& w, const SinCos<T>& x) {
    const T one(1.0), two(2.0), zero(0.0);
    const P twice_x{one - two * x.sin * x.sin, two * x.sin * x.cos};
    const T twice = two * twice_x.re;
    const T q2 = q * q, q4 = q2 * q2, w2 = w * w;
    Series s{{one, zero}, {zero, zero}, one, zero};
    P even_before{one, zero}, even = twice_x, odd_before{x.cos, -x.sin}, odd{x.cos, x.sin};
    // q^(2 j^2) / w^j, w^(2 j); q^(2 n (n + 1)) / w^n, w^(2 n + 1)
    T even_size = q2 / w, even_step = q4 * even_size, even_power = w2;
    T odd_size = one, odd_step = q4 / w, odd_power = w;
#pragma GCC unroll 6
    for (int j = 1; j <= 6; ++j) {
      const T plus = even_size * (one + even_power), minus = even_size * (one - even_power);
      const T odd_plus = odd_size * (one + odd_power), odd_minus = odd_size * (one - odd_power);
      const P term{plus * even.re, minus * even.im};
      const P odd_term{odd_plus * odd.im, -(odd_minus * odd.re)};
      s.alpha = j % 2 == 1 ? s.alpha - term : s.alpha + term;
      s.beta = j % 2 == 1 ? s.beta + odd_term : s.beta - odd_term;
      s.alpha_quarter = s.alpha_quarter + plus;
      s.beta_quarter = s.beta_quarter + odd_plus;
      const P next = twice * even - even_before, odd_next = twice * odd - odd_before;
      even_before = even;
      even = next;
      odd_before = odd;
      odd = odd_next;
      even_size = even_size * even_step;
      even_step = even_step * q4;
      even_power = even_power * w2;
      odd_size = odd_size * odd_step;
      odd_step = odd_step * q4;
      odd_power = odd_power * w2;
    }
    return s;
  }

  // Primed axes <- mean frame, at x; not of length one.
  [[gnu::always_inline]] LanePhasorPair<T> at_phase(std::size_t i, const SinCos<T>& x) const {
    const T one(1.0);
    const SadovMean<T>& m = mean_[i];
    const PolhodeOfDeficit<T>& c = polhode_[i];
    const T q = exp_of_negative(m.nome);
    const T w = exp_of_negative(log_of_shift(m, root_[i].kap2, c.r2));
    const Series s = series(q, w, x);
    const T a1 = sqrt(c.r2) * c.a3, a2 = a1 * of_mode<T>(set_[i].long_axis, c_.a2_over_a1);
    // tan(theta/2) at x = pi/2, where the momentum is (0, a2, a3 k')
    const T size = a2 * s.alpha_quarter / ((one + c.a3 * sqrt(c.kp2)) * s.beta_quarter);
    return {s.alpha, size * s.beta};
  }

  // qz(h) qx(I) qz(mean angle), times sqrt(2 G); the mean angle is phi_g - x or phi_g, and a
  // quarter turn.
  [[gnu::always_inline]] LanePhasorPair<T> frame(const Set& s, const T& x) const {
    const T zero(0.0), half(0.5), root(0.70710678118654752);
    const SinCos<T> h = sincos(T(half * s.phi_h));
    const SinCos<T> g = sincos(T(half * (s.phi_g - select(s.long_axis, zero, x))));
    const Mask minus = s.long_axis || s.negative3;
    const P turn = P{g.cos, g.sin} * P{root, negated(minus, root)}, node{h.cos, h.sin};
    const T c = sqrt(T(s.I_g + s.I_h)), d = sqrt(T(s.I_g - s.I_h));
    return {c * (node * turn), d * (node * conj(turn))};
  }

  [[gnu::always_inline]] static LanePhasorPair<T> product(const LanePhasorPair<T>& p,
                                                          const LanePhasorPair<T>& r) {
    return {p.a * r.a - p.b * conj(r.b), p.a * r.b + p.b * conj(r.a)};
  }

  [[gnu::always_inline]] void finish(std::size_t i, std::size_t count, RotorState* results,
                                     bool* usual) const {
    const Set& s = set_[i];
    const T two(2.0), one(1.0);
    const T x = negated(!(s.long_axis || s.negative3), s.phi_l);
    const LanePhasorPair<T> p = at_phase(i, sincos(x));
    const LanePhasorPair<T> all = product(frame(s, x), p);
    // times the half turn about axis 1 where the momentum along axis 3 is negative
    const T half_turn = of_mode<T>(s.long_axis, c_.half_turn);
    const P turned_a = T(-half_turn) * all.b, turned_b = half_turn * all.a;
    const P a = select(s.negative3, turned_a, all.a), b = select(s.negative3, turned_b, all.b);
    const auto constant = [&](std::size_t j) {
      return select(s.long_axis, T(c_.to_axes[1][j]), T(c_.to_axes[0][j]));
    };
    const BasicQuaternion<T> axes{constant(0), -constant(1), -constant(2), -constant(3)};
    const BasicQuaternion<T> q = BasicQuaternion<T>{a.re, b.re, b.im, a.im} * axes;
    const T over = one / sqrt(T(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z));
    const T alpha2 = p.a.re * p.a.re + p.a.im * p.a.im, beta2 = p.b.re * p.b.re + p.b.im * p.b.im;
    const T scale = s.I_g / (alpha2 + beta2);
    const T m1 = two * scale * (p.b.re * p.a.im - p.a.re * p.b.im),
            m2 = two * scale * (p.b.im * p.a.im + p.a.re * p.b.re),
            m3 = negated(s.negative3, T(scale * (alpha2 - beta2)));
    T g[3];
    const T sorted[] = {select(s.long_axis, m3, m1), negated(s.long_axis != s.negative3, m2),
                        select(s.long_axis, m1, m3)};
    for (std::size_t j = 0; j < 3; ++j) g[c_.axis[j]] = T(c_.sign[j]) * sorted[j];
    const T n[] = {over * q.w, over * q.x, over * q.y, over * q.z};
    for (std::size_t j = 0; j < count; ++j) {
      results[j] = {{n[0].lanes[j], n[1].lanes[j], n[2].lanes[j], n[3].lanes[j]},
                    {g[0].lanes[j], g[1].lanes[j], g[2].lanes[j]}};
      usual[j] = s.usual.lanes[j] != 0;
    }
  }

  static constexpr int most_steps = 12;

  const SadovConstants& c_;
  Set set_[most];
  Root root_[most];
  PolhodeOfDeficit<T> polhode_[most];
  SadovMean<T> mean_[most];
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
