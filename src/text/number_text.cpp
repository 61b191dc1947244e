// SPDX-License-Identifier: MIT
// Shortest decimals by R. Giulietti, "The Schubfach way to render doubles" (2020): three products
// of 64 by 128 bits decide, where Ryu of libstdc++ takes digits away one by one.
#include "text/number_text.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using u64 = std::uint64_t;
__extension__ using u128 = unsigned __int128;

// floor(log2(10^e)) and floor(log10(2^e)), for the exponents of doubles.
constexpr int log2_of_power(int e) { return (e * 1741647) >> 19; }
constexpr int log10_of_power(int e) { return (e * 1262611) >> 22; }

// The 128 leading bits of 10^k, rounded up, for k = least .. most.
class PowersOfTen {
 public:
  static constexpr int least = -292, most = 324;
  PowersOfTen();
  u128 of(int k) const { return leading_[static_cast<std::size_t>(k - least)]; }

 private:
  // Bits of an integer, least first: enough for 5^324, and for 2^1023/5^292 with 128 of them left.
  using Integer = std::array<std::uint32_t, 32>;
  void keep(int k, const Integer& x, bool exact);

  std::array<u128, most - least + 1> leading_;
};

void PowersOfTen::keep(int k, const Integer& x, bool exact) {
  int top = 32 * static_cast<int>(x.size()) - 1;
  const auto bit = [&](int i) {
    return (x[static_cast<std::size_t>(i / 32)] >> (i % 32)) & std::uint32_t{1};
  };
  while (bit(top) == 0) --top;
  u128 bits = 0;
  bool rest = !exact;
  for (int i = 0; i < 128; ++i) bits = bits << 1 | (top >= i ? bit(top - i) : 0);
  for (int i = top - 128; i >= 0; --i) rest = rest || bit(i) != 0;
  leading_[static_cast<std::size_t>(k - least)] = bits + (rest ? 1 : 0);
}

