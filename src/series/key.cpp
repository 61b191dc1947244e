// SPDX-License-Identifier: MIT
#include "polhode/series/key.hpp"

#include <cstdlib>

#include "polhode/error.hpp"
#include "polhode/series/detail/canonical_terms.hpp"

namespace polhode {
inline namespace v0 {

namespace {

[[noreturn]] void refuse(const char* what, const std::string& name, long long n,
                         const PackedFields& fields) {
  throw DomainError("Series: the " + std::string(what) + " " + std::to_string(n) + " of " + name +
                    " is out of [" + std::to_string(fields.least()) + ", " +
                    std::to_string(fields.greatest()) + "], the range of " +
                    std::to_string(fields.count()) + " packed numbers");
}

// The sum may leave the range of int, or of the field, on its way.
std::uint64_t word(const PackedFields& fields, const std::vector<std::string>& names,
                   const std::vector<std::pair<int, int>>& given, const char* what) {
  std::vector<long long> n(names.size(), 0);
  for (const auto& [i, value] : given) n[static_cast<std::size_t>(i)] += value;
  std::uint64_t packed = fields.zero();
  for (std::size_t i = 0; i < n.size(); ++i) {
    if (n[i] < fields.least() || n[i] > fields.greatest()) refuse(what, names[i], n[i], fields);
    packed = fields.with(packed, static_cast<int>(i), static_cast<int>(n[i]));
  }
  return packed;
}

void refuse_first(const PackedFields& fields, const std::vector<std::string>& names,
                  std::uint64_t packed, const char* what) {
  for (int i = 0; i < fields.count(); ++i) {
    const int n = fields.at(packed, i);
    if (n < fields.least() || n > fields.greatest())
      refuse(what, names[static_cast<std::size_t>(i)], n, fields);
  }
}

}  // namespace

TermKey packed(const Symbols& symbols, const std::vector<std::pair<std::string, int>>& powers,
               const std::vector<std::pair<std::string, int>>& multiples, Trigonometric function) {
  std::vector<std::pair<int, int>> exponents, multipliers;
  for (const auto& [name, n] : powers) exponents.emplace_back(symbols.variable(name), n);
  for (const auto& [name, n] : multiples) multipliers.emplace_back(symbols.angle(name), n);
  return {word(symbols.exponents(), symbols.variables(), exponents, "exponent"),
          word(symbols.multipliers(), symbols.angles(), multipliers, "multiplier") |
              static_cast<std::uint64_t>(function)};
}

void out_of_range(const Symbols& symbols, const TermKey& key) {
  refuse_first(symbols.exponents(), symbols.variables(), key.exponents, "exponent");
  refuse_first(symbols.multipliers(), symbols.angles(), key.angle(), "multiplier");
  throw DomainError("Series: a key that is no key of " + symbols.names());
}

std::string text(const Symbols& symbols, const TermKey& key) {
  std::string product;
  for (int i = 0; i < symbols.exponents().count(); ++i) {
    const int n = exponent(symbols, key, i);
    if (n == 0) continue;
    if (!product.empty()) product += '*';
    product += symbols.variables()[static_cast<std::size_t>(i)];
    if (n != 1) product += '^' + std::to_string(n);
  }
  std::string angle;
  for (int i = 0; i < symbols.multipliers().count(); ++i) {
    const int n = multiplier(symbols, key, i);
    if (n == 0) continue;
    if (n < 0) angle += angle.empty() ? "-" : " - ";
    if (n > 0 && !angle.empty()) angle += " + ";
    if (n != 1 && n != -1) angle += std::to_string(std::abs(n)) + '*';
    angle += symbols.angles()[static_cast<std::size_t>(i)];
  }
  if (!angle.empty()) {
    if (!product.empty()) product += '*';
    product += (key.function() == Trigonometric::sine ? "sin(" : "cos(") + angle + ')';
  }
  return product.empty() ? "1" : product;
}

namespace detail {

void require_same(const Symbols& a, const Symbols& b) {
  if (!(a == b))
    throw DomainError("Series: two sets of symbols, " + a.names() + " and " + b.names() +
                      "; both series need the same, with the same pairs");
}

}  // namespace detail

}  // namespace v0
}  // namespace polhode
