// SPDX-License-Identifier: MIT
// The experiment of kind "obliquity" from the values of a file: the planet, its satellites and
// tides.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "output/obliquity_columns.hpp"
#include "polhode/scenario/key_values.hpp"
#include "polhode/secular/planet.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "polhode/secular/tides.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/detail/history_keys.hpp"
#include "scenario/detail/made_experiments.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/tables/head.hpp"
#include "scenario/tables/time.hpp"
#include "scenario/value_access.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

// In core units; mass over that of the planet.
struct PlanetSatellite {
  std::string path;
  bool is_inner;
  double mass, distance;
  double eccentricity, inclination;  // of an outer one
};

// Refuses a planet without a name that lacks a key which satellites and tides need.
[[noreturn]] void refuse_without(const KindContext& at, const char* key) {
  refuse(at.values, "planet", at.name,
         std::string("expected a key ") + key +
             " or the name of a planet, for its satellites and tides");
}

class PlanetSatellites {
 public:
  // `known` is the planet `name`, or null.
  PlanetSatellites(const KindContext& at, const KeyValues& planet, const PlanetSpin* known);

  bool empty() const { return satellites_.empty(); }
  bool has_tides() const { return planet_.has("tides.k2"); }
  // The torque of the outer ones over that of the star on a circle; n of the planet's orbit.
  double outer_share(double n) const;
  // Where a constant is given next to inner ones, which it has in it.
  void refuse_inner(const std::string& given) const;
  // What star is multiplied with for the inner ones; of a planet that turns at w.
  double inner_factor(double ellipticity, double w) const;
  // Where there are tides.
  TidalRates tides(double w, double n) const;

 private:
  // In core units. Where files have no unit of length the radius is 1.
  double gm() const;
  double radius() const;
  double inertia_factor() const;
  bool is_scale_free() const { return at_.units.length() == "1"; }
  double known_length(double metres) const;
  // Refuses a planet that is not known, for want of the key.
  const PlanetSpin& known_for(const char* key) const;
  // The one that raises tides; mass 0 where there is none.
  OuterSatellite tidal_satellite() const;

  const KindContext& at_;
  const KeyValues& planet_;
  const PlanetSpin* known_;
  std::vector<PlanetSatellite> satellites_;
};

double mean_motion(double gm, const OuterSatellite& of) {
  const double a = of.distance;
  return std::sqrt(gm * (1.0 + of.mass) / a) / a;
}

PlanetSatellites::PlanetSatellites(const KindContext& at, const KeyValues& planet,
                                   const PlanetSpin* known)
    : at_(at), planet_(planet), known_(known) {
  for (const std::string& path : array_paths(at.values, "planet.satellite")) {
    const KeyValues table(at.values, at.units, path, at.name);
    for (const char* const key : {"mass", "distance"})
      require_range(at.values, table.key_path(key), at.name);
    const bool is_inner = table.word("kind") == "inner";
    satellites_.push_back({path, is_inner, table.number("mass"), table.number("distance"),
                           is_inner ? 0.0 : table.number("eccentricity"),
                           is_inner ? 0.0 : table.number("inclination")});
    if (!(satellites_.back().eccentricity >= 0.0 && satellites_.back().eccentricity < 1.0))
      table.refuse("eccentricity", "expected a number from 0 to below 1");
  }
  for (const char* const key : {"gm", "radius", "inertia_factor"})
    if (planet.has(key)) require_range(at.values, planet.key_path(key), at.name);
}

const PlanetSpin& PlanetSatellites::known_for(const char* key) const {
  if (known_ == nullptr) refuse_without(at_, key);
  return *known_;
}
double PlanetSatellites::known_length(double metres) const {
  return is_scale_free() ? metres / known_->radius
                         : at_.units.to_core(metres, "m", Dimension::length);
}
double PlanetSatellites::gm() const {
  if (planet_.has("gm")) return planet_.number("gm");
  const PlanetSpin& of = known_for("gm");
  if (!is_scale_free()) return at_.units.to_core(of.gm, "m3/s2", Dimension::gm);
  const double R = of.radius;
  return at_.units.to_core(of.gm / (R * R * R), "1/s2", Dimension::gm);
}
double PlanetSatellites::radius() const {
  if (planet_.has("radius")) {
    if (is_scale_free() && known_ != nullptr)
      planet_.refuse("radius", "expected a unit of length in [units] as well");
    return planet_.number("radius");
  }
  return is_scale_free() ? 1.0 : known_length(known_for("radius").radius);
}
double PlanetSatellites::inertia_factor() const {
  return planet_.has("inertia_factor") ? planet_.number("inertia_factor")
                                       : known_for("inertia_factor").inertia_factor;
}

