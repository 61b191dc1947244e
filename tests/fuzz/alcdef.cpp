// SPDX-License-Identifier: MIT
// Any bytes are sessions of finite points with fluxes above 0, or one DomainError: never a crash.
#include <cmath>

#include "fuzz.hpp"
#include "polhode/error.hpp"
#include "polhode/tables/light_curve_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polhode;
  using fuzz::require;
  try {
    const io::LightCurveFile file = io::alcdef_from_text(fuzz::text_of(data, size), "fuzz");
    require(!file.sessions.empty() && file.epoch.has_value());
    for (const io::LightSession& session : file.sessions) {
      require(session.lines.size() == session.curve.points.size() && !session.lines.empty());
      require(session.zero_magnitude && std::isfinite(*session.zero_magnitude));
      for (const light::LightPoint& p : session.curve.points)
        require(std::isfinite(p.t) && std::isfinite(p.flux) && p.flux > 0.0);
    }
    light::first_flaw(io::light_curves(file));
  } catch (const DomainError& error) {
    fuzz::require_message(error.what());
  }
  return 0;
}
