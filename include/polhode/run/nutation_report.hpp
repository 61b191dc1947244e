// SPDX-License-Identifier: MIT
// The table of nutation of a planet, as text and as CSV.
//
// Equations   those of NutationTheory (polhode/secular/nutation.hpp).
// Units       periods in days, with the sign of their rate; coefficients in mas.
// Domain      planets of polhode/detail/scenario/planet_nutation.hpp.
// Accuracy    that of the theory; coefficients are written to 1e-6 mas.
// Errors      those of nutation_theory; DomainError for a path that cannot be had, OutputError
//             where writing fails.
// Cost        that of the theory, and a microsecond a term.
#pragma once

#include <string>

#include "polhode/detail/scenario/planet_nutation.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

enum class NutationPart { all, oppolzer };

struct NutationRequest {
  PlanetNutation of;
  secular::PlanetAxis axis = secular::PlanetAxis::figure;
  NutationPart part = NutationPart::all;
  bool relative = false;  // to the moving ecliptic; of the axis of rotation alone
  int lines = 20;         // of the text
  bool changes = false;   // columns for the change of each coefficient, mas a century
};

struct NutationReport {
  NutationRequest request;  // with every number of the planet
  secular::NutationTheory theory;
};

NutationReport nutation_report(const NutationRequest& request);
// For people: what the theory rests on, precession, offset, the largest terms.
std::string nutation_text(const NutationReport& report);
// Notes behind #, then arguments,period,dpsi_sin,dpsi_cos,deps_cos,deps_sin; largest first. With
// changes, four columns more, the names of coefficients with _t behind.
std::string nutation_csv(const NutationReport& report);
// As PATH.part, which is renamed when it is complete; "-" is standard output.
void write_nutation_csv(const NutationReport& report, const std::string& path);

}  // namespace io
}  // namespace v0
}  // namespace polhode
