// SPDX-License-Identifier: MIT
// What a fit of light curves found, as Python is given it.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "fit/bind_fit.hpp"
#include "polhode/fit/convex_fit.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/fit/mesh_fit.hpp"

namespace polhode::python {

// (spin, (a, b, c), (single, multiple))
EllipsoidModel ellipsoid_of(const nb::tuple& parts);
// (spin, degree, rows, coefficients, (single, multiple))
nb::tuple convex_parts(const ConvexModel& body);

// Residuals of fits, as functions of the unknowns.
PythonResiduals light_residuals_of(const LightFit& fit);
PythonResiduals convex_residuals_of(const ConvexFit& fit);
PythonResiduals mesh_residuals_of(const MeshFit& fit);

nb::dict light_dict(const LightSolution& found);
nb::dict found_dict(const FoundLight& found);
nb::dict search_dict(const LightSearchResult& result);

// (mode, P_phi, P_psi) of each pair
using PeriodParts = std::vector<std::tuple<std::string, double, double>>;
std::vector<TumblerPeriods> periods_of_parts(const PeriodParts& parts);

}  // namespace polhode::python
