// SPDX-License-Identifier: MIT
// [orbit.NAME] from elements.
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

#include "polhode/scenario/schema.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr Key keys[] = {
    orbit_gm_key,
    {.path = "semi_major_axis",
     .type = KeyType::number,
     .presence = Presence::alternative,
     .dimension = Dimension::length,
     .example = "\"7000 km\"",
     .help = "Semi-major axis of an ellipse."},
    {.path = "pericentre",
     .type = KeyType::number,
     .presence = Presence::alternative,
     .dimension = Dimension::length,
     .example = "\"6930 km\"",
     .help = "Distance at pericentre; a hyperbola needs it."},
    {.path = "period",
     .type = KeyType::number,
     .presence = Presence::alternative,
     .dimension = Dimension::time,
     .example = "\"1.6 h\"",
     .help = "Period of an ellipse, 2 pi over the mean motion; with gm it gives the size."},
    {.path = "eccentricity",
     .type = KeyType::number,
     .fallback = "0",
     .example = "0.01",
     .help = "From 0 to below 1, or above 1."},
    {.path = "inclination",
     .type = KeyType::number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "51.6",
     .help = "Of the plane to inertial axes 1 and 2."},
    {.path = "node",
     .type = KeyType::number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "From inertial axis 1 to the ascending node, at the epoch."},
    {.path = "pericentre_argument",
     .type = KeyType::number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "From the node to the pericentre, at the epoch."},
    {.path = "mean_anomaly",
     .type = KeyType::number,
     .dimension = Dimension::angle,
     .fallback = "0",
     .example = "0",
     .help = "Mean anomaly at the epoch."},
    orbit_epoch_key,
    {.path = "node_rate",
     .type = KeyType::number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "\"-5 deg/d\"",
     .help = "Rate of the node."},
    {.path = "pericentre_rate",
     .type = KeyType::number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "\"3.7 deg/d\"",
     .help = "Rate of the argument of the pericentre."},
    {.path = "mean_anomaly_rate",
     .type = KeyType::number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "0",
     .help = "What is added to the mean motion that gm gives."},
    {.path = "inclination_rate",
     .type = KeyType::number,
     .dimension = Dimension::rate,
     .fallback = "0",
     .example = "\"0.5 arcsec/yr\"",
     .help = "Rate of the inclination."},
    {.path = "eccentricity_rate",
     .type = KeyType::number,
     .dimension = Dimension::growth,
     .fallback = "0",
     .example = "\"-4e-5 1/cy\"",
     .help = "Rate of the eccentricity of an ellipse, whose axis stays; it must be in [0, 1) all "
             "along the run."},
    orbit_axes_key,
};

KeplerElements elements_of(const Values& values, const std::string& path, const std::string& name) {
  const auto key = [&](const char* own) { return path + "." + own; };
  const double gm = number(values, key("gm")), e = number(values, key("eccentricity"));
  if (!(gm > 0.0)) refuse(values, key("gm"), name, "expected a positive gravitational parameter");
  if (!(e >= 0.0) || e == 1.0)
    refuse(values, key("eccentricity"), name,
           "expected 0 <= e < 1 (an ellipse) or e > 1 (a hyperbola); at e = 1 use a number next to "
           "it, with the same pericentre");
  const bool by_axis = has(values, key("semi_major_axis"));
  const bool by_period = has(values, key("period"));
  const std::string size_key = key(by_axis     ? "semi_major_axis"
                                   : by_period ? "period"
                                               : "pericentre");
  const double size = number(values, size_key);
  if (!(size > 0.0))
    refuse(values, size_key, name,
           by_period ? "expected a positive time" : "expected a positive length");
  if ((by_axis || by_period) && e > 1.0)
    refuse(values, size_key, name, "expected pericentre instead, since e > 1 is a hyperbola");
  const double turn = size / (2.0 * std::numbers::pi);
  const double axis = by_period ? std::cbrt(gm * turn * turn) : size;
  return {.gm = gm,
          .pericentre = by_axis || by_period ? pericentre_distance(axis, e) : size,
          .eccentricity = e,
          .inclination = number(values, key("inclination")),
          .node = number(values, key("node")),
          .argument = number(values, key("pericentre_argument")),
          .mean_anomaly = number(values, key("mean_anomaly")),
          .epoch = number(values, key("epoch"))};
}

// All along the run.
void require_ellipse(const OrbitContext& at, const PrecessingKeplerOrbit& orbit) {
  const std::optional<TimeSpan> span = at.run_span();
  if (!span) return;
  const bool early =
      !(orbit.eccentricity(span->first) >= 0.0 && orbit.eccentricity(span->first) < 1.0);
  const bool late =
      !(orbit.eccentricity(span->last) >= 0.0 && orbit.eccentricity(span->last) < 1.0);
  if (!early && !late) return;
  const double when = early ? orbit.first_time() : orbit.last_time();
  const bool round = (orbit.rates().eccentricity > 0.0) == early;
  refuse(at.values(), at.key_path("eccentricity_rate"), at.file(),
         std::string("the eccentricity ") + (round ? "reaches 0" : "reaches 1") + " at " +
             time_and_date(at.file_values(), when) + "; expected 0 to below 1 all along the run, " +
             time_and_date(at.file_values(), span->first) + " to " +
             time_and_date(at.file_values(), span->last));
}

ScenarioOrbit kepler_orbit(const OrbitContext& at) {
  const Values& values = at.values();
  const std::string &path = at.path(), &name = at.file();
  const KeplerElements elements = elements_of(values, path, name);
  const SecularRates rates{.node = number(values, path + ".node_rate"),
                           .argument = number(values, path + ".pericentre_rate"),
                           .mean_anomaly = number(values, path + ".mean_anomaly_rate"),
                           .inclination = number(values, path + ".inclination_rate"),
                           .eccentricity = number(values, path + ".eccentricity_rate")};
  if (rates.eccentricity != 0.0 && elements.eccentricity > 1.0)
    refuse(values, path + ".eccentricity_rate", name,
           "expected 0 for a hyperbola: only of an ellipse it may change");
  const PrecessingKeplerOrbit moving =
      built(values, path, name, [&] { return PrecessingKeplerOrbit(elements, rates); });
  if (rates.eccentricity != 0.0) require_ellipse(at, moving);
  return precessing_orbit(at, moving);
}

}  // namespace

ScenarioOrbit precessing_orbit(const OrbitContext& at, const PrecessingKeplerOrbit& orbit) {
  const std::string &axes = orbit_axes(at), &of_state = at.state_axes();
  if (axes != of_state) {
    return {{},
            of_state == "ecliptic-J2000" ? TurnedKeplerOrbit::from_equator(orbit)
                                         : TurnedKeplerOrbit::from_ecliptic(orbit),
            orbit.gm()};
  }
  if (orbit.rates() == SecularRates{}) return {{}, KeplerOrbit(orbit.elements()), orbit.gm()};
  return {{}, orbit, orbit.gm()};
}

OrbitKind kepler_kind() {
  return {.name = "kepler",
          .help = "Elements at an epoch, which may precess.",
          .keys = {std::begin(keys), std::end(keys)},
          .sets = "semi_major_axis|pericentre|period",
          .made = kepler_orbit};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
