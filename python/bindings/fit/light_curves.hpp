// SPDX-License-Identifier: MIT
// Light curves from Python and to it: (name, calibrated, rows of t, flux, sigma, to_sun,
// to_observer).
#pragma once

#include <vector>

#include "bindings.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode::python {

std::vector<LightCurve> light_curves_of(const nb::list& curves);
nb::list curves_parts(const std::vector<LightCurve>& curves);

}  // namespace polhode::python