double PlanetSatellites::outer_share(double n) const {
  double share = 0.0;
  const double of_star = star_precession(1.0, 1.0, n * n, 1.0);  // gm / a^3 is n^2
  for (const PlanetSatellite& one : satellites_)
    if (!one.is_inner)
      share += satellite_precession(1.0, 1.0, one.mass * gm(), one.distance, one.eccentricity,
                                    one.inclination) /
               of_star;
  return share;
}

void PlanetSatellites::refuse_inner(const std::string& given) const {
  for (const PlanetSatellite& one : satellites_)
    if (one.is_inner)
      refuse(at_.values, one.path + ".kind", at_.name,
             "expected no inner satellite next to " + given + ", which is that of all together");
}

double PlanetSatellites::inner_factor(double ellipticity, double w) const {
  std::vector<InnerSatellite> inner;
  for (const PlanetSatellite& one : satellites_)
    if (one.is_inner)
      inner.push_back({.mass = one.mass,
                       .distance = one.distance / radius(),
                       .mean_motion = mean_motion(gm(), {one.mass, one.distance}) / w});
  if (inner.empty()) return 1.0;
  return inner_satellites_factor(ellipticity * inertia_factor(), inertia_factor(), inner);
}

OuterSatellite PlanetSatellites::tidal_satellite() const {
  if (satellites_.empty() && known_ != nullptr)
    return {known_->satellite.mass, known_length(known_->satellite.distance)};
  OuterSatellite found;
  for (const PlanetSatellite& one : satellites_) {
    if (one.is_inner) continue;
    if (found.mass > 0.0)
      refuse(at_.values, one.path + ".kind", at_.name,
             "expected one outer satellite next to a table planet.tides");
    found = {one.mass, one.distance};
  }
  return found;
}

// Of the star, gm / a^3 is n^2, at any a.
TidalRates PlanetSatellites::tides(double w, double n) const {
  for (const char* const key : {"tides.k2", "tides.lag"})
    require_range(at_.values, planet_.key_path(key), at_.name);
  if (planet_.number("tidal_drift") != 0.0)
    planet_.refuse("tidal_drift", "expected none next to a table planet.tides");
  if (!(w > 0.0))
    planet_.refuse("rotation_period",
                   "expected a positive one next to a table planet.tides, and the pole about "
                   "which the planet turns that way");
  const double k2 = planet_.number("tides.k2"), lag = planet_.number("tides.lag");
  const double gm = this->gm(), R = radius(), factor = inertia_factor();
  TidalRates rates{
      .spin = w, .orbit = n, .star = tidal_rate(k2, lag, n * n, n * n / gm, R, factor, 1.0)};
  const OuterSatellite raising = tidal_satellite();
  if (raising.mass > 0.0 && k2 * lag > 0.0) {
    const double month = mean_motion(gm, raising), ratio = raising.distance / R;
    rates.satellite =
        tidal_rate(k2, lag, raising.mass * gm, raising.mass, R, factor, raising.distance);
    rates.satellite_orbit = month;
    rates.satellite_momentum = raising.mass / (1.0 + raising.mass) * month * ratio * ratio / factor;
  }
  return rates;
}

const std::vector<std::string> usual_columns = {"obliquity", "precession", "climatic_precession"};

// [planet], with what the planet `name` fills in.
class PlanetBuilder {
 public:
  PlanetBuilder(const KindContext& at, const Obliquity* base)
      : at_(at), planet_(at.values, at.units, path_, at.name), base_(base) {}

