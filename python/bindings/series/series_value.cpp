// SPDX-License-Identifier: MIT
#include "series/series_value.hpp"

#include <cmath>

#include "polhode/error.hpp"

namespace polhode::python {

bool read_rational(nb::handle value, Rational& out) noexcept {
  try {
    const nb::object kind = nb::module_::import_("numbers").attr("Rational");
    if (PyBool_Check(value.ptr()) || !nb::isinstance(value, kind)) return false;
    out = Rational::from_text(nb::cast<std::string>(nb::str(value)));
    return true;
  } catch (const std::exception&) {  // too many digits, for us or for Python
    return false;
  }
}

PyObject* fraction_of(const Rational& x) noexcept {
  try {
    const nb::module_ fractions = nb::module_::import_("fractions");
    return nb::object(fractions.attr("Fraction")(x.text())).release().ptr();
  } catch (nb::python_error& error) {
    error.restore();
    return nullptr;
  }
}

const Symbols& PythonSeries::symbols() const {
  return std::visit([](const auto& a) -> const Symbols& { return a.symbols(); }, s);
}

Series<double> PythonSeries::doubles() const {
  return std::visit([](const auto& a) { return to_doubles(a); }, s);
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

PythonSeries series_of(const Symbols& symbols, const Operand& x) {
  if (const auto* series = std::get_if<PythonSeries>(&x)) return *series;
  if (const auto* exact = std::get_if<Rational>(&x)) return {constant(symbols, *exact)};
  return {constant(symbols, finite(std::get<double>(x)))};
}

template <>
Series<double> as(const PythonSeries& a) {
  return a.doubles();
}
template <>
Series<Rational> as(const PythonSeries& a) {
  if (!a.is_exact())
    throw DomainError(
        "Series: a series with float coefficients meets a transform that is exact; make the "
        "transform of hamiltonian.to_doubles()");
  return std::get<0>(a.s);
}

}  // namespace polhode::python
