// SPDX-License-Identifier: MIT
// Light curves, bodies and solutions of their fits, as Python has them.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "fit/bind_fit.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode::python {

// (name, calibrated, rows of t, flux, sigma, to_sun, to_observer) of each.
std::vector<light::LightCurve> light_curves_of(const nb::list& curves);
nb::list curves_parts(const std::vector<light::LightCurve>& curves);

// (spin, shape, (single, multiple)); a shape is an array a, b, c, (degree, rows, coefficients) or a
// FacetShape, which is `mesh` again where that is given.
fit::LightModel body_of(const nb::tuple& parts);
nb::tuple body_parts(const fit::LightModel& body, nb::handle mesh = {});

// Residuals of fits, as functions of the unknowns.
PythonResiduals light_residuals_of(const fit::LightFit& fit, const nb::object& mesh);

nb::dict found_dict(const fit::FoundLight& found, nb::handle mesh = {});

}  // namespace polhode::python
