// SPDX-License-Identifier: MIT
#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {

// Without expression templates.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                              boost::multiprecision::et_off>;

// Not always in lowest terms; d is not 0.
struct Fraction {
  Integer n = 0, d = 1;
};

namespace detail {

class BigRational {
 public:
  static constexpr unsigned most_bits = 300000;

  explicit BigRational(Fraction x) : value(std::move(x)) {}
  Fraction value;

  static Fraction of(const Rational& a) { return a.big_ ? a.big_->value : Fraction{a.n_, a.d_}; }
  // In lowest terms, and small where it fits: every number has one form.
  static Rational number(Fraction x) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    Integer &n = x.n, &d = x.d, divisor;
    eval_gcd(divisor.backend(), n.backend(), d.backend());
    if (d < 0) divisor = -divisor;
    n /= divisor;
    d /= divisor;
    if ((n != 0 && msb(abs(n)) > most_bits) || msb(d) > most_bits)
      throw DomainError("Rational: a number of more than " + std::to_string(most_bits) +
                        " binary digits; none is that long");
    Rational a;
    if (abs(n) <= most && d <= most) {
      a.n_ = n.convert_to<std::int64_t>();
      a.d_ = d.convert_to<std::int64_t>();
    } else {
      a.big_ = std::make_shared<const BigRational>(std::move(x));
    }
    return a;
  }
};

}  // namespace detail

using detail::BigRational;

namespace {

constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();

// What no exact number should cost: the longest text, and the largest power of ten in it.
constexpr std::size_t most_digits = 10000;
constexpr int most_power = 4000;

[[noreturn]] void refuse(std::string_view text, const char* why) {
  throw DomainError("Rational: '" + std::string(text.substr(0, 40)) + "' " + why);
}

bool is_digits(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Integer takes a leading 0 for octal.
Integer integer(std::string_view digits) {
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits.empty() ? Integer(0) : Integer(std::string(digits));
}

// Digits, perhaps with a point and a power of ten.
Fraction decimal(std::string_view whole, std::string_view text) {
  int power = 0;
  if (const std::size_t e = text.find_first_of("eE"); e != std::string_view::npos) {
    std::string_view digits = text.substr(e + 1);
    const bool plus = digits.starts_with('+');
    if (plus) digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), power);
    if (error != std::errc{} || end != digits.data() + digits.size() ||
        (plus && digits.starts_with('-')))
      refuse(whole, "is no number");
    if (power > most_power || power < -most_power) refuse(whole, "has too large a power of ten");
    text = text.substr(0, e);
  }
  std::string digits(text);
  if (const std::size_t point = text.find('.'); point != std::string_view::npos) {
    digits.erase(point, 1);
    power -= static_cast<int>(text.size() - point) - 1;
  }
  if (!is_digits(digits)) refuse(whole, "is no number");
  const Integer scale = pow(Integer(10), static_cast<unsigned>(power < 0 ? -power : power));
  const Integer value = integer(digits);
  return power < 0 ? Fraction{value, scale} : Fraction{value * scale};
}

}  // namespace

Rational::Rational(std::int64_t numerator, std::int64_t denominator) {
  if (denominator == 0) throw DomainError("Rational: denominator 0; it must not be 0");
  if (numerator == least || denominator == least) {
    *this = BigRational::number({numerator, denominator});
    return;
  }
  const std::int64_t divisor = std::gcd(numerator, denominator);
  const std::int64_t sign = denominator < 0 ? -1 : 1;
  n_ = sign * (numerator / divisor);
  d_ = sign * (denominator / divisor);
}

Rational Rational::from_text(std::string_view text) {
  if (text.size() > most_digits) refuse(text, "is too long");
  std::string_view rest = text;
  const bool negative = rest.starts_with('-');
  if (negative) rest.remove_prefix(1);
  Fraction value;
  if (const std::size_t slash = rest.find('/'); slash != std::string_view::npos) {
    const std::string_view n = rest.substr(0, slash), d = rest.substr(slash + 1);
    if (!is_digits(n) || !is_digits(d)) refuse(text, "is no number");
    const Integer divisor = integer(d);
    if (divisor == 0) refuse(text, "has a denominator of 0");
    value = {integer(n), divisor};
  } else {
    value = decimal(text, rest);
  }
  if (negative) value.n = -value.n;
  return BigRational::number(std::move(value));
}

Rational operator-(const Rational& a) {
  if (a.big_) return BigRational::number({-a.big_->value.n, a.big_->value.d});
  Rational b;
  b.n_ = -a.n_;
  b.d_ = a.d_;
  return b;
}

