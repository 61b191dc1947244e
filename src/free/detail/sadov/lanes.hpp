// SPDX-License-Identifier: MIT
// Sadov's variables of many states of a body, as many at a time as a register holds; compiled once
// for each set of instructions.
//
// One loop of the arithmetic-geometric mean, Bulirsch's, gives the action and, by Gauss's
// transformation of the amplitude, x = pi u / (2K) itself, the nome, and the shift of the theta
// function whose argument is what the mean frame needs: no K, no K', no F.
// docs/design/0033-grids-and-charts-in-lanes.md.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "free/detail/sadov/polhode.hpp"
#include "math/pack_functions.hpp"
#include "math/pack_rows.hpp"
#include "polhode/free/sadov.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Stage by stage for a block of packs: each step of the loop for all of them, so that their long
// chains of roots and quotients overlap.
template <InstructionSet isa>
class SadovBlock {
 public:
  using T = Pack<isa>;
  using Mask = PackMask<isa>;
  using P = LanePhasor<T>;
  using Curve = SadovCurve<T>;
  static constexpr std::size_t most = 64 / T::width;  // packs

  explicit SadovBlock(const SadovConstants& c, const TimesOfStates& times = {nullptr, 0})
      : c_(c), times_(times) {}

  // Results, and whether each is right: not next to what degenerates.
  template <class To>
  [[gnu::flatten]] void convert(const double* rows, std::size_t count, To* results, bool* usual) {
    rows_ = rows;
    const std::size_t whole = count / T::width, packs = (count + T::width - 1) / T::width;
    for (std::size_t i = 0; i < whole; ++i) begin(i, loaded_rows<7, isa>(rows + 7 * T::width * i));
    if (whole < packs) begin(whole, loaded_rows<7, isa>(padded(rows, whole * T::width, count)));
    for (std::size_t i = 0; i < packs; ++i) first_angle(i);
    step_of_mean<0>(packs);
    for (std::size_t i = 0; i < packs; ++i) large_angle(i, T(0.25));
    step_of_mean<1>(packs);
    for (std::size_t i = 0; i < packs; ++i) large_angle(i, T(0.125));
    step_of_mean<2>(packs);
    for (std::size_t i = 0; i < packs; ++i) small_angle(i, T(0.0625));
    step_of_mean<3>(packs);
    for (std::size_t i = 0; i < packs; ++i) small_angle(i, T(0.03125));
    step_of_mean<4>(packs);
    for (std::size_t i = 0; i < packs; ++i) small_angle(i, T(0.015625));
    step_of_mean<5>(packs);
    for (std::size_t i = 0; i < packs; ++i) small_angle(i, T(0.0078125));
    step_of_mean<6>(packs);
    for (std::size_t i = 0; i < packs; ++i) theta(i);
    for (std::size_t i = 0; i < packs; ++i)
      finish(i, std::min(T::width, count - T::width * i), results + T::width * i,
             usual + T::width * i);
  }

 private:
  // The last ones next to copies of the first of them.
  [[gnu::always_inline]] const double* padded(const double* rows, std::size_t first,
                                              std::size_t count) {
    for (std::size_t j = 0; j < T::width; ++j)
      std::memcpy(padded_ + 7 * j, rows + 7 * (first + j < count ? first + j : first),
                  7 * sizeof(double));
    return padded_;
  }

  // What the amplitude becomes, besides.
  struct Means : SadovMean<T> {
    P phi;
    T x;
  };

  [[gnu::always_inline]] void begin(std::size_t i, const std::array<T, 7>& row) {
    const BasicVec3<T> g{row[4], row[5], row[6]};
    const T square = row[0] * row[0] + row[1] * row[1] + row[2] * row[2] + row[3] * row[3];
    const T n = T(1.0) / sqrt(square);
    attitude_[i] = {n * row[0], n * row[1], n * row[2], n * row[3]};
    momentum_[i] = rotate(attitude_[i], g);
    curve_[i] = sadov_curve(c_, g);
    curve_[i].usual = curve_[i].usual && square > T(0x1p-200) && square < T(0x1p200);
    begin_means(i, curve_[i]);
  }

  [[gnu::always_inline]] void begin_means(std::size_t i, const Curve& k) {
    const T one(1.0), zero(0.0);
    Means& s = means_[i];
    begin_mean<isa>(s, k.kp2, sqrt(select(k.by_deficit, T(one + k.r2), T(one + k.kap2))),
                    select(k.by_deficit, zero, k.kp2), k.kap2, k.r2);
    const T c = k.m.x * of_mode<T>(k.long_axis, c_.cosine),
            d = k.m.y * of_mode<T>(k.long_axis, c_.sine);
    const T size = one / sqrt(T(c * c + d * d));
    s.phi = {c * size, d * size};
  }

