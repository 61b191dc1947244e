// SPDX-License-Identifier: MIT
// Lie transforms: the keys of their terms, order by order.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/secular/detail/lie_keys.hpp"
#include "polhode/secular/detail/lie_orders.hpp"
#include "polhode/secular/detail/lie_problem.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

namespace {

const series::Truncation no_limit{{}, 0, std::numeric_limits<std::size_t>::max()};

// How many dimensions keys, with both signs of their angles, take up. At most 24.
int rank(const std::vector<Keys>& all) {
  std::vector<std::vector<double>> rows;  // each with a place where the later ones have 0
  std::vector<std::size_t> places;
  const auto add = [&](std::vector<double> row) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double factor = row[places[i]] / rows[i][places[i]];
      for (std::size_t j = 0; j < row.size(); ++j) row[j] -= factor * rows[i][j];
    }
    const auto largest = std::max_element(
        row.begin(), row.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    constexpr double rounding = 1e-9;
    if (largest == row.end() || std::abs(*largest) < rounding) return;
    places.push_back(static_cast<std::size_t>(largest - row.begin()));
    rows.push_back(std::move(row));
  };
  for (const Keys& keys : all) {
    const series::Symbols& symbols = keys.symbols();
    const int variables = symbols.exponents().count(), angles = symbols.multipliers().count();
    for (const auto& term : keys.terms())
      for (const double sign : {1.0, -1.0}) {
        std::vector<double> row;
        for (int i = 0; i < variables; ++i) row.push_back(series::exponent(symbols, term.key, i));
        for (int i = 0; i < angles; ++i)
          row.push_back(sign * series::multiplier(symbols, term.key, i));
        if (rows.size() < row.size()) add(std::move(row));
      }
  }
  return static_cast<int>(rows.size());
}

// The variables in which no derivative can leave the exponents from 0 on: all of these keys have
// such exponents, and rates have exponent 0.
std::vector<int> polynomial_variables(const std::vector<const std::vector<Keys>*>& of,
                                      const Keys& over_rates) {
  const series::Symbols& symbols = over_rates.symbols();
  std::vector<int> found;
  for (int i = 0; i < symbols.exponents().count(); ++i) {
    const auto at = [&](const auto& term) { return series::exponent(symbols, term.key, i); };
    bool is_one = std::all_of(over_rates.terms().begin(), over_rates.terms().end(),
                              [&](const auto& term) { return at(term) == 0; });
    for (const std::vector<Keys>* parts : of)
      for (const Keys& keys : *parts)
        is_one = is_one && std::all_of(keys.terms().begin(), keys.terms().end(),
                                       [&](const auto& term) { return at(term) >= 0; });
    if (is_one) found.push_back(i);
  }
  return found;
}

Keys without_negative(const Keys& keys, const std::vector<int>& variables) {
  return series::selected(keys, [&](const series::TermKey& key) {
    return std::all_of(variables.begin(), variables.end(),
                       [&](int i) { return series::exponent(keys.symbols(), key, i) >= 0; });
  });
}

double terms(const Keys& keys) {
  double sum = 0.0;
  for (const auto& term : keys.terms()) {
    const bool has_angle = term.key.angle() != keys.symbols().multipliers().zero();
    sum += has_angle ? to_double(term.c) : (term.c.cosine() ? 1.0 : 0.0);
  }
  return sum;
}

// The sum over a of reached[n - a] with a step of order a. Nothing where one leaves the range of
// keys; whether a term does is seen when it is made.
std::optional<Keys> stepped(const std::vector<Keys>& reached, const std::vector<Keys>& steps,
                            std::size_t n) {
  std::vector<series::detail::Pairing<KeyFunctions>> pairings;
  for (std::size_t a = 1; a <= n; ++a)
    pairings.push_back({reached[n - a].terms(), steps[a].terms(), KeyFunctions(1)});
  const series::Symbols& symbols = reached[0].symbols();
  try {
    return Keys(
        symbols,
        series::detail::Products<KeyFunctions>(symbols, no_limit, std::move(pairings)).terms());
  } catch (const DomainError&) {
    return std::nullopt;
  }
}
double pair_count(const std::vector<Keys>& reached, const std::vector<Keys>& steps, std::size_t n) {
  double sum = 0.0;
  for (std::size_t a = 1; a <= n; ++a)
    sum += static_cast<double>(reached[n - a].size()) * static_cast<double>(steps[a].size());
  return sum;
}

// Keys of order n fill a body that grows with n, in one dimension less than the steps have: their
// number is like (n + a)^power, and a is that of the last one and of the one two orders before.
void extrapolate(KeyCount& found, std::size_t size, int power) {
  std::size_t last = found.terms.size() - 1;
  while (last > 1 && found.terms[last] == 0.0) --last;
  const double terms = found.terms[last];
  double a = 0.0;
  if (last > 2 && power > 0 && found.terms[last - 2] > 0.0) {
    const double growth = std::pow(terms / found.terms[last - 2], 1.0 / power) - 1.0;
    if (growth > 0.0) a = std::max(a, 2.0 / growth - static_cast<double>(last - 2));
  }
  for (std::size_t n = found.terms.size(); n < size; ++n) {
    const double ratio = (static_cast<double>(n) + a) / (static_cast<double>(last) + a);
    found.terms.push_back(terms * std::pow(ratio, power));
  }
}

}  // namespace

