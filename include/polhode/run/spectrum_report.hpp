// SPDX-License-Identifier: MIT
// The leading frequencies of a column of a file, as text.
//
// Equations   those of spectrum (polhode/analysis/spectrum.hpp).
// Units       times in the unit that the file says, as every output of polhode does, or in what the
//             caller says; frequencies in the unit asked for.
// Domain      outputs of polhode and text tables with columns of numbers, with times that
//             are evenly spaced and rise or fall.
// Accuracy    that of spectrum.
// Errors      DomainError "FILE: ..." for what the table lacks and times that are not evenly
//             spaced; "spectrum: ..." for units that are none.
// Cost        that of reading, and of spectrum.
#pragma once

#include <string>

#include "polhode/analysis/spectrum.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

struct SpectrumRequest {
  std::string file;
  std::string time = "t";  // names of columns, or their numbers from 1
  std::string column;
  std::string imaginary = {};  // with it, column + i imaginary is analysed
  std::string time_unit = {};  // empty: what the file says
  std::string unit = {};       // of frequencies; empty: arcsec/yr of long times, otherwise rad/TIME
  analysis::SpectrumOptions options = {};
};

struct SpectrumReport {
  analysis::Spectrum spectrum;  // times and frequencies in the units below
  std::string time_unit;        // "kyr"; empty where nothing says it
  std::string unit;             // of frequencies: "arcsec/yr"
  double per_unit = 1.0;        // what one of these is in rad per unit of time
  std::string column_unit;      // "deg", or empty
};

SpectrumReport spectrum_report(const SpectrumRequest& request);
// For people, and as CSV.
std::string spectrum_text(const SpectrumReport& report);
std::string spectrum_csv(const SpectrumReport& report);

}  // namespace io
}  // namespace v0
}  // namespace polhode
