// SPDX-License-Identifier: MIT
// Orbits, as Python gives them: Kepler's, tables, or any function of time.
#pragma once

#include <variant>

#include "interface/python_function.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/secular/orbit_history.hpp"

namespace polhode::python {

// A Python function t -> 3 numbers as an Orbit. It is called with floats: DomainError in
// double-double.
class FunctionOrbit {
 public:
  explicit FunctionOrbit(SharedFunction function) : function_(std::move(function)) {}

  Vec3 position(double t) const;
  BasicVec3<DoubleDouble> position(const DoubleDouble& t) const;

 private:
  SharedFunction function_;
};

using AnyPythonOrbit = std::variant<KeplerOrbit, PrecessingKeplerOrbit, TurnedKeplerOrbit,
                                    TableOrbit, secular::HistoryOrbit, FunctionOrbit>;

// `label` names the function in messages; the one that was wrapped is added to `functions`.
AnyPythonOrbit orbit_of(nb::handle orbit, const std::string& label,
                        std::vector<SharedFunction>& functions);

// Dates and planets, bound with the orbits.
void bind_ephemeris(nb::module_& m);

// A UserWarning for a table whose interpolation error, as a part `of` something, is noticeable
// or cannot be estimated (NaN).
void warn_of_coarse_rows(const char* what, double error, double noticeable, const char* of);

}  // namespace polhode::python