// Sums and products in lowest terms by Henrici's method: common factors go before they can
// overflow.
Rational operator+(const Rational& a, const Rational& b) {
  if (!a.big_ && !b.big_) {
    const std::int64_t shared = std::gcd(a.d_, b.d_);
    std::int64_t left, right, n, d;
    if (!__builtin_mul_overflow(a.n_, b.d_ / shared, &left) &&
        !__builtin_mul_overflow(b.n_, a.d_ / shared, &right) &&
        !__builtin_add_overflow(left, right, &n) && n != least) {
      const std::int64_t again = shared == 1 ? 1 : std::gcd(n, shared);
      if (!__builtin_mul_overflow(a.d_ / shared, b.d_ / again, &d)) {
        Rational sum;
        sum.n_ = n / again;
        sum.d_ = n == 0 ? 1 : d;
        return sum;
      }
    }
  }
  const Fraction left = BigRational::of(a), right = BigRational::of(b);
  return BigRational::number({left.n * right.d + right.n * left.d, left.d * right.d});
}

Rational operator-(const Rational& a, const Rational& b) { return a + (-b); }

Rational operator*(const Rational& a, const Rational& b) {
  if (!a.big_ && !b.big_) {
    const std::int64_t first = std::gcd(a.n_, b.d_), second = std::gcd(b.n_, a.d_);
    Rational product;
    if (!__builtin_mul_overflow(a.n_ / first, b.n_ / second, &product.n_) &&
        !__builtin_mul_overflow(a.d_ / second, b.d_ / first, &product.d_) && product.n_ != least)
      return product;
  }
  const Fraction left = BigRational::of(a), right = BigRational::of(b);
  return BigRational::number({left.n * right.n, left.d * right.d});
}

Rational operator/(const Rational& a, const Rational& b) {
  if (b == Rational{}) throw DomainError("Rational: division by 0; the divisor must not be 0");
  if (b.big_) {
    const Fraction left = BigRational::of(a), &right = b.big_->value;
    return BigRational::number({left.n * right.d, left.d * right.n});
  }
  Rational inverse;
  inverse.n_ = b.n_ < 0 ? -b.d_ : b.d_;
  inverse.d_ = b.n_ < 0 ? -b.n_ : b.n_;
  return a * inverse;
}

// One form a number: a big one is never equal to a small one.
bool operator==(const Rational& a, const Rational& b) {
  if (a.big_ && b.big_)
    return a.big_ == b.big_ ||
           (a.big_->value.n == b.big_->value.n && a.big_->value.d == b.big_->value.d);
  return !a.big_ && !b.big_ && a.n_ == b.n_ && a.d_ == b.d_;
}

bool operator<(const Rational& a, const Rational& b) {
  const Fraction left = BigRational::of(a), right = BigRational::of(b);
  return left.n * right.d < right.n * left.d;
}

// A quotient below the normal range, in units of the smallest double: to even where two are as
// near.
double subnormal(const Integer& n, const Integer& d) {
  constexpr int smallest = 1074;
  const Integer scaled = n << smallest;
  Integer quotient = scaled / d;
  const Integer rest = 2 * (scaled - quotient * d);
  if (rest > d || (rest == d && quotient % 2 != 0)) quotient += 1;
  return std::ldexp(static_cast<double>(quotient.convert_to<std::uint64_t>()), -smallest);
}

// The first 63 or 64 bits of the quotient, the last of them set where more follow, are rounded
// once.
Rational::operator double() const {
  const Fraction x = BigRational::of(*this);
  if (x.n == 0) return 0.0;
  Integer n = abs(x.n), d = x.d;
  const int exponent = static_cast<int>(msb(n)) - static_cast<int>(msb(d));
  // Below 2^-1021, and so an integer of 53 bits there.
  if (exponent < std::numeric_limits<double>::min_exponent)
    return x.n < 0 ? -subnormal(n, d) : subnormal(n, d);
  const int shift = 63 - exponent;
  if (shift >= 0)
    n <<= shift;
  else
    d <<= -shift;
  const Integer quotient = n / d;
  const auto bits = quotient.convert_to<std::uint64_t>() | (quotient * d == n ? 0U : 1U);
  const double size = std::ldexp(static_cast<double>(bits), -shift);
  return x.n < 0 ? -size : size;
}

std::string Rational::text() const {
  if (big_) return big_->value.n.str() + (big_->value.d == 1 ? "" : "/" + big_->value.d.str());
  return d_ == 1 ? std::to_string(n_) : std::to_string(n_) + "/" + std::to_string(d_);
}

}  // namespace series
}  // namespace v0
}  // namespace polhode
