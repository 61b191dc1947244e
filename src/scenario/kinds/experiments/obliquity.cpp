// SPDX-License-Identifier: MIT
// The experiment of kind "obliquity" from the tables of a file.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "output/obliquity_columns.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/detail/made_experiments.hpp"
#include "scenario/kinds/experiments/planet_satellites.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/tables/head.hpp"
#include "scenario/tables/planet.hpp"
#include "scenario/tables/time.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

const std::vector<std::string> usual_columns = {"obliquity", "precession", "climatic_precession"};

template <auto member, class A>
double latitude(const Placed<A>& from) {
  const double angle = (*from).*member;
  if (!(std::fabs(angle) <= 0.5 * std::numbers::pi * (1.0 + 1e-15)))
    from.template refuse<member>("expected an angle from -90 to 90 deg");
  return angle;
}

// [planet], with what the planet `name` fills in.
class PlanetBuilder {
 public:
  PlanetBuilder(const KindContext& at, const Obliquity* base)
      : at_(at),
        planet_(planet_table(at)),
        base_(base),
        known_(planet_->name ? secular::planet_spin(*planet_->name) : nullptr) {}

  Obliquity made() const {
    Obliquity of = base_ != nullptr ? *base_ : on_orbit();
    of.time = times_of(time_table(at_), true);
    of.columns = columns();
    of.insolation = insolation(of.columns);
    require_cover(of);
    const secular::OrbitElements start = of.history.at(0.0);
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
    const std::string& name = planet_->orbit;
    std::vector<std::string_view> names;
    for (const std::string& path : paths) {
      names.push_back(key_name(path));
      if (names.back() == name) return on_orbit(path);
    }
    if (names.empty())
      planet_.refuse<&PlanetTable::orbit>("expected a table [orbit." + name + "] as well");
    planet_.refuse<&PlanetTable::orbit>(
        "expected the name of an orbit of this file: " + one_of(names) + did_you_mean(name, names));
  }

