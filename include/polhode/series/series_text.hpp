// SPDX-License-Identifier: MIT
// Series as text, LaTeX and CSV, and read back.
//
// Equations   text: "3/2*e^2*cos(2*l - g) - G^-1*sin(g)", one sum; "0" for no terms.
//             CSV: a header and a row a term: coefficient,function,a^,b^,x,y with a column for
//             the exponent of each variable a, b and for the multiplier of each angle x, y.
// Units       those of the symbols.
// Domain      text that is read may be any expression: sums, products, quotients by one term
//             without an angle, integer powers, parentheses, cos and sin of sums of integer
//             multiples of angles. The text of a series is one of them. With coefficients that
//             are functions, and symbols with values (taylor_coefficient.hpp), also quotients
//             by any function of the variables with a value, and sqrt of one.
// Accuracy    what is written is read back as the same series, NaN and infinities apart, in double
//             and Rational; other types to their max_digits10.
// Errors      DomainError of one line: the column, or the row, and what was expected there.
//             Powers above 1000 of sums, cos and sin, parentheses more than 100 deep, and products
//             that together have more than 2e5 pairs of terms and 100 a character, are refused.
// Cost        linear in the terms.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/series/detail/csv_rows.hpp"
#include "polhode/series/detail/expression.hpp"
#include "polhode/series/detail/term_text.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace series {

template <Coefficient T>
std::string text(const Series<T>& a) {
  std::string sum;
  for (const Term<T>& term : a.terms())
    detail::add_term(sum, CoefficientText<T>::text(term.c), text(a.symbols(), term.key), "*");
  return sum.empty() ? "0" : sum;
}

// For a formula: names of Greek letters become these letters, what follows the first _ an index.
template <Coefficient T>
std::string latex(const Series<T>& a) {
  std::string sum;
  for (const Term<T>& term : a.terms())
    detail::add_term(sum, detail::latex_number(CoefficientText<T>::text(term.c)),
                     detail::latex(a.symbols(), term.key), " ");
  return sum.empty() ? "0" : sum;
}

template <Coefficient T>
std::string csv(const Series<T>& a) {
  std::string table = detail::csv_header(a.symbols());
  for (const Term<T>& term : a.terms())
    table += CoefficientText<T>::text(term.c) + detail::csv_row(a.symbols(), term.key);
  return table;
}

template <Coefficient T>
Series<T> series_from_text(const Symbols& symbols, std::string_view text) {
  return detail::Expression<T>(symbols, text).series();
}

// The header must be that of these symbols.
template <Coefficient T>
Series<T> series_from_csv(const Symbols& symbols, std::string_view table) {
  std::vector<Term<T>> terms;
  for (const detail::CsvRow& row : detail::csv_rows(symbols, table)) {
    try {
      terms.push_back({row.key, CoefficientText<T>::from_text(row.coefficient)});
    } catch (const DomainError&) {
      detail::refuse_row(row.line, row.coefficient, "is no number of this type");
    }
  }
  return Series<T>(symbols, std::move(terms));
}

}  // namespace series
}  // namespace v0
}  // namespace polhode
