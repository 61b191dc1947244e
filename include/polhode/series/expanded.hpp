// SPDX-License-Identifier: MIT
// A series whose coefficients are Taylor polynomials, as a series with powers of displacements: to
// be evaluated, printed or truncated; and back.
//
// Equations   sum of c_m x^m a^n cos(k.phi): the exponents of the first variables are those of
//             their displacements.
// Units       those of the symbols.
// Domain      any series of TaylorCoefficient. most_degree cuts the polynomials.
//             A table in CSV has a column `known` more: the degree to which a coefficient is known,
//             or `all` for a polynomial that nothing was cut off from.
// Accuracy    no rounding. A table is read back as the same series. Text is, too, but for known():
//             polynomials of a text are taken as complete.
// Errors      DomainError for an exponent that leaves its range, or that of the polynomials; for a
//             table that is not right.
// Cost        a term for each number of a coefficient that is not zero.
#pragma once

#include <charconv>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/series/detail/collected_term.hpp"
#include "polhode/series/series_text.hpp"
#include "polhode/series/taylor_coefficient.hpp"

namespace polhode {
inline namespace v0 {

template <Coefficient T, int count, int degree>
Series<T> expanded(const Series<TaylorCoefficient<T, count, degree>>& a, int most_degree = degree) {
  using Taylor = TaylorCoefficient<T, count, degree>;
  const Symbols& symbols = a.symbols();
  const PackedFields& fields = symbols.exponents();
  std::vector<Term<T>> terms;
  for (const Term<Taylor>& term : a.terms())
    for (std::size_t i = 0; i < Taylor::size; ++i) {
      if (term.c.at(i) == T(0)) continue;
      const auto powers = Taylor::exponents(i);
      TermKey key = term.key;
      int order = 0;
      for (int v = 0; v < count; ++v) {
        const int n = powers[static_cast<std::size_t>(v)];
        if (n != 0) key.exponents = fields.with(key.exponents, v, n);
        order += n;
      }
      if (order <= most_degree) terms.push_back({key, term.c.at(i)});
    }
  return Series<T>(symbols, std::move(terms));
}

// expanded, backwards: powers of displacements become polynomials that are known completely.
template <class Taylor>
Series<Taylor> collected(const Series<typename Taylor::Number>& a) {
  std::vector<Term<Taylor>> terms;
  for (const auto& term : a.terms())
    terms.push_back(detail::collected_term<Taylor>(a.symbols(), term));
  return Series<Taylor>(a.symbols(), std::move(terms));
}

template <Coefficient T, int count, int degree>
std::string text(const Series<TaylorCoefficient<T, count, degree>>& a) {
  return text(expanded(a));
}
template <Coefficient T, int count, int degree>
std::string latex(const Series<TaylorCoefficient<T, count, degree>>& a) {
  return latex(expanded(a));
}

template <Coefficient T, int count, int degree>
std::string csv(const Series<TaylorCoefficient<T, count, degree>>& a) {
  using Taylor = TaylorCoefficient<T, count, degree>;
  std::string table = detail::csv_header(a.symbols(), true);
  for (const Term<Taylor>& term : a.terms()) {
    const std::string known = term.c.is_exact() ? "all" : std::to_string(term.c.known());
    const Series<T> rows = expanded(Series<Taylor>(a.symbols(), {term}));
    for (const Term<T>& row : rows.terms()) {
      std::string rest = detail::csv_row(a.symbols(), row.key);
      rest.insert(rest.size() - 1, "," + known);
      table += CoefficientText<T>::text(row.c) + rest;
    }
  }
  return table;
}

template <VariableCoefficient Taylor>
Series<Taylor> series_from_csv(const Symbols& symbols, std::string_view table) {
  using T = typename Taylor::Number;
  std::vector<Term<Taylor>> terms;
  for (const detail::CsvRow& row : detail::csv_rows(symbols, table, true)) {
    int known = Taylor::highest_degree;
    const char* const end = row.known.data() + row.known.size();
    const bool is_all = row.known == "all";
    if (!is_all) {
      const auto [last, error] = std::from_chars(row.known.data(), end, known);
      if (error != std::errc{} || last != end || known < 0 || known > Taylor::highest_degree)
        detail::refuse_row(row.line, row.known, "is no degree and not `all`");
    }
    try {
      const T c = CoefficientText<T>::from_text(row.coefficient);
      terms.push_back(detail::collected_term<Taylor>(symbols, {row.key, c}));
    } catch (const DomainError&) {
      detail::refuse_row(row.line, row.coefficient, "is no number of this type, or no such power");
    }
    if (!is_all) terms.back().c = terms.back().c.known_to(known);
  }
  return Series<Taylor>(symbols, std::move(terms));
}

}  // namespace v0
}  // namespace polhode
