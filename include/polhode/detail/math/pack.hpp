// SPDX-License-Identifier: MIT
// Pack: as many doubles as a register holds, one lane each, that a kernel computes with at a time.
//
// Equations   every operation lane by lane.
// Domain      what a Number offers (polhode/math/real.hpp), and what the kernels of free rotation
//             ask for besides. A source that uses Pack<isa> is compiled for that set; baseline, for
//             any processor. The set in the type keeps its code apart from that of other sources
//             (docs/design/0031-packs.md).
// Accuracy    the bits of a double alone, in each lane and by each set.
// Errors      none; NaN in, NaN out, in the same lane.
// Cost        one to four instructions for all lanes; exp that of a call for each.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/math/detail/registers.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {

// One truth value a lane: all bits or none.
template <InstructionSet isa>
struct PackMask {
  using Bits = typename detail::Registers<isa>::Bits;
  Bits lanes;

  PackMask() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): to all lanes
  [[gnu::always_inline]] PackMask(bool b) : lanes(Bits{} - std::int64_t{b}) {}
  [[gnu::always_inline]] explicit PackMask(const Bits& bits) : lanes(bits) {}

  [[gnu::always_inline]] friend PackMask operator!(const PackMask& a) { return PackMask(~a.lanes); }
  [[gnu::always_inline]] friend PackMask operator&&(const PackMask& a, const PackMask& b) {
    return PackMask(a.lanes & b.lanes);
  }
  [[gnu::always_inline]] friend PackMask operator||(const PackMask& a, const PackMask& b) {
    return PackMask(a.lanes | b.lanes);
  }
  [[gnu::always_inline]] friend PackMask operator!=(const PackMask& a, const PackMask& b) {
    return PackMask(a.lanes ^ b.lanes);
  }
  [[gnu::always_inline]] friend PackMask operator==(const PackMask& a, const PackMask& b) {
    return PackMask(~(a.lanes ^ b.lanes));
  }
  [[gnu::always_inline]] friend bool any(const PackMask& a) {
    return detail::Registers<isa>::any(a.lanes);
  }
  [[gnu::always_inline]] friend bool all(const PackMask& a) { return !any(!a); }
};

template <InstructionSet isa>
struct Pack {
  using Registers = detail::Registers<isa>;
  using Doubles = typename Registers::Doubles;
  using Bits = typename Registers::Bits;
  using Whole = typename Registers::Whole;
  using Mask = PackMask<isa>;
  static constexpr InstructionSet set = isa;
  static constexpr std::size_t width = sizeof(Doubles) / sizeof(double);

  struct Scaled {
    Pack part, exponent;
  };

  Doubles lanes;