// Each order n has n + 1 rows of the triangle, the mean Hamiltonian and the generator.
std::vector<double> bytes_by_order(const std::vector<double>& terms, std::size_t term,
                                   std::size_t slot) {
  std::vector<double> bytes;
  double stored = 0.0;
  for (std::size_t n = 0; n < terms.size(); ++n) {
    const double t = terms[n];
    stored += static_cast<double>(n + 3) * t * static_cast<double>(term);
    // The table of a product: as it begins, or as it counts itself (products.hpp).
    const double slots =
        std::max(6.0 * t, std::min(4.0 * t * t, 2.0 * series::detail::most_expected_terms));
    bytes.push_back(stored + slots * static_cast<double>(slot) + t * static_cast<double>(term));
  }
  return bytes;
}

void require_room(const std::string& what, const KeyCount& count, const std::vector<double>& bytes,
                  std::size_t most_bytes) {
  const auto most = static_cast<double>(most_bytes);
  if (!(bytes.back() > most)) return;
  const auto gb = [](double x) { return polhode::detail::rounded_text(x / 1e9) + " GB"; };
  const std::size_t last = bytes.size() - 1;
  std::size_t fits = last;
  while (fits > 0 && bytes[fits] > most) --fits;
  std::string message = "LieTransform: " + what + "order " + std::to_string(last) + " may have " +
                        polhode::detail::rounded_text(count.terms[last]) +
                        " terms in a series and take " + gb(bytes[last]) + ", more than the " +
                        gb(most) + " allowed; ";
  if (fits > 0) message += "order " + std::to_string(fits) + " takes " + gb(bytes[fits]) + ": ";
  throw DomainError(message + "lower the order, or raise Truncation::most_bytes");
}

LieKeys::LieKeys(std::vector<Keys> hamiltonian, const Keys& rates, int variables_of_coefficients)
    : h_(std::move(hamiltonian)),
      integrable_(terms(h_[0])),
      over_rates_(h_[0].symbols()),
      variables_of_coefficients_(variables_of_coefficients) {
  const series::Symbols& symbols = h_[0].symbols();
  std::vector<series::Term<KeyFunctions>> inverses;
  for (const auto& term : rates.terms())
    inverses.push_back({{symbols.exponents().negative(term.key.exponents), term.key.multipliers},
                        KeyFunctions(1)});
  over_rates_ = Keys(symbols, std::move(inverses));
  h_[0] = Keys(symbols);
}

LieKeys::Flags LieKeys::coordinates(const std::vector<Keys>& parts) const {
  const series::Symbols& symbols = over_rates_.symbols();
  Flags has;
  for (const series::ConjugatePair& pair : symbols.pairs()) {
    const bool is_angle = symbols.has_angle(pair.coordinate);
    const int i = is_angle ? symbols.angle(pair.coordinate) : symbols.variable(pair.coordinate);
    const auto is_there = [&](const auto& term) {
      return (is_angle ? series::multiplier(symbols, term.key, i)
                       : series::exponent(symbols, term.key, i)) != 0;
    };
    has.push_back((!is_angle && i < variables_of_coefficients_) ||
                  std::any_of(parts.begin(), parts.end(), [&](const Keys& keys) {
                    return std::any_of(keys.terms().begin(), keys.terms().end(), is_there);
                  }));
  }
  return has;
}

Keys LieKeys::falls(const Flags& has_coordinate) const {
  const series::Symbols& symbols = over_rates_.symbols();
  const Keys one = series::constant(symbols, KeyFunctions(1));
  const auto fall = [&](const std::string& name) {
    const Keys less = series::monomial(symbols, KeyFunctions(1), {{name, -1}});
    return symbols.variable(name) < variables_of_coefficients_ ? less + one : less;
  };
  Keys sum(symbols);
  for (std::size_t i = 0; i < symbols.pairs().size(); ++i) {
    const auto& [q, p] = symbols.pairs()[i];
    // The generator has sines for cosines; the derivative by an angle turns them back.
    const Keys odd = series::constant(symbols, KeyFunctions::of(series::Trigonometric::sine));
    if (has_coordinate[i]) sum += symbols.has_angle(q) ? fall(p) : odd * fall(q) * fall(p);
  }
  return sum;
}

KeyCount LieKeys::walk(std::vector<Keys> parts, const Flags& has_coordinate, double pairs) const {
  const Keys shifts = falls(has_coordinate) * over_rates_;
  std::vector<Keys> steps;
  for (const Keys& part : h_) steps.push_back(series::product(part, shifts, no_limit));
  const std::vector<int> polynomial = polynomial_variables({&h_, &parts}, over_rates_);
  KeyCount found{{}, 0};
  double done = 0.0;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    done += pair_count(parts, steps, n);
    if (n > 1 && done > pairs) break;
    const auto sum = stepped(parts, steps, n);
    if (!sum) break;
    parts[n] = without_negative(parts[n] + *sum, polynomial);
    found.terms.push_back(terms(parts[n]));
    found.counted = static_cast<int>(n);
  }
  extrapolate(found, parts.size(), std::max(rank(steps) - 1, 0));
  return found;
}

