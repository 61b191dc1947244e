// SPDX-License-Identifier: MIT
// LightCurveFile: the light curves of a file, with what the file or its reader declares of them.
// Readers: lc.hpp, alcdef.hpp, light_columns.hpp.
//
// Units       t in seconds of TT from `epoch`, so that leap seconds are counted; where there is
//             none, as the file has it. Fluxes of magnitudes: those of a source of `zero_magnitude`
//             are 1.
// Domain      what is not declared is not known: no light time, no axes and no errors are guessed.
// Accuracy    a Julian date keeps all of its digits until the epoch is taken from it.
// Errors      require_sound: DomainError "FILE:LINE: ..." for the first flaw (polhode/light/
//             light_curve_checks.hpp), and for calibrated sessions that have no common scale.
// Cost        plain values.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polhode/ephemeris/date.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/light/light_curve_checks.hpp"
#include "polhode/light/light_time.hpp"

namespace polhode {
inline namespace v0 {

// From which distances fluxes are: those of the time, or one au from Sun and observer.
enum class Distances { unknown, of_the_time, unit };

struct LightSession {
  LightCurve curve;
  std::optional<LightTime> times;    // none: not declared
  std::optional<double> light_time;  // s, from the body to the observer, as the file says
  Distances distances = Distances::unknown;
  std::string band;                      // as the file calls it; may be empty
  std::optional<double> zero_magnitude;  // none: the file has fluxes
  std::size_t line = 0;                  // of the file, from 1: where the session begins
  std::vector<std::size_t> lines = {};   // where each of its points stands
  // Lines of points that were left out, as the reader was told. They are not parsed; a session may
  // have no other points.
  std::vector<std::size_t> left_out = {};
  std::vector<std::pair<std::string, std::string>> notes = {};  // all that the file says of it
};

struct LightCurveFile {
  std::string file;           // as messages show it
  std::string object;         // what was observed; may be empty
  std::optional<Date> epoch;  // of t = 0, in the time scale of the file
  std::string axes;           // of the vectors: "ecliptic-J2000"; empty: not declared
  std::string length;         // their unit: "au"; empty: not declared
  std::vector<LightSession> sessions;
};

std::vector<LightCurve> light_curves(const LightCurveFile& file);
void require_sound(const LightCurveFile& file, const LightCurveNeeds& needs = {});

}  // namespace v0
}  // namespace polhode
