// SPDX-License-Identifier: MIT
// Any bytes are light curves of finite points, or one DomainError: never a crash. What was read is
// written and read back with the same fluxes and vectors.
#include <cmath>

#include "fuzz.hpp"
#include "polhode/error.hpp"
#include "polhode/tables/light_curve_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polhode;
  using fuzz::require;
  try {
    const io::LightCurveFile file =
        io::lc_from_text(fuzz::text_of(data, size), "fuzz", ephemeris::TimeScale::UTC);
    require(!file.sessions.empty() && file.epoch.has_value());
    for (const io::LightSession& session : file.sessions) {
      require(session.lines.size() == session.curve.points.size() && !session.lines.empty());
      for (const light::LightPoint& p : session.curve.points)
        require(std::isfinite(p.t) && std::isfinite(p.flux) && p.to_sun != Vec3{});
    }
    const std::vector<light::LightCurve> curves = io::light_curves(file);
    light::first_flaw(curves, {.vectors = true});
    const io::LightCurveFile again = io::lc_from_text(io::lc_text(curves, *file.epoch), "fuzz",
                                                      ephemeris::TimeScale::UTC, file.epoch);
    require(again.sessions.size() == curves.size());
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const std::vector<light::LightPoint>&of = curves[c].points,
            &read = again.sessions[c].curve.points;
      require(read.size() == of.size());
      for (std::size_t k = 0; k < of.size(); ++k)
        require(read[k].flux == of[k].flux && read[k].to_sun == of[k].to_sun &&
                read[k].to_observer == of[k].to_observer && std::abs(read[k].t - of[k].t) < 1e-3);
    }
  } catch (const DomainError& error) {
    fuzz::require_message(error.what());
  }
  return 0;
}