KeyCount LieKeys::count(double pairs) const {
  KeyCount found = walk(h_, coordinates(h_), pairs);
  found.terms[0] = integrable_;
  return found;
}

KeyCount LieKeys::count_of(std::vector<Keys> parts) const {
  Flags has = coordinates(h_);
  const Flags of_parts = coordinates(parts);
  for (std::size_t i = 0; i < has.size(); ++i) has[i] = has[i] || of_parts[i];
  return walk(std::move(parts), has);
}

// An angle stands as the sine of 0, a key that no term has: odd, as the angle is.
KeyCount LieKeys::count_of(std::string_view symbol) const {
  const series::Symbols& symbols = over_rates_.symbols();
  const std::string name(symbol);
  std::vector<Keys> parts(h_.size(), Keys(symbols));
  parts[0] = symbols.has_angle(name)
                 ? series::constant(symbols, KeyFunctions::of(series::Trigonometric::sine))
                 : series::monomial(symbols, KeyFunctions(1), {{name, 1}});
  Flags has = coordinates(h_);
  for (std::size_t i = 0; i < has.size(); ++i)
    has[i] = has[i] || symbols.pairs()[i].coordinate == name;
  KeyCount found = walk(std::move(parts), has);
  found.terms[0] = 0.0;
  return found;
}

namespace {
// Factorials and rows of the triangle: more is never reached by series that fit in memory.
constexpr int most_orders = 30;
}  // namespace

void require_small(const series::Symbols& symbols, const series::Truncation& keep) {
  if (keep.weights.empty())
    throw DomainError("LieTransform: no small parameters; keep.weights must name them");
  if (keep.order < 0 || keep.order > most_orders)
    throw DomainError("LieTransform: the order " + std::to_string(keep.order) + " is out of [0, " +
                      std::to_string(most_orders) + "]");
  for (const auto& [name, weight] : keep.weights)
    for (const series::ConjugatePair& pair : symbols.pairs())
      if (weight != 0 && (pair.coordinate == name || pair.momentum == name))
        throw DomainError("LieTransform: the small parameter " + name +
                          " has a conjugate; brackets would change the order");
}

void require_symbol(const series::Symbols& symbols, std::string_view name) {
  if (!symbols.has_angle(name)) symbols.variable(name);
}

void require_turning(const series::Symbols& symbols, const std::vector<std::string>& angles,
                     const std::set<std::string>& clocks) {
  for (const std::string& angle : angles) {
    symbols.angle(angle);  // throws for an unknown one
    const auto is_of = [&](const series::ConjugatePair& pair) { return pair.coordinate == angle; };
    if (!clocks.contains(angle) && std::ranges::none_of(symbols.pairs(), is_of))
      throw DomainError("LieTransform: the angle " + angle +
                        " is to be eliminated, and has neither a momentum nor a clock");
  }
}

void require_bound(const char* name, double bound) {
  if (!(bound >= 0.0))
    throw DomainError("LieTransform: " + std::string(name) + " = " +
                      polhode::detail::number_text(bound) + " must not be negative");
}

KeptAngles::KeptAngles(const series::Symbols& symbols, const std::vector<std::string>& angles,
                       const std::vector<std::vector<std::pair<std::string, int>>>& resonances)
    : symbols_(symbols) {
  for (const std::string& name : angles) places_.push_back(symbols.angle(name));
  for (const auto& combination : resonances) {
    std::vector<int> multipliers(places_.size(), 0);
    for (const auto& [name, n] : combination) {
      const auto found = std::find(places_.begin(), places_.end(), symbols.angle(name));
      if (found == places_.end())
        throw DomainError("LieTransform: the resonance has the angle " + name +
                          ", which is not among those to be eliminated");
      multipliers[static_cast<std::size_t>(found - places_.begin())] += n;
    }
    resonances_.push_back(std::move(multipliers));
  }
}

bool KeptAngles::keeps(const series::TermKey& key) const {
  std::vector<int> k;
  for (const int place : places_) k.push_back(series::multiplier(symbols_, key, place));
  if (std::all_of(k.begin(), k.end(), [](int n) { return n == 0; })) return true;
  // k = (p / q) r: cross products are zero, and the quotient is an integer.
  return std::any_of(resonances_.begin(), resonances_.end(), [&](const std::vector<int>& r) {
    const auto first = std::find_if(r.begin(), r.end(), [](int n) { return n != 0; });
    if (first == r.end()) return false;
    const auto place = static_cast<std::size_t>(first - r.begin());
    if (k[place] % *first != 0) return false;
    const int times = k[place] / *first;
    for (std::size_t i = 0; i < k.size(); ++i)
      if (k[i] != times * r[i]) return false;
    return true;
  });
}

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
