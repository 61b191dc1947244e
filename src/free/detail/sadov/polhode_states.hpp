// SPDX-License-Identifier: MIT
// States on polhodes that are known, a body's: what Sadov's variables and Serret's elements are put
// together by, as many at a time as a register holds. The attitude is that of theta4 and theta1 of
// x - ia. docs/design/0036-threads-and-the-way-back.md.
#pragma once

#include <cstddef>

#include "free/detail/sadov/constants.hpp"
#include "free/detail/sadov/polhode.hpp"
#include "math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <InstructionSet isa>
class StatesOnPolhodes {
 public:
  using T = Pack<isa>;
  using Mask = PackMask<isa>;
  using P = LanePhasor<T>;
  static constexpr std::size_t most = 64 / T::width;  // packs

 protected:
  // Where on its polhode, and the frame: its mean angle is `angle` and a quarter turn.
  struct Motion {
    T x, angle, h, G, H;
    Mask long_axis, negative3, usual;
  };

  explicit StatesOnPolhodes(const SadovConstants& c) : c_(c) {}

  // The mean of a polhode that stands in polhode_ and kap2_.
  [[gnu::always_inline]] void begin_polhode(std::size_t i) {
    const PolhodeOfDeficit<T>& c = polhode_[i];
    motion_[i].usual = motion_[i].usual && c.kp2 > T(least_complement) && c.r2 > T(1e-24);
    begin_mean<isa>(mean_[i], c.kp2, T(T(1.0) / c.a3), T(0.0), kap2_[i], c.r2);
  }
  [[gnu::always_inline]] void steps_of_mean(std::size_t packs) {
    step_of_mean<0>(packs);
    step_of_mean<1>(packs);
    step_of_mean<2>(packs);
    step_of_mean<3>(packs);
    step_of_mean<4>(packs);
    step_of_mean<5>(packs);
    step_of_mean<6>(packs);
  }

  [[gnu::always_inline]] void finish(std::size_t i, std::size_t count, RotorState* results,
                                     bool* usual) const {
    const Motion& s = motion_[i];
    const T two(2.0), one(1.0);
    const LanePhasorPair<T> p = at_phase(i, sincos(s.x));
    const LanePhasorPair<T> all = product(frame(s), p);
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
    const T scale = s.G / (alpha2 + beta2);
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

  const SadovConstants& c_;
  Motion motion_[most];
  PolhodeOfDeficit<T> polhode_[most];
  T kap2_[most];
  SadovMean<T> mean_[most];

 private:
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
    const T w = exp_of_negative(log_of_shift(m, kap2_[i], c.r2));
    const Series s = series(q, w, x);
    const T a1 = sqrt(c.r2) * c.a3, a2 = a1 * of_mode<T>(motion_[i].long_axis, c_.a2_over_a1);
    // tan(theta/2) at x = pi/2, where the momentum is (0, a2, a3 k')
    const T size = a2 * s.alpha_quarter / ((one + c.a3 * sqrt(c.kp2)) * s.beta_quarter);
    return {s.alpha, size * s.beta};
  }

  // qz(h) qx(I) qz(mean angle), times sqrt(2 G).
  [[gnu::always_inline]] static LanePhasorPair<T> frame(const Motion& s) {
    const T half(0.5), root(0.70710678118654752);
    const SinCos<T> h = sincos(T(half * s.h)), g = sincos(T(half * s.angle));
    const Mask minus = s.long_axis || s.negative3;
    const P turn = P{g.cos, g.sin} * P{root, negated(minus, root)}, node{h.cos, h.sin};
    const T c = sqrt(T(s.G + s.H)), d = sqrt(T(s.G - s.H));
    return {c * (node * turn), d * (node * conj(turn))};
  }

  [[gnu::always_inline]] static LanePhasorPair<T> product(const LanePhasorPair<T>& p,
                                                          const LanePhasorPair<T>& r) {
    return {p.a * r.a - p.b * conj(r.b), p.a * r.b + p.b * conj(r.a)};
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