PowersOfTen::PowersOfTen() {
  Integer x{1};
  for (int k = 0; k <= most; ++k) {  // 5^k
    keep(k, x, true);
    u64 carry = 0;
    for (std::uint32_t& limb : x) {
      carry += u64{limb} * 5;
      limb = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }
  x = {};
  x.back() = std::uint32_t{1} << 31;
  for (int k = -1; k >= least; --k) {  // floor(2^1023/5^-k)
    u64 rest = 0;
    for (auto limb = x.rbegin(); limb != x.rend(); ++limb) {
      rest = rest << 32 | *limb;
      *limb = static_cast<std::uint32_t>(rest / 5);
      rest %= 5;
    }
    keep(k, x, false);
  }
}

// The product's upper 64 bits, the last of them set where bits below are: "round to odd".
u64 upper(u128 power, u64 x) {
  const u128 low = static_cast<u128>(static_cast<u64>(power)) * x;
  const u128 sum = static_cast<u128>(static_cast<u64>(power >> 64)) * x + (low >> 64);
  return static_cast<u64>(sum >> 64) | (static_cast<u64>(sum) > 1 ? 1 : 0);
}

struct Decimal {
  u64 digits;  // below 10^17, may end in zeros
  int exponent;
};

// Of a positive finite double.
Decimal shortest(u64 bits) {
  static const PowersOfTen powers;
  constexpr int fraction = 52;
  const u64 low = bits & ((u64{1} << fraction) - 1), high = bits >> fraction;
  const u64 c = high != 0 ? low | u64{1} << fraction : low;
  const int q = (high != 0 ? static_cast<int>(high) : 1) - 1075;
  const bool odd = (c & 1) != 0;
  const bool closer = low == 0 && high > 1;  // the double below is at half the distance
  const int k = closer ? (q * 1262611 - 524031) >> 22 : log10_of_power(q);
  const int h = q + log2_of_power(-k) + 1;
  const u128 power = powers.of(-k);
  const u64 v = upper(power, (4 * c) << h);  // four times the value, in units of 10^k
  const u64 least = upper(power, (4 * c - 2 + (closer ? 1 : 0)) << h) + (odd ? 1 : 0);
  const u64 most = upper(power, (4 * c + 2) << h) - (odd ? 1 : 0);
  const u64 s = v / 4, tens = s / 10;
  // Without branches: which of two neighbours it is, nobody can predict.
  const auto is = [](bool x) { return static_cast<u64>(x); };
  const u64 ten_above = is(40 * tens + 40 <= most);
  const u64 shorter = is(s >= 10) & (is(least <= 40 * tens) ^ ten_above);
  const u64 above = is(4 * s + 4 <= most);
  const u64 one_inside = is(least <= 4 * s) ^ above;
  const u64 nearer = is(v > 4 * s + 2) | (is(v == 4 * s + 2) & s & 1);
  const u64 full = s + ((one_inside & above) | (~one_inside & nearer));
  const u64 mask = u64{0} - shorter;
  return {(mask & (tens + ten_above)) | (~mask & full), k + static_cast<int>(shorter)};
}

constexpr std::array<u64, 18> powers_of_ten = [] {
  std::array<u64, 18> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = 10 * powers[i - 1];
  return powers;
}();

// Of 0 < x < 10^17.
int digits_of(u64 x) {
  const int least = (static_cast<int>(std::bit_width(x)) * 1233) >> 12;  // log10(2) is 1233/4096
  return least + (x >= powers_of_ten[static_cast<std::size_t>(least)] ? 1 : 0);
}

// Eight digits in the bytes of a word, first digit in the lowest: four, two and one at a time.
u64 eight_digits(u64 v) {
  u64 x = v / 10000 | (v % 10000) << 32;
  u64 q = ((x * 10486) >> 20) & 0x0000007f0000007f;
  x = q | (x - q * 100) << 16;
  q = ((x * 103) >> 10) & 0x000f000f000f000f;
  x = q | (x - q * 10) << 8;
  return x + 0x3030303030303030;
}

// Digits in registers: a text in memory that is read again at another place waits for its stores.
struct Digits {
  explicit Digits(const Decimal& d);

  char first;          // not '0'
  u128 rest;           // sixteen more, the next one in the lowest byte
  int size, exponent;  // without the zeros at the end
};

Digits::Digits(const Decimal& d) {
  constexpr u64 e8 = 100000000, zeros = 0x3030303030303030;
  const int missing = 17 - digits_of(d.digits);
  const u64 all = d.digits * powers_of_ten[static_cast<std::size_t>(missing)];
  const u64 high = all / e8;
  const u64 middle = eight_digits(high % e8), last = eight_digits(all % e8);
  first = static_cast<char>('0' + high / e8);
  rest = static_cast<u128>(last) << 64 | middle;
  int at_end = std::countl_zero(last ^ zeros) / 8;
  if (at_end == 8) at_end += std::countl_zero(middle ^ zeros) / 8;
  size = 17 - at_end;
  exponent = d.exponent - missing + at_end;
}

// All sixteen of them: two stores.
char* put(char* out, u128 digits, int count) {
  std::memcpy(out, &digits, sizeof digits);
  return out + count;
}

char* fixed(char* out, const Digits& d) {
  const int before = d.size + d.exponent;  // digits before the point, 12 at most
  if (before <= 0) {
    std::memcpy(out, "0.000000", 8);
    out += 2 - before;
    *out = d.first;
    return put(out + 1, d.rest, d.size - 1);
  }
  *out = d.first;
  put(out + 1, d.rest, 16);
  if (d.exponent >= 0) {
    std::memcpy(out + d.size, "00000", 5);
    return out + before;
  }
  out[before] = '.';
  return put(out + before + 1, d.rest >> (8 * (before - 1)), d.size - before);
}

char* scientific(char* out, const Digits& d) {
  *out = d.first;
  out[1] = '.';
  put(out + 2, d.rest, 16);
  out += d.size == 1 ? 1 : d.size + 1;
  int e = d.exponent + d.size - 1;
  *out++ = 'e';
  *out++ = e < 0 ? '-' : '+';
  e = e < 0 ? -e : e;
  if (e >= 100) *out++ = static_cast<char>('0' + e / 100);
  *out++ = static_cast<char>('0' + e / 10 % 10);
  *out++ = static_cast<char>('0' + e % 10);
  return out;
}

}  // namespace

char* detail::write_number(char* out, double value) {
  // What is written beside a longer number would not stay in `longest_number`, and from 2^53 on
  // std::to_chars has rules of its own.
  constexpr double largest = 1e12;
  if (std::isnan(value)) value = std::fabs(value);  // "nan": its sign says nothing
  const double size = std::fabs(value);
  if (std::endian::native != std::endian::little || !(size > 0.0 && size < largest))
    return std::to_chars(out, out + longest_number, value).ptr;
  *out = '-';
  out += std::signbit(value) ? 1 : 0;
  const Digits d(shortest(std::bit_cast<u64>(size)));
  // As std::to_chars: whichever is shorter, in fixed notation where they are equal.
  const int one = d.size == 1 ? 1 : 0;
  const bool is_fixed = d.exponent >= one - d.size - 3 && d.exponent <= 5 - one;
  return is_fixed ? fixed(out, d) : scientific(out, d);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
