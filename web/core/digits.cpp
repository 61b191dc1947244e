// SPDX-License-Identifier: MIT
// std::to_chars of double (standard/charconv), by the digits that JavaScript finds.
#include <charconv>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000
#include <algorithm>
#include <cmath>
#include <string_view>
#include <system_error>

namespace {

constexpr int shortest = 0;  // as many digits as tell the number from its neighbours

// Significant digits of a positive finite number into `digits`, at most 17, `count` of them unless
// that is `shortest`; returns how many, and the exponent of the first.
extern "C" __attribute__((import_module("env"), import_name("polhode_digits"))) int polhode_digits(
    double value, int count, char* digits, int* exponent);

struct Writer {
  char* to;
  void operator()(std::string_view text) { to = std::copy(text.begin(), text.end(), to); }
  void repeat(int zeros) { to = std::fill_n(to, zeros, '0'); }
};

int digits_of(int number) { return number < 10 ? 1 : number < 100 ? 2 : 3; }

std::string_view without_end_zeros(std::string_view digits) {
  while (digits.size() > 1 && digits.back() == '0') digits.remove_suffix(1);
  return digits;
}

// 1.5e+20
void write_scientific(Writer& out, std::string_view digits, int exponent) {
  out(digits.substr(0, 1));
  if (digits.size() > 1) out("."), out(digits.substr(1));
  out(exponent < 0 ? "e-" : "e+");
  const int size = std::abs(exponent);
  if (size < 10) out("0");
  out.to = std::to_chars(out.to, out.to + 3, size).ptr;
}

// 0.0015, 1500, 1.5
void write_fixed(Writer& out, std::string_view digits, int exponent) {
  const int count = static_cast<int>(digits.size());
  if (exponent < 0) {
    out("0.");
    out.repeat(-exponent - 1);
    out(digits);
  } else if (exponent + 1 >= count) {
    out(digits);
    out.repeat(exponent + 1 - count);
  } else {
    out(digits.substr(0, exponent + 1)), out("."), out(digits.substr(exponent + 1));
  }
}

int scientific_length(int count, int exponent) {
  return count + (count > 1 ? 1 : 0) + 2 + std::max(2, digits_of(std::abs(exponent)));
}
int fixed_length(int count, int exponent) {
  if (exponent < 0) return 1 - exponent + count;
  return exponent + 1 >= count ? exponent + 1 : count + 1;
}

// precision `shortest`: the shorter of the two forms, the fixed one of equals.
std::to_chars_result written(char* first, double value, int precision) {
  Writer out{first};
  if (std::signbit(value)) out("-");
  value = std::abs(value);
  if (std::isnan(value)) out("nan");
  if (std::isinf(value)) out("inf");
  if (value == 0.0) out("0");
  if (!std::isfinite(value) || value == 0.0) return {out.to, std::errc()};
  char buffer[32];
  int exponent = 0;
  const int count = polhode_digits(value, precision, buffer, &exponent);
  std::string_view digits =
      without_end_zeros(std::string_view(buffer, static_cast<std::size_t>(count)));
  const int left = static_cast<int>(digits.size());
  const bool is_fixed = precision == shortest
                            ? fixed_length(left, exponent) <= scientific_length(left, exponent)
                            : exponent >= -4 && exponent < precision;
  // a whole number beyond 2^53 is written out to its last digit
  if (is_fixed && precision == shortest && exponent >= left && value > 0x1p53)
    digits = std::string_view(
        buffer, static_cast<std::size_t>(polhode_digits(value, exponent + 1, buffer, &exponent)));
  if (is_fixed)
    write_fixed(out, digits, exponent);
  else
    write_scientific(out, digits, exponent);
  return {out.to, std::errc()};
}

}  // namespace

namespace std {
to_chars_result to_chars(char* first, char* /*last*/, double value) {
  return written(first, value, shortest);
}
to_chars_result to_chars(char* first, char* /*last*/, double value, chars_format /*format*/,
                         int precision) {
  return written(first, value, precision);
}
}  // namespace std
#endif