  Obliquity on_orbit(const std::string& path) const {
    const KeyValues table(at_.values, at_.units, path, at_.name);
    const OrbitKind* const kind = at_.kinds.orbit(table.word("kind"));
    if (kind == nullptr || !kind->history) {
      std::vector<std::string_view> known;
      for (const OrbitKind& one : at_.kinds.orbits())
        if (one.history) known.push_back(one.name);
      table.refuse("kind", "expected a history of elements, " + one_of(known, "\""));
    }
    const std::optional<SaveAt> rows = times_of(time_table(at_), true);
    OrbitUses uses;
    ScenarioHistory orbit =
        table.built("kind", [&] { return kind->history(OrbitContext(table, rows, uses)); });
    return {.planet = planet_->name.value_or(""),
            .orbit = planet_->orbit,
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
  static std::string direction_hint(const secular::OrbitHistory& history, double first,
                                    double last) {
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
      return polhode::detail::number_text(at_.units.from_core(t, Dimension::time));
    };
    planet_.refuse<&PlanetTable::orbit>(
        "its orbit covers the times " + text(of.history.first_time()) + " to " +
        text(of.history.last_time()) + " " + at_.units.time() + "; expected all of the run, " +
        text(first) + " to " + text(last) + " (t = 0 is part of it)" +
        direction_hint(of.history, first, last));
  }

  secular::SpinAxis pole(const secular::OrbitElements& start, const std::string& axes) const {
    const Placed<PoleTable> pole = pole_table(at_);
    if (pole->obliquity) {
      const double obliquity = *pole->obliquity, equinox = -pole->precession;
      if (!(obliquity >= 0.0 && obliquity <= std::numbers::pi * (1.0 + 1e-15)))
        pole.refuse<&PoleTable::obliquity>("expected an angle from 0 to 180 deg");
      // spin_angles the other way round
      const Vec3 s{-std::sin(obliquity) * std::sin(equinox),
                   std::sin(obliquity) * std::cos(equinox), std::cos(obliquity)};
      return secular::spin_axis(rotate(secular::equinoctial_attitude(start), s));
    }
    if (!pole->ra && known_ == nullptr)
      planet_.refuse("expected a key pole, or the name of a planet");
    if (axes == "inertial" && pole->ra)
      pole.refuse<&PoleTable::ra>(
          "ra and dec need an orbit along axes of J2000; expected obliquity and precession");
    if (axes == "inertial")
      planet_.refuse<&PlanetTable::name>(
          "its pole needs an orbit along axes of J2000; expected a key pole with obliquity and "
          "precession");
    if (!pole->ra) return secular::spin_axis(secular::planet_pole(*known_));
    return secular::spin_axis(
        secular::ecliptic_direction(*pole->ra, latitude<&PoleTable::dec>(pole)));
  }

  // In core units.
  double second() const { return at_.units.to_core(1.0, "s", Dimension::time); }
  bool has_constant() const { return planet_->precession_rate || planet_->precession_constant; }
  template <auto member>
  double of_planet(double known) const {
    if (const std::optional<double>& own = (*planet_).*member) return *own;
    if (known_ == nullptr && has_constant()) refuse_without<member>(planet_);
    if (known_ == nullptr)
      planet_.refuse(
          "expected precession_rate, precession_constant, the name of a planet, or all of "
          "ellipticity, rotation_period and orbital_period; got no " +
          std::string(planet_.name<member>()));
    return known;
  }

  double spin_rate() const {
    const double turn = 2.0 * std::numbers::pi;
    const double day = of_planet<&PlanetTable::rotation_period>(
        known_ ? turn / known_->spin_rate * second() : 0.0);
    if (day == 0.0) planet_.refuse<&PlanetTable::rotation_period>("expected a period other than 0");
    return turn / day;
  }
  double mean_motion() const {
    return 2.0 * std::numbers::pi /
           of_planet<&PlanetTable::orbital_period>(known_ ? known_->orbital_period * second()
                                                          : 0.0);
  }

  void require_constant_alone(const PlanetSatellites& bodies) const {
    const std::string given = planet_->precession_rate ? "precession_rate" : "precession_constant";
    const std::string none = "expected none next to " + given;
    if (planet_->precession_rate && planet_->precession_constant)
      planet_.refuse<&PlanetTable::precession_constant>("expected one of it and precession_rate");
    if (planet_->ellipticity) planet_.refuse<&PlanetTable::ellipticity>(none);
    // satellites and tides need the periods whatever the constant is
    const bool needs_periods = !bodies.empty() || bodies.has_tides();
    if (planet_->rotation_period && !needs_periods)
      planet_.refuse<&PlanetTable::rotation_period>(none);
    if (planet_->orbital_period && !needs_periods)
      planet_.refuse<&PlanetTable::orbital_period>(none);
    bodies.refuse_inner(given);
    if (planet_->precession_rate && planet_->J != 0.0)
      planet_.refuse<&PlanetTable::J>(
          "expected none next to precession_rate, which is that of this J");
  }

  // The rate by the star on a circle, from whatever is given.
  double star(double satellites, const secular::OrbitElements& start,
              const secular::SpinAxis& initial, const PlanetSatellites& bodies) const {
    if (has_constant()) require_constant_alone(bodies);
    if (planet_->precession_constant) return *planet_->precession_constant / (1.0 + satellites);
    if (planet_->precession_rate)
      return planet_.built<&PlanetTable::precession_rate>([&] {
        return secular::rates_of_precession(*planet_->precession_rate,
                                            dot(initial.s, secular::orbit_normal(start)),
                                            secular::orbit_plane(start).e2, satellites)
            .star;
      });
    const double E = of_planet<&PlanetTable::ellipticity>(known_ ? known_->ellipticity : 0.0);
    const bool as_known = known_ != nullptr && !planet_->ellipticity && !planet_->rotation_period &&
                          !planet_->orbital_period;
    const double w = spin_rate(), n = mean_motion();
    return bodies.inner_factor(E, w) *
           (as_known ? known_->rates.star / second() : secular::star_precession(E, w, n * n, 1.0));
  }

  double share_of_satellites(const PlanetSatellites& bodies,
                             const secular::PrecessionRates& known) const {
    if (bodies.empty())
      return planet_->satellites ? *planet_->satellites : known.satellites / known.star;
    if (planet_->satellites)
      planet_.refuse<&PlanetTable::satellites>("expected none next to tables planet.satellite");
    return bodies.outer_share(mean_motion());
  }

  secular::PrecessionRates rates(const secular::OrbitElements& start,
                                 const secular::SpinAxis& initial,
                                 const PlanetSatellites& bodies) const {
    const secular::PrecessionRates none{.star = 1.0};
    const secular::PrecessionRates& known = known_ != nullptr ? known_->rates : none;
    const double satellites = share_of_satellites(bodies, known);
    const double of_star = star(satellites, start, initial, bodies);
    const double factor = secular::andoyer_factor(planet_->J);
    return {.star = factor * of_star,
            .satellites = factor * of_star * satellites,
            .geodetic = planet_->geodetic ? *planet_->geodetic : known.geodetic / second(),
            .drift = planet_->tidal_drift};
  }

  void require_steady(const Obliquity& of) const {
    if (!of.time) return;
    planet_.built<&PlanetTable::tidal_drift>([&] {
      secular::require_drift(of.rates, (*of.time)[0], (*of.time)[of.time->size() - 1]);
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

  std::optional<secular::InsolationPlace> insolation(
      const std::vector<std::string>& columns) const {
    const Placed<InsolationTable> place = insolation_table(at_);
    if (!place.is_there()) {
      if (std::find(columns.begin(), columns.end(), "insolation") != columns.end())
        refuse_columns(at_, "expected a table planet.insolation for the column insolation");
      return std::nullopt;
    }
    return secular::InsolationPlace{latitude<&InsolationTable::latitude>(place), place->longitude,
                                    place->flux};
  }

  Method method() const {
    Method method = method_of(at_).value_or(default_model_method);
    if (!moves_any_state(method) && method_of_frozen_models(method) == nullptr)
      refuse_method(at_, "expected \"adaptive\", \"collocation\" or \"splitting\"");
    return method;
  }

  const KindContext& at_;
  Placed<PlanetTable> planet_;
  const Obliquity* base_;
  const secular::PlanetSpin* known_;
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

}  // namespace io
}  // namespace v0
}  // namespace polhode
