// SPDX-License-Identifier: MIT
// A coefficient that is a function of the first variables of a series: its Taylor polynomial about
// chosen values of them. Divisors k.w of any form are divided by, and brackets know what they do.
//
// Equations   c(x) = sum of c_m x^m, |m| <= degree, x the displacement from the values chosen.
//             Quotients and roots are power series in what is left without the constant term.
// Units       those of the function.
// Domain      the first `count` variables of the symbols, in their order, or as many of them as
//             have values (symbols.hpp). A power of such a variable in a key is one of its
//             displacement. Division and roots need a constant term
//             that is not zero, or positive; they converge where x is small against the distance of
//             the nearest zero.
// Accuracy    exact in Rational up to known(); else the roundings of T. A polynomial that nothing
//             was cut off from is exact, and stays so in sums, products within the degree and
//             derivatives. Else a derivative is known to one degree less. A term of a series whose
//             known part is zero is dropped.
// Errors      DomainError for a division by a constant term of zero, a root of one that is not
//             positive, a derivative of which nothing would be known, a place that is not there.
// Cost        sizeof: binomial(count + degree, count) numbers. A product takes the pairs within the
//             degree, those with a zero left out.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/math/real.hpp"
#include "polhode/series/detail/collected_term.hpp"
#include "polhode/series/detail/taylor_layout.hpp"
#include "polhode/series/series.hpp"
#include "polhode/series/series_text.hpp"