  template <int n>
  [[gnu::always_inline]] void step_of_mean(std::size_t packs) {
    for (std::size_t i = 0; i < packs; ++i)
      detail::step_of_mean<n, isa>(means_[i], curve_[i].k2, curve_[i].small);
  }
  // The amplitude phi goes to phi + arctan(b/a tan phi), and x is the limit of phi / 2^n: the first
  // step by the bisector of the two angles, then phi goes to twice itself less an angle e,
  // tan e = (a - b) sin cos / (a cos^2 + b sin^2).
  [[gnu::always_inline]] void first_angle(std::size_t i) {
    Means& s = means_[i];
    const T across = s.kc * s.phi.im;
    const T unit = T(1.0) / sqrt(T(s.phi.re * s.phi.re + across * across));
    const P to{s.phi.re * unit, across * unit};
    s.x = atan2(T(s.phi.im + to.im), T(s.phi.re + to.re));
    s.phi = s.phi * to;
  }
  struct Turn {
    T over, under;
  };
  [[gnu::always_inline]] static Turn turn(const Means& s) {
    return {(s.mean - s.kc) * s.phi.im * s.phi.re,
            s.mean * s.phi.re * s.phi.re + s.kc * s.phi.im * s.phi.im};
  }
  [[gnu::always_inline]] void large_angle(std::size_t i, const T& part) {
    Means& s = means_[i];
    const Turn t = turn(s);
    s.x = s.x - part * atan2(t.over, t.under);
    const P next = s.phi * P{s.mean * s.phi.re, s.kc * s.phi.im};
    // to a length near 1, however far b/a is from 1
    s.phi = T(T(1.0) / (abs(next.re) + abs(next.im))) * next;
  }
  [[gnu::always_inline]] void small_angle(std::size_t i, const T& part) {
    Means& s = means_[i];
    const Turn t = turn(s);
    s.x = s.x - part * small_atan(T(t.over / t.under));
    s.phi = s.phi * P{s.phi.re, s.kc * s.inverse_mean * s.phi.im};
  }

  // theta4(x - ia) of nome q^2, up to a positive factor: what turns the mean frame.
  [[gnu::always_inline]] void theta(std::size_t i) {
    const T one(1.0), two(2.0);
    const Means& s = means_[i];
    const Curve& k = curve_[i];
    const T q = exp_of_negative(s.nome), w = exp_of_negative(log_of_shift(s, k.kap2, k.r2));
    const T q2 = q * q, q4 = q2 * q2, w2 = w * w;
    const SinCos<T> at = sincos(s.x);
    const P first{one - two * at.sin * at.sin, two * at.sin * at.cos};
    const T twice = two * first.re;
    T low = q2 / w, step = q4 * low, power = w2;  // q^(2 j^2) / w^j, q^(4 j + 2) / w, w^(2 j)
    P z = first, before{one, T(0.0)}, sum{one, T(0.0)};
#pragma GCC unroll 6
    for (int j = 1; j <= 6; ++j) {
      const P term{low * (one + power) * z.re, low * (one - power) * z.im};
      sum = j % 2 == 1 ? sum - term : sum + term;
      const P next = twice * z - before;
      before = z;
      z = next;
      low = low * step;
      step = step * q4;
      power = power * w2;
    }
    theta_[i] = sum;
  }

  [[gnu::always_inline]] T action(const Curve& k, const Means& s) const {
    const T one(1.0);
    const T cel = (s.b + s.a * s.mean) / (s.mean * (s.mean + s.p));
    return of_mode<T>(k.long_axis, c_.root_of_kap2) / sqrt(T(one + k.r2)) * cel *
           select(k.by_deficit, k.r2, one);
  }

  // What both sets of variables hold.
  struct Found {
    T h, H, mean_angle;  // of the frame, less the angle of its node at u = 0
    Mask usual;
  };
  [[gnu::always_inline]] Found found(std::size_t i) const {
    const T half_pi(1.5707963267948966);
    const Curve& k = curve_[i];
    const BasicVec3<T>& M = momentum_[i];
    const P frame = frame_phasor(c_, k, attitude_[i]) * conj(theta_[i] * theta_[i]);
    const T node2 = M.x * M.x + M.y * M.y;
    const Mask minus = (k.long_axis && !k.negative1) || (!k.long_axis && k.negative3);
    return {wrapped_angle(atan2(M.x, T(-M.y))), third_momentum(k.G, M.z, node2),
            atan2(frame.im, frame.re) - negated(minus, half_pi),
            k.usual && node2 > T(least_tilt * least_tilt) * (k.G * k.G)};
  }

