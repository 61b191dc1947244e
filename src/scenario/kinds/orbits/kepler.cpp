// SPDX-License-Identifier: MIT
// [orbit.NAME] from elements.
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct Arguments {
  std::optional<double> gm;
  std::optional<double> semi_major_axis, pericentre, period;
  double eccentricity, inclination, node, argument, mean_anomaly;
  double epoch;
  double node_rate, argument_rate, mean_anomaly_rate, inclination_rate, eccentricity_rate;
  std::optional<std::string> axes;
};

template <auto at>
consteval KindKey<Arguments> element_key(std::string_view name, std::string_view help) {
  return quantity_key<at>(name, Dimension::angle, help).otherwise("0");
}
template <auto at>
consteval KindKey<Arguments> rate_key(std::string_view name, std::string_view help) {
  return quantity_key<at>(name, Dimension::rate, help).otherwise("0");
}

constexpr KindKey<Arguments> keys[] = {
    orbit_gm_key<&Arguments::gm>(),
    quantity_key<&Arguments::semi_major_axis>("semi_major_axis", Dimension::length,
                                              "Semi-major axis of an ellipse.")
        .alternative()
        .example("\"7000 km\""),
    quantity_key<&Arguments::pericentre>("pericentre", Dimension::length,
                                         "Distance at pericentre; a hyperbola needs it.")
        .alternative()
        .example("\"6930 km\""),
    quantity_key<&Arguments::period>(
        "period", Dimension::time,
        "Period of an ellipse, 2 pi over the mean motion; with gm it gives the size.")
        .alternative()
        .example("\"1.6 h\""),
    quantity_key<&Arguments::eccentricity>("eccentricity", Dimension::number,
                                           "From 0 to below 1, or above 1.")
        .otherwise("0")
        .example("0.01"),
    element_key<&Arguments::inclination>("inclination", "Of the plane to inertial axes 1 and 2.")
        .example("51.6"),
    element_key<&Arguments::node>("node",
                                  "From inertial axis 1 to the ascending node, at the epoch."),
    element_key<&Arguments::argument>("pericentre_argument",
                                      "From the node to the pericentre, at the epoch."),
    element_key<&Arguments::mean_anomaly>("mean_anomaly", "Mean anomaly at the epoch."),
    orbit_epoch_key<&Arguments::epoch>(),
    rate_key<&Arguments::node_rate>("node_rate", "Rate of the node.").example("\"-5 deg/d\""),
    rate_key<&Arguments::argument_rate>("pericentre_rate",
                                        "Rate of the argument of the pericentre.")
        .example("\"3.7 deg/d\""),
    rate_key<&Arguments::mean_anomaly_rate>("mean_anomaly_rate",
                                            "What is added to the mean motion that gm gives."),
    rate_key<&Arguments::inclination_rate>("inclination_rate", "Rate of the inclination.")
        .example("\"0.5 arcsec/yr\""),
    quantity_key<&Arguments::eccentricity_rate>(
        "eccentricity_rate", Dimension::growth,
        "Rate of the eccentricity of an ellipse, whose axis stays; it must be in [0, 1) all along "
        "the run.")
        .otherwise("0")
        .example("\"-4e-5 1/cy\""),
    orbit_axes_key<&Arguments::axes>(),
};

double pericentre_of(const Arguments& a, const OrbitContext& at) {
  const double e = a.eccentricity;
  const char* const key = a.semi_major_axis ? "semi_major_axis"
                          : a.period        ? "period"
                                            : "pericentre";
  const double size = a.semi_major_axis ? *a.semi_major_axis : a.period ? *a.period : *a.pericentre;
  if (!(size > 0.0))
    at.refuse(key, a.period ? "expected a positive time" : "expected a positive length");
  if (a.pericentre) return size;
  if (e > 1.0) at.refuse(key, "expected pericentre instead, since e > 1 is a hyperbola");
  const double turn = size / (2.0 * std::numbers::pi);
  return pericentre_distance(a.period ? std::cbrt(*a.gm * turn * turn) : size, e);
}

KeplerElements elements_of(const Arguments& a, const OrbitContext& at) {
  const double gm = *positive_gm(at, a.gm), e = a.eccentricity;
  if (!(e >= 0.0) || e == 1.0)
    at.refuse("eccentricity",
              "expected 0 <= e < 1 (an ellipse) or e > 1 (a hyperbola); at e = 1 use a number next "
              "to it, with the same pericentre");
  return {.gm = gm,
          .pericentre = pericentre_of(a, at),
          .eccentricity = e,
          .inclination = a.inclination,
          .node = a.node,
          .argument = a.argument,
          .mean_anomaly = a.mean_anomaly,
          .epoch = a.epoch};
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
  const FileValues file = at.file_values();
  at.refuse("eccentricity_rate",
            std::string("the eccentricity ") + (round ? "reaches 0" : "reaches 1") + " at " +
                time_and_date(file, when) + "; expected 0 to below 1 all along the run, " +
                time_and_date(file, span->first) + " to " + time_and_date(file, span->last));
}

ScenarioOrbit made(const Arguments& a, const OrbitContext& at) {
  const KeplerElements elements = elements_of(a, at);
  const SecularRates rates{.node = a.node_rate,
                           .argument = a.argument_rate,
                           .mean_anomaly = a.mean_anomaly_rate,
                           .inclination = a.inclination_rate,
                           .eccentricity = a.eccentricity_rate};
  if (rates.eccentricity != 0.0 && elements.eccentricity > 1.0)
    at.refuse("eccentricity_rate", "expected 0 for a hyperbola: only of an ellipse it may change");
  const PrecessingKeplerOrbit moving = built(
      at.values(), at.path(), at.file(), [&] { return PrecessingKeplerOrbit(elements, rates); });
  if (rates.eccentricity != 0.0) require_ellipse(at, moving);
  return precessing_orbit(at, orbit_axes(at, a.axes), moving);
}

}  // namespace

ScenarioOrbit precessing_orbit(const OrbitContext& at, const std::string& axes,
                               const PrecessingKeplerOrbit& orbit) {
  const std::string of_state = at.state_axes();
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
  OrbitKind kind =
      orbit_kind<Arguments>("kepler", "Elements at an epoch, which may precess.", keys, made);
  kind.sets = "semi_major_axis|pericentre|period";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