namespace polhode {
inline namespace v0 {
namespace series {

template <class T, int count, int degree>
class TaylorCoefficient {
  using Layout = detail::TaylorLayout<count, degree>;
  static constexpr const Layout& layout = detail::taylor_layout<count, degree>;
  static constexpr int exact = degree + 1;

 public:
  using Number = T;
  using Exponents = std::array<int, static_cast<std::size_t>(count)>;
  static constexpr int variable_count = count;
  static constexpr int highest_degree = degree;
  static constexpr std::size_t size = Layout::size;

  TaylorCoefficient() : TaylorCoefficient(0) {}
  explicit TaylorCoefficient(int number) : TaylorCoefficient(T(number)) {}
  explicit TaylorCoefficient(T number) {
    c_.fill(T(0));
    c_[0] = std::move(number);
  }
  // The variable itself, at `value` of it.
  static TaylorCoefficient variable(int place, T value) {
    require_place(place);
    TaylorCoefficient a(std::move(value));
    a.c_[layout.raised[static_cast<std::size_t>(place)][0]] = T(1);
    return a;
  }

  // The displacement of a variable from its value.
  static TaylorCoefficient displacement(int place) { return variable(place, T(0)); }

  // The degree up to which all is known.
  int known() const { return known_ < degree ? known_ : degree; }
  // A polynomial that nothing was cut off from.
  bool is_exact() const { return known_ == exact; }
  // Without what is beyond a degree, which is then not known.
  TaylorCoefficient known_to(int most) const { return within(*this, most); }
  const T& constant() const { return c_[0]; }
  // Of the monomial with that place, in ascending degree; and its exponents.
  const T& at(std::size_t i) const { return c_[i]; }
  static Exponents exponents(std::size_t i) { return layout.exponents[i]; }

  TaylorCoefficient derivative(int place) const {
    require_place(place);
    TaylorCoefficient d;
    d.known_ = known_ == exact ? exact : known_ - 1;
    if (d.known_ < 0)
      throw DomainError(
          "TaylorCoefficient: nothing is known of this derivative: a polynomial of degree " +
          std::to_string(degree) + " has no more than " + std::to_string(degree) +
          " derivatives of a root or a quotient");
    const auto& raised = layout.raised[static_cast<std::size_t>(place)];
    for (std::size_t i = 0; i < Layout::size_to(degree - 1) && layout.order[i] <= d.known_; ++i) {
      const T& c = c_[raised[i]];
      if (!(c == T(0)))
        d.c_[i] = T(layout.exponents[raised[i]][static_cast<std::size_t>(place)]) * c;
    }
    return d;
  }

  friend TaylorCoefficient operator-(TaylorCoefficient a) {
    for (T& c : a.c_) c = -c;
    return a;
  }
  friend TaylorCoefficient operator+(const TaylorCoefficient& a, const TaylorCoefficient& b) {
    TaylorCoefficient sum = within(a, b.known_);
    for (std::size_t i = 0; i < size && layout.order[i] <= sum.known_; ++i)
      sum.c_[i] = sum.c_[i] + b.c_[i];
    return sum;
  }
  friend TaylorCoefficient operator-(const TaylorCoefficient& a, const TaylorCoefficient& b) {
    return a + -b;
  }
  friend TaylorCoefficient operator*(const TaylorCoefficient& a, const TaylorCoefficient& b) {
    TaylorCoefficient product;
    product.known_ = a.known_ < b.known_ ? a.known_ : b.known_;
    if (product.known_ == exact && a.order() + b.order() > degree) product.known_ = degree;
    for (std::size_t i = 0; i < size; ++i) {
      if (a.c_[i] == T(0) || layout.order[i] > product.known_) continue;
      const int room = (product.known_ < degree ? product.known_ : degree) - layout.order[i];
      for (std::size_t j = 0; j < Layout::size_to(room); ++j) {
        if (b.c_[j] == T(0)) continue;
        T& sum = product.c_[layout.product[i][j]];
        sum = sum + a.c_[i] * b.c_[j];
      }
    }
    return product;
  }
  friend TaylorCoefficient operator/(const TaylorCoefficient& a, const TaylorCoefficient& b) {
    return a * b.inverse();
  }
  // Of what is known: degrees are not compared.
  friend bool operator==(const TaylorCoefficient& a, const TaylorCoefficient& b) {
    return a.c_ == b.c_;
  }

  // Also for T without roots: they are looked up where this is called.
  friend TaylorCoefficient sqrt(const TaylorCoefficient& a) {
    using std::sqrt;
    if (!(to_double(a.c_[0]) > 0.0))
      throw DomainError("TaylorCoefficient: the root of a function that is not positive");
    const T root = sqrt(a.c_[0]);
    // binomial(1/2, n) u^n, a = c (1 + u)
    const TaylorCoefficient u = a.rest();
    TaylorCoefficient sum(0), power(1);
    T factor(1);
    for (int n = 0; n <= degree; ++n) {
      sum = sum + TaylorCoefficient(factor) * power;
      power = power * u;
      factor = factor * (T(1) - T(2 * n)) / T(2 * (n + 1));
    }
    return TaylorCoefficient(root) * sum.cut_at(a.constant_alone() ? exact : degree);
  }

  // The value at a displacement.
  T value(const std::array<T, static_cast<std::size_t>(count)>& x) const {
    T sum(0);
    for (std::size_t i = 0; i < size; ++i) {
      T product = c_[i];
      for (std::size_t v = 0; v < x.size(); ++v)
        for (int n = 0; n < layout.exponents[i][v]; ++n) product = product * x[v];
      sum = sum + product;
    }
    return sum;
  }

 private:
  static void require_place(int place) {
    if (place < 0 || place >= count)
      throw DomainError("TaylorCoefficient: no variable at place " + std::to_string(place));
  }
  // Without what is beyond a degree.
  static TaylorCoefficient within(TaylorCoefficient a, int known) {
    if (known >= a.known_) return a;
    a.known_ = known;
    for (std::size_t i = 0; i < size; ++i)
      if (layout.order[i] > known) a.c_[i] = T(0);
    return a;
  }
  TaylorCoefficient cut_at(int known) const { return within(*this, known); }
  int order() const {
    int most = 0;
    for (std::size_t i = 0; i < size; ++i)
      if (!(c_[i] == T(0))) most = layout.order[i];
    return most;
  }
  bool constant_alone() const { return order() == 0; }
  // u of a = c (1 + u).
  TaylorCoefficient rest() const {
    TaylorCoefficient u = *this;
    for (T& c : u.c_) c = c / c_[0];
    u.c_[0] = T(0);
    return u;
  }
  TaylorCoefficient inverse() const {
    if (c_[0] == T(0))
      throw DomainError("TaylorCoefficient: a division by a function that is 0 where it is taken");
    if (constant_alone()) return within(TaylorCoefficient(T(1) / c_[0]), known_);
    const TaylorCoefficient u = -rest();
    TaylorCoefficient sum(1);
    for (int n = 0; n < degree; ++n) sum = TaylorCoefficient(1) + u * sum;
    return TaylorCoefficient(T(1) / c_[0]) * sum.cut_at(degree);
  }

  std::array<T, size> c_;
  int known_ = exact;
};

template <class T, int count, int degree>
struct CoefficientText<TaylorCoefficient<T, count, degree>> {
  static TaylorCoefficient<T, count, degree> from_text(std::string_view text) {
    return TaylorCoefficient<T, count, degree>(CoefficientText<T>::from_text(text));
  }
};

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

}  // namespace series
}  // namespace v0
}  // namespace polhode

namespace polhode {
inline namespace v0 {

template <class T, int count, int degree>
struct RealTraits<series::TaylorCoefficient<T, count, degree>> {
  static double to_double(const series::TaylorCoefficient<T, count, degree>& a) {
    return v0::to_double(a.constant());
  }
};

}  // namespace v0
}  // namespace polhode