  [[gnu::always_inline]] void finish(std::size_t i, std::size_t count, SadovState* results,
                                     bool* usual) const {
    const T zero(0.0), pi(3.141592653589793);
    const Curve& k = curve_[i];
    const T x = means_[i].x, G = k.G, size = G * action(k, means_[i]);
    const Found f = found(i);
    const T I_l =
        select(k.long_axis, size, negated(k.negative3, select(k.by_deficit, T(G - size), size)));
    const T from_start = select(k.negative1, T(x + pi), x);
    const T phi_l = wrapped_angle(negated(!(k.long_axis || k.negative3), from_start));
    const T phi_g = wrapped_angle(wrapped_angle(f.mean_angle + select(k.long_axis, zero, x)));
    for (std::size_t j = 0; j < count; ++j) {
      const bool is_long = k.long_axis.lanes[j] != 0;
      results[j] = {phi_l.lanes[j],
                    phi_g.lanes[j],
                    f.h.lanes[j],
                    I_l.lanes[j],
                    G.lanes[j],
                    f.H.lanes[j],
                    is_long ? SadovRegion::long_axis : SadovRegion::short_axis,
                    is_long && k.negative3.lanes[j] != 0 ? -1 : 1};
      usual[j] = f.usual.lanes[j] != 0;
    }
  }

  [[gnu::always_inline]] BasicVec3<T> given_momentum(std::size_t i, std::size_t count) {
    const std::size_t first = T::width * i;
    const double* const rows =
        count == T::width ? rows_ + 7 * first : padded(rows_, first, first + count);
    const std::array<T, 7> row = loaded_rows<7, isa>(rows);
    return {row[4], row[5], row[6]};
  }

  [[gnu::always_inline]] void finish(std::size_t i, std::size_t count, SerretState* results,
                                     bool* usual) {
    const T zero(0.0), one(1.0), pi(3.141592653589793);
    const Curve& k = curve_[i];
    const Means& m = means_[i];
    const Found f = found(i);
    const LaneInvariants<T> c = lane_invariants(c_, given_momentum(i, count));
    const T size = action(k, m), deficit = select(k.by_deficit, size, T(one - size));
    const T a3 = one / sqrt(T(one + k.r2));
    const T rate = of_mode<T>(k.long_axis, c_.rate_per_a3) * a3 * (m.mean * T(1.0 / 128));
    // from where the momentum along primed axis 1 is positive
    const T x = m.x, from_start = select(k.negative1, T(x - negated(!(x > zero), pi)), x);
    const T elapsed = negated(k.long_axis, from_start) / rate;
    const T over = one / c.G, E = T(2.0 * c_.moment_unit) * c.energy * over * over;
    const T turn = E * elapsed, half_turn = select(k.negative1 && !k.long_axis, pi, zero);
    const T swept = whole_turns_off<1>(exact_product(E, elapsed)) - deficit * from_start;
    const T g0 = wrapped_angle(wrapped_angle(f.mean_angle + half_turn) - wrapped_angle(swept));
    double at[T::width];
    for (std::size_t j = 0; j < T::width; ++j) at[j] = times_[T::width * i + (j < count ? j : 0)];
    const T t = T::loaded(at), since = elapsed * over * T(c_.moment_unit), t0 = t - since;
    const Mask right = f.usual && abs(turn) < T(most_radians) && abs(t) < T(0x1p200) &&
                       abs(since) < T(0x1p200) && c.energy > T(0x1p-900) && c.energy < T(0x1p900);
    for (std::size_t j = 0; j < count; ++j) {
      const bool is_long = k.long_axis.lanes[j] != 0;
      const int sign3 = k.negative3.lanes[j] != 0 ? -1 : 1;
      results[j] = {g0.lanes[j],  f.h.lanes[j],      t0.lanes[j],         c.G.lanes[j],
                    f.H.lanes[j], c.energy.lanes[j], is_long ? sign3 : 1, is_long ? 1 : sign3};
      usual[j] = right.lanes[j] != 0;
    }
  }

  static constexpr double least_tilt = 1e-6;

  const SadovConstants& c_;
  TimesOfStates times_;
  const double* rows_ = nullptr;
  BasicQuaternion<T> attitude_[most];
  BasicVec3<T> momentum_[most];  // along inertial axes
  Curve curve_[most];
  Means means_[most];
  P theta_[most];
  double padded_[7 * T::width];
};

// At most 64 states; usual[i] says whether result i is right.
template <InstructionSet isa>
void sadov_in_lanes(const SadovConstants& constants, const RotorState* states, std::size_t count,
                    SadovState* results, bool* usual) {
  SadovBlock<isa> block(constants);
  block.convert(reinterpret_cast<const double*>(states), count, results, usual);
}

// The same of Serret's elements.
template <InstructionSet isa>
void serret_in_lanes(const SadovConstants& constants, const RotorState* states,
                     const TimesOfStates& times, std::size_t count, SerretState* results,
                     bool* usual) {
  SadovBlock<isa> block(constants, times);
  block.convert(reinterpret_cast<const double*>(states), count, results, usual);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