  Obliquity made() {
    known_ = planet_.has("name") ? planet_spin(planet_.word("name")) : nullptr;
    Obliquity of = base_ != nullptr ? *base_ : on_orbit();
    of.time = times_of(time_table(at_), true);
    of.columns = columns();
    of.insolation = insolation(of.columns);
    require_cover(of);
    const OrbitElements start = of.history.at(0.0);
    of.initial = pole(start, of.axes);
    const PlanetSatellites bodies(at_, planet_, known_);
    of.rates = rates(start, of.initial, bodies);
    of.tides.reset();
    if (bodies.has_tides()) of.tides = bodies.tides(spin_rate(), mean_motion());
    require_tides(of);
    require_steady(of);
    of.method = method();
    return of;
  }

 private:
  Obliquity on_orbit() const {
    const std::vector<std::string> paths = orbit_paths(at_.values);
    const std::string& name = planet_.word("orbit");
    std::vector<std::string_view> names;
    for (const std::string& path : paths) {
      names.push_back(key_name(path));
      if (names.back() == name) return on_orbit(path);
    }
    if (names.empty()) planet_.refuse("orbit", "expected a table [orbit." + name + "] as well");
    planet_.refuse("orbit", "expected the name of an orbit of this file: " + one_of(names) +
                                did_you_mean(name, names));
  }

  Obliquity on_orbit(const std::string& path) const {
    const OrbitKind* const kind = at_.kinds.orbit(word(at_.values, path + ".kind"));
    if (kind == nullptr || !kind->history) {
      std::vector<std::string_view> known;
      for (const OrbitKind& one : at_.kinds.orbits())
        if (one.history) known.push_back(one.name);
      refuse(at_.values, path + ".kind", at_.name,
             "expected a history of elements, " + one_of(known, "\""));
    }
    const std::optional<SaveAt> rows = times_of(time_table(at_), true);
    OrbitUses uses;
    const KeyValues table(at_.values, at_.units, path, at_.name);
    ScenarioHistory orbit =
        table.built("kind", [&] { return kind->history(OrbitContext(table, rows, uses)); });
    return {.planet = planet_.has("name") ? planet_.word("name") : "",
            .orbit = planet_.word("orbit"),
            .orbit_kind = std::string(kind->name),
            .orbit_text = orbit.text,
            .warnings = orbit.warnings,
            .axes = orbit.is_inertial ? "inertial" : "ecliptic-J2000",
            .history = std::move(orbit.elements),
            .rates = {},
            .initial = {},
            .columns = {}};
  }

  // Where the times would do with the other sign.
  static std::string direction_hint(const OrbitHistory& history, double first, double last) {
    const bool fits = history.first_time() <= -last && history.last_time() >= -first;
    return fits ? "; where its times count years before present, time_direction = "
                  "\"before-present\" in its table"
                : "";
  }

  // t = 0 and all rows.
  void require_cover(const Obliquity& of) const {
    double first = 0.0, last = 0.0;
    if (of.time) {
      for (const double t : {(*of.time)[0], (*of.time)[of.time->size() - 1]}) {
        first = std::min(first, t);
        last = std::max(last, t);
      }
    }
    if (of.history.first_time() <= first && of.history.last_time() >= last) return;
    const auto text = [&](double t) {
      return number_text(at_.units.from_core(t, Dimension::time));
    };
    refuse(at_.values, "planet.orbit", at_.name,
           "its orbit covers the times " + text(of.history.first_time()) + " to " +
               text(of.history.last_time()) + " " + at_.units.time() +
               "; expected all of the run, " + text(first) + " to " + text(last) +
               " (t = 0 is part of it)" + direction_hint(of.history, first, last));
  }

