// SPDX-License-Identifier: MIT
// Jacobi's functions of many arguments, as many at a time as a register holds; compiled once for
// each set of instructions.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "elliptic/detail/jacobi_lanes_declared.hpp"
#include "elliptic/detail/jacobi_theta.hpp"
#include "polhode/detail/math/pack.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {
namespace detail {

// What goes in lanes: moduli from 0 to 1 - 2^-500, and arguments whose half turns have 20 bits.
inline constexpr double least_trigonometric = 0.14, least_hyperbolic = 0x1p-500;
inline constexpr double most_argument = 1e6;

// Signs that say what goes how: integers of double numbers without sign are in their order, and
// those of NaN above all.
template <InstructionSet isa>
struct JacobiSigns {
  using T = Pack<isa>;
  using Bits = typename T::Bits;
  using Mask = typename T::Mask;

  [[gnu::always_inline]] static Bits bits(const T& x) { return std::bit_cast<Bits>(x.lanes); }
  [[gnu::always_inline]] static Bits below(const T& size, double most) {
    return std::bit_cast<std::int64_t>(most) - bits(abs(size));
  }
  // Set where a number goes by itself, whatever m1.
  [[gnu::always_inline]] static Bits alone(const T& u, const T& m, const T& m1) {
    return bits(m) | below(u, most_argument) | below((m + m1) - T(1.0), 0x1p-49);
  }
  // Set where the circle is left to the hyperbola, and where that is left, too.
  [[gnu::always_inline]] static Bits past_circle(const T& m1) {
    return bits(m1 - T(least_trigonometric));
  }
  [[gnu::always_inline]] static Bits past_hyperbola(const T& m1) {
    return bits(m1 - T(least_hyperbolic));
  }
  [[gnu::always_inline]] static Mask set(const Bits& signs) { return Mask(signs < 0); }
};

// Some packs of arguments, stage by stage: within a stage their chains of operations overlap, where
// those of whole values are longer than the processor looks ahead.
template <InstructionSet isa, bool one_modulus>
class JacobiBlock {
 public:
  using T = Pack<isa>;
  using Signs = JacobiSigns<isa>;
  static constexpr std::size_t packs = 16, width = T::width, lanes = packs * width;

  explicit JacobiBlock(const JacobiColumns& c) {
    if constexpr (one_modulus) {
      if (*c.m1 >= least_trigonometric)
        prepare_trigonometric(c, 1);
      else
        prepare_hyperbolic(c, 1);
    }
  }

  // Of n packs.
  [[gnu::flatten]] void write(const JacobiColumns& c, std::size_t n) {
    typename Signs::Bits alone{}, circle{}, hyperbola{};
    for (std::size_t i = 0; i < n; ++i) {
      const T m1 = of_modulus(c.m1, i);
      alone |= Signs::alone(T::loaded(c.u + i * width), of_modulus(c.m, i), m1);
      circle |= Signs::past_circle(m1);
    }
    if (!any(Signs::set(alone | circle))) {
      if constexpr (!one_modulus) prepare_trigonometric(c, n);
      return write_trigonometric(c, n);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const T m1 = of_modulus(c.m1, i);
      hyperbola |= Signs::past_hyperbola(m1) | ~Signs::past_circle(m1);
    }
    if (any(Signs::set(alone | hyperbola))) return write_mixed(c, n);
    if constexpr (!one_modulus) prepare_hyperbolic(c, n);
    write_hyperbolic(c, n);
  }

 private:
  [[gnu::always_inline]] static T of_modulus(const double* x, std::size_t i) {
    if constexpr (one_modulus)
      return T(*x);
    else
      return T::loaded(x + i * width);
  }
  // The place of what pack i has of its modulus.
  static constexpr std::size_t at(std::size_t i) { return one_modulus ? 0 : i; }