  Pack() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): to all lanes; x - 0, so that -0 keeps its sign
  [[gnu::always_inline]] Pack(double x) : lanes(x - Doubles{}) {}
  [[gnu::always_inline]] explicit Pack(const Doubles& x) : lanes(x) {}

  // So many numbers one after the other, wherever they lie.
  [[gnu::always_inline]] static Pack loaded(const double* from) {
    Pack x;
    std::memcpy(&x.lanes, from, sizeof x.lanes);
    return x;
  }
  [[gnu::always_inline]] void store(double* to) const { std::memcpy(to, &lanes, sizeof lanes); }

  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return Pack(-a.lanes); }
  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) {
    return Pack(a.lanes + b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) {
    return Pack(a.lanes - b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) {
    return Pack(a.lanes * b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) {
    return Pack(a.lanes / b.lanes);
  }
  [[gnu::always_inline]] friend Mask operator==(const Pack& a, const Pack& b) {
    return Mask(a.lanes == b.lanes);
  }
  [[gnu::always_inline]] friend Mask operator!=(const Pack& a, const Pack& b) {
    return Mask(a.lanes != b.lanes);
  }
  [[gnu::always_inline]] friend Mask operator<(const Pack& a, const Pack& b) {
    return Mask(a.lanes < b.lanes);
  }
  [[gnu::always_inline]] friend Mask operator>(const Pack& a, const Pack& b) {
    return Mask(a.lanes > b.lanes);
  }
  [[gnu::always_inline]] friend Mask operator<=(const Pack& a, const Pack& b) {
    return Mask(a.lanes <= b.lanes);
  }
  [[gnu::always_inline]] friend Mask operator>=(const Pack& a, const Pack& b) {
    return Mask(a.lanes >= b.lanes);
  }

  [[gnu::always_inline]] friend Pack select(const Mask& mask, const Pack& a, const Pack& b) {
    return Pack(mask.lanes ? a.lanes : b.lanes);
  }
  [[gnu::always_inline]] friend Pack abs(const Pack& x) {
    return Pack(std::bit_cast<Doubles>(x.bits() & ~detail::sign_bit));
  }
  [[gnu::always_inline]] friend Mask signbit(const Pack& x) { return Mask(x.bits() < 0); }
  // -x where the mask holds.
  [[gnu::always_inline]] friend Pack negated(const Mask& mask, const Pack& x) {
    return Pack(std::bit_cast<Doubles>(x.bits() ^ (mask.lanes & detail::sign_bit)));
  }
  [[gnu::always_inline]] friend Pack sqrt(const Pack& x) { return Pack(Registers::sqrt(x.lanes)); }
  // The power of two in [|x|/2, |x|], of a normal x, and its inverse.
  [[gnu::always_inline]] friend Pack power_below(const Pack& x) {
    return Pack(std::bit_cast<Doubles>(x.bits() & detail::exponent_bits));
  }
  [[gnu::always_inline]] friend Pack inverse_power_below(const Pack& x) {
    return Pack(
        std::bit_cast<Doubles>(detail::inverse_exponent - (x.bits() & detail::exponent_bits)));
  }
  [[gnu::always_inline]] friend Pack rint(const Pack& x) { return Pack(Registers::rint(x.lanes)); }
  [[gnu::always_inline]] friend Pack floor(const Pack& x) {
    return Pack(Registers::floor(x.lanes));
  }
  // One rounding. Sets that have no such instruction have no fma.
  [[gnu::always_inline]] friend Pack fma(const Pack& x, const Pack& y, const Pack& z)
    requires(isa != InstructionSet::baseline)
  {
    return Pack(Registers::fma(x.lanes, y.lanes, z.lanes));
  }
  // The sine and cosine of an angle k quarter turns on, as those of double in
  // free/detail/reduced_sincos.hpp: the low bits of `shifted` are those of k.
  [[gnu::always_inline]] friend SinCos<Pack> quarters_turned(const Pack& sine, const Pack& cosine,
                                                             const Pack& shifted,
                                                             const Pack& /*k*/) {
    const Bits quarter = shifted.bits();
    const Bits swapped = (sine.bits() ^ cosine.bits()) & -(quarter & 1);
    return {Pack(std::bit_cast<Doubles>(sine.bits() ^ swapped ^ ((quarter & 2) << 62))),
            Pack(std::bit_cast<Doubles>(cosine.bits() ^ swapped ^ (((quarter + 1) & 2) << 62)))};
  }
  // A normal positive number over 2^k, between 1/sqrt 2 and sqrt 2, and k.
  [[gnu::always_inline]] friend Scaled halves_off(const Pack& x) {
    // the exponent of x times sqrt 2, but for the few next to the ends
    // (modulo 2^64: of what is no normal number, the sums go round)
    const Whole whole = std::bit_cast<Whole>(x.lanes);
    const Bits biased = std::bit_cast<Bits>(whole + 0x00095f619980c433U);
    const Whole k = std::bit_cast<Whole>((biased >> 52) - 1023);
    const Whole part = whole - (k << 52);
    const Doubles magic = std::bit_cast<Doubles>(k + 0x4338000000000000U);
    return {Pack(std::bit_cast<Doubles>(part)), Pack(magic - 0x1.8p52)};
  }
  // 2^k of an integer k in [-1022, 1023]: the low bits of `shifted`, k + 1.5 2^52, are those of k.
  [[gnu::always_inline]] friend Pack power_of_two(const Pack& shifted) {
    return Pack(std::bit_cast<Doubles>((std::bit_cast<Whole>(shifted.lanes) + 1023U) << 52));
  }
  friend Pack exp(const Pack& x) {
    Pack r;
    for (std::size_t i = 0; i < width; ++i) r.lanes[i] = std::exp(x.lanes[i]);
    return r;
  }

 private:
  [[gnu::always_inline]] Bits bits() const { return std::bit_cast<Bits>(lanes); }
};

template <InstructionSet isa>
struct LaneTraits<Pack<isa>> {
  using Scalar = double;
  static constexpr std::size_t count = Pack<isa>::width;
  static double get(const Pack<isa>& x, std::size_t lane) { return x.lanes[lane]; }
  static void set(Pack<isa>& x, std::size_t lane, double value) { x.lanes[lane] = value; }
  static void set_mask(PackMask<isa>& mask, std::size_t lane, bool value) {
    mask.lanes[lane] = -std::int64_t{value};
  }
};

template <InstructionSet isa>
struct RealTraits<Pack<isa>> {
  static Pack<isa> pi() { return Pack<isa>(polhode::pi<double>()); }
  static constexpr double epsilon() { return RealTraits<double>::epsilon(); }
};

}  // namespace v0
}  // namespace polhode