  SpinAxis pole(const OrbitElements& start, const std::string& axes) const {
    if (planet_.has("pole.obliquity")) {
      const double obliquity = planet_.number("pole.obliquity"),
                   equinox = -planet_.number("pole.precession");
      if (!(obliquity >= 0.0 && obliquity <= std::numbers::pi * (1.0 + 1e-15)))
        planet_.refuse("pole.obliquity", "expected an angle from 0 to 180 deg");
      // spin_angles the other way round
      const Vec3 s{-std::sin(obliquity) * std::sin(equinox),
                   std::sin(obliquity) * std::cos(equinox), std::cos(obliquity)};
      return spin_axis(rotate(equinoctial_attitude(start), s));
    }
    const bool is_given = planet_.has("pole.ra");
    if (!is_given && known_ == nullptr)
      refuse(at_.values, "planet", at_.name, "expected a key pole, or the name of a planet");
    if (axes == "inertial")
      planet_.refuse(is_given ? "pole.ra" : "name",
                     is_given ? "ra and dec need an orbit along axes of J2000; expected obliquity "
                                "and precession"
                              : "its pole needs an orbit along axes of J2000; expected a key pole "
                                "with obliquity and precession");
    if (!is_given) return spin_axis(planet_pole(*known_));
    const double dec = planet_.number("pole.dec");
    if (!(std::fabs(dec) <= 0.5 * std::numbers::pi * (1.0 + 1e-15)))
      planet_.refuse("pole.dec", "expected an angle from -90 to 90 deg");
    return spin_axis(ecliptic_direction(planet_.number("pole.ra"), dec));
  }

  // In core units.
  double second() const { return at_.units.to_core(1.0, "s", Dimension::time); }
  bool has_constant() const {
    return planet_.has("precession_rate") || planet_.has("precession_constant");
  }
  double of_planet(const char* key, double known) const {
    if (planet_.has(key)) return planet_.number(key);
    if (known_ == nullptr && has_constant()) refuse_without(at_, key);
    if (known_ == nullptr)
      refuse(at_.values, "planet", at_.name,
             "expected precession_rate, precession_constant, the name of a planet, or all of "
             "ellipticity, rotation_period and orbital_period; got no " +
                 std::string(key));
    return known;
  }

  double spin_rate() const {
    const double turn = 2.0 * std::numbers::pi;
    const double day =
        of_planet("rotation_period", known_ ? turn / known_->spin_rate * second() : 0.0);
    if (day == 0.0) planet_.refuse("rotation_period", "expected a period other than 0");
    return turn / day;
  }
  double mean_motion() const {
    return 2.0 * std::numbers::pi /
           of_planet("orbital_period", known_ ? known_->orbital_period * second() : 0.0);
  }

  // star, of a circle, from whatever is given.
  double star(double satellites, const OrbitElements& start, const SpinAxis& initial,
              const PlanetSatellites& bodies) const {
    const bool by_rate = planet_.has("precession_rate");
    const bool by_constant = planet_.has("precession_constant");
    const char* const given = by_rate ? "precession_rate" : "precession_constant";
    if (by_rate && by_constant)
      planet_.refuse("precession_constant", "expected one of it and precession_rate");
    // satellites and tides need the periods whatever the constant is
    const bool needs_periods = !bodies.empty() || bodies.has_tides();
    for (const char* const key : {"ellipticity", "rotation_period", "orbital_period"})
      if ((by_rate || by_constant) && planet_.has(key) &&
          !(needs_periods && std::string_view(key) != "ellipticity"))
        planet_.refuse(key, std::string("expected none next to ") + given);
    if (by_rate || by_constant) bodies.refuse_inner(given);
    if (by_rate && planet_.number("J") != 0.0)
      planet_.refuse("J", "expected none next to precession_rate, which is that of this J");
    if (by_constant) return planet_.number("precession_constant") / (1.0 + satellites);
    if (by_rate)
      return planet_.built("precession_rate", [&] {
        return rates_of_precession(planet_.number("precession_rate"),
                                   dot(initial.s, orbit_normal(start)), orbit_plane(start).e2,
                                   satellites)
            .star;
      });
    const double E = of_planet("ellipticity", known_ ? known_->ellipticity : 0.0);
    const bool as_known = known_ != nullptr && !planet_.has("ellipticity") &&
                          !planet_.has("rotation_period") && !planet_.has("orbital_period");
    const double w = spin_rate(), n = mean_motion();
    return bodies.inner_factor(E, w) *
           (as_known ? known_->rates.star / second() : star_precession(E, w, n * n, 1.0));
  }

  double share_of_satellites(const PlanetSatellites& bodies, const PrecessionRates& known) const {
    if (bodies.empty())
      return planet_.has("satellites") ? planet_.number("satellites")
                                       : known.satellites / known.star;
    if (planet_.has("satellites"))
      planet_.refuse("satellites", "expected none next to tables planet.satellite");
    return bodies.outer_share(mean_motion());
  }

