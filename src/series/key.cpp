// SPDX-License-Identifier: MIT
// Keys of terms: symbols, and exponents and multipliers packed into words.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/series/detail/canonical_terms.hpp"
#include "polhode/series/detail/term_text.hpp"
#include "polhode/series/detail/words.hpp"
#include "polhode/series/series.hpp"
#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {

namespace {

using Names = std::vector<std::string>;

std::string listed(const char* what, const Names& names) {
  std::string text = names.empty() ? std::string("no ") + what : what;
  for (const std::string& name : names) text += (&name == names.data() ? " " : ", ") + name;
  return text;
}

int place(const Names& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool is_name(const std::string& name) {
  return !name.empty() && name != "cos" && name != "sin" && detail::is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(), detail::is_name_character);
}

void require_names(const char* what, const Names& names, std::set<std::string>& seen) {
  if (names.size() > PackedFields::most)
    throw DomainError("Symbols: " + std::to_string(names.size()) + " " + what + ", at most " +
                      std::to_string(PackedFields::most));
  for (const std::string& name : names) {
    if (!is_name(name))
      throw DomainError("Symbols: " + detail::quoted(name) +
                        " is no name: a letter, then letters, digits, _ or '; not cos or sin");
    if (!seen.insert(name).second)
      throw DomainError("Symbols: " + name + " is there twice; every name needs to be its own");
  }
}

// In the order of the variables.
std::vector<double> checked_values(const Names& variables, const std::vector<ConjugatePair>& pairs,
                                   const std::vector<std::pair<std::string, double>>& given) {
  std::vector<double> values(given.size());
  std::set<std::string> seen;
  for (const auto& [name, value] : given) {
    const int i = place(variables, name);
    if (i < 0)
      throw DomainError("Symbols: values: " + detail::quoted(name) + " is no variable; there are " +
                        listed("variables", variables));
    if (!seen.insert(name).second)
      throw DomainError("Symbols: values: " + name + " is there twice");
    if (!std::isfinite(value))
      throw DomainError("Symbols: values: " + name + " = " + CoefficientText<double>::text(value) +
                        "; expected a finite number");
    if (std::any_of(pairs.begin(), pairs.end(),
                    [&](const ConjugatePair& pair) { return pair.coordinate == name; }))
      throw DomainError("Symbols: values: " + name +
                        " is a coordinate; expected momenta and parameters");
    if (i >= static_cast<int>(given.size()))
      throw DomainError("Symbols: values: " + name + " comes after variables without a value in " +
                        listed("variables", variables) + "; put those with a value first");
    values[static_cast<std::size_t>(i)] = value;
  }
  return values;
}

}  // namespace

Symbols::Symbols(Names variables, Names angles, std::vector<ConjugatePair> pairs,
                 const std::vector<std::pair<std::string, double>>& values) {
  std::set<std::string> seen;
  require_names("variables", variables, seen);
  require_names("angles", angles, seen);
  std::set<std::string> paired;
  for (const ConjugatePair& pair : pairs) {
    if (place(variables, pair.momentum) < 0)
      throw DomainError("Symbols: the momentum " + detail::quoted(pair.momentum) +
                        " of a pair is no variable; there are " + listed("variables", variables));
    if (!seen.contains(pair.coordinate))
      throw DomainError("Symbols: the coordinate " + detail::quoted(pair.coordinate) +
                        " of a pair is neither a variable nor an angle");
    for (const std::string& name : {pair.coordinate, pair.momentum})
      if (!paired.insert(name).second)
        throw DomainError("Symbols: " + name + " is in two pairs, or twice in one");
  }
  std::vector<double> chosen = checked_values(variables, pairs, values);
  const PackedFields exponents(static_cast<int>(variables.size()));
  const PackedFields multipliers(static_cast<int>(angles.size()));
  table_ =
      std::make_shared<const Table>(Table{std::move(variables), std::move(angles), std::move(pairs),
                                          std::move(chosen), exponents, multipliers});
}

bool Symbols::has_variable(std::string_view name) const { return place(variables(), name) >= 0; }
bool Symbols::has_angle(std::string_view name) const { return place(angles(), name) >= 0; }

int Symbols::variable(std::string_view name) const {
  const int i = place(variables(), name);
  if (i < 0)
    throw DomainError("Symbols: no variable " + detail::quoted(name) + "; there are " + names());
  return i;
}

int Symbols::angle(std::string_view name) const {
  const int i = place(angles(), name);
  if (i < 0)
    throw DomainError("Symbols: no angle " + detail::quoted(name) + "; there are " + names());
  return i;
}

std::string Symbols::names() const {
  return listed("variables", variables()) + "; " + listed("angles", angles());
}

std::string Symbols::values_text() const {
  std::string text;
  for (std::size_t i = 0; i < values().size(); ++i)
    text +=
        (i == 0 ? "" : ", ") + variables()[i] + " = " + CoefficientText<double>::text(values()[i]);
  return text;
}

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
    product += detail::base_text(symbols, i);
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

std::string displacement_text(const std::string& name, double value) {
  if (value == 0.0) return name;
  return "(" + name + (value < 0.0 ? " + " : " - ") +
         CoefficientText<double>::text(std::abs(value)) + ")";
}

std::string base_text(const Symbols& symbols, int variable) {
  const auto i = static_cast<std::size_t>(variable);
  const std::string& name = symbols.variables()[i];
  return i < symbols.values().size() ? displacement_text(name, symbols.values()[i]) : name;
}

void require_same(const Symbols& a, const Symbols& b) {
  if (!(a == b) && !(a.values() == b.values())) {
    const auto described = [](const Symbols& s) {
      return s.values().empty() ? s.names() + " without values"
                                : s.names() + " at " + s.values_text();
    };
    throw DomainError("Series: two sets of symbols, " + described(a) + " and " + described(b) +
                      "; both series need the same, with the same values");
  }
  if (!(a == b))
    throw DomainError("Series: two sets of symbols, " + a.names() + " and " + b.names() +
                      "; both series need the same, with the same pairs");
}

}  // namespace detail

}  // namespace series
}  // namespace v0
}  // namespace polhode
