// SPDX-License-Identifier: MIT
// The layer fit, for the modules of Python that show it (python/polhode/fit.py, _spin_fits.py,
// _light_fits.py, _scans.py): what they are given and give back is plain, tables of numbers and
// dicts.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "interface/arrays.hpp"
#include "polhode/fit/least_squares.hpp"
#include "polhode/fit/spin_fit.hpp"

namespace polhode::python {

// All of it; after bind_io.
void bind_fit(nb::module_& m);

void bind_spin_fit(nb::module_& m);
void bind_light_fit(nb::module_& m);
void bind_scan(nb::module_& m);
void bind_scenario_fit(nb::module_& m);
void bind_light_scenario_fit(nb::module_& m);

// Residuals of a fit, and what the unknowns say of the state.
struct PythonResiduals {
  fit::ResidualFunction function;
  std::function<nb::object(std::span<const double>)> state;
};

// Rows of `width` numbers.
template <class Row, class Make>
std::vector<Row> rows_of_table(nb::handle table, const char* name, std::size_t width, Make make) {
  const Numbers numbers(table, name, {width});
  std::vector<Row> rows;
  for (std::size_t k = 0; k < size_of(numbers.shape()); ++k)
    rows.push_back(make(numbers.at(0) + k * width));
  return rows;
}
inline Vec3 vector_at(const double* x) { return {x[0], x[1], x[2]}; }

fit::Loss loss_of(const std::string& kind, double scale);
nb::tuple loss_parts(const fit::Loss& loss);  // (kind, scale)
// (t0, q, w, inertia)
fit::SpinState spin_of(const nb::tuple& parts);
nb::tuple spin_parts(const fit::SpinState& state);
nb::dict dict_of(const fit::LeastSquaresResult& result, const fit::UnknownsCovariance& covariance,
                 double degrees_of_freedom, const std::vector<std::string>& notes);

}  // namespace polhode::python