  [[gnu::always_inline]] void prepare_trigonometric(const JacobiColumns& c, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) root_[i] = rough_inverse_fourth_root(of_modulus(c.m1, i));
    for (std::size_t i = 0; i < n; ++i) root_[i] = fourth_root(of_modulus(c.m1, i), root_[i]);
    for (std::size_t i = 0; i < n; ++i) {
      const T l = second_root(root_[i]);
      nome_[i] = trigonometric_nome(l);
      rate_[i] = trigonometric_rate(root_[i], l);
    }
  }
  [[gnu::always_inline]] void write_trigonometric(const JacobiColumns& c, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const T x = rate_[at(i)] * T::loaded(c.u + i * width);
      const T whole = whole_quarters(x), k = whole - T(0x1.8p52), t = x - k;
      const SinCos<T> turned = quarters_turned(quarter_sine(t), quarter_cosine(t), whole, k);
      sine_[i] = turned.sin;
      cosine_[i] = turned.cos;
    }
    const T q = nome_[0];  // of one modulus, not read again
    for (std::size_t i = 0; i < n; ++i)
      store(trigonometric_jacobi(one_modulus ? q : nome_[i], SinCos<T>{sine_[i], cosine_[i]}), c,
            i);
  }

  [[gnu::always_inline]] void prepare_hyperbolic(const JacobiColumns& c, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const T m1 = of_modulus(c.m1, i);
      root_[i] = fourth_root_near_one(of_modulus(c.m, i), m1);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const T l = complementary_root(of_modulus(c.m1, i), root_[i]);
      nome_[i] = small_nome(l);
      rate_[i] = hyperbolic_rate(root_[i], l);
    }
    for (std::size_t i = 0; i < n; ++i) period_[i] = -log_of(nome_[i]);
  }
  [[gnu::always_inline]] void write_hyperbolic(const JacobiColumns& c, std::size_t n) {
    T rest[packs], doublings[packs];
    for (std::size_t i = 0; i < n; ++i) {
      const T v = rate_[at(i)] * T::loaded(c.u + i * width);
      const T periods = whole_periods(v, period_[at(i)]);
      whole_[i] = periods + T(0x1.8p52);
      const T left = v - periods * period_[at(i)];
      doublings[i] = whole_doublings(left);
      rest[i] = rest_of_doublings(left, doublings[i]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const T up = half_power(doublings[i]), down = half_inverse_power(doublings[i]);
      const T even = small_cosh(rest[i]), odd = small_sinh(rest[i]);
      const T ch = up + down, sh = up - down;
      sine_[i] = sh * even + ch * odd;
      cosine_[i] = ch * even + sh * odd;
    }
    const T s = root_[0], q = nome_[0];
    for (std::size_t i = 0; i < n; ++i)
      store(hyperbolic_jacobi(one_modulus ? s : root_[i], one_modulus ? q : nome_[i], sine_[i],
                              cosine_[i], whole_[i]),
            c, i);
  }
  // Rounding must not carry a sine or cosine beyond 1, where inverse functions give NaN.
  [[gnu::always_inline]] static T within_one(const T& x) {
    const T one(1.0);
    return select(x > one, one, select(x < T(-1.0), T(-1.0), x));
  }
  [[gnu::always_inline]] static void store(const JacobiInLanes<T>& j, const JacobiColumns& c,
                                           std::size_t i) {
    within_one(j.sn).store(c.sn + i * width);
    within_one(j.cn).store(c.cn + i * width);
    j.dn.store(c.dn + i * width);
  }

  // Sorted by kind: those of one kind side by side.
  [[gnu::noinline]] void write_mixed(const JacobiColumns& c, std::size_t n);

  static constexpr std::size_t moduli = one_modulus ? 1 : packs;
  T root_[moduli], nome_[moduli], rate_[moduli], period_[moduli];
  T sine_[packs], cosine_[packs], whole_[packs];
};

