// SPDX-License-Identifier: MIT
#include "series/series_value.hpp"

#include <cmath>

#include "polhode/error.hpp"
#include "polhode/series/taylor_coefficient.hpp"

namespace polhode::python {

bool read_rational(nb::handle value, series::Rational& out) noexcept {
  try {
    const nb::object kind = nb::module_::import_("numbers").attr("Rational");
    if (PyBool_Check(value.ptr()) || !nb::isinstance(value, kind)) return false;
    out = series::Rational::from_text(nb::cast<std::string>(nb::str(value)));
    return true;
  } catch (const std::exception&) {  // too many digits, for us or for Python
    return false;
  }
}

PyObject* fraction_of(const series::Rational& x) noexcept {
  try {
    const nb::module_ fractions = nb::module_::import_("fractions");
    return nb::object(fractions.attr("Fraction")(x.text())).release().ptr();
  } catch (nb::python_error& error) {
    error.restore();
    return nullptr;
  }
}

const series::Symbols& PythonSeries::symbols() const {
  return std::visit([](const auto& a) -> const series::Symbols& { return a.symbols(); }, s);
}

series::Series<double> PythonSeries::doubles() const {
  if (has_functions()) return series::expanded(std::get<2>(s));
  return is_exact() ? series::to_doubles(std::get<0>(s)) : std::get<1>(s);
}

double finite(double coefficient) {
  if (!std::isfinite(coefficient))
    throw DomainError(std::string("Series: the coefficient ") +
                      (std::isnan(coefficient) ? "nan"
                       : coefficient > 0.0     ? "inf"
                                               : "-inf") +
                      "; expected a finite number");
  return coefficient;
}

PythonSeries series_of(const series::Symbols& symbols, const Operand& x) {
  if (const auto* series = std::get_if<PythonSeries>(&x)) return *series;
  const auto* const exact = std::get_if<series::Rational>(&x);
  if (symbols.values().empty() && exact) return {series::constant(symbols, *exact)};
  const double number = finite(exact ? to_double(*exact) : std::get<double>(x));
  if (symbols.values().empty()) return {series::constant(symbols, number)};
  return {series::constant(symbols, MomentumFunction(number))};
}

template <>
series::Series<double> as(const PythonSeries& a) {
  return a.doubles();
}
template <>
series::Series<series::Rational> as(const PythonSeries& a) {
  if (!a.is_exact())
    throw DomainError(
        "Series: a series with float coefficients meets a transform that is exact; make the "
        "transform of hamiltonian.to_doubles()");
  return std::get<0>(a.s);
}
template <>
series::Series<MomentumFunction> as(const PythonSeries& a) {
  if (!a.has_functions())
    throw DomainError("Series: the symbols " + a.symbols().names() +
                      " without values meet symbols with values; both series need the same");
  return std::get<2>(a.s);
}

}  // namespace polhode::python