  PrecessionRates rates(const OrbitElements& start, const SpinAxis& initial,
                        const PlanetSatellites& bodies) const {
    const PrecessionRates none{.star = 1.0};
    const PrecessionRates& known = known_ != nullptr ? known_->rates : none;
    for (const char* const key : {"satellites", "ellipticity", "orbital_period"})
      require_range(key);
    const double satellites = share_of_satellites(bodies, known);
    const double of_star = star(satellites, start, initial, bodies);
    const double factor = andoyer_factor(planet_.number("J"));
    return {.star = factor * of_star,
            .satellites = factor * of_star * satellites,
            .geodetic =
                planet_.has("geodetic") ? planet_.number("geodetic") : known.geodetic / second(),
            .drift = planet_.number("tidal_drift")};
  }

  void require_range(const char* key) const {
    if (planet_.has(key)) detail::require_range(at_.values, planet_.key_path(key), at_.name);
  }

  void require_steady(const Obliquity& of) const {
    if (!of.time) return;
    planet_.built("tidal_drift", [&] {
      require_drift(of.rates, (*of.time)[0], (*of.time)[of.time->size() - 1]);
      return true;
    });
  }
  void require_tides(const Obliquity& of) const {
    if (!of.tides && std::find(of.columns.begin(), of.columns.end(), "tides") != of.columns.end())
      refuse_columns(at_, "expected a table planet.tides for the columns tides");
  }

  std::vector<std::string> columns() const {
    if (!output_table(at_).is_explicit<&OutputTable::columns>()) return usual_columns;
    const std::vector<std::string_view> known = spin_column_groups();
    for (const std::string& column : at_.output.columns)
      if (std::find(known.begin(), known.end(), column) == known.end())
        refuse_columns(at_, "expected columns of kind \"obliquity\": " + one_of(known));
    return at_.output.columns;
  }

  std::optional<InsolationPlace> insolation(const std::vector<std::string>& columns) const {
    if (!planet_.has("insolation.latitude")) {
      if (std::find(columns.begin(), columns.end(), "insolation") != columns.end())
        refuse_columns(at_, "expected a table planet.insolation for the column insolation");
      return std::nullopt;
    }
    const double latitude = planet_.number("insolation.latitude");
    if (!(std::fabs(latitude) <= 0.5 * std::numbers::pi * (1.0 + 1e-15)))
      planet_.refuse("insolation.latitude", "expected an angle from -90 to 90 deg");
    require_range("insolation.flux");
    return InsolationPlace{latitude, planet_.number("insolation.longitude"),
                           planet_.number("insolation.flux")};
  }

  Method method() const {
    Method method = method_of(at_).value_or(default_model_method);
    if (!moves_any_state(method) && method_of_frozen_models(method) == nullptr)
      refuse(at_.values, "method.kind", at_.name,
             "expected \"adaptive\", \"collocation\" or \"splitting\"");
    return method;
  }

  const KindContext& at_;
  std::string path_ = "planet";
  KeyValues planet_;
  const Obliquity* base_;
  const PlanetSpin* known_ = nullptr;
};

}  // namespace

Obliquity made_obliquity(const KindContext& at, const Obliquity* base) {
  return PlanetBuilder(at, base).made();
}

}  // namespace detail

const std::optional<SaveAt>& row_times(const Obliquity& of) { return of.time; }
bool has_events(const Obliquity&) { return false; }
std::optional<Method> propagation_method(const Obliquity& of) { return of.method; }

BasicProblem<SpinOnHistory> spin_problem(const Obliquity& of) {
  if (!of.time) throw DomainError("spin_problem: got no [time]; expected its rows");
  const SaveAt& rows = *of.time;
  return {SpinOnHistory(of.history, of.rates), of.initial, 0.0, rows[rows.size() - 1], of.method};
}
BasicProblem<TidalSpinOnHistory> tidal_problem(const Obliquity& of) {
  if (!of.tides) throw DomainError("tidal_problem: got no tides; expected [planet.tides]");
  const BasicProblem<SpinOnHistory> without = spin_problem(of);
  return {TidalSpinOnHistory(of.history, of.rates, *of.tides),
          {.s = of.initial.s},
          without.start,
          without.stop,
          of.method};
}

}  // namespace v0
}  // namespace polhode