template <InstructionSet isa>
struct JacobiRoom {
  static constexpr std::size_t lanes = JacobiBlock<isa, false>::lanes;
  alignas(64) double u[lanes], m[lanes], m1[lanes], sn[lanes], cn[lanes], dn[lanes];
  JacobiColumns columns() { return {u, m, m1, sn, cn, dn}; }
};

template <InstructionSet isa, bool one_modulus>
void JacobiBlock<isa, one_modulus>::write_mixed(const JacobiColumns& c, std::size_t n) {
  // 0 on the circle, -1 on the hyperbola, -2 alone
  alignas(64) std::int64_t kind[lanes];
  for (std::size_t i = 0; i < n; ++i) {
    const T m1 = of_modulus(c.m1, i);
    const auto past = Signs::past_circle(m1);
    const auto alone = Signs::alone(T::loaded(c.u + i * width), of_modulus(c.m, i), m1) |
                       (past & Signs::past_hyperbola(m1));
    const auto by_itself = Signs::set(alone).lanes;
    const auto kinds = (by_itself & -2) | (~by_itself & Signs::set(past).lanes);
    std::memcpy(kind + i * width, &kinds, sizeof kinds);
  }
  JacobiRoom<isa> room;
  std::size_t place[lanes];
  for (const int which : {0, -1}) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < n * width; ++i) {
      place[count] = i;
      count += static_cast<std::size_t>(kind[i] == which);
    }
    if (count == 0) continue;
    const std::size_t whole = (count + width - 1) / width;
    for (std::size_t i = 0; i < whole * width; ++i) {
      const std::size_t from = place[i < count ? i : 0];
      room.u[i] = c.u[from];
      room.m[i] = c.m[at(from)];
      room.m1[i] = c.m1[at(from)];
    }
    if (which == 0) {
      if constexpr (!one_modulus) prepare_trigonometric(room.columns(), whole);
      write_trigonometric(room.columns(), whole);
    } else {
      if constexpr (!one_modulus) prepare_hyperbolic(room.columns(), whole);
      write_hyperbolic(room.columns(), whole);
    }
    for (std::size_t i = 0; i < count; ++i) {
      c.sn[place[i]] = room.sn[i];
      c.cn[place[i]] = room.cn[i];
      c.dn[place[i]] = room.dn[i];
    }
  }
  for (std::size_t i = 0; i < n * width; ++i)
    if (kind[i] == -2) jacobi_alone(c.u[i], c.m[at(i)], c.m1[at(i)], c.sn[i], c.cn[i], c.dn[i]);
}

template <InstructionSet isa, bool one_modulus>
void jacobi_in_lanes(const JacobiColumns& c, std::size_t count) {
  JacobiBlock<isa, one_modulus> block(c);
  constexpr std::size_t width = Pack<isa>::width, lanes = block.lanes;
  const std::size_t whole = count - count % width;
  const auto from = [&c](std::size_t i) {
    const std::size_t j = one_modulus ? 0 : i;
    return JacobiColumns{c.u + i, c.m + j, c.m1 + j, c.sn + i, c.cn + i, c.dn + i};
  };
  for (std::size_t i = 0; i < whole; i += lanes)
    block.write(from(i), std::min(lanes, whole - i) / width);
  if (whole == count) return;
  JacobiRoom<isa> room;
  for (std::size_t i = 0; i < width; ++i) {
    const bool there = whole + i < count;
    room.u[i] = there ? c.u[whole + i] : 0.0;
    room.m[i] = one_modulus ? *c.m : there ? c.m[whole + i] : 0.0;
    room.m1[i] = one_modulus ? *c.m1 : there ? c.m1[whole + i] : 1.0;
  }
  block.write(room.columns(), 1);
  for (std::size_t i = 0; whole + i < count; ++i) {
    c.sn[whole + i] = room.sn[i];
    c.cn[whole + i] = room.cn[i];
    c.dn[whole + i] = room.dn[i];
  }
}

}  // namespace detail
}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
