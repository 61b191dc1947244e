// SPDX-License-Identifier: MIT
// Series of Python, whose coefficients are rationals, doubles or functions of momenta, and
// fractions.Fraction for Rational.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "interface/arrays.hpp"
#include "polhode/series/linear_flow.hpp"
#include "polhode/series/series.hpp"
#include "polhode/series/taylor_coefficient.hpp"

namespace polhode::python {

// An int or a fraction, of Python, NumPy or elsewhere; not a bool. False for anything else.
bool read_rational(nb::handle value, series::Rational& out) noexcept;
// With an error of Python where it has more digits than Python converts.
PyObject* fraction_of(const series::Rational& x) noexcept;

}  // namespace polhode::python

namespace nanobind::detail {

template <>
struct type_caster<polhode::series::Rational> {
  NB_TYPE_CASTER(polhode::series::Rational,
                 io_name("fractions.Fraction | int", "fractions.Fraction"))
  template <class Flags>
  bool from_python(handle source, Flags, cleanup_list*) noexcept {
    return polhode::python::read_rational(source, value);
  }
  static handle from_cpp(const polhode::series::Rational& x, rv_policy, cleanup_list*) noexcept {
    return polhode::python::fraction_of(x);
  }
};

}  // namespace nanobind::detail

namespace polhode::python {

// Of symbols with values. Three momenta; 84 numbers a coefficient.
using MomentumFunction = series::TaylorCoefficient<double, 3, 6>;

struct PythonSeries {
  std::variant<series::Series<series::Rational>, series::Series<double>,
               series::Series<MomentumFunction>>
      s;

  bool is_exact() const { return s.index() == 0; }
  bool has_functions() const { return s.index() == 2; }
  const series::Symbols& symbols() const;
  // With functions, in powers of displacements.
  series::Series<double> doubles() const;
};

// A coefficient; and what stands for a series, where a number is a constant.
using SeriesNumber = std::variant<series::Rational, double>;
using Operand = std::variant<PythonSeries, series::Rational, double>;

}  // namespace polhode::python

namespace nanobind::detail {

// nanobind's own would say that no function takes a quantity, and not why (plain_number.hpp).
template <class V>
struct number_variant_caster {
  using Value = V;
  template <class T_>
  using Cast = movable_cast_t<T_>;
  static constexpr bool has_series = std::is_same_v<V, polhode::python::Operand>;
  static constexpr auto Name =
      const_name<has_series>(make_caster<polhode::python::PythonSeries>::Name + const_name(" | "),
                             const_name("")) +
      make_caster<polhode::series::Rational>::Name + const_name(" | float");

  template <class Flags>
  bool from_python(handle source, Flags flags, cleanup_list* list) noexcept {
    value.reset();
    refused = handle();
    polhode::series::Rational exact;
    if constexpr (has_series) {
      if (polhode::python::PythonSeries* series = nullptr; try_cast(source, series) && series)
        return value.emplace(*series), true;
    }
    if (polhode::python::read_rational(source, exact)) return value.emplace(exact), true;
    make_caster<double> number;
    if (!number.from_python(source, flags, list)) return false;
    refused = number.refused;
    value.emplace(number.value);
    return true;
  }
  static handle from_cpp(const V& x, rv_policy policy, cleanup_list* list) noexcept {
    return std::visit(
        [&](const auto& one) {
          return make_caster<std::decay_t<decltype(one)>>::from_cpp(one, policy, list);
        },
        x);
  }
  template <class T_>
  bool can_cast() const noexcept {
    return !refused.is_valid();
  }
  explicit operator V*() { return &checked(); }
  explicit operator V&() { return checked(); }
  explicit operator V&&() { return std::move(checked()); }

  V& checked() {
    if (refused.is_valid()) polhode::python::require_plain(refused, "");
    return *value;
  }

  std::optional<V> value;
  handle refused;
};

template <>
struct type_caster<polhode::python::SeriesNumber>
    : number_variant_caster<polhode::python::SeriesNumber> {};
template <>
struct type_caster<polhode::python::Operand> : number_variant_caster<polhode::python::Operand> {};

}  // namespace nanobind::detail

namespace polhode::python {

// Names with an exponent, a multiplier, a weight each.
using Counts = std::map<std::string, int>;
inline series::Multiples pairs_of(const Counts& counts) { return {counts.begin(), counts.end()}; }

using Operands = std::map<std::string, Operand>;
// A number that somebody gave as a coefficient: DomainError unless it is finite.
double finite(double coefficient);
PythonSeries series_of(const series::Symbols& symbols, const Operand& x);

// As coefficients of type T; of doubles no rationals are made: DomainError.
template <class T>
series::Series<T> as(const PythonSeries& a);
template <>
series::Series<double> as(const PythonSeries& a);
template <>
series::Series<series::Rational> as(const PythonSeries& a);
template <>
series::Series<MomentumFunction> as(const PythonSeries& a);

// Its value where each symbol has the number or array of its name.
FloatArray value_of(const PythonSeries& a, const nb::kwargs& at);
void bind_compiled_series(nb::module_& m);
// Bound with the Lie transforms.
void bind_mean_rotation(nb::module_& m);

// f.operator()<T>(), T the coefficients of what is made of a and, if it is exact, others that are.
template <class F>
auto with_numbers_of(const PythonSeries& a, bool others_exact, F f) {
  if (a.has_functions()) return f.template operator()<MomentumFunction>();
  if (a.is_exact() && others_exact) return f.template operator()<series::Rational>();
  return f.template operator()<double>();
}

inline bool are_exact(const series::Symbols& symbols, const Operands& all) {
  for (const auto& [name, x] : all)
    if (!series_of(symbols, x).is_exact()) return false;
  return true;
}
template <class T>
std::vector<series::AngleRate<T>> rates_of(const series::Symbols& symbols, const Operands& all) {
  std::vector<series::AngleRate<T>> rates;
  for (const auto& [angle, x] : all) rates.push_back({angle, as<T>(series_of(symbols, x))});
  return rates;
}

}  // namespace polhode::python
