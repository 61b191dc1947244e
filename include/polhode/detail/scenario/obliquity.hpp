// SPDX-License-Identifier: MIT
// Obliquity: what a scenario of kind "obliquity" describes, the spin axis of a planet over ages.
//
// Equations   those of SpinPrecession (polhode/secular/spin_precession.hpp), with tides those of
//             TidalPrecession (polhode/secular/tidal_spin.hpp).
// Units       core units (polhode/text/units.hpp).
// Domain      axes of the orbit and the spin: ecliptic-J2000, or inertial ones.
// Accuracy    that of its method.
// Errors      none: it is a plain value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/secular/insolation.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "polhode/secular/tidal_spin.hpp"
#include "polhode/trajectory/save_at.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

using SpinOnHistory = secular::SpinPrecession<secular::OrbitHistory>;
using TidalSpinOnHistory = secular::TidalPrecession<secular::OrbitHistory>;

struct Obliquity {
  std::string planet;                 // "mars", or empty
  std::string orbit;                  // the name of its table
  std::string orbit_kind;             // "elements", ...
  std::string orbit_text;             // "elements mars.csv, 5001 rows"
  std::vector<std::string> warnings;  // of the orbit
  std::string axes;                   // "ecliptic-J2000" or "inertial"
  secular::OrbitHistory history;
  secular::PrecessionRates rates;
  secular::SpinAxis initial;  // at t = 0
  Method method = default_model_method;
  std::vector<std::string> columns;
  std::optional<secular::TidalRates> tides = std::nullopt;
  std::optional<secular::InsolationPlace> insolation = std::nullopt;
  std::optional<SaveAt> time = std::nullopt;
};

const std::optional<SaveAt>& row_times(const Obliquity& of);
bool has_events(const Obliquity& of);
std::optional<Method> propagation_method(const Obliquity& of);

// From t = 0 to the last row, without the tides and with them.
BasicProblem<SpinOnHistory> spin_problem(const Obliquity& of);
// DomainError where it has none.
BasicProblem<TidalSpinOnHistory> tidal_problem(const Obliquity& of);
// What `use` makes of the one that it is.
template <class Use>
decltype(auto) with_problem(const Obliquity& of, Use&& use) {
  return of.tides ? use(tidal_problem(of)) : use(spin_problem(of));
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
