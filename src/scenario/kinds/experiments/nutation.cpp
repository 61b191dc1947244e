// SPDX-License-Identifier: MIT
// kind = "nutation".
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "polhode/detail/scenario/planet_nutation.hpp"
#include "polhode/text/separated.hpp"
#include "polhode/text/units.hpp"
#include "scenario/detail/built_in_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

enum class Planet : std::size_t {};  // its place among nutation_planets

struct Arguments {
  Planet planet;
  std::string epoch;
  std::optional<double> ellipticity, triaxiality, spin_rate, obliquity, satellite_mass;
  double least;
};

constexpr KindKey<Arguments> keys[] = {
    choice_key<&Arguments::planet, Planet{0}, Planet{1}, Planet{2}>(
        "planet", nutation_planets,
        "Whose nutation: the Earth under Moon and Sun, or another under the Sun.")
        .required()
        .example("\"earth\""),
    epoch_key<&Arguments::epoch>(
        "epoch", "The date of t = 0. The obliquity and the eccentricities are those of then.")
        .otherwise("\"JD 2451545.0 TDB\"")
        .shown(),
    quantity_key<&Arguments::ellipticity>("ellipticity", Dimension::number,
                                          "H = (C - (A + B)/2) / C. Left out, that of the planet.")
        .example("0.0032737548")
        .positive(),
    quantity_key<&Arguments::triaxiality>("triaxiality", Dimension::number,
                                          "(B - A) / C. Left out, that of the planet.")
        .example("0.0")
        .not_negative(),
    quantity_key<&Arguments::spin_rate>("spin_rate", Dimension::rate,
                                        "Left out, that of the planet.")
        .example("\"7.292115e-5 rad/s\"")
        .positive(),
    quantity_key<&Arguments::obliquity>(
        "obliquity", Dimension::angle,
        "Of the mean equator on the orbit of date. Left out, that of the planet at the epoch.")
        .example("\"84381.406 arcsec\"")
        .positive(),
    quantity_key<&Arguments::satellite_mass>(
        "satellite_mass", Dimension::number,
        "Mass of the Moon over that of the Earth. Left out, that of DE440.")
        .example("0.0123000371")
        .positive(),
    quantity_key<&Arguments::least>("least", Dimension::angle, "Smaller terms are left out.")
        .otherwise("\"1 uas\"")
        .positive(),
};

// In the core unit of time of the file; the theory counts seconds.
double second_of(const ExperimentContext& at) {
  return at.units().to_core(1.0, "s", Dimension::time);
}

// Number by number, so that one out of its range is refused at its key.
PlanetNutation request_of(const Arguments& a, const ExperimentContext& at) {
  PlanetNutation of;
  of.planet = separated(nutation_planets, '|').at(static_cast<std::size_t>(a.planet));
  const auto take = [&](std::string_view key, auto PlanetNutation::*member, const auto& value) {
    at.built(key, [&] {
      of.*member = value();
      return polhode::io::completed(of);
    });
  };
  const auto spin_rate = [&]() -> std::optional<double> {
    if (!a.spin_rate) return {};
    return *a.spin_rate * second_of(at);
  };
  take("epoch", &PlanetNutation::T, [&] { return julian_centuries(epoch_date(a.epoch)); });
  take("ellipticity", &PlanetNutation::ellipticity, [&] { return a.ellipticity; });
  take("triaxiality", &PlanetNutation::triaxiality, [&] { return a.triaxiality; });
  take("spin_rate", &PlanetNutation::spin_rate, spin_rate);
  take("obliquity", &PlanetNutation::obliquity, [&] { return a.obliquity; });
  take("satellite_mass", &PlanetNutation::satellite_mass, [&] { return a.satellite_mass; });
  take("least", &PlanetNutation::least, [&] { return a.least; });
  return of;
}

// Made when it is asked for: what a file says is read, described and cited without it.
class Lazy {
 public:
  explicit Lazy(PlanetNutation of) : of_(std::move(of)) {}
  const secular::NutationTheory& theory() const {
    std::call_once(once_, [&] { theory_.emplace(nutation_theory(of_)); });
    return *theory_;
  }

 private:
  PlanetNutation of_;
  mutable std::once_flag once_;
  mutable std::optional<secular::NutationTheory> theory_;
};

// Longitude and obliquity of each axis, then of that of rotation once more, for the rate relative
// to the ecliptic of date.
std::vector<CustomColumn> columns() {
  std::vector<std::string> axes(secular::planet_axes.begin(), secular::planet_axes.end());
  axes.emplace_back("relative");
  std::vector<CustomColumn> all;
  for (const std::string& axis : axes)
    for (const char* const angle : {"dpsi_", "deps_"})
      all.push_back({angle + axis, Dimension::angle});
  return all;
}

void fill(const secular::NutationTheory& theory, double t, std::span<double> row) {
  auto next = row.begin();
  secular::NutationOffset last{};
  for (std::size_t i = 0; i < secular::planet_axes.size(); ++i) {
    last = theory.at(static_cast<secular::PlanetAxis>(i), t);
    *next++ = last.longitude;
    *next++ = last.obliquity;
  }
  const secular::NutationOffset moved = theory.relative_offset();
  *next++ = last.longitude + moved.longitude;
  *next++ = last.obliquity + moved.obliquity;
}

CustomExperiment made(const Arguments& a, const ExperimentContext& at) {
  const PlanetNutation of = polhode::io::completed(request_of(a, at));
  CustomExperiment own{.kind = "nutation", .rows = at.rows(), .columns = columns()};
  const double second = second_of(at);
  const auto lazy = std::make_shared<const Lazy>(of);
  own.formula = [lazy, second](double t, std::span<double> row) {
    fill(lazy->theory(), t / second, row);
  };
  own.facts = {{"ellipticity", "dynamical ellipticity H", *of.ellipticity, Dimension::number},
               {"obliquity", "mean obliquity at t = 0", *of.obliquity, Dimension::angle}};
  // Of the epoch: no change of coefficients, and so one theory in place of three.
  own.more_facts = [of, second] {
    const secular::NutationTheory theory(nutation_problem(of));
    const secular::NutationOffset precession = theory.precession();
    return std::vector<SummaryItem>{
        {"precession", "precession in longitude", precession.longitude / second, Dimension::rate},
        {"obliquity_rate", "rate of the mean obliquity", precession.obliquity / second,
         Dimension::rate},
        {"terms", "terms of the axis of figure",
         static_cast<double>(theory.terms(secular::PlanetAxis::figure).size()), Dimension::number}};
  };
  return own;
}

}  // namespace

ExperimentKind nutation_kind() {
  ExperimentKind kind = experiment_kind<Arguments>(
      "nutation",
      "Nutation of a rigid planet: how its axes of momentum, figure and rotation swing.", keys,
      made, nutation_citations());
  kind.time_unit = "d";  // terms of 5 days to 18 years
  kind.angle_unit = "arcsec";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
